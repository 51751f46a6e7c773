#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace isofield {

// A file that appears under its name only when it is complete: it is written under a temporary name in the same
// directory and renamed by commit(). Without a commit nothing stays behind. "-" is the standard output, and what is no
// regular file (a pipe, /dev/null) is written directly.
//
// Single-threaded. Errors name the path. One file at a time is removed when the process is interrupted; see
// remove_output_when_interrupted().
class OutputFile {
 public:
  static absl::StatusOr<std::unique_ptr<OutputFile>> create(const std::string& path);
  // What create() is sure to fail with, such as a missing directory: to be asked before long work. Creates nothing.
  static absl::Status check(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  absl::Status write(const void* data, std::size_t bytes);
  absl::Status write(const std::string& text) { return write(text.data(), text.size()); }
  // Overwrites bytes already written, such as a header that states a count. FAILED_PRECONDITION: not a regular file.
  absl::Status rewrite(std::uint64_t offset, const void* data, std::size_t bytes);
  absl::Status commit();

  std::uint64_t bytes() const { return flushed_ + buffer_.size(); }

 private:
  OutputFile(std::string path, std::string temporary, int descriptor);
  absl::Status flush();
  absl::Status write_through(const char* data, std::size_t bytes);

  const std::string path_;
  const std::string temporary_;  // empty: written directly
  int descriptor_;
  std::vector<char> buffer_;
  std::uint64_t flushed_ = 0;
};

// Makes SIGINT, SIGTERM and SIGHUP remove the temporary file before they end the process. Once, at the start.
void remove_output_when_interrupted();
// Makes SIGINT and SIGTERM a normal end of the program: the temporary file is removed and the exit code is 0.
void end_well_when_interrupted();

}  // namespace isofield
