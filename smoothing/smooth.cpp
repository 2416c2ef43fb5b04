// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/smooth.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/heights.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/rings/analysed_mesh.h"

namespace trismooth {

class SmoothingPlan::Implementation {
 public:
  Implementation(std::int64_t vertex_count, const IndexView& indices, const Constraints& constraints,
                 const SmoothingOptions& options)
      : options_(checked(options)), workers_(options.threads) {
    check_mesh_size(vertex_count, static_cast<std::int64_t>(indices.size()), indices.may_have_quadrilaterals() ? 4 : 3);
    vertex_count_ = static_cast<std::int32_t>(vertex_count);
    const ElementList elements = as_triangles_where_all_are(indices.list(vertex_count, elements_), elements_);
    if (!elements.are_triangles()) {
      note_ = host_finds_quadrilaterals(options);
    } else if (options.prefers_topology_of_device() && !constraints.slide.names_vertices()) {
      // (A device does not know of named lines.)
      try {
        smoother_ = backend_of(options).prepare_mesh(vertex_count_, elements.triangles(), constraints, options);
      } catch (const DeviceError& error) {
        if (options.topology == Topology::device) {
          throw;
        }
        note_ = host_took_over(error);
      }
      is_analysed_by_backend_ = smoother_ != nullptr;
      if (is_analysed_by_backend_) {
        elements_ = OwnElements();
        return;
      }
    }
    elements_.keep(elements);
    mesh_.emplace(vertex_count_, elements_.list(), constraints, workers_);
  }

  const SmoothingOptions& options() const { return options_; }

  std::vector<std::uint8_t> fixed() const { return is_analysed_by_backend_ ? smoother_->fixed() : mesh_->fixed(); }

  /// `is_once`: what is made ready serves this call alone.
  SmoothingResult smooth(const PointView& points, Storage storage, bool is_once) {
    require_a_point_a_vertex(points.size(), points.components(), vertex_count_);
    // What later calls need is not left for lack of time: under a limit that is too short for it each of them would
    // begin with it again. The caller may cancel it.
    std::optional<CallLimit> patient;
    if (!is_once && smoother_ == nullptr) {
      patient.emplace(std::numeric_limits<double>::infinity(), *CallLimit::current());
    }
    const Storage stored = points.storage() == Storage::float32 ? Storage::float32 : storage;
    if (is_analysed_by_backend_ && !points.as_pairs().empty()) {
      return smoother_->smooth(points.as_pairs(), stored, std::nullopt);
    }
    std::vector<Point2<double>> copy = points.read(workers_);
    if (points.components() == 3) {
      require_one_height(points, copy, [this] { return fixed(); });
    }
    SmoothingResult result = is_analysed_by_backend_ ? smoother_->smooth(copy, stored, std::nullopt)
                                                     : smooth_oriented(copy, stored, patient);
    result.backend_note = joined_notes(note_, result.backend_note);
    points.write(copy, workers_);
    return result;
  }

 private:
  static const SmoothingOptions& checked(const SmoothingOptions& options) {
    options.validate();
    return options;
  }

  /// Finds the frame and the orientation that these points give the mesh, and makes it ready again where that is new.
  /// `patient`: ends when all is ready.
  SmoothingResult smooth_oriented(std::vector<Point2<double>>& points, Storage storage,
                                  std::optional<CallLimit>& patient) {
    const ElementList elements = elements_.list();
    const LocalPoints local = entered(local_frame_of_cells(points, mesh_->fixed()), points);
    if (mesh_->look_at(local.points, elements, options_.used_layers(), workers_) || smoother_ == nullptr) {
      // It goes first: its memory is free for the next one, and if that cannot be made, nobody takes the old one for
      // it.
      smoother_.reset();
      smoother_ = backend_of(options_).prepare(mesh_->with_rings(elements, workers_), elements, local.points, options_);
    }
    patient.reset();
    SmoothingResult result = smoother_->smooth(points, storage, local.frame);
    result.layers = mesh_->layers();
    result.quadrilaterals = elements.count_quadrilaterals();
    elements.visit([&](const auto& listed) {
      count_invalid(
          listed, mesh_->reversed(), [&](std::int32_t v) { return local.frame.enter(points[v]); }, workers_, result);
    });
    return result;
  }

  SmoothingOptions options_;
  Workers workers_;
  std::int32_t vertex_count_ = 0;
  std::unique_ptr<PreparedSmoother> smoother_;
  bool is_analysed_by_backend_ = false;  ///< what follows is empty then
  std::string note_;                     ///< what the user is to know of who found the topology
  OwnElements elements_;                 ///< listed as triangles where all are
  std::optional<AnalysedMesh> mesh_;
};

SmoothingPlan::SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                             const SmoothingOptions& options)
    : implementation_(planned(
          options, [&] { return std::make_unique<Implementation>(vertex_count, triangles, constraints, options); })) {}

SmoothingPlan::SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const SmoothingOptions& options)
    : SmoothingPlan(vertex_count, triangles, Constraints{}, options) {}

SmoothingPlan::SmoothingPlan(SmoothingPlan&&) noexcept = default;
SmoothingPlan& SmoothingPlan::operator=(SmoothingPlan&&) noexcept = default;
SmoothingPlan::~SmoothingPlan() = default;

SmoothingResult SmoothingPlan::smooth(const PointView& points, Storage storage) {
  Implementation& plan = not_moved_from(implementation_);
  const SmoothingOptions& options = plan.options();
  const bool is_once = is_part_of_call();
  return limited(options, backend_of(options).name(), [&] { return plan.smooth(points, storage, is_once); });
}

std::vector<std::uint8_t> SmoothingPlan::fixed() const {
  return not_moved_from(implementation_).fixed();
}

SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                   const SmoothingOptions& options) {
  return {vertex_count, triangles, constraints, options};
}

SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const SmoothingOptions& options) {
  return {vertex_count, triangles, options};
}

SmoothingResult smooth(const PointView& points, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options) {
  options.validate();
  return limited(options, backend_of(options).name(), [&] {
    return plan(static_cast<std::int64_t>(points.size()), triangles, constraints, options).smooth(points);
  });
}

SmoothingResult smooth(const PointView& points, const IndexView& triangles, const SmoothingOptions& options) {
  return smooth(points, triangles, Constraints{}, options);
}

}  // namespace trismooth
