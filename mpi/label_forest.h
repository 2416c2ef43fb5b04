// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/component_labels.h"

namespace trismooth::mpi {

/// Labels that turned out to name the same component, in trees whose roots are their lowest: scattered over the ranks,
/// each label at its home. Joined as in connected components of graphs on parallel machines (Y. Shiloach and
/// U. Vishkin 1982): every label is hooked under a lower one, then paths are shortened by jumping.
class LabelForest {
 public:
  /// Two labels that name the same component.
  struct Hook {
    std::int64_t high;
    std::int64_t low;
    std::uint8_t parity;  ///< 1 where their triangles are listed against each other
  };

  /// Of these labels, each a tree of its own. Collective.
  LabelForest(std::span<const ComponentLabel> labels, const Communicator& ranks);

  /// Hooks roots: of each label under one of the lower ones that `hooks` of all ranks say. What they say beyond that is
  /// found again with the new labels. Collective.
  void join(std::span<const Hook> hooks, const Communicator& ranks);

  /// Brings the labels, which are roots or were before join(), to their roots. Collective.
  void look_up(std::span<ComponentLabel> labels, const Communicator& ranks) const;

 private:
  /// The parents of labels, as their homes know them.
  std::vector<ComponentLabel> parents_of(std::span<const std::int64_t> labels, const Communicator& ranks) const;

  std::unordered_map<std::int64_t, ComponentLabel> parents_;  ///< of labels whose home is here
};

}  // namespace trismooth::mpi
