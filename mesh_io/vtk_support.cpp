// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_support.h"

#include <stdexcept>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/new_parallel_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/ranges/vtu_range.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_descriptions.h"

// The one place that knows whether the build has VTK.
#ifdef TRISMOOTH_HAS_VTK
#include "trismooth/mesh_io/vtk_xml/silence_vtk.h"
#endif

namespace trismooth {

#ifdef TRISMOOTH_HAS_VTK

bool has_vtk() {
  return true;
}

void silence_libraries() {
  silence_vtk();
}

#else

bool has_vtk() {
  return false;
}

const Codec vtu_codec{vtu_description};
const Codec vtp_codec{vtp_description};

void silence_libraries() {}

ParallelFile read_parallel_file(const std::filesystem::path& path, std::string_view /*bytes*/) {
  throw ReadError(path, "is a mesh in pieces of VTK's XML formats, which this build cannot read: build with VTK");
}

std::string with_sources(std::string_view bytes, const ParallelFile& /*file*/,
                         std::span<const std::string> /*sources*/) {
  return std::string(bytes);
}

NewParallelFile make_parallel_file(FileFormat /*piece_format*/, const MeshDocument& /*document*/,
                                   std::span<const std::string> /*sources*/) {
  throw std::logic_error("this build has no VTK, and no pieces of .vtu and .vtp");
}

std::string with_arrays(std::string text, const AddedArrays& /*added*/) {
  return text;
}

VtuCounts count_vtu(const std::filesystem::path& path) {
  throw ReadError(path, "is not read by ranges: this build has no VTK");
}

MeshDocument read_vtu_range(const std::filesystem::path& path, NumberRange /*points*/, NumberRange /*cells*/,
                            bool /*with_fields*/, const FileWorkers& /*workers*/) {
  throw ReadError(path, "is not read by ranges: this build has no VTK");
}

#endif

}  // namespace trismooth
