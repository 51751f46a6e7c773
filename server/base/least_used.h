// Which entry of a cache goes first.
#pragma once

namespace isofield::base {

// The entry of a map with the least `last_used` among those that may go, or entries.end() where none may.
template <class Map, class MayGo>
typename Map::iterator least_used(Map& entries, const MayGo& may_go) {
  auto least = entries.end();
  for (auto it = entries.begin(); it != entries.end(); ++it) {
    if (may_go(it->second) && (least == entries.end() || it->second.last_used < least->second.last_used)) least = it;
  }
  return least;
}

}  // namespace isofield::base
