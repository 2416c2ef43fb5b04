// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/mesh_options.h"

#include <string>
#include <utility>

#include "trismooth/base/machine/worker_threads.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/cli/format_option.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/picture_options.h"
#include "trismooth/pipeline/report/report_file.h"

namespace trismooth {

void add_hold_options(CLI::App& command, MeshRunSettings& settings) {
  PipelineOptions& options = settings.pipeline;
  constexpr bool repeatable = true;
  add_parsed_option(
      command, "--region-array", "NAME",
      "Cell array that gives regions; vertices between two regions are fixed. Repeatable; none: there are no regions "
      "[arrays known by their name, as region or gmsh:physical, and those that look like regions]",
      [&options](const std::string& text) { options.region_arrays.push_back(text); }, repeatable)
      ->group(option_group::constraints);
  add_parsed_option(
      command, "--fixed-array", "NAME",
      "Point array; where it is not 0, the vertex is fixed. none: no array fixes any [fixed, if the file has it]",
      [&options](const std::string& text) { options.fixed_array = text; })
      ->group(option_group::constraints);
  add_parsed_option(
      command, "--fixed-set", "NAME",
      "Set of points in the file (NSET, Corners, boundary) whose vertices are fixed, or ARRAY=NUMBER, what the file "
      "gives that number (medit:ref=7). Repeatable; none: no set fixes any [all that do not cover an area]",
      [&options](const std::string& text) { options.fixed_sets.push_back(text); }, repeatable)
      ->group(option_group::constraints);
  CLI::Option* const ids = add_parsed_option(
      command, "--fixed-ids", "FILE",
      "Text file of vertices to fix: their places in the mesh file, which count from 0 whatever numbers the file gives",
      [&options](const std::string& text) { options.fixed_ids = text; });
  ids->group(option_group::constraints);
  add_parsed_option(command, "--fixed-labels", "FILE",
                    "Text file of vertices to fix: the numbers that the mesh file itself gives them, as node tags of "
                    "MSH, nodes of Abaqus or global ids of pieces",
                    [&options](const std::string& text) {
                      options.fixed_ids = text;
                      options.fixed_ids_are_labels = true;
                    })
      ->excludes(ids)
      ->group(option_group::constraints);
  add_enum_option(command, "--quads", options.quads, "Quadrilaterals: smooth them as well, or hold their vertices")
      ->group(option_group::constraints);
}

void add_mesh_options(CLI::App& command, MeshRunSettings& settings) {
  add_hold_options(command, settings);
  PipelineOptions& options = settings.pipeline;
  add_parsed_option(command, "--project", alternatives<Projection>(),
                    "For a mesh that is not flat, a surface z(x, y): smooth it in x and y; z is a value at points, "
                    "which --fields keep leaves as it is",
                    [&options](const std::string& text) { options.project = parse_choice<Projection>(text); })
      ->group(option_group::coordinates);
  command
      .add_flag("--geographic", options.geographic,
                "x is longitude and y latitude, in degrees: shapes are those on the sphere, also across the date line")
      ->group(option_group::coordinates);
  add_parsed_option(command, "--merge", "DISTANCE",
                    "Corners of elements that are no further apart count as one vertex, in the file's unit; they move "
                    "together, and the file keeps all of them [none are joined]",
                    [&options](const std::string& text) { options.merge = parse_finite(text, 0); })
      ->group(option_group::constraints);
}

void add_piece_options(CLI::App& command, MeshRunSettings& settings) {
  command
      .add_flag(
          "--single", settings.pipeline.single,
          "Of a mesh in pieces over MPI ranks: write one file of any format, by rank 0, with the whole mesh in its "
          "memory")
      ->group(option_group::running);
  command
      .add_flag("--gather", settings.pipeline.gather,
                "Of a mesh in pieces over MPI ranks: rank 0 does all but the sweeps, with the whole mesh in its memory "
                "[it does where something is not done in pieces: --slide, untangling, ...]")
      ->group(option_group::running);
}

void add_result_options(CLI::App& command, MeshRunSettings& settings) {
  add_format_option(command, settings.pipeline.format)->group(option_group::running);
  add_parsed_option(command, "--threads", "N", "CPU threads; the result does not depend on it [one a core]",
                    [&settings](const std::string& text) {
                      settings.pipeline.smoothing.threads = parse_integer(text, 0, most_threads());
                    })
      ->group(option_group::running);
  constexpr bool repeatable = true;
  add_parsed_option(
      command, "--report", "FILE", "Write a report: FILE.json or FILE.html. Repeatable",
      [&settings](const std::string& text) {
        require_report_extension(text);
        settings.reports.emplace_back(text);
      },
      repeatable)
      ->group(option_group::results);
  add_picture_options(command, settings.pictures);
  add_parsed_option(
      command, "--require", "'NAME>=X'",
      "Exit with 1 if the result misses this. Compares by >= <= > < ==; names: min_angle, max_angle, inverted, "
      "degenerate, invalid_quadratic, triangles, quadrilaterals, size_ratio, of deform crossings and overlaps, and "
      "min_, mean_, max_, stddev_ or "
      "acceptable_ before a metric: min_shape; 'triangle.' or 'quadrilateral.' before a name takes those alone. "
      "Repeatable",
      [&settings](const std::string& text) { settings.gates.push_back(parse_gate(text)); }, repeatable)
      ->group(option_group::results);
  const auto add_verbosity_flag = [&](const char* name, Verbosity verbosity, const char* help) {
    const auto choose = [&settings, verbosity] {
      if (settings.verbosity != Verbosity::normal) {
        throw CLI::ExcludesError("--quiet", "--verbose");
      }
      settings.verbosity = verbosity;
    };
    command.add_flag_callback(name, choose, help)->group(option_group::results);
  };
  add_verbosity_flag("--quiet,-q", Verbosity::quiet, "Print errors and failed gates only");
  add_verbosity_flag("--verbose,-v", Verbosity::verbose,
                     "Print all metrics, the worst elements, and every sweep, note and time");
}

void add_annotations_options(CLI::App& command, MeshRunSettings& settings) {
  command
      .add_flag("--annotate", settings.pipeline.annotate,
                "Add arrays to VTK or MSH output, or to PLY, XDMF, Exodus II, MED or CGNS made of another format, in "
                "place of earlier ones: "
                "trismooth:shape, trismooth:shape_before (cells), "
                "trismooth:fixed, trismooth:displacement (points)")
      ->group(option_group::results);
  add_annotated_metrics_option(command, settings);
}

void add_annotated_metrics_option(CLI::App& command, MeshRunSettings& settings) {
  add_parsed_option(
      command, "--annotate-metrics", "M,M,...",
      "Metrics that --annotate shows: shape, min_angle, ...; the message for an unknown one lists all [shape]",
      [&settings](const std::string& text) {
        AnnotatedMetrics annotated = parse_metrics(text);
        settings.pipeline.annotated_metrics = std::move(annotated.metrics);
        settings.pipeline.annotated_size_ratio = annotated.size_ratio;
      })
      ->needs("--annotate")
      ->group(option_group::results);
}

}  // namespace trismooth
