// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/piece_options.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <xxhash.h>

#include "trismooth/base/enum_text.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/mpi/same_options.h"
#include "trismooth/pipeline/input/point_sets.h"

namespace trismooth {

namespace {

void refuse(bool is_given, const std::string& option, const std::string& way_out) {
  if (is_given) {
    throw std::invalid_argument(option + " is not there for meshes in pieces; " + way_out);
  }
}

/// Whether it names a set otherwise than by a label, ARRAY=NUMBER.
bool names_sets(const std::vector<std::string>& names) {
  return !holds_no_sets(names) &&
         std::ranges::any_of(names, [](const std::string& name) { return name.find('=') == std::string::npos; });
}

void require_output(const PipelineOptions& options, const std::filesystem::path& output) {
  const bool is_in_pieces = names_parallel_file(output);
  const bool is_read_in_pieces = names_parallel_file(options.input);
  if (options.single) {
    if (is_in_pieces) {
      throw std::invalid_argument("--single writes one file, and " + output.string() +
                                  " is the name of a mesh in pieces");
    }
    if (!is_standard_stream(output)) {
      output_format(output, std::nullopt, options.format);
    }
  } else if (is_read_in_pieces && (!is_in_pieces || extension_of(output) != extension_of(options.input))) {
    throw std::invalid_argument("a mesh in pieces is written as it is read: the name of the output has to end in " +
                                extension_of(options.input) + ", and is " + output.string() +
                                "; --single writes one file, with the whole mesh in the memory of rank 0");
  }
}

/// As the program has it: that of the library is the member's name.
std::string program_option(std::string name) {
  if (name == "record_min_shape") {
    return "--verbose";  // as --target-quality, which stands before it, is the same
  }
  if (name == "time_limit_seconds") {
    return "--time-limit";
  }
  if (name == "slide.coincident") {
    return "--slide-coincident";
  }
  if (name == "slide.along") {
    return "--slide";
  }
  std::ranges::replace(name, '_', '-');
  return "--" + name.substr(name.find('.') + 1);
}

std::int64_t hash_of(std::string_view text) {
  return static_cast<std::int64_t>(XXH64(text.data(), text.size(), 0));
}

std::int64_t number_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += name + '\0';
  }
  return hash_of(text);
}

std::int64_t number_of(const std::optional<std::filesystem::path>& path) {
  return path ? hash_of(path->native()) : -1;
}

std::int64_t number_of(const std::optional<std::string>& text) {
  return text ? hash_of(*text) : -1;
}

std::vector<std::string> annotated_metrics(const PipelineOptions& options) {
  std::vector<std::string> names{options.annotated_size_ratio ? "size_ratio" : ""};
  for (const Metric metric : options.annotated_metrics) {
    names.push_back(std::to_string(static_cast<int>(metric)));
  }
  return names;
}

template <class Enum>
std::int64_t number_of(const std::optional<Enum>& value) {
  return value ? static_cast<std::int64_t>(*value) : -1;
}

}  // namespace

void require_same_options(const PipelineOptions& options, const mpi::Communicator& ranks) {
  std::vector<mpi::OptionValue> values = mpi::option_values(options.smoothing, options.slide);
  for (mpi::OptionValue& value : values) {
    value.first = program_option(value.first);
  }
  values.insert(values.end(), {{"INPUT", hash_of(options.input.native())},
                               {"OUTPUT", number_of(options.output)},
                               {"--format", number_of(options.format)},
                               {"--region-array", number_of(options.region_arrays)},
                               {"--fixed-array", number_of(options.fixed_array)},
                               {"--fixed-set", number_of(options.fixed_sets)},
                               {"--fixed-labels", options.fixed_ids_are_labels ? number_of(options.fixed_ids) : -1},
                               {"--fixed-ids", options.fixed_ids_are_labels ? -1 : number_of(options.fixed_ids)},
                               {"--merge", options.merge ? std::bit_cast<std::int64_t>(*options.merge) : -1},
                               {"--size-array", number_of(options.size_array)},
                               {"--fields", number_of(options.fields)},
                               {"--field-array", number_of(options.field_arrays)},
                               {"--project", number_of(options.project)},
                               {"--geographic", options.geographic ? 1 : 0},
                               {"--quads", static_cast<std::int64_t>(options.quads)},
                               {"--partition", number_of(options.partition)},
                               {"--gather", options.gather ? 1 : 0},
                               {"--single", options.single ? 1 : 0},
                               {"--annotate", options.annotate ? 0 : number_of(options.annotated)},
                               {"--annotate-metrics", number_of(annotated_metrics(options))},
                               {"--require size_ratio", options.size_ratio ? 1 : 0}});
  mpi::require_same(values, ranks);
}

std::string_view what_needs_whole_mesh(const PipelineOptions& options) {
  return options.gather                                      ? "--gather"
         : options.slide.along != Slide::off                 ? "--slide"
         : options.project                                   ? "--project"
         : options.geographic                                ? "--geographic"
         : options.size_array                                ? "--size-array"
         : options.fields == Fields::interpolate             ? "--fields interpolate"
         : !options.field_arrays.empty()                     ? "--field-array"
         : options.merge                                     ? "--merge"
         : options.size_ratio                                ? "--require size_ratio"
         : options.annotate || options.annotated.has_value() ? "--annotate"
                                                             : "";
}

void require_piece_options(const PipelineOptions& options) {
  if (options.written()) {
    require_output(options, *options.written());
  }
  const bool is_read_in_pieces = names_parallel_file(options.input);
  refuse(options.format && !options.single && is_read_in_pieces, "--format", "the extension says it");
  refuse(names_sets(options.fixed_sets) && is_read_in_pieces, "--fixed-set with the name of a set",
         "files of VTK have none; ARRAY=NUMBER and --fixed-array hold vertices");
  refuse(!options.fixed_vertices.empty(), "PipelineOptions::fixed_vertices", "name them in a file, by fixed_ids");
  refuse(options.smoothing.topology == Topology::halfedge, "--topology halfedge",
         "the result of triangles is the same without it");
}

}  // namespace trismooth
