// Orders the jobs of a dispatch so that a driver that cuts the dispatch into equal runs, one for each of its threads,
// gives every thread the same amount of work.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isofield::engine {

// Reorders the jobs from `begin` to before `end`: it deals them out into `hands` hands, as one deals cards, and lays
// the hands one after the other. Neighbours in a list cost about the same, and costs change along the list, so that one
// run of the list may cost twice as much as another; hands that are dealt from it all cost the same. Neighbours share
// memory, and so up to 64 of them are dealt together.
template <class Job>
void deal(std::vector<Job>& jobs, std::size_t begin, std::size_t end, std::uint64_t hands) {
  constexpr std::size_t kMostTogether = 64, kLeastRounds = 16;
  const std::size_t count = end - begin;
  if (hands < 2) return;
  const std::size_t together = std::clamp<std::size_t>(count / (kLeastRounds * hands), 1, kMostTogether);
  const auto from = jobs.begin() + static_cast<std::ptrdiff_t>(begin);
  const std::vector<Job> list(from, from + static_cast<std::ptrdiff_t>(count));
  auto to = from;
  for (std::size_t hand = 0; hand < hands; ++hand) {
    for (std::size_t i = hand * together; i < count; i += hands * together) {
      to = std::copy_n(list.begin() + static_cast<std::ptrdiff_t>(i), std::min(together, count - i), to);
    }
  }
}

}  // namespace isofield::engine
