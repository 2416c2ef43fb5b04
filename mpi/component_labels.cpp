// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/component_labels.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <unordered_map>

#include "trismooth/base/errors.h"
#include "trismooth/mpi/directory.h"
#include "trismooth/mpi/label_forest.h"
#include "trismooth/quality/orientation.h"

namespace trismooth::mpi {

namespace {

/// A component as the other rank hears of it.
struct Named {
  std::int32_t component;
  std::uint8_t parity;
};

/// The joins with every rank, in an order that both sides have.
std::vector<std::vector<ComponentJoin>> find_joins(const Overlap& overlap, const TriangleComponents& components,
                                                   const Communicator& ranks) {
  // An element is known to those who own its vertices.
  auto named = lists_by_rank<Named>(ranks);
  std::size_t t = 0;
  for (const std::span<const std::int32_t> corners : overlap.elements()) {
    std::array<std::int32_t, 4> told{};
    auto end = told.begin();
    for (const std::int32_t v : corners) {
      const std::int32_t owner = overlap.owners[static_cast<std::size_t>(v)];
      if (owner != ranks.rank() && std::find(told.begin(), end, owner) == end) {
        *end++ = owner;
        named[static_cast<std::size_t>(owner)].push_back({components.component[t], components.parity[t]});
      }
    }
    ++t;
  }
  const ByRank<Named> others = ranks.exchanged(std::vector(named));
  std::vector<std::vector<ComponentJoin>> joins(named.size());
  for (std::size_t r = 0; r < named.size(); ++r) {
    std::vector<ComponentJoin>& with = joins[r];
    for (std::size_t i = 0; i < named[r].size(); ++i) {
      with.push_back({named[r][i].component, others[r][i].component,
                      static_cast<std::uint8_t>(named[r][i].parity ^ others[r][i].parity)});
    }
    const bool own_first = ranks.rank() < static_cast<int>(r);
    const auto key = [own_first](const ComponentJoin& join) { return join.key(own_first); };
    std::ranges::sort(with, {}, key);
    with.erase(std::unique(with.begin(), with.end(),
                           [&](const ComponentJoin& a, const ComponentJoin& b) { return key(a) == key(b); }),
               with.end());
  }
  return joins;
}

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();  // no triangle

/// What a rank's triangles of one component say, on the way to the rank that adds it up.
struct SentVotes {
  std::int64_t label;
  OrientationVotes votes;
};

/// Votes against the lowest triangle here, turned into votes against that of the label.
OrientationVotes against_label(OrientationVotes votes, std::uint8_t parity, const AscendingIds& ids) {
  if (votes.first != OrientationVotes::nobody) {
    const auto triangle = static_cast<std::size_t>(votes.first / 2);
    votes.first = 2 * ids[triangle] + (votes.first % 2);
  }
  if (parity != 0) {
    std::swap(votes.positive, votes.negative);
    votes.against = votes.triangles - votes.against;
    votes.first = votes.first == OrientationVotes::nobody ? votes.first : votes.first ^ 1;
  }
  return votes;
}

void add(OrientationVotes& all, const OrientationVotes& some) {
  all.positive += some.positive;
  all.negative += some.negative;
  all.triangles += some.triangles;
  all.against += some.against;
  all.first = std::min(all.first, some.first);
}

}  // namespace

ComponentLabels::ComponentLabels(const Overlap& overlap, const TriangleComponents& components,
                                 const Communicator& ranks)
    : labels_(static_cast<std::size_t>(components.components), {none, 0}) {
  for (std::size_t t = 0; t < components.component.size(); ++t) {
    // The first one has the lowest id.
    if (ComponentLabel& label = labels_[static_cast<std::size_t>(components.component[t])]; label.triangle == none) {
      label.triangle = overlap.triangle_ids[t];
    }
  }
  const std::vector<std::vector<ComponentJoin>> joins = find_joins(overlap, components, ranks);
  LabelForest forest(labels_, ranks);
  for (;;) {
    // What is on the other side of every join, and how it stands to the label here.
    const ByRank<ComponentLabel> others = told_over(joins, ranks);
    bool is_contradicted = false;
    std::vector<LabelForest::Hook> hooks;
    for (std::size_t r = 0; r < joins.size(); ++r) {
      for (std::size_t i = 0; i < joins[r].size(); ++i) {
        const ComponentLabel& own = labels_[static_cast<std::size_t>(joins[r][i].own)];
        const ComponentLabel& other = others[r][i];
        const auto parity = static_cast<std::uint8_t>(own.parity ^ joins[r][i].parity ^ other.parity);
        if (own.triangle != other.triangle) {
          hooks.push_back({std::max(own.triangle, other.triangle), std::min(own.triangle, other.triangle), parity});
        } else if (parity != 0) {
          is_contradicted = true;
        }
      }
    }
    ranks.on_all([&] {
      if (is_contradicted) {
        throw MeshError("triangles that are connected across ranks cannot be oriented consistently (" +
                        std::string(why_one_sided(overlap)) + ")");
      }
    });
    if (!ranks.any(!hooks.empty())) {
      break;
    }
    forest.join(hooks, ranks);
    forest.look_up(labels_, ranks);
  }
  to_homes_.assign(static_cast<std::size_t>(ranks.size()), 0);
  for (const ComponentLabel& label : labels_) {
    ++to_homes_[static_cast<std::size_t>(home_of(label.triangle, ranks))];
  }
  from_ranks_ = ranks.exchanged_counts(to_homes_);
}

ByRank<ComponentLabel> ComponentLabels::told_over(const std::vector<std::vector<ComponentJoin>>& joins,
                                                  const Communicator& ranks) const {
  auto told = lists_by_rank<ComponentLabel>(ranks);
  std::vector<std::int64_t> counts(told.size(), 0);
  for (std::size_t r = 0; r < joins.size(); ++r) {
    counts[r] = std::ssize(joins[r]);
    for (const ComponentJoin& join : joins[r]) {
      told[r].push_back(labels_[static_cast<std::size_t>(join.own)]);
    }
  }
  return ranks.exchanged(std::move(told), counts);
}

std::vector<std::uint8_t> ComponentLabels::reversed(const Overlap& overlap, const TriangleComponents& components,
                                                    std::span<const Point2<double>> points, const Communicator& ranks,
                                                    Workers& workers) const {
  // Every element has its say on one rank.
  std::vector<std::uint8_t> left_out(components.component.size());
  for (std::size_t t = 0; t < left_out.size(); ++t) {
    left_out[t] = overlap.counts(t) ? 0 : 1;
  }
  const std::vector<OrientationVotes> votes = overlap.elements().visit(
      [&](const auto& elements) { return orientation_votes(components, elements, points, left_out, workers); });
  auto sent = lists_by_rank<SentVotes>(ranks);
  for (std::size_t c = 0; c < labels_.size(); ++c) {
    sent[static_cast<std::size_t>(home_of(labels_[c].triangle, ranks))].push_back(
        {labels_[c].triangle, against_label(votes[c], labels_[c].parity, overlap.triangle_ids)});
  }
  const ByRank<SentVotes> received = ranks.exchanged(std::move(sent), from_ranks_);
  std::unordered_map<std::int64_t, OrientationVotes> totals;
  for (const auto& of_rank : received) {
    for (const SentVotes& some : of_rank) {
      add(totals[some.label], some.votes);
    }
  }
  auto answers = lists_by_rank<std::uint8_t>(ranks);
  for (std::size_t r = 0; r < received.size(); ++r) {
    for (const SentVotes& some : received[r]) {
      answers[r].push_back(totals.at(some.label).flip() ? 1 : 0);
    }
  }
  const ByRank<std::uint8_t> told = ranks.exchanged(std::move(answers), to_homes_);
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::uint8_t> flips(labels_.size());
  for (std::size_t c = 0; c < labels_.size(); ++c) {
    const auto home = static_cast<std::size_t>(home_of(labels_[c].triangle, ranks));
    flips[c] = static_cast<std::uint8_t>(told[home][next[home]++] ^ labels_[c].parity);
  }
  std::vector<std::uint8_t> reversed(components.component.size());
  for (std::size_t t = 0; t < reversed.size(); ++t) {
    reversed[t] =
        static_cast<std::uint8_t>(components.parity[t] ^ flips[static_cast<std::size_t>(components.component[t])]);
  }
  return reversed;
}

}  // namespace trismooth::mpi
