// WindowPacker cuts pruned tapes into windows, which are pieces that fit uniform buffers, each with the records that
// its instructions name.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/tape/parameter_layout.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// A uniform buffer holds kWindowSize vec4s, and may be bound from multiples of kWindowAlignment vec4s on.
inline constexpr std::uint32_t kWindowSize = 4096;
inline constexpr std::uint32_t kWindowAlignment = 16;

// Window says where the parts of a window begin, in vec4s from the start of what WindowPacker::finish() returns.
// Records that fit whole are not copied: `leaves` or `operations` is kWhole then, and instructions hold places in the
// whole buffer.
struct Window {
  static constexpr std::uint32_t kWhole = ~0u;
  std::uint32_t code, leaves = kWhole, operations = kWhole;
};

class WindowPacker {
 public:
  // Keeps references to the three arguments. `code` holds tapes that are pruned from `tape`.
  WindowPacker(const Tape& tape, const ParameterBuffers& parameters, const std::vector<Instruction>& code);

  static constexpr std::uint32_t kNoWindow = ~0u;
  // Puts the `count` instructions from `begin` on into the last window, or into a new one if they do not fit, and sets
  // `begin` to their place in it. Returns the number of the window, which is the last one given or one more. Returns
  // kNoWindow, and leaves `begin` as it is, if no window would hold them.
  std::uint32_t add(std::uint32_t& begin, std::uint32_t count);

  // Returns what all windows hold, and keeps none of it. Call it after the last add().
  std::vector<Float4> finish() {
    close();
    return std::move(data_);
  }
  const std::vector<Window>& windows() const { return windows_; }

 private:
  // Records holds the records of leaves, or of operations, and which of them are copied.
  struct Records {
    const std::vector<Float4>* from;
    bool is_whole;
    std::vector<std::uint32_t> window, place;  // for each place in `from`: the window that holds it, and where
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
  std::uint32_t window_ = 0;  // number of the window being filled
  std::vector<Instruction> packed_;
  std::uint32_t last_begin_ = ~0u, last_count_ = 0, last_place_ = 0;  // neighbouring bricks often share a tape
  std::vector<Window> windows_;
  std::vector<Float4> data_;
};

}  // namespace isofield::blobtree
