// Keeps compiled kernels on disk, by the text that they were compiled from, so that a later process need not compile
// them.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace isofield::engine {

// Each kernel is a file, named by the hash of its text; the file holds the text and the SPIR-V. Thread-safe; several
// processes may share a folder.
class SpirvStore {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{256} << 20;

  // If the folder's name is empty, nothing is kept. If the folder holds more than `most_bytes`, the store removes the
  // files that have not been read or written for longest. It does so on construction, and whenever a further sixteenth
  // of `most_bytes` has been saved.
  explicit SpirvStore(std::filesystem::path folder, std::uintmax_t most_bytes = kMostBytes);

  // Returns nothing if there is no such file, or if the file is cut short, was changed, or belongs to another text.
  std::optional<std::vector<std::uint32_t>> load(std::string_view text) const;
  // A failure leaves the folder as it was; the kernel is then compiled again when it is next needed.
  void save(std::string_view text, const std::vector<std::uint32_t>& spirv) const;

 private:
  std::filesystem::path path_of(std::string_view text) const;
  void prune() const;

  const std::filesystem::path folder_;
  const std::uintmax_t most_bytes_;
  mutable std::atomic<std::uintmax_t> saved_bytes_ = 0;  // since the last prune()
};

}  // namespace isofield::engine
