#include "blobtree/tape/window_packer.h"

#include <cstring>

namespace isofield::blobtree {

static_assert(sizeof(Instruction) == sizeof(Float4));

WindowPacker::WindowPacker(const Tape& tape, const ParameterBuffers& parameters, const std::vector<Instruction>& code)
    : tape_(tape), code_(code), leaves_(records(parameters.leaves)), operations_(records(parameters.operations)) {}

WindowPacker::Records WindowPacker::records(const std::vector<Float4>& from) {
  const bool is_whole = from.size() <= kWindowSize;
  const std::size_t places = is_whole ? 0 : from.size();
  return {&from, is_whole, std::vector<std::uint32_t>(places, kNoWindow), std::vector<std::uint32_t>(places), {}};
}

std::uint32_t WindowPacker::Records::take(std::uint32_t record, std::uint32_t size, std::uint32_t w) {
  if (is_whole) return record;
  if (window[record] != w) {
    window[record] = w;
    place[record] = static_cast<std::uint32_t>(copied.size());
    copied.insert(copied.end(), from->begin() + record, from->begin() + record + size);
  }
  return place[record];
}

// Returns whether the window being filled has room. It counts as if no two instructions shared a record.
bool WindowPacker::fits(std::uint32_t begin, std::uint32_t count) {
  if (packed_.size() + count > kWindowSize) return false;
  std::size_t leaves = leaves_.copied.size(), operations = operations_.copied.size();
  for (std::uint32_t n = begin; n < begin + count; ++n) {
    const Instruction& i = code_[n];
    if (i.is_leaf() && !leaves_.has(i.leaf, window_)) leaves += record_size(i.operand());
    if (operations_.is_whole || i.op() == Opcode::kPush) continue;
    const Operation& o = tape_.operation(i);
    if (!operations_.has(o.begin(), window_)) operations += operation_record_size(o);
  }
  return leaves <= kWindowSize && operations <= kWindowSize;
}

std::uint32_t WindowPacker::add(std::uint32_t& begin, std::uint32_t count) {
  if (begin == last_begin_ && count == last_count_) {
    begin = last_place_;
    return window_;
  }
  if (!fits(begin, count)) {
    if (packed_.empty()) return kNoWindow;
    close();
    if (!fits(begin, count)) return kNoWindow;
  }
  last_begin_ = begin;
  last_count_ = count;
  last_place_ = static_cast<std::uint32_t>(packed_.size());
  for (std::uint32_t n = begin; n < begin + count; ++n) {
    Instruction i = code_[n];
    if (i.is_leaf()) i.leaf = leaves_.take(i.leaf, record_size(i.operand()), window_);
    if (!operations_.is_whole && i.op() != Opcode::kPush) {
      const Operation& o = tape_.operation(i);
      i.operation += operations_.take(o.begin(), operation_record_size(o), window_) - o.begin();
    }
    packed_.push_back(i);
  }
  begin = last_place_;
  return window_;
}

void WindowPacker::close() {
  if (packed_.empty()) return;
  Window window;
  std::vector<Float4> code(packed_.size());
  std::memcpy(code.data(), packed_.data(), packed_.size() * sizeof(Float4));
  window.code = append(code);
  if (!leaves_.is_whole) window.leaves = append(leaves_.copied);
  if (!operations_.is_whole) window.operations = append(operations_.copied);
  windows_.push_back(window);
  packed_.clear();
  leaves_.copied.clear();
  operations_.copied.clear();
  last_begin_ = kNoWindow;
  ++window_;
}

std::uint32_t WindowPacker::append(const std::vector<Float4>& part) {
  const std::size_t at = (data_.size() + kWindowAlignment - 1) / kWindowAlignment * kWindowAlignment;
  data_.resize(at);
  data_.insert(data_.end(), part.begin(), part.end());
  return static_cast<std::uint32_t>(at);
}

}  // namespace isofield::blobtree
