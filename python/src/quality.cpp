// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/repeated_triangles.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/new_array.h"
#include "trismooth/python/options.h"
#include "trismooth/python/results.h"
#include "trismooth/python/smoothing.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/size_ratio.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

using Values = nb::ndarray<nb::numpy, double, nb::ndim<1>>;

/// The report, and by its name the values of each metric that elements of the mesh have, one an element.
nb::tuple quality_of_arrays(nb::handle points_object, nb::handle triangles_object, nb::handle threads_object) {
  const HostArray points_array(points_object, "points");
  const PointArray points(points_array);
  const HostArray numbers(triangles_object, "triangles");
  const TriangleArray triangles(numbers);
  const int threads = threads_of(threads_object);
  const std::size_t count = triangles.size();
  auto values = std::make_unique<std::vector<double>>(metric_count * count);
  ElementValues places;
  for (std::size_t m = 0; m < metric_count; ++m) {
    places[m] = std::span(*values).subspan(m * count, count);
  }
  QualityReport report;
  {
    const nb::gil_scoped_release no_gil;
    Workers workers(threads);
    BulkVector<std::byte> packed(points.bytes());
    points.copy_to(packed.data(), workers);
    report = naming_arguments([&] {
      // Copied: another thread may change the caller's while they are read.
      const OwnElements elements = own_elements(triangles.corners(), static_cast<std::int64_t>(points.size()));
      return quality(packed_points(packed.data(), points.size(), points.components(), points.storage()),
                     IndexView(elements.list()), places, QualityOptions{.threads = threads});
    });
  }
  double* const first = values->data();
  const nb::capsule owner(values.release(), [](void* memory) noexcept {
    const std::unique_ptr<std::vector<double>> gone(static_cast<std::vector<double>*>(memory));
  });
  nb::dict arrays;
  for (const MetricInfo* const metric : metrics_of(report)) {
    const auto place = static_cast<std::size_t>(metric->metric);
    arrays[nb::str(metric->name.data(), metric->name.size())] = Values(first + place * count, {count}, owner);
  }
  return nb::make_tuple(std::move(report), arrays);
}

/// The elements that are listed again, as an array of shape (K, 2): the number of each and that of the first one. None
/// where an element is not valid, which is found and told later.
nb::object repeated_triangles(nb::handle triangles_object, std::size_t vertex_count) {
  static_assert(sizeof(RepeatedTriangle) == 2 * sizeof(std::int32_t));
  const HostArray numbers(triangles_object, "triangles");
  const TriangleArray triangles(numbers);
  std::vector<RepeatedTriangle> found;
  {
    const nb::gil_scoped_release no_gil;
    naming_arguments([&] {
      const OwnElements elements = own_elements(triangles.corners(), static_cast<std::int64_t>(vertex_count));
      const bool is_valid = elements.list().visit([&](const auto& listed) {
        return std::ranges::none_of(
            listed, [&](const auto& corners) { return is_faulty(static_cast<std::int32_t>(vertex_count), corners); });
      });
      if (is_valid) {
        Workers workers(1);
        found = find_repeated_triangles(IndexView(elements.list()), workers);
      }
    });
  }
  const std::size_t count = found.size();
  return new_array<std::int32_t, 2>(std::move(found), {count, std::size_t{2}});
}

/// The report with other numbers of triangles: numbers[t] in place of t.
QualityReport renumbered(QualityReport report, const nb::object& numbers) {
  for (WorstElement& element : report.worst) {
    element.element = nb::cast<std::int64_t>(nb::int_(numbers[element.element]));
  }
  return report;
}

nb::list metrics() {
  nb::list list;
  for (const MetricInfo& metric : all_metrics()) {
    list.append(nb::make_tuple(nb::str(metric.name.data(), metric.name.size()),
                               nb::str(metric.unit.data(), metric.unit.size()),
                               nb::str(metric.meaning.data(), metric.meaning.size()), metric.larger_is_better));
  }
  return list;
}

/// vertex_flags() as an array of bool.
nb::object vertex_mask(nb::handle array, const std::string& argument, std::size_t vertex_count) {
  return new_array<bool, 1>(vertex_flags(array, argument, vertex_count), {vertex_count});
}

}  // namespace

void bind_quality_of_arrays(nb::module_& module) {
  module.def("quality", &quality_of_arrays, "points"_a, "triangles"_a, "threads"_a.none());
  module.def("vertex_mask", &vertex_mask, "array"_a, "argument"_a, "vertex_count"_a);
  module.def("repeated_triangles", &repeated_triangles, "triangles"_a, "vertex_count"_a);
  module.def("renumbered", &renumbered, "report"_a, "numbers"_a);
  module.def("metrics", &metrics, "Name, unit, meaning of each metric, and whether larger values are better.");
}

}  // namespace trismooth::python
