#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "isofield/client.h"

namespace isofield {

// An empty directory that goes away with the object.
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

std::string write_file(const std::string& path, std::string_view data);

// A file of the shared test data, or "" where it is missing: then skip, with this macro.
std::string shared_data(const std::string& name);
#define ISOFIELD_SKIP_WITHOUT(path) \
  if ((path).empty()) GTEST_SKIP() << "SKIPPED, NOT TESTED: shared test data is missing; set ISOFIELD_SHARED"

// A closed torus around the y axis with outward normals; 2 * rings * sides triangles.
Mesh torus_mesh(int rings, int sides, float major_radius, float minor_radius);

// Seconds of processor time since the process began: what a loaded machine does not stretch.
double processor_seconds();

}  // namespace isofield
