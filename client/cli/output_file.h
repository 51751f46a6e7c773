#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace isofield {

// Writes an output file that appears under its name only when it is complete: the bytes go to a temporary file in the
// same directory, which commit() renames. Without a commit the destructor removes it. "-" is the standard output; it
// and any other file that is not a regular one (a pipe, /dev/null) are written directly.
//
// It is single-threaded. Errors name the path. An interrupted process can remove only the file that was created last;
// see remove_output_when_interrupted().
class OutputFile {
 public:
  static absl::StatusOr<std::unique_ptr<OutputFile>> create(const std::string& path);
  // Returns the error that create() would certainly meet, such as a missing directory. Commands ask before long work;
  // nothing is created.
  static absl::Status check(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  absl::Status write(const void* data, std::size_t bytes);
  absl::Status write(const std::string& text) { return write(text.data(), text.size()); }
  // Overwrites bytes that are already written, such as a header that states a count. FAILED_PRECONDITION: the output is
  // not a regular file.
  absl::Status rewrite(std::uint64_t offset, const void* data, std::size_t bytes);
  // Writes the buffered bytes, closes the file and gives it its name.
  absl::Status commit();

  // The number of bytes passed to write() so far.
  std::uint64_t bytes() const { return flushed_ + buffer_.size(); }

 private:
  OutputFile(std::string path, std::string temporary, int descriptor);
  absl::Status flush();
  absl::Status write_through(const char* data, std::size_t bytes);

  const std::string path_;
  const std::string temporary_;  // the temporary name; empty if the output is written directly
  int descriptor_;
  std::vector<char> buffer_;
  std::uint64_t flushed_ = 0;
};

// Makes SIGINT, SIGTERM and SIGHUP remove the temporary file before they end the process. main() calls this once.
void remove_output_when_interrupted();
// Makes SIGINT and SIGTERM a normal end of the program: the temporary file is removed and the exit code is 0.
void end_well_when_interrupted();

}  // namespace isofield
