#include <absl/strings/str_cat.h>

#include <algorithm>
#include <charconv>

#include "mesh_files/crease_normals.h"
#include "mesh_files/mesh_file.h"

namespace isofield {
namespace {

// Appends numbers to a block of text that goes to the file when it is full.
class TextBlock {
 public:
  explicit TextBlock(OutputFile& file) : file_(file) { text_.reserve(kBlock + kLongestLine); }

  template <typename T>
  void add(T number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), number).ptr;
    text_.append(digits, end);
  }
  void add(const char* text) { text_.append(text); }
  absl::Status end_line() {
    text_.push_back('\n');
    return text_.size() < kBlock ? absl::OkStatus() : flush();
  }
  absl::Status flush() {
    auto status = file_.write(text_);
    text_.clear();
    return status;
  }

 private:
  static constexpr std::size_t kBlock = 65536;
  static constexpr std::size_t kLongestLine = 256;
  OutputFile& file_;
  std::string text_;
};

absl::Status write_vectors(const char* keyword, const std::vector<float>& numbers, TextBlock& block) {
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    block.add(keyword);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.add(" ");
      block.add(numbers[i + axis]);
    }
    if (auto status = block.end_line(); !status.ok()) return status;
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status write_obj(const Mesh& mesh, const std::string& name, CreaseShading shading, const std::string& unit,
                       OutputFile& file) {
  const bool is_sharp = shading == CreaseShading::kSharp && !mesh.normals.empty();
  const CreaseNormals creases =
      is_sharp ? crease_normals(mesh) : CreaseNormals{.normals = mesh.normals, .corners = mesh.triangles};
  std::string object = name;
  std::replace_if(
      object.begin(), object.end(), [](unsigned char c) { return c <= ' '; }, '_');
  absl::Status status = file.write(
      absl::StrCat("# isofield\n", unit.empty() ? "" : absl::StrCat("# unit ", unit, "\n"), "o ", object, "\n"));
  TextBlock block(file);
  status.Update(write_vectors("v", mesh.positions, block));
  status.Update(write_vectors("vn", creases.normals, block));
  for (std::size_t i = 0; status.ok() && i < mesh.triangles.size(); i += 3) {
    block.add("f");
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint64_t vertex = mesh.triangles[i + corner] + std::uint64_t{1};
      block.add(" ");
      block.add(vertex);
      if (!mesh.normals.empty()) {
        block.add("//");
        block.add(creases.corners[i + corner] + std::uint64_t{1});
      }
    }
    status = block.end_line();
  }
  status.Update(block.flush());
  return status;
}

}  // namespace isofield
