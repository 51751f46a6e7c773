#include "importers/swc_tree.h"

#include <absl/container/flat_hash_map.h>

#include <algorithm>
#include <numeric>

#include "importers/import_report.h"

namespace isofield {
namespace {

void cut_cycles(std::vector<SwcSample>& samples, ImportReport& report) {
  // Each sample is marked with the walk towards the root that came to it first; a walk that meets its own mark has
  // gone round a cycle. Every sample is walked over once.
  constexpr int kUnvisited = -1;
  std::vector<int> walk_of(samples.size(), kUnvisited);
  for (int start = 0; start < static_cast<int>(samples.size()); ++start) {
    int at = start;
    while (at != kNoParent && walk_of[at] == kUnvisited) {
      walk_of[at] = start;
      at = samples[at].parent;
    }
    if (at == kNoParent || walk_of[at] != start) continue;
    int first = at;
    for (int member = samples[at].parent; member != at; member = samples[member].parent) {
      first = std::min(first, member);
    }
    samples[first].parent = kNoParent;
    note(report, "sample made a root: it is its own ancestor", samples[first].line_number, samples[first].line);
  }
}

}  // namespace

void link_parents(std::vector<SwcSample>& samples, ImportReport& report) {
  absl::flat_hash_map<SwcId, int> index_of;
  index_of.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) index_of.emplace(samples[i].id, static_cast<int>(i));
  for (SwcSample& sample : samples) {
    if (sample.parent_id < 0) continue;
    if (sample.parent_id == sample.id) {
      note(report, "sample is its own parent, which makes it a root", sample.line_number, sample.line, false);
      continue;
    }
    const auto parent = index_of.find(sample.parent_id);
    if (parent == index_of.end()) {
      note(report, "sample made a root: its parent is not in the file or was dropped", sample.line_number, sample.line);
    } else {
      sample.parent = parent->second;
    }
  }
  cut_cycles(samples, report);
}

std::vector<int> parents_first(const std::vector<SwcSample>& samples) {
  const int count = static_cast<int>(samples.size());
  std::vector<int> order(samples.size());
  std::iota(order.begin(), order.end(), 0);
  if (std::all_of(order.begin(), order.end(), [&](int i) { return samples[i].parent < i; })) return order;

  // The children of a sample form a chain: the first child of each sample, then the next sibling of each child. The
  // chains are built from the back, so that they run in the order of the file.
  std::vector<int> first_child(samples.size(), kNoParent);
  std::vector<int> next_sibling(samples.size(), kNoParent);
  for (int i = count - 1; i >= 0; --i) {
    const int parent = samples[i].parent;
    if (parent == kNoParent) continue;
    next_sibling[i] = first_child[parent];
    first_child[parent] = i;
  }
  order.clear();
  std::vector<int> waiting;
  for (int root = 0; root < count; ++root) {
    if (samples[root].parent != kNoParent) continue;
    waiting.push_back(root);
    while (!waiting.empty()) {
      const int at = waiting.back();
      waiting.pop_back();
      order.push_back(at);
      if (next_sibling[at] != kNoParent) waiting.push_back(next_sibling[at]);
      if (first_child[at] != kNoParent) waiting.push_back(first_child[at]);
    }
  }
  return order;
}

}  // namespace isofield
