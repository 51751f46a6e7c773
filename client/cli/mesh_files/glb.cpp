#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <charconv>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "mesh_files/mesh_file.h"
#include "utf8.h"

// This file writes the binary form of glTF 2.0: a header, a chunk of JSON and a chunk of arrays. It does not use
// tinygltf, because here the arrays go to the file straight from the mesh; tinygltf makes two copies of them (measured
// for 2 million triangles, 48 MB: 0.08 s of processor time and 91 MB, against 0.02 s and no further memory).
namespace isofield {
namespace {

// Lengths in a GLB are 32-bit.
constexpr std::uint64_t kMaxBytes = std::numeric_limits<std::uint32_t>::max();
// These constants come from the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

// Returns the text as a JSON string. The name comes from a file's, whose bytes need not be UTF-8.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : valid_utf8(text)) {
    if (c == '"' || c == '\\') out.push_back('\\');
    if (static_cast<unsigned char>(c) < 0x20) {
      absl::StrAppendFormat(&out, "\\u%04x", c);
    } else {
      out.push_back(c);
    }
  }
  return out + "\"";
}

// Returns the properties "min" and "max" of x, y, z, exactly as these are in the array.
std::string bounds(const std::vector<float>& positions) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const glm::vec3 p = {positions[i], positions[i + 1], positions[i + 2]};
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto list = [](const glm::vec3& corner) {
    std::string out = "[";
    for (int axis = 0; axis < 3; ++axis) {
      char digits[32];
      out.append(digits, std::to_chars(digits, digits + sizeof(digits), corner[axis]).ptr);
      out.push_back(',');
    }
    out.back() = ']';
    return out;
  };
  return absl::StrCat("\"min\":", list(low), ",\"max\":", list(high));
}

// Builds the accessors and their buffer views, in the order in which the arrays follow each other. All numbers have 4
// bytes, so all views are aligned.
class Layout {
 public:
  // Adds an array and returns the number of its accessor.
  int add(std::uint64_t numbers, int components, int component_type, int target, const std::string& more) {
    const char* comma = count_ > 0 ? "," : "";
    absl::StrAppend(&views, comma, "{\"buffer\":0,\"byteOffset\":", bytes, ",\"byteLength\":", 4 * numbers,
                    ",\"target\":", target, "}");
    absl::StrAppend(&accessors, comma, "{\"bufferView\":", count_, ",\"componentType\":", component_type,
                    ",\"count\":", numbers / components, ",\"type\":\"", components == 3 ? "VEC3" : "SCALAR", "\"",
                    more, "}");
    bytes += 4 * numbers;
    return count_++;
  }

  std::string views, accessors;
  std::uint64_t bytes = 0;

 private:
  int count_ = 0;
};

// Returns the node's scale as JSON, and nothing for 1, which is the format's default.
std::string scale_property(double scale) {
  if (scale == 1) return "";
  char digits[32];
  const std::string text(digits, std::to_chars(digits, digits + sizeof(digits), scale).ptr);
  return absl::StrCat(R"(,"scale":[)", text, ",", text, ",", text, "]");
}

// Returns the JSON chunk. The format forbids empty arrays, so an empty surface becomes a scene without nodes.
std::string description(const Mesh& mesh, const std::string& name, double scale, Layout& layout) {
  std::string out = R"({"asset":{"version":"2.0","generator":"isofield"},"scene":0)";
  if (mesh.triangles.empty()) return out + R"(,"scenes":[{}]})";
  std::string attributes = absl::StrCat("\"POSITION\":", layout.add(mesh.positions.size(), 3, kFloat, kArrayBuffer,
                                                                    absl::StrCat(",", bounds(mesh.positions))));
  if (!mesh.normals.empty()) {
    absl::StrAppend(&attributes, ",\"NORMAL\":", layout.add(mesh.normals.size(), 3, kFloat, kArrayBuffer, ""));
  }
  const int indices = layout.add(mesh.triangles.size(), 1, kUnsignedInt, kElementArrayBuffer, "");
  absl::StrAppend(&out, R"(,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":)", quoted(name), scale_property(scale),
                  R"(}],"meshes":[{"name":)", quoted(name), R"(,"primitives":[{"attributes":{)", attributes,
                  R"(},"indices":)", indices, R"(,"material":0}]}])",
                  R"(,"materials":[{"name":"surface","pbrMetallicRoughness":{"baseColorFactor":[0.78,0.42,0.24,1],)",
                  R"("metallicFactor":0,"roughnessFactor":0.55}}],"buffers":[{"byteLength":)", layout.bytes,
                  R"(}],"bufferViews":[)", layout.views, R"(],"accessors":[)", layout.accessors, "]}");
  return out;
}

absl::Status write_words(std::initializer_list<std::uint32_t> words, OutputFile& file) {
  return file.write(words.begin(), words.size() * sizeof(std::uint32_t));
}

}  // namespace

absl::Status write_glb(const Mesh& mesh, const std::string& name, double scale, OutputFile& file) {
  constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  Layout layout;
  std::string json = description(mesh, name, scale, layout);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t binary_chunk = layout.bytes > 0 ? 8 + layout.bytes : 0;
  const std::uint64_t total = 12 + 8 + json.size() + binary_chunk;
  if (total > kMaxBytes) return absl::OutOfRangeError("a GLB file holds at most 4 GiB; write .ply, or coarser cells");
  absl::Status status = write_words({kMagic, 2, static_cast<std::uint32_t>(total)}, file);
  status.Update(write_words({static_cast<std::uint32_t>(json.size()), kJson}, file));
  status.Update(file.write(json));
  if (binary_chunk == 0) return status;
  status.Update(write_words({static_cast<std::uint32_t>(layout.bytes), kBinary}, file));
  status.Update(file.write(mesh.positions.data(), 4 * mesh.positions.size()));
  status.Update(file.write(mesh.normals.data(), 4 * mesh.normals.size()));
  status.Update(file.write(mesh.triangles.data(), 4 * mesh.triangles.size()));
  return status;
}

}  // namespace isofield
