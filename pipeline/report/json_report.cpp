// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/json_report.h"

#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/report/timings.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/size_ratio.h"
#include "trismooth/version.h"

namespace trismooth {

namespace {

using Json = nlohmann::ordered_json;

Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number_json(const std::optional<double>& value) {
  return value ? number_json(*value) : Json(nullptr);
}

Json text_or_null(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json(nullptr);
}

template <class Enum>
Json name_of(Enum value) {
  return std::string(to_string(value));
}

Json held_json(const HeldVertices& held) {
  return {{"boundary", held.boundary}, {"interface", held.interface},     {"non_manifold", held.non_manifold},
          {"bow_tie", held.bow_tie},   {"other_cells", held.other_cells}, {"unused", held.unused},
          {"named", held.named},       {"layers", held.layers},           {"several", held.several}};
}

Json input_json(const InputSummary& input) {
  Json region_arrays = Json::array();
  for (const RegionArray& array : input.region_arrays) {
    region_arrays.push_back({{"name", array.name},
                             {"reason", name_of(array.reason)},
                             {"values", array.values},
                             {"held_vertices", array.held_vertices}});
  }
  Json point_sets = Json::array();
  for (const FilePointSet& set : input.point_sets) {
    point_sets.push_back({{"name", set.name}, {"vertices", set.vertices}, {"area", set.is_area}, {"holds", set.holds}});
  }
  Json cell_sets = Json::array();
  for (const FileCellSet& set : input.cell_sets) {
    cell_sets.push_back({{"name", set.name}, {"cells", set.cells}});
  }
  Json line_groups = Json::array();
  for (const FileLineGroup& group : input.line_groups) {
    line_groups.push_back({{"name", group.name}, {"vertices", group.vertices}});
  }
  return {{"path", input.path.string()},
          {"format", name_of(input.format)},
          {"vertices", input.vertices},
          {"triangles", input.triangles},
          {"quadrilaterals", input.quadrilaterals},
          {"other_cells", input.other_cells},
          {"lines", input.lines},
          {"quadratic_triangles", input.quadratic_triangles},
          {"quadratic_quadrilaterals", input.quadratic_quadrilaterals},
          {"middle_nodes", input.middle_nodes},
          {"regions", input.regions},
          {"region_array", input.region_array.empty() ? Json(nullptr) : Json(input.region_array)},
          {"components", input.components},
          {"fixed_vertices", input.fixed_vertices},
          {"free_vertices", input.free_vertices},
          {"merged_vertices", input.merged_vertices},
          {"reoriented_triangles", input.reoriented_triangles},
          {"region_arrays", std::move(region_arrays)},
          {"fixed_array", input.fixed_array.empty() ? Json(nullptr) : Json(input.fixed_array)},
          {"fixed_array_vertices", input.fixed_array_vertices},
          {"fixed_ids_vertices", input.fixed_ids_vertices},
          {"point_sets", std::move(point_sets)},
          {"cell_sets", std::move(cell_sets)},
          {"line_groups", std::move(line_groups)},
          {"held", held_json(input.held)}};
}

Json options_json(const PipelineOptions& options, const PipelineResult& run) {
  const std::optional<SmoothingResult>& result = run.smoothing;
  const SmoothingOptions& smoothing = options.smoothing;
  const MeanRatioOptions& mean_ratio = smoothing.mean_ratio;
  const bool is_mean_ratio = smoothing.method == Method::mean_ratio;
  const auto& written = options.written();
  Json annotated = Json::array();
  for (const Metric metric : options.annotated_metrics) {
    annotated.push_back(std::string(metrics_of_any_kind()[static_cast<std::size_t>(metric)]->name));
  }
  if (options.annotated_size_ratio) {
    annotated.push_back(std::string(size_ratio_info.name));
  }
  const bool annotates = options.annotate || options.annotated.has_value();
  Json other_outputs = Json::array();
  for (const std::filesystem::path& other : run.other_outputs) {
    other_outputs.push_back(other.string());
  }
  return {{"output", written ? Json(shown_output(*written).string()) : Json(nullptr)},
          {"other_outputs", std::move(other_outputs)},
          {"method", std::string(smoothing.method_name())},
          {"form", name_of(smoothing.form)},
          {"layout", name_of(smoothing.layout)},
          {"backend", result ? result->backend : "cpu"},
          {"execution", name_of(smoothing.execution)},
          {"order", name_of(smoothing.order)},
          {"topology", name_of(smoothing.topology)},
          {"precision", name_of(smoothing.precision)},
          {"guard", smoothing.guard},
          {"untangle", name_of(smoothing.untangles() ? Untangle::on : Untangle::off)},
          {"layers", name_of(smoothing.layers)},
          {"threads", result ? result->threads : smoothing.threads},
          {"max_sweeps", smoothing.max_sweeps},
          {"tolerance", number_json(smoothing.tolerance)},
          {"time_limit", number_json(smoothing.time_limit_seconds)},
          {"target_quality", number_json(smoothing.target_quality)},
          {"size_weight", is_mean_ratio ? number_json(mean_ratio.size_weight) : Json(nullptr)},
          {"power", is_mean_ratio && mean_ratio.power > 0 ? Json(mean_ratio.power) : Json(nullptr)},
          {"target", is_mean_ratio ? name_of(mean_ratio.target) : Json(nullptr)},
          {"steady", is_mean_ratio ? Json(mean_ratio.steady) : Json(nullptr)},
          {"size_array", is_mean_ratio ? text_or_null(options.size_array) : Json(nullptr)},
          {"quads", name_of(options.quads)},
          {"slide", name_of(options.slide.along)},
          {"corner_angle", number_json(options.slide.corner_angle)},
          {"deviation", number_json(options.slide.deviation)},
          {"curve", name_of(options.slide.curve)},
          {"slide_coincident", options.slide.coincident},
          {"project", options.project ? name_of(*options.project) : Json(nullptr)},
          {"geographic", options.geographic},
          {"fields", options.fields ? name_of(*options.fields) : Json(nullptr)},
          {"field_arrays", options.field_arrays},
          {"region_array", options.region_arrays.empty() ? Json(nullptr) : Json(options.region_arrays.front())},
          {"region_arrays", options.region_arrays},
          {"fixed_array", text_or_null(options.fixed_array)},
          {"fixed_sets", options.fixed_sets},
          {"merge", options.merge ? Json(*options.merge) : Json(nullptr)},
          {"fixed_ids", options.fixed_ids ? Json(options.fixed_ids->string()) : Json(nullptr)},
          {"fixed_ids_are_labels", options.fixed_ids_are_labels},
          {"annotate", annotates},
          {"annotated_metrics", annotates ? std::move(annotated) : Json(nullptr)}};
}

Json summary_json(const MetricSummary& summary) {
  return {{"min", number_json(summary.min)},
          {"mean", number_json(summary.mean)},
          {"max", number_json(summary.max)},
          {"stddev", number_json(summary.stddev)},
          {"acceptable_fraction", number_json(summary.acceptable_fraction)}};
}

/// Of the elements of each kind, where there are quadrilaterals.
Json kinds_json(const QualityReport& report) {
  Json kinds = Json::array();
  for (const KindQuality& kind : report.kinds) {
    Json metrics = Json::object();
    for (const MetricInfo& metric : all_metrics(kind.kind)) {
      metrics[std::string(metric.name)] = summary_json(kind[metric.metric]);
    }
    kinds.push_back({{"kind", kind.kind == ElementKind::triangle ? "triangle" : "quadrilateral"},
                     {"elements", kind.elements},
                     {"inverted", kind.inverted},
                     {"degenerate", kind.degenerate},
                     {"metrics", std::move(metrics)}});
  }
  return kinds;
}

/// `names`: of regions.
Json quality_json(const QualityReport& report, const std::vector<std::string>& names) {
  Json metrics = Json::object();
  for (const MetricInfo* const metric : metrics_of(report)) {
    metrics[std::string(metric->name)] = summary_json(summary_of(report, *metric));
  }
  Json worst = Json::array();
  for (const WorstElement& element : report.worst) {
    worst.push_back({{"cell", element.element},
                     {"shape", number_json(element.shape)},
                     {"centroid", Json::array({number_json(element.centroid.x), number_json(element.centroid.y)})},
                     {"region", element.region < 0 ? Json(nullptr) : Json(names[element.region])},
                     {"all_fixed", element.all_fixed}});
  }
  return {{"triangles", report.triangles},
          {"quadrilaterals", report.quadrilaterals},
          {"inverted", report.inverted},
          {"degenerate", report.degenerate},
          {"metrics", std::move(metrics)},
          {"kinds", kinds_json(report)},
          {"histogram", {{"shape", report.shape_histogram}}},
          {"worst", std::move(worst)}};
}

Json gates_json(const std::vector<GateOutcome>& outcomes) {
  Json gates = Json::array();
  for (const GateOutcome& outcome : outcomes) {
    gates.push_back({{"gate", gate_text(outcome.gate)},
                     {"name", outcome.gate.name},
                     {"comparison", name_of(outcome.gate.comparison)},
                     {"bound", number_json(outcome.gate.bound)},
                     {"value", number_json(outcome.value)},
                     {"passed", outcome.passed}});
  }
  return gates;
}

/// The report with the quality of each region and of quadratic elements.
Json quality_json(const QualityReport& report, const std::vector<std::string>& names,
                  const std::vector<RegionQuality>& qualities, const std::optional<QuadraticQuality>& quadratic) {
  Json regions = Json::array();
  for (std::size_t r = 0; r < qualities.size(); ++r) {
    const RegionQuality& quality = qualities[r];
    regions.push_back({{"region", names[r]},
                       {"triangles", quality.triangles},
                       {"quadrilaterals", quality.quadrilaterals},
                       {"inverted", quality.inverted},
                       {"shape", {{"min", number_json(quality.min_shape)}, {"mean", number_json(quality.mean_shape)}}},
                       {"min_angle", {{"min", number_json(quality.min_angle)}}}});
  }
  Json json = quality_json(report, names);
  json["regions"] = std::move(regions);
  json["quadratic"] = quadratic ? Json{{"elements", quadratic->elements},
                                       {"quadrilaterals", quadratic->quadrilaterals},
                                       {"invalid", quadratic->invalid},
                                       {"undecided", quadratic->undecided},
                                       {"min_jacobian", number_json(quadratic->min_jacobian)}}
                                : Json(nullptr);
  return json;
}

Json untangling_json(const std::optional<UntanglingResult>& untangling) {
  if (!untangling) {
    return nullptr;
  }
  return {{"inverted_before", untangling->inverted_before},
          {"inverted_untangled", untangling->inverted_untangled},
          {"inverted_after", untangling->inverted_after},
          {"inverted_fixed", untangling->inverted_fixed},
          {"turned_components", untangling->turned_components}};
}

Json sliding_json(const std::optional<SlidingResult>& sliding) {
  if (!sliding) {
    return nullptr;
  }
  return {{"lines", sliding->chains},
          {"vertices", sliding->vertices},
          {"slid", sliding->slid},
          {"largest_deviation", number_json(sliding->largest_deviation)},
          {"relative_deviation", number_json(sliding->relative_deviation)},
          {"in_same_place", sliding->in_same_place},
          {"at_edges", sliding->at_edges},
          {"given_up", sliding->given_up}};
}

Json areas_json(const PipelineResult& result) {
  Json areas = Json::array();
  for (std::size_t region = 0; region < result.areas.size(); ++region) {
    const bool has_name = region < result.region_names.size();
    areas.push_back({{"region", has_name ? Json(result.region_names[region]) : Json(nullptr)},
                     {"before", number_json(result.areas[region].before)},
                     {"after", number_json(result.areas[region].after)}});
  }
  return areas;
}

Json smoothing_json(const SmoothingResult& smoothing, Topology topology) {
  Json history = Json::array();
  for (const SweepRecord& record : smoothing.history) {
    history.push_back({{"sweep", record.sweep},
                       {"evaluated", record.evaluated},
                       {"moved", record.moved},
                       {"max_relative_move", number_json(record.max_relative_move)},
                       {"min_shape", number_json(record.min_shape)}});
  }
  return {{"sweeps", smoothing.sweeps},
          {"stop_reason", name_of(smoothing.stop_reason)},
          {"vertex_updates", smoothing.vertex_updates},
          {"moved_vertices", smoothing.moved_vertices},
          {"reverted_vertices", smoothing.reverted_vertices},
          {"device", smoothing.device},
          {"topology", name_of(topology)},
          {"backend_note", smoothing.backend_note.empty() ? Json(nullptr) : Json(smoothing.backend_note)},
          {"reproducible", smoothing.reproducible},
          {"kernel_launches", smoothing.kernel_launches},
          {"child_launches", smoothing.child_launches},
          {"device_memory_bytes", smoothing.device_memory_bytes},
          {"guard_rounds", smoothing.guard_rounds},
          {"untangling", untangling_json(smoothing.untangling)},
          {"sliding", sliding_json(smoothing.sliding)},
          {"history", std::move(history)}};
}

Json size_change_json(const SizeChange& change) {
  return {{"elements", change.triangles},
          {"left_out", change.left_out},
          {"rms_log_ratio", number_json(change.rms_log_ratio)},
          {"ratio_p1", number_json(change.ratio_p1)},
          {"ratio_p99", number_json(change.ratio_p99)}};
}

Json size_array_json(const InputSummary& input) {
  if (input.size_array.empty()) {
    return nullptr;
  }
  return {{"name", input.size_array}, {"values", input.sizes_are_areas ? "areas_of_cells" : "lengths_at_points"}};
}

Json size_fit_json(const PipelineResult& result) {
  if (!result.size_fit_before || !result.size_fit_after) {
    return nullptr;
  }
  const auto side = [](const SizeFit& fit) {
    return Json{
        {"elements", fit.elements}, {"left_out", fit.left_out}, {"rms_log_ratio", number_json(fit.rms_log_ratio)}};
  };
  return {{"before", side(*result.size_fit_before)}, {"after", side(*result.size_fit_after)}};
}

Json fields_json(const std::vector<InterpolatedField>& fields) {
  Json json = Json::array();
  for (const InterpolatedField& field : fields) {
    json.push_back({{"name", field.name}, {"interpolated_vertices", field.interpolated_vertices}});
  }
  return json;
}

Json deformation_json(const PipelineOptions& options, const std::optional<DeformationResult>& result) {
  if (!result) {
    return nullptr;
  }
  Json steps = Json::array();
  for (const DeformedStep& step : result->steps) {
    steps.push_back({{"displacements", step.displacements.string()},
                     {"output", shown_output(step.output).string()},
                     {"inverted", step.quality.inverted},
                     {"degenerate", step.quality.degenerate},
                     {"invalid_quadratic", step.quadratic ? Json(step.quadratic->invalid) : Json(nullptr)},
                     {"min_shape", number_json(step.quality[Metric::shape].min)},
                     {"mean_shape", number_json(step.quality[Metric::shape].mean)},
                     {"min_relative_shape", number_json(step.min_relative_shape)},
                     {"mean_relative_shape", number_json(step.mean_relative_shape)},
                     {"invalid_held", step.invalid_held},
                     {"crossings", step.crossings},
                     {"overlaps", step.overlaps},
                     {"largest_displacement", number_json(step.largest_displacement)},
                     {"sweeps", step.sweeps},
                     {"coordinates_hash", hash_text(step.coordinates_hash)}});
  }
  return {{"array", options.deformation->array.empty() ? Json(nullptr) : Json(options.deformation->array)},
          {"start", name_of(options.deformation->start)},
          {"worst_step", result->worst + 1},
          {"steps", std::move(steps)}};
}

Json comparison_json(const std::optional<ComparisonResult>& comparison) {
  if (!comparison) {
    return nullptr;
  }
  return {{"path", comparison->path.string()},
          {"format", name_of(comparison->format)},
          {"moved_vertices", comparison->moved_vertices},
          {"rounded_vertices", comparison->rounded_vertices},
          {"held_vertices", comparison->held_vertices},
          {"held", held_json(comparison->held)},
          {"largest_displacement", number_json(comparison->largest_displacement)},
          {"mean_displacement", number_json(comparison->mean_displacement)},
          {"farthest_vertex", comparison->farthest_vertex < 0 ? Json(nullptr) : Json(comparison->farthest_vertex)},
          {"largest_relative_displacement", number_json(comparison->largest_relative_displacement)},
          {"mean_relative_displacement", number_json(comparison->mean_relative_displacement)},
          {"better_elements", comparison->better_elements},
          {"worse_elements", comparison->worse_elements},
          {"newly_invalid_elements", comparison->newly_invalid_elements},
          {"newly_valid_elements", comparison->newly_valid_elements},
          {"mirrored_elements", comparison->mirrored_elements},
          {"coordinates_hash", hash_text(comparison->coordinates_hash)}};
}

Json timings_json(const PipelineTimings& timings) {
  Json json = Json::object();
  for (const auto& [name, milliseconds] : timing_parts(timings)) {
    json[std::string(name)] = number_json(milliseconds);
  }
  json["total"] = number_json(timings.total);
  return json;
}

}  // namespace

std::string json_report(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record) {
  const Json report{
      {"trismooth", std::string(version())},
      {"date", record.date},
      {"command", record.command},
      {"input", input_json(result.input)},
      {"options", options_json(options, result)},
      {"before", quality_json(result.before, result.region_names, result.regions_before, result.quadratic_before)},
      {"after", result.after
                    ? quality_json(*result.after, result.region_names, result.regions_after, result.quadratic_after)
                    : Json(nullptr)},
      {"size_change", result.size_change ? size_change_json(*result.size_change) : Json(nullptr)},
      {"size_array", size_array_json(result.input)},
      {"size_fit", size_fit_json(result)},
      {"fields", fields_json(result.fields)},
      {"kept_fields", result.kept_fields},
      {"areas", areas_json(result)},
      {"deformation", deformation_json(options, result.deformation)},
      {"comparison", comparison_json(result.comparison)},
      {"gates", gates_json(record.gates)},
      {"smoothing", result.smoothing ? smoothing_json(*result.smoothing, result.topology) : Json(nullptr)},
      {"coordinates_hash", result.smoothing ? Json(hash_text(result.coordinates_hash)) : Json(nullptr)},
      {"uncommitted_hash", result.smoothing ? Json(hash_text(result.unguarded_hash)) : Json(nullptr)},
      {"warnings", result.warnings},
      {"timings_ms", timings_json(result.timings_ms)},
      {"peak_memory_bytes", result.peak_memory_bytes}};
  constexpr int indent = 2;
  return report.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace trismooth
