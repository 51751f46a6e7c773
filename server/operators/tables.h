// Tables collects the tables of silhouettes, openings and curves that a tape's operators read on the device. Operators
// with the same silhouette, opening or curve share its table.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/float4.h"
#include "operators/opening.h"
#include "operators/profile_table.h"
#include "operators/sampled_curve.h"
#include "operators/silhouette.h"

namespace isofield::operators {

class Tables {
 public:
  // The tables are appended to `out`, which must outlive this object.
  explicit Tables(std::vector<base::Float4>& out) : out_(out) {}

  // Each function returns the place in `out` where the table begins, and appends it if it is new. Bit 30 marks a
  // silhouette whose two halves differ.
  std::uint32_t silhouette(const Silhouette& s) {
    return find(silhouettes_, s, [&] { return silhouette_table(s); }) | (s.is_symmetric() ? 0 : 1u << 30);
  }
  std::uint32_t opening(const Opening& o) {
    return find(openings_, o, [&] { return opening_table(o); });
  }
  std::uint32_t curve(const SampledCurve& c) {
    return find(curves_, c, [&] { return curve_table(c); });
  }

 private:
  template <class Key, class Make>
  std::uint32_t find(std::map<Key, std::uint32_t>& known, const Key& key, Make make) {
    const auto [it, is_new] = known.try_emplace(key);
    if (is_new) it->second = append(make());
    return it->second;
  }
  std::uint32_t append(const ProfileTable& table) {
    const auto offset = static_cast<std::uint32_t>(out_.size());
    out_.insert(out_.end(), table.begin(), table.end());
    return offset;
  }

  std::vector<base::Float4>& out_;
  std::map<Silhouette, std::uint32_t> silhouettes_;
  std::map<Opening, std::uint32_t> openings_;
  std::map<SampledCurve, std::uint32_t> curves_;
};

}  // namespace isofield::operators
