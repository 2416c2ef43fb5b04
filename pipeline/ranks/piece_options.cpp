#include "trismooth/pipeline/ranks/piece_options.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/parallel_file.h"

namespace trismooth {

namespace {

void refuse(bool is_given, const std::string& option, const std::string& way_out) {
  if (is_given) {
    throw std::invalid_argument(option + " is not there for meshes in pieces yet; " + way_out);
  }
}

bool names_sets(const std::vector<std::string>& names) {
  return !names.empty() && names != std::vector<std::string>{"none"};
}

}  // namespace

void require_piece_options(const PipelineOptions& options) {
  const std::string as_one_file = "leave it out, or smooth the mesh as one file";
  if (options.output &&
      !(names_parallel_file(*options.output) && extension_of(*options.output) == extension_of(options.input))) {
    throw std::invalid_argument("a mesh in pieces is written as it is read: the name of the output has to end in " +
                                extension_of(options.input) + ", and is " + options.output->string());
  }
  refuse(options.format.has_value(), "--format", "the extension says it");
  refuse(options.geographic, "--geographic", as_one_file);
  refuse(options.project.has_value(), "--project", as_one_file);
  refuse(options.slide.along != Slide::off, "--slide", as_one_file);
  refuse(options.size_array.has_value(), "--size-array", as_one_file);
  refuse(names_sets(options.fixed_sets), "--fixed-set", "files of VTK have no sets; hold vertices by --fixed-array");
  refuse(!options.fixed_vertices.empty(), "PipelineOptions::fixed_vertices", "name them in a file, by fixed_ids");
  refuse(options.fields == Fields::interpolate, "--fields interpolate", as_one_file);
  refuse(!options.field_arrays.empty(), "--field-array", as_one_file);
  refuse(options.annotate || options.annotated.has_value(), "--annotate", as_one_file);
  refuse(options.smoothing.topology == Topology::halfedge, "--topology halfedge", "the result is the same without it");
}

}  // namespace trismooth
