// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/label_forest.h"

#include <cstddef>
#include <utility>

#include "trismooth/mpi/directory.h"

namespace trismooth::mpi {

LabelForest::LabelForest(std::span<const ComponentLabel> labels, const Communicator& ranks) {
  auto sent = lists_by_rank<std::int64_t>(ranks);
  for (const ComponentLabel& label : labels) {
    sent[static_cast<std::size_t>(home_of(label.triangle, ranks))].push_back(label.triangle);
  }
  for (const auto& of_rank : ranks.exchanged(std::move(sent))) {
    for (const std::int64_t label : of_rank) {
      parents_.try_emplace(label, ComponentLabel{label, 0});
    }
  }
}

void LabelForest::join(std::span<const Hook> hooks, const Communicator& ranks) {
  auto sent = lists_by_rank<Hook>(ranks);
  for (const Hook& hook : hooks) {
    sent[static_cast<std::size_t>(home_of(hook.high, ranks))].push_back(hook);
  }
  std::vector<std::int64_t> hooked;
  for (const auto& of_rank : ranks.exchanged(std::move(sent))) {
    for (const Hook& hook : of_rank) {
      ComponentLabel& parent = parents_.at(hook.high);
      if (parent.triangle == hook.high) {
        hooked.push_back(hook.high);
      }
      if (hook.low < parent.triangle) {
        parent = {hook.low, hook.parity};
      }
    }
  }
  // Every label that has just been hooked jumps to the parent of its parent, until that is a root.
  for (bool has_changed = true; ranks.any(has_changed);) {
    has_changed = false;
    std::vector<std::int64_t> asked;
    for (const std::int64_t label : hooked) {
      asked.push_back(parents_.at(label).triangle);
    }
    const std::vector<ComponentLabel> above = parents_of(asked, ranks);
    for (std::size_t i = 0; i < hooked.size(); ++i) {
      ComponentLabel& parent = parents_.at(hooked[i]);
      if (above[i].triangle != parent.triangle) {
        parent = {above[i].triangle, static_cast<std::uint8_t>(parent.parity ^ above[i].parity)};
        has_changed = true;
      }
    }
  }
}

void LabelForest::look_up(std::span<ComponentLabel> labels, const Communicator& ranks) const {
  std::vector<std::int64_t> asked;
  for (const ComponentLabel& label : labels) {
    asked.push_back(label.triangle);
  }
  const std::vector<ComponentLabel> roots = parents_of(asked, ranks);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = {roots[i].triangle, static_cast<std::uint8_t>(labels[i].parity ^ roots[i].parity)};
  }
}

std::vector<ComponentLabel> LabelForest::parents_of(std::span<const std::int64_t> labels,
                                                    const Communicator& ranks) const {
  auto asked = lists_by_rank<std::int64_t>(ranks);
  for (const std::int64_t label : labels) {
    asked[static_cast<std::size_t>(home_of(label, ranks))].push_back(label);
  }
  auto answers = lists_by_rank<ComponentLabel>(ranks);
  const ByRank<std::int64_t> heard = ranks.exchanged(std::move(asked));
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const std::int64_t label : heard[r]) {
      answers[r].push_back(parents_.at(label));
    }
  }
  const ByRank<ComponentLabel> told = ranks.exchanged(std::move(answers));
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<ComponentLabel> parents;
  for (const std::int64_t label : labels) {
    const auto home = static_cast<std::size_t>(home_of(label, ranks));
    parents.push_back(told[home][next[home]++]);
  }
  return parents;
}

}  // namespace trismooth::mpi
