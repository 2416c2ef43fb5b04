// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/mesh_io/halfedge/flat_mesh.h"
#include "trismooth/mesh_io/halfedge/mesh_place.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/rings/analysed_mesh.h"
#include "trismooth/smoothing/smooth.h"
#include "trismooth/space/plane_smoothing.h"

namespace trismooth {

namespace {

const SmoothingOptions& checked(const SmoothingOptions& options) {
  options.validate();
  return options;
}

/// What the caller's own functions do meanwhile is not part of the call.
KeptConstraints asked_for(const OpenMesh::PolyConnectivity& mesh, const FlatMesh& flat,
                          const MeshConstraints& constraints) {
  const CallLimit::Hidden hidden;
  return flat_constraints(mesh, flat, constraints);
}

}  // namespace

/// Two ways lead to the result: a plan of flat arrays where the points can be smoothed where they are, and in all other
/// planes a copy of them that is laid into their plane. Which one it is, the points say; what a way needs is made when
/// it is first gone.
class MeshPlan::Implementation {
 public:
  Implementation(const ConstOpenMeshView& view, const MeshConstraints& constraints, const SmoothingOptions& options)
      : options_(checked(options)),
        workers_(options.threads),
        mesh_(flat_mesh(*view.mesh)),
        constraints_(asked_for(*view.mesh, mesh_, constraints)) {
    check_mesh_size(mesh_.vertices, std::ssize(mesh_.faces), elements().are_triangles() ? 3 : 4);
    check_constraints(constraints_.view(), vertex_count(), std::ssize(mesh_.faces));
    const Constraints held = constraints_.view();
    std::ranges::transform(
        mesh_.in_a_cell, held.other_cells, mesh_.in_a_cell.begin(),
        [](std::uint8_t face, std::uint8_t other) { return static_cast<std::uint8_t>(face | (other != 0 ? 1 : 0)); });
    if (std::visit([this](const auto& points) { return exact_axes(points, mesh_.in_a_cell); }, view.points)) {
      make_flat();
    } else {
      make_in_space();
    }
  }

  /// Throws std::invalid_argument for a mesh with other vertices or faces than that of which the plan was made.
  void require_same(const OpenMeshView& view) {
    const auto vertices = static_cast<std::int64_t>(view.mesh->n_vertices());
    const auto faces = static_cast<std::int64_t>(view.mesh->n_faces());
    if (vertices != mesh_.vertices || faces != mesh_.all_faces) {
      throw std::invalid_argument("the mesh has " + std::to_string(vertices) + " vertices and " +
                                  std::to_string(faces) + " faces, the plan is for one of " +
                                  std::to_string(mesh_.vertices) + " and " + std::to_string(mesh_.all_faces) +
                                  ", deleted ones counted");
    }
    if (!has_faces_of(*view.mesh, mesh_, workers_)) {
      throw std::invalid_argument(
          "the mesh has other faces than that of which the plan was made: a mesh whose edges are flipped, or of which "
          "elements are deleted, collected or added, needs a new plan");
    }
  }

  /// Of the mesh of which the plan was made, or one that is the same.
  SmoothingResult smooth(const OpenMeshView& view) {
    SmoothingResult result = std::visit([this](const auto& points) { return smooth_points(points); }, view.points);
    if (layers_) {
      result.layers = *layers_;
    }
    if (result.untangling && !result.untangling->turned.empty()) {
      result.untangling->turned = of_faces(result.untangling->turned);
    }
    return result;
  }

  std::vector<std::uint8_t> fixed() {
    if (flat_) {
      return flat_->fixed();
    }
    analyse();
    return analysed_->fixed();
  }

 private:
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(mesh_.vertices); }
  ElementList elements() const { return mesh_.elements.list(); }

  void make_flat() {
    if (!flat_) {
      flat_ = plan(vertex_count(), IndexView(elements()), constraints_.view(), options_);
    }
  }

  /// Where a device finds the rings (of triangles alone), it does so in every call, and nothing is made before.
  void make_in_space() {
    if (cells_.size() == 0) {
      cells_ = cells_of(mesh_);
    }
    if (!options_.prefers_topology_of_device() || !elements().are_triangles()) {
      analyse();
    }
  }

  void analyse() {
    if (!analysed_) {
      analysed_.emplace(vertex_count(), elements(), constraints_.view(), workers_);
    }
  }

  template <class T>
  SmoothingResult smooth_points(const NumberRows<T>& points) {
    const NumberRows<const T> read = constant(points);
    const bool are_all_finite = require_finite(read, mesh_.in_a_cell);
    const auto axes = exact_axes(read, mesh_.in_a_cell);
    if (!axes) {
      return smooth_in_space(points, read);
    }
    make_flat();
    const NumberRows<T> pairs = along(points, *axes);
    SmoothingResult result;
    if (are_all_finite) {
      result = flat_->smooth(PointView(pairs));
    } else {
      std::vector<Point2<double>> copy = pairs_of(along(read, *axes), mesh_.in_a_cell);
      result = flat_->smooth(copy, storage_of<T>);
      for (std::size_t v = 0; v < copy.size(); ++v) {
        write(pairs, v, std::array{copy[v].x, copy[v].y});
      }
    }
    const bool is_over = result.inverted < 0;  // before layers were looked for
    if (!layers_ && !is_over && keep_layers(result.layers, flat_->fixed())) {
      analysed_.reset();
    }
    return result;
  }

  /// What the first points say of layers holds for all later ones, whichever way these go; true where these are the
  /// first. What is known of the other way is to go: it does not know of them.
  bool keep_layers(const LayersResult& layers, std::span<const std::uint8_t> fixed) {
    if (layers_) {
      return false;
    }
    layers_ = layers;
    constraints_.fix(fixed, hold::named);
    options_.layers = Layers::smooth;
    return true;
  }

  template <class T>
  SmoothingResult smooth_in_space(const NumberRows<T>& points, const NumberRows<const T>& read) {
    return limited(options_, backend_of(options_).name(), [&] { return smoothed_in_space(points, read); });
  }

  template <class T>
  SmoothingResult smoothed_in_space(const NumberRows<T>& points, const NumberRows<const T>& read) {
    constexpr Storage storage = storage_of<T>;
    make_in_space();
    std::vector<double> xyz = triples_of(read);
    const std::vector<std::uint8_t>& in_a_cell = mesh_.in_a_cell;
    InPlane placed(fit_plane(xyz, in_a_cell, cells_, storage, workers_), xyz, in_a_cell, workers_);
    MeshRings found = rings_for(options_, placed.local.points, elements(), constraints_.view(), [&] {
      analyse();
      analysed_->look_at(placed.local.points, elements(), options_.used_layers(), workers_);
      return std::as_const(*analysed_).with_rings(elements(), workers_);
    });
    if (const auto fit = plane_of_fixed(placed.plane, xyz, in_a_cell, found.fixed, storage)) {
      placed = InPlane(*fit, xyz, in_a_cell, workers_);
    }
    if (!placed.plane.aligned && constraints_.view().slide.along != Slide::off) {
      throw std::invalid_argument(
          "slide: the mesh lies in a tilted plane, where rounding takes points off their lines; leave it out");
    }
    SmoothingResult result =
        smooth_in_plane(found, elements(), placed.plane, xyz, placed.points, placed.local, storage, options_);
    if (keep_layers(found.layers, found.fixed)) {
      flat_.reset();
    }
    result.backend_note = joined_notes(found.note, result.backend_note);
    const auto position = [&](std::int32_t v) { return placed.local.frame.enter(placed.points[v]); };
    elements().visit([&](const auto& listed) { count_invalid(listed, found.reversed, position, workers_, result); });
    result.quadrilaterals = elements().count_quadrilaterals();
    for (std::size_t v = 0; v < points.rows; ++v) {
      write(points, v, std::array{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
    }
    return result;
  }

  /// What is in no cell has not moved, and may be no number.
  template <class T, std::size_t n>
  void write(const NumberRows<T>& points, std::size_t v, const std::array<double, n>& numbers) const {
    if (mesh_.in_a_cell[v] != 0) {
      for (std::size_t k = 0; k < n; ++k) {
        number_at(points, v, k) = static_cast<T>(numbers[k]);
      }
    }
  }

  /// A byte for each face, deleted ones as well, of what has one for each element.
  std::vector<std::uint8_t> of_faces(const std::vector<std::uint8_t>& of_elements) const {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(mesh_.all_faces), 0);
    for (std::size_t e = 0; e < of_elements.size(); ++e) {
      bytes[static_cast<std::size_t>(mesh_.faces[e])] = of_elements[e];
    }
    return bytes;
  }

  SmoothingOptions options_;
  Workers workers_;
  FlatMesh mesh_;
  KeptConstraints constraints_;
  std::optional<SmoothingPlan> flat_;     ///< the one way
  CellList cells_;                        ///< the other one
  std::optional<AnalysedMesh> analysed_;  ///< likewise
  std::optional<LayersResult> layers_;    ///< of the first points
};

MeshPlan::MeshPlan(const ConstOpenMeshView& mesh, const MeshConstraints& constraints, const SmoothingOptions& options)
    : implementation_(planned(options, [&] { return std::make_unique<Implementation>(mesh, constraints, options); })) {}

MeshPlan::MeshPlan(MeshPlan&&) noexcept = default;
MeshPlan& MeshPlan::operator=(MeshPlan&&) noexcept = default;
MeshPlan::~MeshPlan() = default;

std::vector<std::uint8_t> MeshPlan::fixed() const {
  return not_moved_from(implementation_).fixed();
}

SmoothingResult MeshPlan::smooth_view(const OpenMeshView& mesh) {
  Implementation& plan = not_moved_from(implementation_);
  plan.require_same(mesh);
  return plan.smooth(mesh);
}

SmoothingResult smooth_open_mesh(const OpenMeshView& mesh, const MeshConstraints& constraints,
                                 const SmoothingOptions& options) {
  const ConstOpenMeshView read{
      mesh.mesh, std::visit([](const auto& points) -> decltype(ConstOpenMeshView::points) { return constant(points); },
                            mesh.points)};
  options.validate();
  return limited(options, backend_of(options).name(),
                 [&] { return MeshPlan(read, constraints, options).implementation_->smooth(mesh); });
}

}  // namespace trismooth
