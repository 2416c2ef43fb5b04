// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/run_record.h"

/// A run with a different value in every field, for tests of reports.
namespace sample {

inline trismooth::QualityReport quality(double offset) {
  trismooth::QualityReport report;
  report.triangles = 210;
  report.degenerate = 6;
  for (std::size_t i = 0; i < report.metrics.size(); ++i) {
    const double base = offset + static_cast<double>(i);
    report.metrics[i] = {base + 0.1, base + 0.2, base + 0.3, base + 0.4, base / 100};
  }
  for (std::size_t bin = 0; bin < report.shape_histogram.size(); ++bin) {
    report.shape_histogram[bin] = static_cast<std::int64_t>(bin) + 1;
  }
  report.worst = {{17, offset + 0.1, {1.5, -2.5}}, {4, offset + 0.2, {3.25, 4.0}, true}};
  return report;
}

inline trismooth::PipelineOptions options() {
  trismooth::PipelineOptions options;
  options.input = "plate.vtk";
  options.output = "out.vtk";
  return options;
}

inline trismooth::PipelineResult result() {
  trismooth::PipelineResult result;
  trismooth::InputSummary& input = result.input;
  input.path = "plate.vtk";
  input.format = trismooth::FileFormat::vtk;
  input.vertices = 120;
  input.triangles = 210;
  input.other_cells = 5;
  input.regions = 3;
  input.region_array = "mat_id";
  input.components = 2;
  input.fixed_vertices = 40;
  input.free_vertices = 80;
  input.reoriented_triangles = 7;
  input.region_arrays = {{"mat_id", trismooth::RegionReason::known_name, 3, 11}};
  input.held = {.boundary = 27, .interface = 11, .other_cells = 9, .several = 7};
  result.before = quality(0);
  result.after = quality(0.25);
  trismooth::SmoothingResult smoothing;
  smoothing.sweeps = 3;
  smoothing.stop_reason = trismooth::StopReason::fixed_point;
  smoothing.vertex_updates = 190;
  smoothing.moved_vertices = 61;
  smoothing.reverted_vertices = 2;
  smoothing.guard_rounds = 1;
  smoothing.free_vertices = 80;
  smoothing.history = {{1, 80, 60, 0.5, 0.125}, {2, 70, 12, 0.25, 0.375}, {3, 40, 0, 0}};
  smoothing.backend = "cpu";
  smoothing.device = "A <fast> processor";
  smoothing.threads = 2;
  result.smoothing = smoothing;
  result.size_change = trismooth::SizeChange{204, 6, 0.125, 0.5, 2.25};
  result.coordinates_hash = 0x0123456789abcdefU;
  result.unguarded_hash = 0xfedcba9876543210U;
  result.notes = {"a note with <b>markup</b> & an ampersand"};
  result.timings_ms = {1.5, 2.5, 3.5, 4.5, 0, 5.5, 6.5, 7.5, 8.5, 9.5, 50};
  result.peak_memory_bytes = 987654321;
  return result;
}

/// Two gates, of which one failed.
inline trismooth::RunRecord record() {
  trismooth::RunRecord record;
  record.command = "trismooth smooth plate.vtk 'a <b>.vtk'";
  record.date = "2026-11-22T10:05:31+01:00";
  record.gates = {{{"min_shape", trismooth::Comparison::at_least, 0.5}, 0.35, false},
                  {{"degenerate", trismooth::Comparison::below, 7}, 6, true}};
  return record;
}

/// The same of a run that untangled the mesh first.
inline trismooth::PipelineResult untangled_result() {
  trismooth::PipelineResult untangled = result();
  untangled.smoothing->untangling = {
      .inverted_before = 12, .inverted_untangled = 4, .inverted_after = 3, .inverted_fixed = 2, .turned_components = 1};
  untangled.timings_ms.untangle = 10.5;
  return untangled;
}

/// The same of a run on a device, in the paper's literal version.
inline trismooth::PipelineOptions cuda_options() {
  trismooth::PipelineOptions chosen = options();
  chosen.smoothing.execution = trismooth::Execution::cdp;
  chosen.smoothing.layout = trismooth::Layout::soa;
  chosen.smoothing.order = trismooth::Order::unordered;
  chosen.smoothing.topology = trismooth::Topology::device;
  return chosen;
}

inline trismooth::PipelineResult cuda_result() {
  trismooth::PipelineResult smoothed = result();
  smoothed.smoothing->backend = "cuda";
  smoothed.smoothing->device = "A <fast> GPU";
  smoothed.smoothing->threads = 0;
  smoothed.smoothing->kernel_launches = 14;
  smoothed.smoothing->child_launches = 120;
  smoothed.smoothing->device_memory_bytes = std::int64_t{3} << 19;
  smoothed.smoothing->reproducible = false;
  return smoothed;
}

/// The same of a run that only checked.
inline trismooth::PipelineResult quality_result() {
  trismooth::PipelineResult checked = result();
  checked.after.reset();
  checked.smoothing.reset();
  checked.size_change.reset();
  return checked;
}

}  // namespace sample
