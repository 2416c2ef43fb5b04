// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>

#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/new_array.h"
#include "trismooth/python/prepared_triangles.h"
#include "trismooth/smoothing/moving_mesh.h"

namespace trismooth::python {

/// A mesh that follows its boundary, for Python: of type M, trismooth::MovingMesh or that of device memory.
template <class M>
class PreparedMovingMesh : public PreparedTriangles {
 public:
  /// MovingMesh::go_on_from().
  void start_at(nanobind::handle points) {
    const HostArray array(points, "points");
    in_turn(nanobind::none(), [&] {
      naming_arguments(
          [&] { with_points(array, threads_, [this](const ConstPointView& view) { mesh_->go_on_from(view); }); });
    });
  }

  void take_back() {
    in_turn(nanobind::none(), [this] { mesh_->take_back(); });
  }

  /// One flag a vertex: whether the caller says where it is.
  nanobind::object held() {
    std::vector<std::uint8_t> flags = in_turn(nanobind::none(), [this] { return mesh_->held(); });
    std::ranges::transform(flags, flags.begin(), [](std::uint8_t why) { return why != 0 ? 1 : 0; });
    return new_array<bool, 1>(std::move(flags), {vertex_count()});
  }

  /// MovingMesh::points().
  nanobind::object last_points() {
    return new_array<double, 2>(in_turn(nanobind::none(), [this] { return mesh_->points(); }), {vertex_count(), 2});
  }

 protected:
  /// `make(mesh, reference, triangles, constraints, options)` makes the mesh, without the GIL.
  template <class Make>
  PreparedMovingMesh(const HostArray& reference_array, nanobind::handle triangles, const nanobind::dict& constraints,
                     const nanobind::dict& arguments, const Make& make)
      : PreparedTriangles(PointArray(reference_array).size(), "moving mesh") {
    prepare(triangles, constraints, arguments, moving_options(),
            [&](const IndexView& corners, const Constraints& all, const SmoothingOptions& options) {
              with_points(reference_array, options.threads,
                          [&](const ConstPointView& reference) { make(mesh_, reference, corners, all, options); });
            });
  }

  /// Calls work(step), in this call's turn, and has no step have happened where it throws. step(points, outcome) makes
  /// one, without the GIL.
  template <class Work>
  Outcome one_step(const std::string& start, const Work& work) {
    MovingStart from{};
    try {
      from = parse_enum<MovingStart>(start);
    } catch (const std::invalid_argument& error) {
      raise_value_error("start", error.what());
    }
    bool is_made = false;
    try {
      return work([&](auto&& points, Outcome& outcome) {
        outcome.followed = mesh_->follow(points, from);
        outcome.smoothing = std::move(outcome.followed->smoothing);
        is_made = outcome.smoothing.inverted >= 0;
      });
    } catch (...) {
      if (is_made) {
        mesh_->take_back();
      }
      throw;
    }
  }

  std::optional<M> mesh_;
};

}  // namespace trismooth::python
