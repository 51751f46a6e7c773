#include "engine/kernels/spirv_store.h"

#include <absl/strings/str_cat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "shaders/tape_compiler.h"

namespace isofield::engine {
namespace {

constexpr char kExtension[] = ".spv";

// A file begins with this head; the text and the SPIR-V follow.
struct Head {
  std::array<char, 8> magic{'i', 's', 'o', 'S', 'P', 'V', '0', '1'};
  std::uint64_t text_bytes = 0, spirv_bytes = 0;
  std::uint64_t hash = 0;  // covers the text and the SPIR-V
};
static_assert(sizeof(Head) == 32);

std::string_view bytes_of(const std::vector<std::uint32_t>& words) {
  return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0])};
}

Head head_of(std::string_view text, std::string_view spirv) {
  return {
      .text_bytes = text.size(), .spirv_bytes = spirv.size(), .hash = shaders::hash_of(spirv, shaders::hash_of(text))};
}

// Notes that a file has been used. Errors are ignored, since files of a read-only folder can be used as well.
void touch(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), ignored);
}

}  // namespace

SpirvStore::SpirvStore(std::filesystem::path folder, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {
  if (!folder_.empty()) prune();
}

void SpirvStore::prune() const {
  struct Kept {
    std::filesystem::file_time_type used;
    std::uintmax_t bytes;
    std::filesystem::path path;
  };
  std::vector<Kept> files;
  std::uintmax_t total = 0;
  // Other processes may remove files meanwhile; files that cannot be examined are skipped.
  std::error_code error;
  for (auto it = std::filesystem::directory_iterator(folder_, error); !error && it != std::filesystem::end(it);
       it.increment(error)) {
    std::error_code gone;
    // Half-written files of killed processes have more text after the extension; they count, and are removed, too.
    if (it->path().filename().string().find(kExtension) == std::string::npos) continue;
    Kept file{it->last_write_time(gone), 0, it->path()};
    if (!gone) file.bytes = it->file_size(gone);
    if (gone) continue;
    total += file.bytes;
    files.push_back(std::move(file));
  }
  if (total <= most_bytes_) return;
  std::sort(files.begin(), files.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& file : files) {
    if (total <= most_bytes_) break;
    if (std::filesystem::remove(file.path, error)) total -= file.bytes;
  }
}

std::filesystem::path SpirvStore::path_of(std::string_view text) const {
  return folder_ / absl::StrCat(absl::Hex(shaders::hash_of(text), absl::kZeroPad16), kExtension);
}

std::optional<std::vector<std::uint32_t>> SpirvStore::load(std::string_view text) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream file(path_of(text), std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t before = sizeof(Head) + text.size();
  if (content.size() <= before || (content.size() - before) % sizeof(std::uint32_t) != 0) return std::nullopt;
  const std::string_view spirv = std::string_view(content).substr(before);
  const Head expected = head_of(text, spirv);
  if (std::memcmp(content.data(), &expected, sizeof(expected)) != 0) return std::nullopt;
  if (std::string_view(content).substr(sizeof(Head), text.size()) != text) return std::nullopt;
  touch(path_of(text));
  std::vector<std::uint32_t> words(spirv.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), spirv.data(), spirv.size());
  return words;
}

void SpirvStore::save(std::string_view text, const std::vector<std::uint32_t>& spirv) const {
  if (folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const std::filesystem::path path = path_of(text);
  // The file is written under another name and then renamed, so that no process sees half of it.
  std::filesystem::path partial = path;
  static std::atomic<std::uint64_t> saves = 0;
  partial += absl::StrCat(".", getpid(), ".", ++saves);
  const Head head = head_of(text, bytes_of(spirv));
  bool is_written = false;
  {
    std::ofstream file(partial, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&head), sizeof(head));
    file << text << bytes_of(spirv);
    file.close();
    is_written = !file.fail();
  }
  if (is_written) std::filesystem::rename(partial, path, error);
  if (!is_written || error) {
    std::filesystem::remove(partial, error);
    return;
  }
  touch(path);
  if ((saved_bytes_ += sizeof(head) + text.size() + 4 * spirv.size()) < most_bytes_ / 16) return;
  saved_bytes_ = 0;
  prune();
}

}  // namespace isofield::engine
