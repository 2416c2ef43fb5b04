// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/mesh_summary.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/stages/run_context.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

/// What the user should know of vertices that are held where elements meet irregularly, one sentence each.
std::vector<std::string> notes_of_irregular_vertices(const ReasonCounts& counts, const std::string& elements) {
  std::int64_t non_manifold = 0;
  std::int64_t bow_ties = 0;  // beside the ends of non-manifold edges, which join several fans as well
  for (std::size_t reasons = 0; reasons < counts.size(); ++reasons) {
    const bool on_edge = (reasons & hold::non_manifold) != 0;
    non_manifold += on_edge ? counts[reasons] : 0;
    bow_ties += !on_edge && (reasons & hold::bow_tie) != 0 ? counts[reasons] : 0;
  }
  std::vector<std::string> notes;
  const auto note = [&](std::int64_t count, const std::string& where) {
    if (count > 0) {
      notes.push_back(counted(count, "vertex ", "vertices ") + where + ": held fixed");
    }
  };
  note(non_manifold, "on edges of three " + elements + " or more");
  note(bow_ties, "where " + elements + " meet without sharing an edge (bow ties)");
  return notes;
}

}  // namespace

bool are_apart(const MeshFacts& facts) {
  return facts.reasons[0] == 0 && facts.elements > 1 && facts.components == facts.elements;
}

void summarise_mesh(RunContext& run, const MeshFacts& facts) {
  PipelineResult& result = run.result;
  InputSummary& input = result.input;
  input.vertices = facts.vertices;
  input.triangles = facts.elements - facts.quadrilaterals;
  input.quadrilaterals = facts.quadrilaterals;
  input.other_cells = facts.other_cells;
  input.lines = facts.lines;
  input.regions = facts.regions.count();
  input.region_arrays = facts.regions.arrays;
  input.region_array = list_text(facts.regions.arrays, &RegionArray::name);
  result.region_names = facts.regions.names;
  input.components = static_cast<std::int32_t>(facts.components);
  input.reoriented_triangles = facts.reoriented_triangles;
  input.free_vertices = facts.reasons[0];
  input.fixed_vertices = input.vertices - input.middle_nodes - input.merged_vertices - input.free_vertices;
  input.held = count_held(facts.reasons, facts.layers);
  input.layers = facts.layers;
  input.fixed_ids = run.options.fixed_ids.value_or(std::filesystem::path{});
  result.notes.insert(result.notes.begin(), facts.regions.notes.begin(), facts.regions.notes.end());
  std::ranges::move(notes_of_irregular_vertices(facts.reasons, facts.quadrilaterals > 0 ? "elements" : "triangles"),
                    std::back_inserter(result.notes));
  run.note(held_layers_text(facts.layers));
}

}  // namespace trismooth
