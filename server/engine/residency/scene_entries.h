// What a cache keeps of resident scenes.
#pragma once

#include <algorithm>
#include <list>
#include <memory>
#include <utility>

#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// Entries have a member `scene`, a std::weak_ptr<const ResidentScene>; those of scenes that are gone go. Not
// thread-safe.
template <class Entry>
class SceneEntries {
 public:
  // The scene's entry for which fits(entry), which is the last used from now on. Null: none.
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

  // Asks keep(entry) from the last used on; from where it says no, all go.
  template <class Keep>
  void trim(const Keep& keep) {
    entries_.remove_if([](const Entry& e) { return e.scene.expired(); });
    entries_.erase(std::find_if_not(entries_.begin(), entries_.end(), keep), entries_.end());
  }

 private:
  std::list<Entry> entries_;  // the last used first
};

}  // namespace isofield::engine
