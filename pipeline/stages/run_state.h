// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_points.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/input/size_array.h"
#include "trismooth/pipeline/stages/run_context.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

/// What the stages of a run hand to each other whose mesh is a document of this process. Each stage is a function that
/// fills its part of it.
struct RunState : RunContext {
  explicit RunState(const PipelineOptions& run_options) : RunContext(run_options), smoothing(run_options.smoothing) {}

  SmoothingOptions smoothing;  ///< with the sizes of the file, where it is asked for them
  MeshDocument document;
  PlanarMesh mesh;
  LocalPoints local;  ///< mesh.points in their local frame: those of the input, after the smoothing of the result
  SizeArray sizes;
  Regions regions;
  Slide slide = Slide::off;  ///< of the options, where this mesh can
  MeshRings found;
  std::vector<DataArray> stage_arrays;    ///< point arrays for the output, of the program's own stage
  std::vector<std::size_t> fields;        ///< point arrays of the document that follow the mesh
  std::shared_ptr<MeshPicture> picture;   ///< that the result has, where it is asked for
  std::vector<double> input_points;       ///< for annotations of a smoothing
  std::vector<DataArray> metrics_before;  ///< for annotations of a smoothing

  /// Brings the points of the mesh into the local frame of those that cells use.
  void enter_frame();
  /// The elements at `local`.
  MeshView view() const { return {local.points, mesh.elements, found.reversed, local.frame.exponent}; }
};

}  // namespace trismooth
