// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/write_stage.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/warnings.h"

namespace trismooth {

namespace {

/// What holds each vertex. Nothing holds what has slid, and a middle is held where its corners are.
std::vector<std::uint8_t> holds_of(const RunState& run) {
  std::vector<std::uint8_t> holds = run.found.fixed;
  if (run.slide != Slide::off) {
    for (std::size_t v = 0; v < holds.size(); ++v) {
      const bool has_slid = !std::equal(run.input_points.begin() + 3 * static_cast<std::ptrdiff_t>(v),
                                        run.input_points.begin() + 3 * static_cast<std::ptrdiff_t>(v + 1),
                                        run.document.points.begin() + 3 * static_cast<std::ptrdiff_t>(v));
      holds[v] = has_slid ? std::uint8_t{0} : holds[v];
    }
  }
  for (std::size_t v = 0; v < run.mesh.merged.size(); ++v) {
    holds[v] = holds[run.mesh.merged[v]];
  }
  for (const MiddleNode& middle : run.mesh.middles) {
    const bool follows = std::ranges::any_of(middle.followed(), [&](std::int32_t v) { return holds[v] == 0; });
    if (follows) {
      holds[middle.vertex] = 0;
    }
  }
  return holds;
}

/// What the output does not hold, of the arrays of the program's own stage as well where it takes arrays.
std::vector<std::string> losses_of(RunState& run, FileFormat target, bool takes_arrays) {
  std::vector<DataArray>& arrays = run.document.point_arrays;
  const std::size_t of_file = arrays.size();
  if (takes_arrays) {
    std::ranges::copy(run.stage_arrays, std::back_inserter(arrays));
  }
  std::vector<std::string> lost = what_is_lost(run.document, target);
  arrays.resize(of_file);
  return lost;
}

/// Throws where a file that is written besides the output is the input: MED or CGNS in "case.h5", and "case.xdmf".
void require_other_than_input(const RunState& run, FileFormat target, const std::filesystem::path& path) {
  const auto others_of = codec_of(target).other_files_of;
  if (others_of == nullptr || run.document.format == target) {
    return;
  }
  std::error_code error;  // what does not exist is not the input
  for (const std::filesystem::path& other : others_of(path)) {
    if (std::filesystem::equivalent(other, run.options.input, error)) {
      throw WriteError(path, "has its numbers in " + other.filename().string() +
                                 ", which is the input here: give the output another name");
    }
  }
}

}  // namespace

AddedArrays annotations_of(RunState& run) {
  AddedArrays added;
  added.cell_arrays = metrics_of_cells(run);
  std::ranges::copy(run.metrics_before, std::back_inserter(added.cell_arrays));
  added.point_arrays.push_back(fixed_annotation(holds_of(run), run.workers));
  if (run.result.smoothing) {
    added.point_arrays.push_back(displacement_annotation(run.input_points, run.document.points, run.workers));
  }
  return added;
}

std::vector<DataArray> metrics_of_cells(RunState& run, std::string_view suffix) {
  const std::size_t cells = run.document.cells.size();
  std::vector<DataArray> arrays = metric_annotations(run.options.annotated_metrics, run.view(), run.mesh.cells, cells,
                                                     run.workers, suffix, run.mesh.copies);
  if (run.options.annotated_size_ratio) {
    arrays.push_back(size_ratio_annotation(run.view(), run.mesh.cells, cells, run.workers, suffix, run.mesh.copies));
  }
  return arrays;
}

WrittenAside write_output(RunState& run, const std::filesystem::path& path, bool annotate) {
  const FileFormat target = output_format(path, run.document.format, run.options.format);
  require_other_than_input(run, target, path);
  const std::vector<std::string> dropped = drop_annotations(run.document);
  const bool takes_arrays = takes_added_arrays(run.document, target);
  std::ranges::move(losses_of(run, target, takes_arrays), std::back_inserter(run.result.losses));
  const bool annotates = annotate && takes_arrays;
  if (annotate && !annotates) {
    const std::string which = target == FileFormat::msh ? " of version 1, or with tags above 2147483647," : "";
    run.note(
        "--annotate has no effect: " + std::string(title_of(target)) + " files" +
        (has_arrays(target) ? which + " that were read are written back with nothing added" : " take no annotations") +
        "; write " + (is_available(FileFormat::vtu) ? ".vtu" : ".vtk") + " to get them");
  }
  if (!annotates && !dropped.empty()) {
    run.note(note_of_dropped_annotations(dropped));
  }
  const OriginalFile* const original = run.document.format == target ? run.document.original.get() : nullptr;
  if (!dropped.empty() && original != nullptr && !original->takes_added_arrays()) {
    run.note("the " + std::string(title_of(target)) + " file is made anew without its old annotations" +
             (target == FileFormat::ply ? ": binary, and without comments" : ""));
  }
  AddedArrays added = annotates ? annotations_of(run) : AddedArrays{};
  if (takes_arrays) {
    std::ranges::copy(run.stage_arrays, std::back_inserter(added.point_arrays));
  } else if (!run.stage_arrays.empty()) {
    run.note(std::string(title_of(target)) +
             " output does not take the point arrays of the program's own stage; write " +
             (is_available(FileFormat::vtu) ? ".vtu" : ".vtk") + " to get them");
  }
  return write_mesh_aside(path, run.document, added, FileOptions{run.options.smoothing.threads, run.options.format});
}

}  // namespace trismooth
