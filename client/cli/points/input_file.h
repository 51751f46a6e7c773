#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <cstdio>
#include <memory>
#include <string>

namespace isofield {

// Reads the bytes of a file or of the standard input. The first bytes can be looked at before they are read. It owns
// the file, which it closes, but not the standard input. It is single-threaded.
class InputFile {
 public:
  // "-" is the standard input. NOT_FOUND, PERMISSION_DENIED ...: the file cannot be opened.
  static absl::StatusOr<InputFile> open(const std::string& path);

  // Returns the first bytes, at most 512; read() returns them again.
  absl::string_view start() const { return start_; }
  // Reads up to `bytes`; fewer only at the end. UNKNOWN ...: the file cannot be read.
  absl::StatusOr<std::size_t> read(void* data, std::size_t bytes);

  // The name for errors; that of the standard input is "<stdin>".
  const std::string& name() const { return name_; }

 private:
  struct Close {
    // The standard input belongs to the process.
    void operator()(FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  InputFile(FILE* file, std::string name) : file_(file), name_(std::move(name)) {}

  std::unique_ptr<FILE, Close> file_;
  std::string name_;
  std::string start_;
  std::size_t start_read_ = 0;
};

}  // namespace isofield
