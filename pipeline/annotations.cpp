// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/annotations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/size_ratio.h"

namespace trismooth {

namespace {

/// Values that a thread takes at a time.
constexpr std::int64_t annotation_grain = 16384;

/// `size` numbers, 0 at first.
template <class T>
std::vector<T> zeros(std::size_t size, Workers& workers) {
  std::vector<T> numbers;
  shared_resize(numbers, size, workers);
  return numbers;
}

/// The first element from `t` on that is not of the cell of the one before it.
std::size_t next_of_other_cell(std::span<const std::int32_t> cells, std::size_t t) {
  while (t > 0 && t < cells.size() && cells[t] == cells[t - 1]) {
    ++t;
  }
  return t;
}

}  // namespace

std::vector<DataArray> metric_annotations(std::span<const Metric> metrics, const MeshView& view,
                                          std::span<const std::int32_t> cells, std::size_t cell_count, Workers& workers,
                                          std::string_view suffix, std::span<const CellCopy> copies) {
  std::vector<DataArray> arrays;
  arrays.reserve(metrics.size());
  for (const Metric metric : metrics) {
    const MetricInfo& of_metric = *metrics_of_any_kind()[static_cast<std::size_t>(metric)];
    std::vector<double> values = zeros<double>(cell_count, workers);
    // A strip is as bad as the worst of its triangles.
    const auto take = [&](std::size_t t, std::int32_t cell, bool has_others) {
      double value = view.visit([&](const auto& elements) {
        return with_points(elements, t, [&](const auto& corners) { return evaluate(metric, corners); });
      });
      if (metric == Metric::area) {
        value = std::ldexp(value, 2 * view.exponent);
      }
      value = std::clamp(value, -largest_annotation, largest_annotation);
      double& of_cell = values[static_cast<std::size_t>(cell)];
      const bool is_worse = of_metric.larger_is_better ? value < of_cell : value > of_cell;
      of_cell = has_others && !is_worse ? of_cell : value;
    };
    workers.for_blocks(static_cast<std::int64_t>(view.elements.size()), annotation_grain,
                       [&](std::int64_t begin, std::int64_t end) {
                         const std::size_t first = next_of_other_cell(cells, static_cast<std::size_t>(begin));
                         const std::size_t last = next_of_other_cell(cells, static_cast<std::size_t>(end));
                         for (std::size_t t = first; t < last; ++t) {
                           // (They come one after the other.)
                           take(t, cells[t], t > first && cells[t] == cells[t - 1]);
                         }
                       });
    for (std::size_t i = 0; i < copies.size(); ++i) {
      const auto [t, cell] = copies[i];
      take(static_cast<std::size_t>(t), cell,
           (i > 0 && copies[i - 1].cell == cell) || std::ranges::binary_search(cells, cell));
    }
    arrays.push_back(make_data_array(annotation_name(of_metric.name).append(suffix), 1, std::move(values)));
  }
  return arrays;
}

DataArray fixed_annotation(std::span<const std::uint8_t> reasons, Workers& workers) {
  std::vector<std::uint8_t> flags = zeros<std::uint8_t>(reasons.size(), workers);
  workers.for_blocks(std::ssize(reasons), annotation_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      flags[v] = reasons[v] != 0 ? 1 : 0;
    }
  });
  return make_data_array(annotation_name("fixed"), 1, std::move(flags));
}

DataArray displacement_annotation(std::span<const double> before, std::span<const double> after, Workers& workers) {
  std::vector<double> displacements = zeros<double>(after.size(), workers);
  workers.for_blocks(std::ssize(after), annotation_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      displacements[i] = after[i] - before[i];
    }
  });
  return make_data_array(annotation_name("displacement"), 3, std::move(displacements));
}

std::vector<std::string> annotations_in(const MeshDocument& document) {
  std::vector<std::string> names;
  for (const std::vector<DataArray>* const arrays : {&document.cell_arrays, &document.point_arrays}) {
    for (const DataArray& array : *arrays) {
      if (is_annotation(array.name)) {
        names.push_back(array.name);
      }
    }
  }
  return names;
}

std::vector<std::string> drop_annotations(MeshDocument& document) {
  std::vector<std::string> names = annotations_in(document);
  for (std::vector<DataArray>* const arrays : {&document.cell_arrays, &document.point_arrays}) {
    std::erase_if(*arrays, [](const DataArray& array) { return is_annotation(array.name); });
  }
  document.has_stale_annotations = document.has_stale_annotations || !names.empty();
  return names;
}

DataArray size_ratio_annotation(const MeshView& view, std::span<const std::int32_t> cells, std::size_t cell_count,
                                Workers& workers, std::string_view suffix, std::span<const CellCopy> copies) {
  const std::vector<double> ratios = size_ratios(view, workers.count());
  std::vector<double> values = zeros<double>(cell_count, workers);
  const auto take = [&](std::size_t t, std::int32_t cell) {
    double& of_cell = values[static_cast<std::size_t>(cell)];
    of_cell = std::max(of_cell, std::min(ratios[t], largest_annotation));  // 0 before the first of a strip
  };
  for (std::size_t t = 0; t < ratios.size(); ++t) {
    take(t, cells[t]);
  }
  for (const CellCopy& copy : copies) {
    take(static_cast<std::size_t>(copy.element), copy.cell);
  }
  return make_data_array(annotation_name(size_ratio_info.name).append(suffix), 1, std::move(values));
}

AnnotatedMetrics parse_metrics(std::string_view text) {
  AnnotatedMetrics annotated;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    const MetricInfo* const found = find_metric(name);
    const std::optional<Metric> metric = found != nullptr ? std::optional(found->metric) : std::nullopt;
    const bool is_size_ratio = name == size_ratio_info.name;
    if (!metric && !is_size_ratio) {
      throw std::invalid_argument("unknown metric '" + std::string(name) + "'; valid are " +
                                  list_text(metrics_of_any_kind(), [](const MetricInfo* of) { return of->name; }) +
                                  ", " + std::string(size_ratio_info.name));
    }
    if (is_size_ratio ? annotated.size_ratio
                      : std::ranges::find(annotated.metrics, *metric) != annotated.metrics.end()) {
      throw std::invalid_argument("the metric '" + std::string(name) + "' is named twice");
    }
    if (is_size_ratio) {
      annotated.size_ratio = true;
    } else {
      annotated.metrics.push_back(*metric);
    }
    begin = end + 1;
  }
  return annotated;
}

}  // namespace trismooth
