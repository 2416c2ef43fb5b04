// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/smoothing.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/python/constraint_arrays.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/interruption.h"
#include "trismooth/python/new_array.h"
#include "trismooth/python/options.h"
#include "trismooth/python/results.h"
#include "trismooth/python/turns.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/smooth.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

/// The caller's points, copied to be smoothed: what fails leaves the caller's arrays as they are, and the caller's
/// other threads do not disturb.
class WorkingPoints {
 public:
  void read(const PointArray& points, Workers& workers) {
    numbers_.resize(points.bytes());
    digest_ = points.copy_to(numbers_.data(), workers);
    size_ = points.size();
    components_ = points.components();
    storage_ = points.storage();
  }

  PointView view() { return packed_points(numbers_.data(), size_, components_, storage_); }
  bool are_still(const PointArray& points, Workers& workers) const { return points.digest(workers) == digest_; }
  void write(const PointArray& out, Workers& workers) const { out.copy_from(numbers_.data(), workers); }

 private:
  BulkVector<std::byte> numbers_;
  std::uint64_t digest_ = 0;
  std::size_t size_ = 0;
  std::size_t components_ = 0;
  Storage storage_ = Storage::float64;
};

void require_same_form(const HostArray& out, const HostArray& points) {
  const bool same_shape = out.dimensions() == points.dimensions() && out.shape_text() == points.shape_text();
  if (!same_shape) {
    out.raise_value("shape " + out.shape_text() + "; that of points is " + points.shape_text());
  }
  if (out.type_text() != points.type_text()) {
    out.raise_type("its numbers are " + out.type_text() + ", those of points " + points.type_text());
  }
}

/// Of few points this thread has copied all before another one is awake.
int threads_to_copy(const PointArray& points, int threads) {
  constexpr std::size_t few = 32768;
  return points.size() <= few ? 1 : threads;
}

/// Smooths `points` into `out` by smooth(view, outcome), which fills in what it did; the GIL is not held while it
/// runs. `mesh_quality` makes the MeshQuality for the reports before and after; null where they are not wanted.
/// `accept` is called with the outcome before anything is written, and may raise: it has the warnings.
template <class Smooth>
Outcome smooth_into(const HostArray& points_array, const HostArray& out_array, WorkingPoints& working,
                    const std::function<MeshQuality()>& mesh_quality, int threads, const nb::callable& accept,
                    const Smooth& smooth) {
  require_same_form(out_array, points_array);
  const PointArray points(points_array);
  const PointArray out(out_array);
  Outcome outcome;
  bool are_still = true;
  {
    const nb::gil_scoped_release no_gil;
    Workers workers(threads_to_copy(points, threads));
    working.read(points, workers);
    naming_arguments([&] {
      std::optional<MeshQuality> quality;
      if (mesh_quality) {
        quality.emplace(mesh_quality());
        outcome.before = quality->report(working.view(), {.threads = threads});
      }
      smooth(working.view(), outcome);
      if (quality) {
        outcome.after = quality->report(working.view(), {.threads = threads});
        if (outcome.smoothing.inverted < 0) {  // the call was over before anybody had counted them
          outcome.smoothing.inverted = outcome.after->inverted;
          outcome.smoothing.degenerate = outcome.after->degenerate;
        }
      }
    });
    are_still = working.are_still(points, workers);
  }
  if (!are_still) {
    points_array.raise_value("changed while they were smoothed; out is as it was");
  }
  // The last moment for Ctrl-C: from here on it comes too late.
  if (PyErr_CheckSignals() != 0) {
    throw nb::python_error();
  }
  accept(outcome);
  const nb::gil_scoped_release no_gil;
  Workers workers(threads_to_copy(points, threads));
  working.write(out, workers);
  return outcome;
}

Outcome smooth_arrays(nb::handle points_object, nb::handle triangles_object, nb::handle out_object,
                      const nb::dict& constraints, bool with_quality, const nb::object& progress,
                      const nb::callable& accept, const nb::dict& arguments) {
  const HostArray points_array(points_object, "points");
  const PointArray points(points_array);
  const HostArray out(out_object, "out", HostArray::Access::write);
  const HostArray triangle_numbers(triangles_object, "triangles");
  const TriangleArray triangles(triangle_numbers);
  const ConstraintArrays held(constraints, points.size(), triangles.size());
  CallOptions call = parse_options(arguments);
  SmoothingOptions& options = call.smoothing;
  options.mean_ratio.target_lengths = held.sizes();
  if (triangles.nodes() == 6 && call.slide.along != Slide::off) {
    raise_value_error("slide", "is for triangles of three nodes; those of six have middles on their sides");
  }
  Interruption interruption(progress);
  Interruption* const current = &interruption;
  Interruption::watch(options, current);
  const IndexView corners = triangles.corners();
  const Constraints all = held.constraints(call.slide);
  WorkingPoints working;
  std::function<MeshQuality()> mesh_quality;
  if (with_quality) {
    mesh_quality = [&] { return MeshQuality(static_cast<std::int64_t>(points.size()), corners, options.threads); };
  }
  return smooth_into(points_array, out, working, mesh_quality, options.threads, accept,
                     [&](const PointView& view, Outcome& outcome) {
                       if (triangles.nodes() == 6) {
                         const auto nodes = triangles.six_nodes(static_cast<std::int64_t>(points.size()));
                         outcome.smoothing = trismooth::smooth_quadratic(view, nodes, all, options);
                       } else {
                         outcome.smoothing = trismooth::smooth(view, corners, all, options);
                       }
                     });
}

/// Triangles that are prepared once for points that change: with all they refer to, for one thread at a time.
class PreparedTriangles {
 public:
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t triangle_count() const { return triangles_.size(); }

 protected:
  /// `what`: what this is, in messages: "plan".
  PreparedTriangles(std::size_t vertex_count, const char* what) : vertex_count_(vertex_count), what_(what) {}

  /// Reads the arrays and options of Python, and calls make(triangles, constraints, options) without the GIL. The
  /// options stay valid with the callbacks of each call. `otherwise`: see parse_options().
  template <class Make>
  void prepare(nb::handle triangles_object, const nb::dict& constraints, const nb::dict& arguments,
               const SmoothingOptions& otherwise, const Make& make) {
    const HostArray numbers(triangles_object, "triangles");
    const TriangleArray triangles(numbers);
    if (triangles.nodes() != 3) {
      numbers.raise_value("a " + std::string(what_) + " is for triangles of three nodes; smooth() takes those of six");
    }
    const ConstraintArrays held(constraints, vertex_count_, triangles.size());
    CallOptions call = parse_options(arguments, otherwise);
    SmoothingOptions& options = call.smoothing;
    sizes_ = held.sizes();
    options.mean_ratio.target_lengths = sizes_;
    Interruption making{nb::none()};
    interruption_ = &making;
    Interruption::watch(options, interruption_);
    threads_ = options.threads;
    const Constraints all = held.constraints(call.slide);
    const nb::gil_scoped_release no_gil;
    naming_arguments([&] {
      const IndexView corners = triangles.corners();
      const std::span<const Triangle> kept = corners.triangles(static_cast<std::int64_t>(vertex_count_), triangles_);
      if (kept.data() != triangles_.data()) {
        triangles_.assign(kept.begin(), kept.end());
      }
      make(triangles_, all, options);
    });
  }

  /// See smooth_into(). Waits for other threads' calls.
  template <class Smooth>
  Outcome smooth_points(
      nb::handle points_object, nb::handle out_object, bool with_quality, const nb::object& progress,
      const nb::callable& accept, const Smooth& smooth, const std::function<void()>& undo = [] {}) {
    const HostArray points_array(points_object, "points");
    const PointArray points(points_array);
    if (points.size() != vertex_count_) {
      points_array.raise_value("shape " + points_array.shape_text() + "; the " + what_ + " has " +
                               std::to_string(vertex_count_) + " vertices");
    }
    const HostArray out(out_object, "out", HostArray::Access::write);
    const Turn turn(turns_, ("the " + std::string(what_)).c_str());
    Interruption interruption(progress);
    interruption_ = &interruption;
    std::function<MeshQuality()> mesh_quality;
    if (with_quality) {
      mesh_quality = [this] { return MeshQuality(static_cast<std::int64_t>(vertex_count_), triangles_, threads_); };
    }
    try {
      return smooth_into(points_array, out, working_, mesh_quality, threads_, accept, smooth);
    } catch (...) {
      undo();
      throw;
    }
  }

  /// Calls use(points) with the numbers of an array of all vertices.
  template <class Use>
  void with_points(const HostArray& array, int threads, const Use& use) {
    const PointArray points(array);
    Workers workers(threads_to_copy(points, threads));
    working_.read(points, workers);
    use(ConstPointView(working_.view()));
  }

  WorkingPoints working_;  ///< kept: new memory costs as much as a sweep
  Turns turns_;
  int threads_ = 0;

 private:
  std::size_t vertex_count_;
  const char* what_;
  std::vector<double> sizes_;
  std::vector<Triangle> triangles_;
  Interruption* interruption_ = nullptr;  ///< of the call that is at work
};

/// A SmoothingPlan for Python.
class HostPlan : public PreparedTriangles {
 public:
  HostPlan(nb::handle triangles, std::size_t vertex_count, const nb::dict& constraints, const nb::dict& arguments)
      : PreparedTriangles(vertex_count, "plan") {
    prepare(triangles, constraints, arguments, {},
            [&](std::span<const Triangle> corners, const Constraints& all, const SmoothingOptions& options) {
              plan_.emplace(static_cast<std::int64_t>(vertex_count), corners, all, options);
            });
  }

  Outcome smooth(nb::handle points, nb::handle out, bool with_quality, const nb::object& progress,
                 const nb::callable& accept) {
    return smooth_points(points, out, with_quality, progress, accept,
                         [this](const PointView& view, Outcome& outcome) { outcome.smoothing = plan_->smooth(view); });
  }

 private:
  std::optional<SmoothingPlan> plan_;
};

/// A MovingMesh for Python.
class HostMovingMesh : public PreparedTriangles {
 public:
  HostMovingMesh(nb::handle reference_object, nb::handle triangles, const nb::dict& constraints,
                 const nb::dict& arguments)
      : HostMovingMesh(HostArray(reference_object, "points"), triangles, constraints, arguments) {}

  Outcome follow(nb::handle points, nb::handle out, const std::string& start, bool with_quality,
                 const nb::object& progress, const nb::callable& accept) {
    MovingStart from{};
    try {
      from = parse_enum<MovingStart>(start);
    } catch (const std::invalid_argument& error) {
      raise_value_error("start", error.what());
    }
    std::optional<std::vector<Point2<double>>> last;  // of a call whose result nobody gets, nothing remains
    return smooth_points(
        points, out, with_quality, progress, accept,
        [&](const PointView& view, Outcome& outcome) {
          last = mesh_->points();
          outcome.followed = mesh_->follow(view, from);
          outcome.smoothing = std::move(outcome.followed->smoothing);
        },
        [&] {
          if (last) {
            mesh_->go_on_from(*last);
          }
        });
  }

  void go_on_from(nb::handle points) {
    const HostArray array(points, "points");
    const Turn turn(turns_, "the moving mesh");
    with_points(array, threads_, [this](const ConstPointView& view) { mesh_->go_on_from(view); });
  }

  /// One flag a vertex: whether the caller says where it is.
  nb::object held() {
    const Turn turn(turns_, "the moving mesh");
    std::vector<std::uint8_t> flags = mesh_->held();
    std::ranges::transform(flags, flags.begin(), [](std::uint8_t why) { return why != 0 ? 1 : 0; });
    return new_array<bool, 1>(std::move(flags), {vertex_count()});
  }

  nb::object points() {
    const Turn turn(turns_, "the moving mesh");
    return new_array<double, 2>(mesh_->points(), {vertex_count(), 2});
  }

 private:
  HostMovingMesh(const HostArray& reference_array, nb::handle triangles, const nb::dict& constraints,
                 const nb::dict& arguments)
      : PreparedTriangles(PointArray(reference_array).size(), "moving mesh") {
    prepare(triangles, constraints, arguments, moving_options(),
            [&](std::span<const Triangle> corners, const Constraints& all, const SmoothingOptions& options) {
              with_points(reference_array, options.threads,
                          [&](const ConstPointView& reference) { mesh_.emplace(reference, corners, all, options); });
            });
  }

  std::optional<MovingMesh> mesh_;
};

std::vector<std::string> methods() {
  std::vector<std::string> names;
  for (const auto& [method, name] : EnumText<Method>::texts) {
    names.emplace_back(name);
  }
  return names;
}

}  // namespace

void bind_smoothing(nb::module_& module) {
  module.def("smooth", &smooth_arrays, "points"_a, "triangles"_a, "out"_a, "constraints"_a, "quality"_a,
             "progress"_a.none(), "accept"_a, "options"_a);
  module.def("option_names", &option_names);
  module.def("methods", &methods);
  nb::class_<HostPlan>(module, "HostPlan")
      .def(nb::init<nb::handle, std::size_t, const nb::dict&, const nb::dict&>(), "triangles"_a, "vertex_count"_a,
           "constraints"_a, "options"_a)
      .def("smooth", &HostPlan::smooth, "points"_a, "out"_a, "quality"_a, "progress"_a.none(), "accept"_a)
      .def_prop_ro("vertex_count", &HostPlan::vertex_count)
      .def_prop_ro("triangle_count", &HostPlan::triangle_count);
  nb::class_<HostMovingMesh>(module, "HostMovingMesh")
      .def(nb::init<nb::handle, nb::handle, const nb::dict&, const nb::dict&>(), "points"_a, "triangles"_a,
           "constraints"_a, "options"_a)
      .def("follow", &HostMovingMesh::follow, "points"_a, "out"_a, "start"_a, "quality"_a, "progress"_a.none(),
           "accept"_a)
      .def("go_on_from", &HostMovingMesh::go_on_from, "points"_a)
      .def_prop_ro("held", &HostMovingMesh::held)
      .def_prop_ro("points", &HostMovingMesh::points)
      .def_prop_ro("vertex_count", &HostMovingMesh::vertex_count)
      .def_prop_ro("triangle_count", &HostMovingMesh::triangle_count);
}

}  // namespace trismooth::python
