// Cuts pruned tapes into windows: pieces that fit uniform buffers, each with the records that its instructions name.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/tape/parameter_layout.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// vec4s that a uniform buffer holds, and from a multiple of which on it may be bound.
inline constexpr std::uint32_t kWindowSize = 4096;
inline constexpr std::uint32_t kWindowAlignment = 16;

// Where the parts of a window begin, in vec4s from the start of what WindowPacker::finish() returns. Records that fit
// whole are not copied: `leaves` and `operations` are kWhole then, and places in them are those of the whole.
struct Window {
  static constexpr std::uint32_t kWhole = ~0u;
  std::uint32_t code, leaves = kWhole, operations = kWhole;
};

class WindowPacker {
 public:
  // What is of a tape is kept by reference; `code` holds the tapes pruned from it.
  WindowPacker(const Tape& tape, const ParameterBuffers& parameters, const std::vector<Instruction>& code);

  static constexpr std::uint32_t kNoWindow = ~0u;
  // Puts the `count` instructions from `begin` on into the last window, or into a new one where they do not fit, and
  // lets `begin` say where they are in it. The window's number: the last given or one more; kNoWindow, and nothing
  // changed, where a window would not hold them.
  std::uint32_t add(std::uint32_t& begin, std::uint32_t count);

  // After the last add(): what all windows hold. It keeps none of it.
  std::vector<Float4> finish() {
    close();
    return std::move(data_);
  }
  const std::vector<Window>& windows() const { return windows_; }

 private:
  // Records of leaves, or of operations.
  struct Records {
    const std::vector<Float4>* from;
    bool is_whole;
    std::vector<std::uint32_t> window, place;  // by place in `from`: the window that holds it, and where
    std::vector<Float4> copied;

    bool has(std::uint32_t record, std::uint32_t w) const { return is_whole || window[record] == w; }
    std::uint32_t take(std::uint32_t record, std::uint32_t size, std::uint32_t w);
  };
  static Records records(const std::vector<Float4>& from);
  bool fits(std::uint32_t begin, std::uint32_t count);
  void close();
  std::uint32_t append(const std::vector<Float4>& part);

  const Tape& tape_;
  const std::vector<Instruction>& code_;
  Records leaves_, operations_;
  std::uint32_t window_ = 0;  // the one being filled
  std::vector<Instruction> packed_;
  std::uint32_t last_begin_ = ~0u, last_count_ = 0, last_place_ = 0;  // neighbours often share a tape
  std::vector<Window> windows_;
  std::vector<Float4> data_;
};

}  // namespace isofield::blobtree
