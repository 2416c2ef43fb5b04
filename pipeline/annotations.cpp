#include "trismooth/pipeline/annotations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace trismooth {

std::vector<DataArray> metric_annotations(std::span<const Metric> metrics, const TriangleView& view,
                                          std::span<const std::int32_t> cells, std::size_t cell_count,
                                          std::string_view suffix) {
  std::vector<std::vector<double>> columns(metrics.size(), std::vector<double>(cell_count, 0.0));
  for (std::size_t t = 0; t < view.triangles.size(); ++t) {
    const auto [a, b, c] = canonical_corners(view, t);
    const auto cell = static_cast<std::size_t>(cells[t]);
    for (std::size_t m = 0; m < metrics.size(); ++m) {
      double value = evaluate(metrics[m], view.points[static_cast<std::size_t>(a)],
                              view.points[static_cast<std::size_t>(b)], view.points[static_cast<std::size_t>(c)]);
      if (metrics[m] == Metric::area) {
        value = std::ldexp(value, 2 * view.exponent);
      }
      value = std::clamp(value, -largest_annotation, largest_annotation);
      // A strip is as bad as the worst of its triangles, which come one after the other.
      double& of_cell = columns[m][cell];
      const bool is_next_of_strip = t > 0 && cells[t] == cells[t - 1];
      const bool is_worse = info(metrics[m]).larger_is_better ? value < of_cell : value > of_cell;
      of_cell = is_next_of_strip && !is_worse ? of_cell : value;
    }
  }
  std::vector<DataArray> arrays;
  arrays.reserve(metrics.size());
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    arrays.push_back(make_data_array(annotation_name(info(metrics[m]).name).append(suffix), 1, std::move(columns[m])));
  }
  return arrays;
}

DataArray fixed_annotation(std::span<const std::uint8_t> reasons) {
  std::vector<std::uint8_t> flags(reasons.size());
  std::ranges::transform(reasons, flags.begin(), [](std::uint8_t reason) { return reason != 0 ? 1 : 0; });
  return make_data_array(annotation_name("fixed"), 1, std::move(flags));
}

DataArray displacement_annotation(std::span<const double> before, std::span<const double> after) {
  std::vector<double> displacements(after.size());
  std::ranges::transform(after, before, displacements.begin(), std::minus<>());
  return make_data_array(annotation_name("displacement"), 3, std::move(displacements));
}

std::vector<Metric> parse_metrics(std::string_view text) {
  std::vector<Metric> metrics;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    const auto metric = metric_named(name);
    if (!metric) {
      throw std::invalid_argument("unknown metric '" + std::string(name) + "'; valid are " + metric_names());
    }
    if (std::ranges::find(metrics, *metric) != metrics.end()) {
      throw std::invalid_argument("the metric '" + std::string(name) + "' is named twice");
    }
    metrics.push_back(*metric);
    begin = end + 1;
  }
  return metrics;
}

}  // namespace trismooth
