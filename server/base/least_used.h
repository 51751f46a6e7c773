// Finds the entry that a full cache evicts first: the least recently used one.
#pragma once

namespace isofield::base {

// Returns the entry of a map that has the least `last_used` among those for which may_go(value) is true, or
// entries.end() if there is none.
template <class Map, class MayGo>
typename Map::iterator least_used(Map& entries, const MayGo& may_go) {
  auto least = entries.end();
  for (auto it = entries.begin(); it != entries.end(); ++it) {
    if (may_go(it->second) && (least == entries.end() || it->second.last_used < least->second.last_used)) least = it;
  }
  return least;
}

}  // namespace isofield::base
