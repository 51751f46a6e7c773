// Compiled kernels on disk, by the text that they were compiled from.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace isofield::engine {

// A file a kernel, named by the hash of its text, which it holds beside the SPIR-V. Thread-safe; processes may share a
// folder.
class SpirvStore {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{256} << 20;

  // An empty folder's name means that nothing is kept. If the folder holds more than `most_bytes`, the files that have
  // not been read or written for longest are removed. This happens on construction, and whenever a further sixteenth of
  // `most_bytes` has been saved.
  explicit SpirvStore(std::filesystem::path folder, std::uintmax_t most_bytes = kMostBytes);

  // Nothing where there is no such file, or where it is cut short, changed, or of another text.
  std::optional<std::vector<std::uint32_t>> load(std::string_view text) const;
  // A failure leaves what was there: the kernel is compiled again.
  void save(std::string_view text, const std::vector<std::uint32_t>& spirv) const;

 private:
  std::filesystem::path path_of(std::string_view text) const;
  void prune() const;

  const std::filesystem::path folder_;
  const std::uintmax_t most_bytes_;
  mutable std::atomic<std::uintmax_t> saved_bytes_ = 0;  // since the last prune()
};

}  // namespace isofield::engine
