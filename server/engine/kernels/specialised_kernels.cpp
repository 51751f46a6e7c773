#include "engine/kernels/specialised_kernels.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <string_view>

#include "base/status_macros.h"
#include "shaders/specialise.h"
#include "shaders/tape_compiler.h"

namespace isofield::engine {
namespace {

std::string text_of(const shaders::Spirv& shader, std::span<const std::uint32_t> constants) {
  const std::string_view bytes(reinterpret_cast<const char*>(shader.data()), shader.size_bytes());
  return absl::StrCat("specialised ", absl::Hex(shaders::specialiser_version()), " ",
                      absl::Hex(shaders::hash_of(bytes)), " ", absl::StrJoin(constants, " "));
}

}  // namespace

absl::StatusOr<SpecialisedKernels::Kernel> SpecialisedKernels::get(const shaders::Spirv& shader,
                                                                   std::span<const std::uint32_t> constants) {
  Key key{shader.data(), {constants.begin(), constants.end()}};
  {
    const base::MutexLock lock(mutex_);
    if (const auto found = by_key_.find(key); found != by_key_.end()) {
      places_.splice(places_.begin(), places_, found->second);
      return found->second->kernel;
    }
  }
  ++made_;
  const std::string text = text_of(shader, constants);
  auto made = std::make_shared<std::vector<std::uint32_t>>();
  if (auto kept = store_.load(text)) {
    *made = *std::move(kept);
  } else {
    ISOFIELD_ASSIGN_OR_RETURN(*made, shaders::specialise(shader, constants));
    store_.save(text, *made);
  }
  const base::MutexLock lock(mutex_);
  if (by_key_.contains(key)) return made;  // two threads made it at once
  places_.push_front({key, made});
  by_key_[std::move(key)] = places_.begin();
  if (places_.size() > kMostInMemory) {
    by_key_.erase(places_.back().key);
    places_.pop_back();
  }
  return made;
}

}  // namespace isofield::engine
