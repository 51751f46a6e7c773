// Compiled kernels on disk, by the text that they were compiled from.
#pragma once

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
  // Empty: keeps nothing.
  explicit SpirvStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Nothing where there is no such file, or where it is cut short, changed, or of another text.
  std::optional<std::vector<std::uint32_t>> load(std::string_view text) const;
  // A failure leaves what was there: the kernel is compiled again.
  void save(std::string_view text, const std::vector<std::uint32_t>& spirv) const;

 private:
  std::filesystem::path path_of(std::string_view text) const;

  std::filesystem::path folder_;
};

}  // namespace isofield::engine
