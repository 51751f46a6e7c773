#pragma once

#include <vector>

#include "importers/swc_contour.h"
#include "importers/swc_sample.h"
#include "importers/swc_stack.h"
#include "isofield/import.h"

namespace isofield {

inline constexpr int kNoSoma = -1;

enum class SomaForm {
  // A sphere about the first sample, with its radius.
  kSphere,
  // A segment for each edge between its samples.
  kFrusta,
  // One contour or several, by depth along the normal that they share.
  kContours,
};

// Samples of type 1 that are linked to each other, and outlines of the same body at other depths.
struct Soma {
  SomaForm form = SomaForm::kSphere;
  // Indices, parents first.
  std::vector<int> members;
  std::vector<Contour> contours;
  // Of several contours.
  ContourStack stack;
};

struct Somata {
  std::vector<Soma> all;
  // Of each sample: the index of its soma, or kNoSoma.
  std::vector<int> soma_of;
  // Of each sample: the first sample of its soma that is its child, or kNoParent.
  std::vector<int> first_child;
  // Of each sample: whether it only tells where the surface of a soma is, and its radius nothing.
  std::vector<bool> outlines;
};

// Finds the somata of linked samples and decides, by geometry, what each one is; the report says what was decided.
// `order`: parents first. Gives the centre of a soma of three samples the radius of its sphere.
//
// Contours have samples that are thin, next to the extent of the soma, and lie in one plane or several parallel ones,
// on a closed loop or at the ends of a star. Three samples are a sphere where the second and third are opposite each
// other at the radius of the first, which is their parent. A soma that is neither has a segment for each edge.
Somata find_somata(const std::vector<int>& order, std::vector<SwcSample>& samples, ImportReport& report);

}  // namespace isofield
