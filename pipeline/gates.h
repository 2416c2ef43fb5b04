// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/quality/quadratic_quality.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

struct DeformedStep;

/// How a gate compares.
enum class Comparison : std::uint8_t { at_least, at_most, above, below, equal };

template <>
struct EnumText<Comparison> {
  static constexpr std::string_view what = "comparison";
  static constexpr std::array<std::pair<Comparison, std::string_view>, 5> texts{{{Comparison::at_least, ">="},
                                                                                 {Comparison::at_most, "<="},
                                                                                 {Comparison::above, ">"},
                                                                                 {Comparison::below, "<"},
                                                                                 {Comparison::equal, "=="}}};
};

/// A demand on a mesh's quality, as `--require 'min_shape>=0.3'` states it.
struct Gate {
  std::string name;  ///< one of gate_names()
  Comparison comparison = Comparison::at_least;
  double bound = 0;
};

/// Parses NAME OP VALUE, with or without blanks between them. Throws std::invalid_argument; for an unknown name, the
/// message lists the valid ones.
Gate parse_gate(std::string_view text);

/// How a gate went.
struct GateOutcome {
  Gate gate;
  double value = 0;  ///< of the mesh; NaN where it is not defined, as in a mesh without triangles
  bool passed = false;

  /// Of two meshes that the same is demanded of, whether this one is further from it.
  bool is_worse_than(const GateOutcome& other) const;
};

/// Every name that a gate may have: triangles, quadrilaterals, inverted, degenerate, invalid_quadratic, min_angle and
/// max_angle (the smallest and the largest angle of the mesh), size_ratio (the largest), and for each metric,
/// size_ratio too, min_M, mean_M, max_M, stddev_M and acceptable_M (the acceptable fraction, 0 to 1). Behind
/// "triangle." and "quadrilateral.", but for the numbers of both, of six-node triangles and size_ratio: of the elements
/// of that kind alone. Of a mesh that has followed its boundary also crossings and overlaps.
std::vector<std::string> gate_names();

/// Whether it takes a report that has the size ratio (PipelineOptions::size_ratio).
bool needs_size_ratio(const Gate& gate);

/// The value of that name in the report, NaN where it has none; invalid_quadratic is that of `quadratic`, and 0 for a
/// mesh without quadratic elements; crossings and overlaps are those of `step`, which may be null: then there are none
/// to know of. Throws std::invalid_argument for a name that is not one of gate_names().
double gate_value(std::string_view name, const QualityReport& report,
                  const std::optional<QuadraticQuality>& quadratic = std::nullopt, const DeformedStep* step = nullptr);

/// Whether the report meets the gate, with what gate_value() takes. A value that is not a number meets none. Throws
/// std::invalid_argument where gate_value() does, and where the gate needs_size_ratio() and the report has none.
GateOutcome check_gate(const Gate& gate, const QualityReport& report,
                       const std::optional<QuadraticQuality>& quadratic = std::nullopt,
                       const DeformedStep* step = nullptr);

/// "min_shape >= 0.3": the demand.
std::string gate_text(const Gate& gate);

/// "0.2134": the value, in four digits or in as many as it takes to be told from the bound; "not defined".
std::string gate_value_text(const GateOutcome& outcome);

/// "gate failed: min_shape >= 0.3, is 0.2134": for the user of a gate that did not pass.
std::string gate_failure(const GateOutcome& outcome);

}  // namespace trismooth
