// Helpers of the client's tests: temporary files, shared test data, a mesh, and processor time.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "isofield/client.h"

namespace isofield {

// An empty directory, which is removed with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::size_t file_count() const;

 private:
  std::string path_;
};

// Writes a file and returns its path.
std::string write_file(const std::string& path, std::string_view data);

// Returns the path of a file of the shared test data, or "" if it is missing. The test must then be skipped with this
// macro.
std::string shared_data(const std::string& name);
#define ISOFIELD_SKIP_WITHOUT(path) \
  if ((path).empty()) GTEST_SKIP() << "SKIPPED, NOT TESTED: shared test data is missing; set ISOFIELD_SHARED"

// Makes a closed torus around the y axis with outward normals; it has 2 * rings * sides triangles.
Mesh torus_mesh(int rings, int sides, float major_radius, float minor_radius);

// Returns seconds of processor time since the process began, which a loaded machine does not stretch.
double processor_seconds();

}  // namespace isofield
