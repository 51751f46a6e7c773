// A list for caches that keep something for each resident scene, such as meshes or indices: the most recently used
// entry is first, and entries go when their scene does.
#pragma once

#include <algorithm>
#include <list>
#include <memory>
#include <utility>

#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// `Entry` has a member `scene`, a std::weak_ptr<const ResidentScene>; an entry whose scene is gone is removed at the
// next call. Not thread-safe.
template <class Entry>
class SceneEntries {
 public:
  // Returns the scene's entry for which fits(entry) holds and makes it the most recently used one; null if there is
  // none.
  template <class Fits>
  Entry* find(const ResidentScene& scene, const Fits& fits) {
    entries_.remove_if([](const Entry& e) { return e.scene.expired(); });
    const std::weak_ptr<const ResidentScene> self = scene.weak_from_this();
    const auto it = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return !e.scene.owner_before(self) && !self.owner_before(e.scene) && fits(e);
    });
    if (it == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, it);
    return &entries_.front();
  }

  Entry& add(Entry entry) {
    entries_.push_front(std::move(entry));
    return entries_.front();
  }

  // Asks keep(entry) for each entry, the most recently used first. It removes the first entry for which the answer is
  // false, and all entries after it.
  template <class Keep>
  void trim(const Keep& keep) {
    entries_.remove_if([](const Entry& e) { return e.scene.expired(); });
    entries_.erase(std::find_if_not(entries_.begin(), entries_.end(), keep), entries_.end());
  }

 private:
  std::list<Entry> entries_;  // the most recently used first
};

}  // namespace isofield::engine
