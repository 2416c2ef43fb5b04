#include "trismooth/pipeline/ranks/piece_options.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"

namespace trismooth {

namespace {

void refuse(bool is_given, const std::string& option, const std::string& way_out) {
  if (is_given) {
    throw std::invalid_argument(option + " is not there for meshes in pieces; " + way_out);
  }
}

bool names_sets(const std::vector<std::string>& names) {
  return !names.empty() && names != std::vector<std::string>{"none"};
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

}  // namespace

std::string_view what_needs_whole_mesh(const PipelineOptions& options) {
  return options.slide.along != Slide::off                   ? "--slide"
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
  refuse((options.annotate || options.annotated) && !(options.single && options.gather), "--annotate",
         "--single with --gather writes one file that has them, with the whole mesh in the memory of rank 0");
  const std::string whole(what_needs_whole_mesh(options));
  if (!whole.empty() && !options.gather) {
    throw std::invalid_argument(whole +
                                " is not done in pieces; --gather has rank 0 do it, with the whole mesh in its memory");
  }
  const bool is_read_in_pieces = names_parallel_file(options.input);
  refuse(options.format && !options.single && is_read_in_pieces, "--format", "the extension says it");
  refuse(names_sets(options.fixed_sets) && is_read_in_pieces, "--fixed-set",
         "files of VTK have no sets; hold vertices by --fixed-array");
  refuse(options.fixed_ids_are_labels, "--fixed-labels", "--fixed-ids takes rows of the file, which count from 0");
  refuse(!options.fixed_vertices.empty(), "PipelineOptions::fixed_vertices", "name them in a file, by fixed_ids");
  refuse(options.smoothing.topology == Topology::halfedge, "--topology halfedge", "the result is the same without it");
}

}  // namespace trismooth
