// Directories and files for the tests of processes.
#pragma once

#include <filesystem>
#include <string>

namespace isofield::integration_test {

// An empty directory, which is removed with the object. Its path is short, because paths of unix sockets must be short.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  // Returns the names of the files in it.
  std::string listing() const;

 private:
  std::filesystem::path path_;
};

void write_file(const std::string& path, const std::string& data);
std::string read_file(const std::string& path);

}  // namespace isofield::integration_test
