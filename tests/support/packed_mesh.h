// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/host_targets.h"

#include "support/test_meshes.h"

namespace test_meshes {

/// A mesh as sweeps in precision T read it: in its local frame, the free vertices first.
template <class T>
class PackedMesh {
  trismooth::Workers workers_;

 public:
  std::vector<trismooth::Point2<double>> local;  ///< by input number
  std::vector<trismooth::Point2<T>> working;     ///< likewise, in working precision
  trismooth::MeshRings found;
  trismooth::PackedRings rings;
  std::vector<trismooth::Point2<T>> points;  ///< by packed number

  PackedMesh(const Mesh& mesh, trismooth::Form form, int threads)
      : workers_(threads),
        local(in_local_frame(mesh)),
        working(narrowed(local)),
        found(trismooth::find_mesh_rings(local, mesh.triangles, {}, workers_)),
        rings(trismooth::pack_rings(found.rings, local, form, workers_)) {
    for (const std::int32_t v : rings.input_index) {
      points.push_back(working[v]);
    }
  }

  /// `inverse_sizes`: see HostTargets.
  trismooth::HostTargets<T> targets(const trismooth::MeanRatioOptions& options,
                                    std::span<const double> inverse_sizes = {}) {
    std::optional<trismooth::HostTargets<T>> targets;
    workers_.run([&] { targets.emplace(points, rings, options, workers_, inverse_sizes); });
    return *std::move(targets);
  }

 private:
  static std::vector<trismooth::Point2<double>> in_local_frame(const Mesh& mesh) {
    const auto frame = trismooth::local_frame(mesh.points);
    std::vector<trismooth::Point2<double>> entered;
    for (const auto p : mesh.points) {
      entered.push_back(frame.enter(p));
    }
    return entered;
  }
  static std::vector<trismooth::Point2<T>> narrowed(std::span<const trismooth::Point2<double>> wide) {
    std::vector<trismooth::Point2<T>> narrow;
    for (const auto p : wide) {
      narrow.push_back({static_cast<T>(p.x), static_cast<T>(p.y)});
    }
    return narrow;
  }
};

}  // namespace test_meshes
