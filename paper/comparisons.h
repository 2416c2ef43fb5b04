// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/paper/experiment.h"

namespace trismooth::experiments {

/// What one comparison says of a claim.
enum class Support : std::uint8_t {
  yes,
  no,
  within_spread,  ///< it may be either: the ranges of the measurements overlap
  unknown,        ///< a time was measured once, so its range is not known
};

/// Two cases on a mesh: how many times as fast the one is that the paper says is faster.
struct Comparison {
  Case claimed_faster;
  Case claimed_slower;
  std::int64_t vertices = 0;
  Spread factor;
  Support support = Support::unknown;
  std::optional<double> published{};              ///< the paper's factor
  std::optional<std::array<Spread, 2>> sweeps{};  ///< of the faster and the slower, where they differ in the form
};

/// Two cases to compare: the one that the paper calls faster comes first.
using Pair = std::pair<Case, Case>;

/// What a factor says of a claim that it is at least so much: yes where all of its range is above, no where all is
/// below.
Support support_of(const Spread& factor, double at_least);

/// The times of smoothing of each pair on every mesh where both were measured, and took some time, held against a claim
/// that the first is `at_least` so many times as fast.
std::vector<Comparison> compare_all(const ExperimentResult& result, const std::vector<Pair>& pairs,
                                    double at_least = 1);

std::int64_t count_of(const std::vector<Comparison>& comparisons, Support support);

/// The median of the factors, and the bounds of them all with the spread of their measurements. Needs one comparison.
Spread overall(const std::vector<Comparison>& comparisons);

/// "AoS is faster in 3 of 20 comparisons, SoA in 12, ...": what comparisons show, as sentences. `faster` is a subject
/// with its verb ("AoS is"), `slower` one without. Needs one comparison.
std::string tally(const std::vector<Comparison>& comparisons, std::string_view faster, std::string_view slower);

/// The median factor of each size, as a sentence.
std::string by_size(const ExperimentResult& result, const std::vector<Comparison>& comparisons);

}  // namespace trismooth::experiments

template <>
struct trismooth::EnumText<trismooth::experiments::Support> {
  using Support = trismooth::experiments::Support;
  static constexpr std::string_view what = "support";
  static constexpr std::array<std::pair<Support, std::string_view>, 4> texts{
      {{Support::yes, "yes"},
       {Support::no, "no"},
       {Support::within_spread, "within the spread"},
       {Support::unknown, "measured once"}}};
};
