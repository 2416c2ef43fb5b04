// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>

#include "trismooth/base/element_list.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/python/constraint_arrays.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/host_points.h"
#include "trismooth/python/interruption.h"
#include "trismooth/python/options.h"
#include "trismooth/python/results.h"
#include "trismooth/python/turns.h"
#include "trismooth/quality/quality.h"

namespace trismooth::python {

/// Elements that are prepared once for points that change: with all they refer to, for one thread at a time.
class PreparedTriangles {
 public:
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t triangle_count() const { return elements_.list().size(); }

 protected:
  /// `what`: what this is, in messages: "plan".
  PreparedTriangles(std::size_t vertex_count, const char* what) : vertex_count_(vertex_count), what_(what) {}

  /// Reads the arrays and options of Python, and calls make(elements, constraints, options) without the GIL. The
  /// options stay valid with the callbacks of each call. `otherwise`: see parse_options().
  template <class Make>
  void prepare(nanobind::handle triangles_object, const nanobind::dict& constraints, const nanobind::dict& arguments,
               const SmoothingOptions& otherwise, const Make& make) {
    const HostArray numbers(triangles_object, "triangles");
    const TriangleArray triangles(numbers);
    if (triangles.may_have_middles()) {
      numbers.raise_value("a " + std::string(what_) +
                          " is for elements of corners alone; smooth() takes those with middles of sides");
    }
    const ConstraintArrays held(constraints, vertex_count_, triangles.size());
    CallOptions call = parse_options(arguments, otherwise);
    SmoothingOptions& options = call.smoothing;
    sizes_ = held.sizes();
    options.mean_ratio.target_lengths = sizes_;
    Interruption making{nanobind::none()};
    interruption_ = &making;
    Interruption::watch(options, interruption_);
    threads_ = options.threads;
    const Constraints all = held.constraints(call.slide);
    const nanobind::gil_scoped_release no_gil;
    naming_arguments([&] {
      elements_ = own_elements(triangles.corners(), static_cast<std::int64_t>(vertex_count_));
      make(indices(), all, options);
    });
  }

  /// Calls work() when other threads' calls are done; meanwhile the options' callbacks are those of this call.
  template <class Work>
  auto in_turn(const nanobind::object& progress, const Work& work) {
    const Turn turn(turns_, ("the " + std::string(what_)).c_str());
    Interruption interruption(progress);
    interruption_ = &interruption;
    return work();
  }

  /// See smooth_into(). In this call's turn.
  template <class Smooth>
  Outcome smooth_points(nanobind::handle points_object, nanobind::handle out_object, bool with_quality,
                        const nanobind::callable& accept, const Smooth& smooth) {
    const HostArray points_array(points_object, "points");
    const PointArray points(points_array);
    if (points.size() != vertex_count_) {
      points_array.raise_value("shape " + points_array.shape_text() + "; the " + what_ + " has " +
                               std::to_string(vertex_count_) + " vertices");
    }
    const HostArray out(out_object, "out", HostArray::Access::write);
    std::function<MeshQuality()> mesh_quality;
    if (with_quality) {
      mesh_quality = [this] { return MeshQuality(static_cast<std::int64_t>(vertex_count_), indices(), threads_); };
    }
    return smooth_into(points_array, out, working_, mesh_quality, threads_, accept, smooth);
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
  int threads_ = 0;

 private:
  IndexView indices() const { return IndexView(elements_.list()); }

  Turns turns_;
  std::size_t vertex_count_;
  const char* what_;
  std::vector<double> sizes_;
  OwnElements elements_;
  Interruption* interruption_ = nullptr;  ///< of the call that is at work
};

}  // namespace trismooth::python
