// CodeSet is a set of opcodes or of operands that the instructions of a tape may hold. A kernel is specialised to such
// sets.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace isofield::blobtree {

// The enumeration `Code` has at most 256 members.
template <class Code>
class CodeSet {
 public:
  static constexpr std::size_t kWords = 8;
  // The enumeration needs this many words; kernels know of no others.
  static constexpr std::size_t kUsedWords = (static_cast<std::size_t>(Code::kCount) + 31) / 32;
  static_assert(kUsedWords <= kWords);

  CodeSet() = default;
  CodeSet(std::initializer_list<Code> codes) {
    for (const Code code : codes) add(code);
  }

  void add(Code code) { word(code) |= bit(code); }
  void remove(Code code) { word(code) &= ~bit(code); }
  void add(const CodeSet& other) {
    for (std::size_t i = 0; i < kWords; ++i) words_[i] |= other.words_[i];
  }
  bool has(Code code) const { return (words_[static_cast<std::size_t>(code) / 32] & bit(code)) != 0; }
  // Returns whether every member of the other set is in this one.
  bool contains(const CodeSet& other) const {
    for (std::size_t i = 0; i < kWords; ++i) {
      if ((other.words_[i] & ~words_[i]) != 0) return false;
    }
    return true;
  }
  int size() const {
    int count = 0;
    for (const std::uint32_t w : words_) count += std::popcount(w);
    return count;
  }
  // Bit i % 32 of word i / 32 tells whether the code of number i is in the set.
  const std::array<std::uint32_t, kWords>& words() const { return words_; }
  auto operator<=>(const CodeSet&) const = default;

 private:
  static std::uint32_t bit(Code code) { return 1u << static_cast<std::uint32_t>(code) % 32; }
  std::uint32_t& word(Code code) { return words_[static_cast<std::size_t>(code) / 32]; }

  std::array<std::uint32_t, kWords> words_{};
};

}  // namespace isofield::blobtree
