// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/quality_part.h"

namespace trismooth {

namespace {

/// Triangles are taken in blocks of this size whatever the number of threads, and the blocks' results are combined in
/// order: no rounding depends on scheduling. A block's values stay in the second-level cache.
constexpr std::size_t block_size = triangles_a_quality_part;

std::size_t block_count(const TriangleView& view) {
  return (view.triangles.size() + block_size - 1) / block_size;
}

/// Calls `function(block)` for every block of the view.
template <class Function>
void for_each_block(const TriangleView& view, int threads, const Function& function) {
  Workers(threads).for_blocks(static_cast<std::int64_t>(block_count(view)), 1,
                              [&](std::int64_t begin, std::int64_t end) {
                                for (std::int64_t block = begin; block < end; ++block) {
                                  function(static_cast<std::size_t>(block));
                                }
                              });
}

/// Collects the worst `capacity` elements offered. A heap with the least bad one in front.
class WorstList {
 public:
  explicit WorstList(std::size_t capacity) : capacity_(capacity) {}

  bool would_take(double shape) const {
    return elements_.size() < capacity_ || (capacity_ > 0 && shape <= elements_.front().shape);
  }

  void offer(const WorstElement& element) {
    if (elements_.size() == capacity_) {
      if (capacity_ == 0 || !is_worse(element, elements_.front())) {
        return;
      }
      std::pop_heap(elements_.begin(), elements_.end(), is_worse);
      elements_.pop_back();
    }
    elements_.push_back(element);
    std::push_heap(elements_.begin(), elements_.end(), is_worse);
  }

  const std::vector<WorstElement>& elements() const { return elements_; }

  /// The elements, worst first. Leaves the list empty.
  std::vector<WorstElement> take_sorted() {
    std::sort_heap(elements_.begin(), elements_.end(), is_worse);
    return std::move(elements_);
  }

 private:
  std::size_t capacity_;
  std::vector<WorstElement> elements_;
};

constexpr MetricValues zeros{};

/// What one block contributes.
struct Block {
  QualityPart part;
  std::vector<WorstElement> worst;
};

void count_shape(QualityPart& partial, double shape) {
  if (shape < 0) {
    ++partial.inverted;
    return;
  }
  const bool valid = shape > 0;
  partial.degenerate += valid ? 0 : 1;
  const auto bin = valid ? static_cast<std::size_t>(shape * static_cast<double>(shape_bins)) : 0;
  ++partial.shape_histogram[std::min(bin, shape_bins - 1)];
}

/// What the report says of each metric, of all of these triangles.
void count_metrics(QualityPart& partial, std::span<const MetricValues> values) {
  std::array<AcceptableRange, metric_count> acceptable;
  for (std::size_t m = 0; m < metric_count; ++m) {
    acceptable[m] = acceptable_range(static_cast<Metric>(m));
  }
  // In variables of their own, which stay in registers.
  MetricValues sum = partial.sum;
  MetricValues min = partial.min;
  MetricValues max = partial.max;
  std::array<std::int64_t, metric_count> accepted{};
  for (const MetricValues& of_triangle : values) {
    for (std::size_t m = 0; m < metric_count; ++m) {
      sum[m] += of_triangle[m];
      min[m] = std::min(min[m], of_triangle[m]);
      max[m] = std::max(max[m], of_triangle[m]);
      accepted[m] += acceptable[m].holds(of_triangle[m]) ? 1 : 0;
    }
  }
  MetricValues mean = sum;
  for (double& value : mean) {
    value /= static_cast<double>(values.size());
  }
  MetricValues squared_deviations = zeros;
  for (const MetricValues& of_triangle : values) {
    for (std::size_t m = 0; m < metric_count; ++m) {
      const double deviation = of_triangle[m] - mean[m];
      squared_deviations[m] += deviation * deviation;
    }
  }
  partial.count = static_cast<double>(values.size());
  partial.sum = sum;
  partial.min = min;
  partial.max = max;
  partial.acceptable = accepted;
  partial.squared_deviations = squared_deviations;
}

Block evaluate_block(const TriangleView& view, std::size_t block, std::size_t worst_count) {
  const std::size_t begin = block * block_size;
  const std::size_t count = std::min(block_size, view.triangles.size() - begin);
  std::array<MetricValues, block_size> values;
  for_corners(view, begin, begin + count, [&](std::size_t first, std::span<const CornerPoints> corners) {
    evaluate_all(corners, std::span(values).subspan(first - begin, corners.size()));
  });
  Block evaluated;
  count_metrics(evaluated.part, std::span(values).first(count));
  WorstList worst(std::min(worst_count, count));
  for (std::size_t t = 0; t < count; ++t) {
    const double shape = values[t][static_cast<std::size_t>(Metric::shape)];
    count_shape(evaluated.part, shape);
    if (worst.would_take(shape)) {
      worst.offer({static_cast<std::int64_t>(begin + t), shape, centroid(corner_points(view, begin + t))});
    }
  }
  evaluated.worst = worst.take_sorted();
  return evaluated;
}

MetricSummary summary(const QualityPart& total, std::size_t m) {
  if (total.count == 0) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, nan, nan};
  }
  return {total.min[m], total.sum[m] / total.count, total.max[m], std::sqrt(total.squared_deviations[m] / total.count),
          static_cast<double>(total.acceptable[m]) / total.count};
}

}  // namespace

bool is_worse(const WorstElement& a, const WorstElement& b) {
  return a.shape < b.shape || (a.shape == b.shape && a.triangle < b.triangle);
}

// Sums of squared deviations are merged as by T. F. Chan, G. H. Golub and R. J. LeVeque (1979).
void QualityPart::append(const QualityPart& next) {
  for (std::size_t m = 0; m < metric_count; ++m) {
    if (count > 0) {
      const double between = next.sum[m] / next.count - sum[m] / count;
      squared_deviations[m] += between * between * (count * next.count / (count + next.count));
    }
    squared_deviations[m] += next.squared_deviations[m];
    sum[m] += next.sum[m];
    min[m] = std::min(min[m], next.min[m]);
    max[m] = std::max(max[m], next.max[m]);
    acceptable[m] += next.acceptable[m];
  }
  for (std::size_t bin = 0; bin < shape_bins; ++bin) {
    shape_histogram[bin] += next.shape_histogram[bin];
  }
  count += next.count;
  inverted += next.inverted;
  degenerate += next.degenerate;
}

QualityParts quality_parts(const TriangleView& view, const QualityOptions& options) {
  const auto worst_count = static_cast<std::size_t>(std::max(options.worst_count, 0));
  std::vector<Block> blocks(block_count(view));
  for_each_block(view, options.threads,
                 [&](std::size_t block) { blocks[block] = evaluate_block(view, block, worst_count); });
  QualityParts made;
  WorstList worst(std::min(worst_count, view.triangles.size()));
  for (const Block& block : blocks) {
    made.parts.push_back(block.part);
    for (const WorstElement& element : block.worst) {
      worst.offer(element);
    }
  }
  made.worst = worst.take_sorted();
  return made;
}

QualityReport report_of(const QualityPart& total, std::vector<WorstElement> worst, int exponent) {
  QualityReport report;
  report.triangles = static_cast<std::int64_t>(total.count);
  report.inverted = total.inverted;
  report.degenerate = total.degenerate;
  report.shape_histogram = total.shape_histogram;
  report.worst = std::move(worst);
  for (std::size_t m = 0; m < metric_count; ++m) {
    report.metrics[m] = summary(total, m);
  }
  MetricSummary& area = report[Metric::area];
  for (double* const value : {&area.min, &area.mean, &area.max, &area.stddev}) {
    *value = std::ldexp(*value, 2 * exponent);
  }
  return report;
}

QualityReport quality_report(const TriangleView& view, const QualityOptions& options) {
  QualityParts made = quality_parts(view, options);
  QualityPart total;
  for (const QualityPart& part : made.parts) {
    total.append(part);
  }
  return report_of(total, std::move(made.worst), view.exponent);
}

double smallest_shape(const TriangleView& view, int threads) {
  if (view.triangles.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<double> smallest(block_count(view));
  for_each_block(view, threads, [&](std::size_t block) {
    const std::size_t begin = block * block_size;
    const std::size_t end = std::min(begin + block_size, view.triangles.size());
    double smallest_of_block = std::numeric_limits<double>::infinity();
    for_corners(view, begin, end, [&](std::size_t /*first*/, std::span<const CornerPoints> corners) {
      for (const CornerPoints& of_element : corners) {
        smallest_of_block = std::min(smallest_of_block, shape_quotient(of_element));
      }
    });
    smallest[block] = smallest_of_block;
  });
  return shape_constant * *std::min_element(smallest.begin(), smallest.end());
}

}  // namespace trismooth
