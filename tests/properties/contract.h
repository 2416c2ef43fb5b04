// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/base/triangle_view.h"

#include "properties/smoothing_cases.h"

/// The contract of every smoothing, written down afresh: shares no code with what it judges.
namespace properties {

/// A mesh's orientation and what is fixed of it.
struct Connectivity {
  std::vector<trismooth::Triangle> elements;  ///< consistently counter-clockwise, each from its smallest index on
  std::vector<std::size_t> component;         ///< of each element, by the number of its first one
  std::vector<bool> fixed;
  /// Some component with a free vertex has as many inverted triangles as others: their order says which they are.
  bool is_tied = false;
  bool is_tied_anywhere = false;  ///< the same of any component
  /// Every component has a fixed vertex.
  bool is_held = true;
};

Connectivity connectivity_of(const RandomMesh& mesh);

/// What a run did that the contract forbids; empty: nothing. Fixed vertices and those that did not move keep their
/// bits, every coordinate is finite, the counts are true; and with the guard nothing is worse: no element is invalid
/// that was valid, none is worse than it was and than the worst of those that a moved vertex touched. (So the number of
/// elements that are not valid never rises; one without area may end inverted beside one that was more so.) Components
/// that untangling has turned over are whole ones, in which most elements are valid as they are turned now; before and
/// now each counts as it was turned then.
std::string breach(const RandomMesh& mesh, const Connectivity& connectivity, const Run& run, bool guard);

}  // namespace properties
