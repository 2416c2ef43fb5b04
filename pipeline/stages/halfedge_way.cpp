// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/halfedge_way.h"

#include <stdexcept>

// The one place that knows whether the build has halfedges.
#ifdef TRISMOOTH_HAS_HALFEDGES
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "trismooth/base/errors.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/pipeline/halfedge_stage.h"
#include "trismooth/pipeline/stages/run_state.h"
#endif

namespace trismooth {

#ifdef TRISMOOTH_HAS_HALFEDGES

namespace {

class OpenMeshWay final : public HalfedgeWay {
 public:
  explicit OpenMeshWay(RunState& run)
      : connected_(connect_halfedges(run.document.points, run.mesh.elements, run.workers)) {}

  std::vector<std::uint8_t> run_stage(RunState& run) const override {
    const HalfedgeMesh& halfedges = connected_.halfedges;
    HalfedgeStage stage{halfedges.mesh, halfedges.copies_of, run.mesh.cells, run.regions.of_triangle, run.document};
    run.options.halfedge_stage(stage);
    const std::size_t points = run.document.point_count();
    const auto require_rows = [&](std::size_t rows, const std::string& what) {
      if (rows != points) {
        throw std::invalid_argument("halfedge_stage: " + what + " has " + std::to_string(rows) + " rows for " +
                                    counted(static_cast<std::int64_t>(points), "point", "points"));
      }
    };
    for (std::size_t i = 0; i < stage.point_arrays.size(); ++i) {
      const DataArray& array = stage.point_arrays[i];
      require_rows(array.rows(), "the array '" + array.name + "'");
      if (array.name.empty() || array.name.starts_with(annotation_prefix)) {
        throw std::invalid_argument("halfedge_stage: an array needs a name that does not begin with '" +
                                    std::string(annotation_prefix) + "'");
      }
      if (find_array(run.document.point_arrays, array.name) != nullptr ||
          find_array(std::span(stage.point_arrays).first(i), array.name) != nullptr) {
        throw std::invalid_argument("halfedge_stage: there is a point array '" + array.name + "' already");
      }
    }
    if (!stage.fixed.empty()) {
      require_rows(stage.fixed.size(), "fixed");
    }
    run.stage_arrays = std::move(stage.point_arrays);
    return std::move(stage.fixed);
  }

  MeshRings rings(RunState& run, const Constraints& constraints, Layers layers) const override {
    return read_halfedge_rings(connected_, run.local.points, run.mesh.elements, constraints, run.workers, layers);
  }

 private:
  ConnectedMesh connected_;
};

}  // namespace

bool has_halfedges() {
  return true;
}

std::unique_ptr<const HalfedgeWay> connect_by_halfedges(RunState& run) {
  try {
    return std::make_unique<OpenMeshWay>(run);
  } catch (const MeshError& error) {
    throw ReadError(run.options.input, error.what());
  }
}

#else

bool has_halfedges() {
  return false;
}

std::unique_ptr<const HalfedgeWay> connect_by_halfedges(RunState& /*run*/) {
  throw std::invalid_argument(
      "this build has no halfedges (TRISMOOTH_HALFEDGE is off): topology 'host' gives the same mesh, and a "
      "halfedge_stage needs one that has");
}

#endif

}  // namespace trismooth
