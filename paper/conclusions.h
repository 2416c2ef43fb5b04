// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/paper/comparisons.h"
#include "trismooth/paper/experiment.h"

namespace trismooth::experiments {

/// Whether something that the paper says shows here.
enum class Verdict : std::uint8_t {
  holds,         ///< every comparison agrees
  in_part,       ///< some do
  does_not,      ///< none does, and some say the opposite
  undecided,     ///< no difference beyond the spread of the measurements
  not_measured,  ///< what it takes is missing
};

/// One of the paper's four claims, judged by what was measured.
struct Conclusion {
  int number = 0;
  std::string claim;
  Verdict verdict = Verdict::not_measured;
  std::vector<std::string> findings{};  ///< whole sentences: by what factor, with the spread, and what else bears on it
  std::vector<Comparison> comparisons{};  ///< that the verdict rests on
};

/// The conclusions, in the order of the paper's abstract, each computed from `result` alone. Times differ where their
/// ranges (least to most) are apart; a time that was measured once decides nothing. With "at least as fast" agrees what
/// is within the spread, too; for "up to 44 times" one case suffices; what "slightly" means is left to the reader, who
/// has the factors.
std::vector<Conclusion> conclusions_of(const ExperimentResult& result);

}  // namespace trismooth::experiments

template <>
struct trismooth::EnumText<trismooth::experiments::Verdict> {
  using Verdict = trismooth::experiments::Verdict;
  static constexpr std::string_view what = "verdict";
  static constexpr std::array<std::pair<Verdict, std::string_view>, 5> texts{{{Verdict::holds, "holds"},
                                                                              {Verdict::in_part, "holds in part"},
                                                                              {Verdict::does_not, "does not hold"},
                                                                              {Verdict::undecided, "cannot be told"},
                                                                              {Verdict::not_measured, "not measured"}}};
};
