// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/results.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/size_ratio.h"
#include "trismooth/quality/text/quality_table.h"
#include "trismooth/smoothing/result_text.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

/// The summary of the metric of that name, of a report or of one kind, which have `metrics`.
template <class Report, class Metrics>
const MetricSummary& summary_in(const Report& report, const Metrics& metrics, const std::string& name) {
  std::string names;
  for (const MetricInfo& metric : metrics) {
    if (metric.name == name) {
      return report[metric.metric];
    }
    add_to_list(names, metric.name);
  }
  throw nb::key_error(("'" + name + "' is no metric; valid are " + names).c_str());
}

const MetricSummary& summary_of_kind(const KindQuality& of_kind, const std::string& name) {
  return summary_in(of_kind, all_metrics(of_kind.kind), name);
}

const MetricSummary& summary_of_all(const QualityReport& report, const std::string& name) {
  std::vector<MetricInfo> metrics;
  std::ranges::transform(metrics_of(report), std::back_inserter(metrics), [](const MetricInfo* of) { return *of; });
  return summary_in(report, metrics, name);
}

const char* name_of(ElementKind kind) {
  return kind == ElementKind::triangle ? "triangle" : "quadrilateral";
}

nb::tuple pair_of(Point2<double> point) {
  return nb::make_tuple(point.x, point.y);
}

nb::dict timings_of(const Outcome& outcome) {
  const SmoothingTimings& timings = outcome.smoothing.timings;
  nb::dict milliseconds;
  milliseconds["prepare"] = timings.prepare;
  milliseconds["transfer_in"] = timings.transfer_in;
  milliseconds["untangle"] = timings.untangle;
  milliseconds["smooth"] = timings.smooth;
  milliseconds["transfer_out"] = timings.transfer_out;
  milliseconds["guard"] = timings.commit;
  return milliseconds;
}

nb::object untangling_of(const Outcome& outcome) {
  const auto& untangling = outcome.smoothing.untangling;
  if (!untangling) {
    return nb::none();
  }
  nb::dict counts;
  counts["inverted_before"] = untangling->inverted_before;
  counts["inverted_untangled"] = untangling->inverted_untangled;
  counts["inverted_after"] = untangling->inverted_after;
  counts["inverted_fixed"] = untangling->inverted_fixed;
  counts["turned_components"] = untangling->turned_components;
  return counts;
}

nb::dict layers_of(const Outcome& outcome) {
  const LayersResult& layers = outcome.smoothing.layers;
  nb::dict found;
  found["kept"] = layers.kept;
  found["kept_on_lines"] = layers.kept_on_lines;
  found["kept_aspect"] = layers.kept_aspect;
  found["left"] = layers.left;
  found["left_aspect"] = layers.left_aspect;
  return found;
}

nb::list reverted_of(const Outcome& outcome) {
  nb::list vertices;
  for (const auto& [vertex, position] : outcome.smoothing.reverted) {
    vertices.append(nb::make_tuple(vertex, pair_of(position)));
  }
  return vertices;
}

void bind_quality(nb::module_& module) {
  nb::class_<MetricSummary>(module, "MetricSummary", "One metric over all elements of a mesh, or over those of a kind.")
      .def_ro("min", &MetricSummary::min, "The smallest value.")
      .def_ro("mean", &MetricSummary::mean, "The mean.")
      .def_ro("max", &MetricSummary::max, "The largest value.")
      .def_ro("stddev", &MetricSummary::stddev, "The standard deviation over these elements.")
      .def_ro("acceptable_fraction", &MetricSummary::acceptable_fraction,
              "The part of the elements in the range that Verdict's manual calls acceptable for their kind, 0 to 1.")
      .def("__repr__", [](const MetricSummary& summary) {
        std::ostringstream text;
        text << "MetricSummary(min=" << summary.min << ", mean=" << summary.mean << ", max=" << summary.max
             << ", stddev=" << summary.stddev << ", acceptable_fraction=" << summary.acceptable_fraction << ")";
        return text.str();
      });
  nb::class_<WorstElement>(module, "WorstElement", "One of the elements with the smallest shape.")
      .def_ro("triangle", &WorstElement::element, "Its number, from 0.")
      .def_ro("shape", &WorstElement::shape, "Its shape; negative where it is inverted.")
      .def_prop_ro(
          "centroid", [](const WorstElement& element) { return pair_of(element.centroid); }, "x and y.")
      .def_ro("all_fixed", &WorstElement::all_fixed, "No smoothing can change it; of files alone.")
      .def("__repr__", [](const WorstElement& element) {
        std::ostringstream text;
        text << "WorstElement(triangle=" << element.element << ", shape=" << element.shape << ", centroid=("
             << element.centroid.x << ", " << element.centroid.y << "))";
        return text.str();
      });
  nb::class_<KindQuality>(
      module, "KindQuality",
      "The quality of the triangles of a mesh, or of its quadrilaterals.\n\n`of_kind['shape']` is the "
      "MetricSummary of a metric.")
      .def_prop_ro(
          "kind", [](const KindQuality& of_kind) { return name_of(of_kind.kind); }, R"("triangle" or "quadrilateral".)")
      .def_ro("elements", &KindQuality::elements, "How many there are.")
      .def_ro("inverted", &KindQuality::inverted, "Those of shape < 0.")
      .def_ro("degenerate", &KindQuality::degenerate, "Those whose shape is 0.")
      .def("__getitem__", &summary_of_kind, "metric"_a, nb::rv_policy::reference_internal)
      .def("__repr__", [](const KindQuality& of_kind) {
        std::ostringstream text;
        text << "<KindQuality: " << of_kind.elements << " " << name_of(of_kind.kind) << "s, " << of_kind.inverted
             << " inverted, shape from " << of_kind[Metric::shape].min << ", mean " << of_kind[Metric::shape].mean
             << ">";
        return text.str();
      });
  nb::class_<QualityReport>(module, "QualityReport",
                            "The quality of a mesh's elements.\n\n`report['shape']` is the MetricSummary of a metric; "
                            "`str(report)` a table.")
      .def_ro("triangles", &QualityReport::triangles, "How many there are.")
      .def_ro("quadrilaterals", &QualityReport::quadrilaterals, "How many there are.")
      .def_ro("kinds", &QualityReport::kinds,
              "A KindQuality of the triangles and one of the quadrilaterals; empty where all are triangles.")
      .def_ro("inverted", &QualityReport::inverted, "Those of shape < 0.")
      .def_ro("degenerate", &QualityReport::degenerate,
              "Those whose shape is 0: without area, or quadrilaterals with a flat corner.")
      .def_ro("histogram", &QualityReport::shape_histogram,
              "20 counts of elements by their shape, from 0 to 1; inverted ones are in none.")
      .def_ro("worst", &QualityReport::worst, "The elements of smallest shape, the worst first; 10 at most.")
      .def("__getitem__", &summary_of_all, "metric"_a, nb::rv_policy::reference_internal)
      .def("__str__", [](const QualityReport& report) { return format_table(report); })
      .def("_repr_html_",
           [](nb::handle report) { return nb::module_::import_("trismooth._html").attr("quality_html")(report); })
      .def("__repr__", [](const QualityReport& report) {
        std::ostringstream text;
        text << "<QualityReport: ";
        if (report.quadrilaterals == 0 || report.triangles > 0) {
          text << report.triangles << " triangles, ";
        }
        if (report.quadrilaterals > 0) {
          text << report.quadrilaterals << " quadrilaterals, ";
        }
        text << report.inverted << " inverted, shape from " << report[Metric::shape].min << ", mean "
             << report[Metric::shape].mean << ">";
        return text.str();
      });
}

void bind_sweeps(nb::module_& module) {
  nb::class_<SweepRecord>(module, "SweepRecord", "What one sweep did.")
      .def_ro("sweep", &SweepRecord::sweep, "Its number, from 1.")
      .def_ro("evaluated", &SweepRecord::evaluated, "Vertices whose update was computed.")
      .def_ro("moved", &SweepRecord::moved, "Vertices that moved.")
      .def_ro("max_relative_move", &SweepRecord::max_relative_move,
              "The largest move over the root mean square length of the vertex's edges.")
      .def_ro("min_shape", &SweepRecord::min_shape, "After the sweep; NaN unless record_min_shape or target_quality.")
      .def("__repr__", [](const SweepRecord& record) {
        return "SweepRecord(sweep=" + std::to_string(record.sweep) + ", evaluated=" + std::to_string(record.evaluated) +
               ", moved=" + std::to_string(record.moved) + ")";
      });
}

void bind_sliding(nb::module_& module) {
  nb::class_<SlidingResult>(module, "SlidingResult", "What became of vertices that may slide along lines.")
      .def_ro("lines", &SlidingResult::chains,
              "Runs of edges that vertices may slide on; those linked with each other count once.")
      .def_ro("vertices", &SlidingResult::vertices, "Vertices that may slide.")
      .def_ro("slid", &SlidingResult::slid, "Those that did.")
      .def_ro("largest_deviation", &SlidingResult::largest_deviation,
              "The largest distance between the old lines and the new ones, in the unit of the points.")
      .def_ro("relative_deviation", &SlidingResult::relative_deviation,
              "The largest one as a part of the length of the edge nearby: what `deviation` bounds.")
      .def_ro("in_same_place", &SlidingResult::in_same_place,
              "Vertices that would slide but for others in the same place, or within a thousandth of an edge of it.")
      .def_ro("at_edges", &SlidingResult::at_edges,
              "Likewise: that lie within an edge of another line, and the ends of these edges.")
      .def_ro("given_up", &SlidingResult::given_up,
              "So many vertices would have gone back for it that all was smoothed once more without sliding.")
      .def("__repr__",
           [](const SlidingResult& sliding) {
             std::ostringstream text;
             text << "SlidingResult(lines=" << sliding.chains << ", vertices=" << sliding.vertices
                  << ", slid=" << sliding.slid << ", largest_deviation=" << sliding.largest_deviation
                  << ", relative_deviation=" << sliding.relative_deviation
                  << ", in_same_place=" << sliding.in_same_place << ", at_edges=" << sliding.at_edges
                  << ", given_up=" << (sliding.given_up ? "True" : "False") << ")";
             return text.str();
           })
      .def("__str__", [](const SlidingResult& sliding) { return sliding_text(sliding); });
  module.def(
      "stop_reasons",
      [] {
        nb::dict reasons;
        for (const auto& [reason, name] : EnumText<StopReason>::texts) {
          reasons[nb::cast(name)] = describe(reason);
        }
        return reasons;
      },
      "Why sweeps end, in words, by the name of the reason.");
  module.def("where_lines_are", &where_lines_are, "sliding"_a,
             "How far the new lines are from the old ones, or why nothing slides; empty where nothing slid.");
}

/// What is said of a mesh that followed its boundary; None of others.
nb::object following_of(const Outcome& outcome) {
  if (!outcome.followed) {
    return nb::none();
  }
  nb::dict found;
  // Of its smoothing the counts are still there, as they were when the call came to its end.
  found["valid"] = outcome.followed->is_valid();
  found["min_relative_shape"] = outcome.followed->min_relative_shape;
  found["mean_relative_shape"] = outcome.followed->mean_relative_shape;
  found["invalid_held"] = outcome.followed->invalid_held;
  nb::list crossings;
  for (const auto& [a, b, c, d] : outcome.followed->crossings) {
    crossings.append(nb::make_tuple(nb::make_tuple(a, b), nb::make_tuple(c, d)));
  }
  found["crossings"] = crossings;
  found["overlaps"] = outcome.followed->overlaps;
  found["invalid"] = outcome.followed->invalid;
  found["largest_move"] = outcome.followed->largest_move;
  return found;
}

/// A property of the smoothing's result.
template <auto member>
auto of_smoothing() {
  return [](const Outcome& outcome) { return outcome.smoothing.*member; };
}

}  // namespace

void bind_results(nb::module_& module) {
  bind_quality(module);
  bind_sweeps(module);
  bind_sliding(module);
  nb::class_<Outcome>(module, "Outcome", "What a smoothing did; see trismooth.Result.")
      .def_ro("before", &Outcome::before)
      .def_ro("after", &Outcome::after)
      .def_prop_ro("moved", of_smoothing<&SmoothingResult::moved_vertices>())
      .def_prop_ro("sweeps", of_smoothing<&SmoothingResult::sweeps>())
      .def_prop_ro("stop_reason", [](const Outcome& outcome) { return to_string(outcome.smoothing.stop_reason); })
      .def_prop_ro("vertex_updates", of_smoothing<&SmoothingResult::vertex_updates>())
      .def_prop_ro("reverted", of_smoothing<&SmoothingResult::reverted_vertices>())
      .def_prop_ro("reverted_vertices", &reverted_of)
      .def_prop_ro("guard_rounds", of_smoothing<&SmoothingResult::guard_rounds>())
      .def_prop_ro("free_vertices", of_smoothing<&SmoothingResult::free_vertices>())
      .def_prop_ro("quadrilaterals", of_smoothing<&SmoothingResult::quadrilaterals>())
      .def_prop_ro("layers", &layers_of)
      .def_prop_ro("layers_notes",
                   [](const Outcome& outcome) {
                     const LayersResult& layers = outcome.smoothing.layers;
                     return std::vector{held_layers_text(layers), left_layers_text(layers)};
                   })
      .def_prop_ro("carried_layers_notes",
                   [](const Outcome& outcome) {
                     const LayersResult& layers = outcome.smoothing.layers;
                     return std::vector{carried_layers_text(layers), left_layers_text(layers)};
                   })
      .def_prop_ro("shared_middles_note",
                   [](const Outcome& outcome) { return shared_middles_text(outcome.smoothing.shared_middles); })
      .def_prop_ro("touching_lines_note",
                   [](const Outcome& outcome) {
                     const auto& sliding = outcome.smoothing.sliding;
                     return sliding ? touching_lines_text(*sliding, true, false) : std::string();
                   })
      .def_prop_ro("no_time_note", [](const Outcome& outcome) { return no_time_text(outcome.smoothing); })
      .def_prop_ro("no_time_to_follow_note",
                   [](const Outcome& outcome) {
                     return no_time_text(outcome.smoothing, outcome.smoothing.inverted >= 0
                                                                ? "so vertices are where they were carried"
                                                                : "so no vertex has moved");
                   })
      .def_prop_ro("following", &following_of)
      .def_prop_ro("inverted", of_smoothing<&SmoothingResult::inverted>())
      .def_prop_ro("degenerate", of_smoothing<&SmoothingResult::degenerate>())
      .def_prop_ro("colours", of_smoothing<&SmoothingResult::colours>())
      .def_prop_ro("history", of_smoothing<&SmoothingResult::history>())
      .def_prop_ro("untangling", &untangling_of)
      .def_prop_ro("sliding", of_smoothing<&SmoothingResult::sliding>())
      .def_prop_ro("backend", of_smoothing<&SmoothingResult::backend>())
      .def_prop_ro("device", of_smoothing<&SmoothingResult::device>())
      .def_prop_ro("threads", of_smoothing<&SmoothingResult::threads>())
      .def_prop_ro("kernel_launches", of_smoothing<&SmoothingResult::kernel_launches>())
      .def_prop_ro("child_launches", of_smoothing<&SmoothingResult::child_launches>())
      .def_prop_ro("device_memory_bytes", of_smoothing<&SmoothingResult::device_memory_bytes>())
      .def_prop_ro("reproducible", of_smoothing<&SmoothingResult::reproducible>())
      .def_prop_ro("note", of_smoothing<&SmoothingResult::backend_note>())
      .def_prop_ro("timings", &timings_of)
      .def("with_invalid",
           [](Outcome outcome, std::vector<std::int32_t> invalid) {
             outcome.followed.value().invalid = std::move(invalid);
             return outcome;
           })
      .def("with_quality",
           [](Outcome outcome, const QualityReport& before, const QualityReport& after) {
             outcome.before = before;
             outcome.after = after;
             return outcome;
           })
      .def("summary", [](const Outcome& outcome) {
        return outcome.before && outcome.after ? format_summary(*outcome.before, *outcome.after) : std::string();
      });
}

}  // namespace trismooth::python
