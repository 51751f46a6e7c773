// Finds the somata (cell bodies) of neurons and decides what shapes they have.
#pragma once

#include <vector>

#include "importers/swc_contour.h"
#include "importers/swc_sample.h"
#include "importers/swc_stack.h"
#include "isofield/import.h"

namespace isofield {

inline constexpr int kNoSoma = -1;

// The form in which the pieces of a soma are made.
enum class SomaForm {
  // A sphere about the first sample, with its radius.
  kSphere,
  // A segment for each edge between its samples.
  kFrusta,
  // One contour, or several ordered by depth along their common normal.
  kContours,
};

// Samples of type 1 that are linked to each other, and outlines of the same body at other depths.
struct Soma {
  SomaForm form = SomaForm::kSphere;
  // Indices of the samples, parents first.
  std::vector<int> members;
  std::vector<Contour> contours;
  // The body of several contours; unused for one.
  ContourStack stack;
};

// All somata of a file.
struct Somata {
  std::vector<Soma> all;
  // The index of the soma of each sample in `all`, or kNoSoma.
  std::vector<int> soma_of;
  // The first child of each sample that belongs to the same soma, or kNoParent.
  std::vector<int> first_child;
  // True for each sample that only marks the surface of a soma, so that its radius means nothing.
  std::vector<bool> outlines;
};

// Finds the somata of linked samples and decides by their geometry which form each one has; the report states the form.
// `order` lists the samples' indices with parents first. The centre of a soma of three samples gets the radius of its
// sphere.
//
// The samples of contours are thin compared with the extent of the soma. They lie in one plane or in several parallel
// ones, on a closed loop or at the ends of a star. Three samples are a sphere where the second and the third are
// opposite each other at the radius of the first, which is their parent. Any other soma has a segment for each edge.
Somata find_somata(const std::vector<int>& order, std::vector<SwcSample>& samples, ImportReport& report);

}  // namespace isofield
