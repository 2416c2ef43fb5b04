// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/elements_by_kind.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/quality_part.h"

namespace trismooth {

namespace {

/// Elements are taken in blocks of this size whatever the number of threads, and the blocks' results are combined in
/// order: no rounding depends on scheduling. A block's values stay in the second-level cache.
constexpr std::size_t block_size = triangles_a_quality_part;

template <class Corners>
std::size_t block_count(const ElementView<Corners>& view) {
  return (view.elements.size() + block_size - 1) / block_size;
}

/// Calls `function(block)` for every block of the view.
template <class Corners, class Function>
void for_each_block(const ElementView<Corners>& view, int threads, const Function& function) {
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

/// What one block contributes.
template <class Points>
struct Block {
  KindPart<Points> part;
  std::vector<WorstElement> worst;
};

template <class Points>
void count_shape(KindPart<Points>& partial, double shape) {
  if (shape < 0) {
    ++partial.inverted;
    return;
  }
  const bool valid = shape > 0;
  partial.degenerate += valid ? 0 : 1;
  const auto bin = valid ? static_cast<std::size_t>(shape * static_cast<double>(shape_bins)) : 0;
  ++partial.shape_histogram[std::min(bin, shape_bins - 1)];
}

/// What the report says of each metric, of all of these elements.
template <class Points>
void count_metrics(KindPart<Points>& partial, std::span<const KindValues<Points>> values) {
  using Kind = KindMetrics<Points>;
  constexpr std::size_t metrics = count_of_metrics<Points>;
  std::array<AcceptableRange, metrics> acceptable;
  for (std::size_t m = 0; m < metrics; ++m) {
    acceptable[m] = acceptable_range(Kind::list[m], Kind::kind);
  }
  // In variables of their own, which stay in registers.
  KindValues<Points> sum = partial.sum;
  KindValues<Points> min = partial.min;
  KindValues<Points> max = partial.max;
  std::array<std::int64_t, metrics> accepted{};
  for (const KindValues<Points>& of_element : values) {
    for (std::size_t m = 0; m < metrics; ++m) {
      sum[m] += of_element[m];
      min[m] = std::min(min[m], of_element[m]);
      max[m] = std::max(max[m], of_element[m]);
      accepted[m] += acceptable[m].holds(of_element[m]) ? 1 : 0;
    }
  }
  KindValues<Points> mean = sum;
  for (double& value : mean) {
    value /= static_cast<double>(values.size());
  }
  KindValues<Points> squared_deviations{};
  for (const KindValues<Points>& of_element : values) {
    for (std::size_t m = 0; m < metrics; ++m) {
      const double deviation = of_element[m] - mean[m];
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

template <class Points, class Corners>
Block<Points> evaluate_block(const ElementView<Corners>& view, std::size_t block, std::size_t worst_count) {
  const std::size_t begin = block * block_size;
  const std::size_t count = std::min(block_size, view.elements.size() - begin);
  std::array<KindValues<Points>, block_size> values;
  for_corners(view, begin, begin + count, [&](std::size_t first, std::span<const Points> corners) {
    evaluate_all(corners, std::span(values).subspan(first - begin, corners.size()));
  });
  Block<Points> evaluated;
  count_metrics<Points>(evaluated.part, std::span(values).first(count));
  WorstList worst(std::min(worst_count, count));
  for (std::size_t e = 0; e < count; ++e) {
    const double shape = values[e][shape_place];
    count_shape(evaluated.part, shape);
    if (worst.would_take(shape)) {
      worst.offer({static_cast<std::int64_t>(begin + e), shape, centroid(corner_points(view, begin + e))});
    }
  }
  evaluated.worst = worst.take_sorted();
  return evaluated;
}

template <class Points, class Corners>
KindParts<Points> parts_of(const ElementView<Corners>& view, const QualityOptions& options) {
  const auto worst_count = static_cast<std::size_t>(std::max(options.worst_count, 0));
  std::vector<Block<Points>> blocks(block_count(view));
  for_each_block(view, options.threads,
                 [&](std::size_t block) { blocks[block] = evaluate_block<Points>(view, block, worst_count); });
  KindParts<Points> made;
  WorstList worst(std::min(worst_count, view.elements.size()));
  for (const Block<Points>& block : blocks) {
    made.parts.push_back(block.part);
    for (const WorstElement& element : block.worst) {
      worst.offer(element);
    }
  }
  made.worst = worst.take_sorted();
  return made;
}

/// Those of the elements of one kind, the worst with their numbers among all.
template <class Corners>
auto parts_of(const ElementsOfKind<Corners>& elements, const MeshView& mesh, const QualityOptions& options) {
  auto made = quality_parts(elements.view(mesh), options);
  for (WorstElement& element : made.worst) {
    element.element = static_cast<std::int64_t>(elements.numbers[static_cast<std::size_t>(element.element)]);
  }
  return made;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Of what a metric's summary is made.
struct MetricPart {
  double count = 0;
  double sum = 0;
  double squared_deviations = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  std::int64_t acceptable = 0;

  // Sums of squared deviations are merged as by T. F. Chan, G. H. Golub and R. J. LeVeque (1979).
  void append(const MetricPart& next) {
    if (count > 0 && next.count > 0) {
      const double between = next.sum / next.count - sum / count;
      squared_deviations += between * between * (count * next.count / (count + next.count));
    }
    squared_deviations += next.squared_deviations;
    sum += next.sum;
    min = std::min(min, next.min);
    max = std::max(max, next.max);
    acceptable += next.acceptable;
    count += next.count;
  }

  MetricSummary summary() const {
    if (count == 0) {
      return {nan, nan, nan, nan, nan};
    }
    return {min, sum / count, max, std::sqrt(squared_deviations / count), static_cast<double>(acceptable) / count};
  }
};

/// By Metric.
using MetricParts = std::array<MetricPart, metric_count>;

template <class Points>
MetricPart metric_part(const KindPart<Points>& part, std::size_t m) {
  return {part.count, part.sum[m], part.squared_deviations[m], part.min[m], part.max[m], part.acceptable[m]};
}

/// What the elements of a kind contribute to the summaries of all.
template <class Points>
void append(const KindPart<Points>& part, MetricParts& all) {
  for (std::size_t m = 0; m < count_of_metrics<Points>; ++m) {
    all[static_cast<std::size_t>(KindMetrics<Points>::list[m])].append(metric_part(part, m));
  }
}

std::array<MetricSummary, metric_count> summaries(const MetricParts& parts, int exponent) {
  std::array<MetricSummary, metric_count> found;
  std::ranges::transform(parts, found.begin(), &MetricPart::summary);
  MetricSummary& area = found[static_cast<std::size_t>(Metric::area)];
  for (double* const value : {&area.min, &area.mean, &area.max, &area.stddev}) {
    *value = std::ldexp(*value, 2 * exponent);
  }
  return found;
}

/// Adds the elements of a kind to a report, but for their metrics.
template <class Points>
void count_in(const KindPart<Points>& part, QualityReport& report) {
  report.inverted += part.inverted;
  report.degenerate += part.degenerate;
  for (std::size_t bin = 0; bin < shape_bins; ++bin) {
    report.shape_histogram[bin] += part.shape_histogram[bin];
  }
}

template <class Points>
void add_kind(const KindPart<Points>& part, int exponent, QualityReport& report) {
  if (part.count > 0) {
    MetricParts alone;
    append(part, alone);
    report.kinds.push_back({KindMetrics<Points>::kind, static_cast<std::int64_t>(part.count), part.inverted,
                            part.degenerate, summaries(alone, exponent)});
  }
}

}  // namespace

bool is_worse(const WorstElement& a, const WorstElement& b) {
  return a.shape < b.shape || (a.shape == b.shape && a.element < b.element);
}

template <class Points>
void KindPart<Points>::append(const KindPart& next) {
  for (std::size_t m = 0; m < metrics; ++m) {
    MetricPart joined = metric_part(*this, m);
    joined.append(metric_part(next, m));
    sum[m] = joined.sum;
    squared_deviations[m] = joined.squared_deviations;
    min[m] = joined.min;
    max[m] = joined.max;
    acceptable[m] = joined.acceptable;
  }
  for (std::size_t bin = 0; bin < shape_bins; ++bin) {
    shape_histogram[bin] += next.shape_histogram[bin];
  }
  count += next.count;
  inverted += next.inverted;
  degenerate += next.degenerate;
}

template struct KindPart<CornerPoints>;
template struct KindPart<QuadrilateralPoints>;

QualityParts quality_parts(const TriangleView& view, const QualityOptions& options) {
  return parts_of<CornerPoints>(view, options);
}
KindParts<QuadrilateralPoints> quality_parts(const QuadrilateralView& view, const QualityOptions& options) {
  return parts_of<QuadrilateralPoints>(view, options);
}

QualityReport report_of(const QualityPart& total, std::vector<WorstElement> worst, int exponent) {
  QualityReport report;
  report.triangles = static_cast<std::int64_t>(total.count);
  count_in(total, report);
  MetricParts all;
  append(total, all);
  report.metrics = summaries(all, exponent);
  report.worst = std::move(worst);
  return report;
}

QualityReport report_of(const QualityPart& triangles, const KindPart<QuadrilateralPoints>& quadrilaterals,
                        std::vector<WorstElement> worst, int exponent) {
  QualityReport report;
  report.triangles = static_cast<std::int64_t>(triangles.count);
  report.quadrilaterals = static_cast<std::int64_t>(quadrilaterals.count);
  count_in(triangles, report);
  count_in(quadrilaterals, report);
  MetricParts all;
  append(triangles, all);
  append(quadrilaterals, all);
  report.metrics = summaries(all, exponent);
  if (quadrilaterals.count > 0) {
    add_kind(triangles, exponent, report);
    add_kind(quadrilaterals, exponent, report);
  }
  report.worst = std::move(worst);
  return report;
}

QualityReport report_of(const KindQuality& kind) {
  QualityReport report;
  (kind.kind == ElementKind::triangle ? report.triangles : report.quadrilaterals) = kind.elements;
  report.inverted = kind.inverted;
  report.degenerate = kind.degenerate;
  report.metrics = kind.metrics;
  return report;
}

QualityReport quality_report(const MeshView& view, const QualityOptions& options) {
  if (view.elements.are_triangles()) {
    QualityParts made =
        quality_parts(TriangleView{view.points, view.elements.triangles(), view.reversed, view.exponent}, options);
    return report_of(made.total(), std::move(made.worst), view.exponent);
  }
  const ElementsByKind kinds(view);
  const QualityParts of_triangles = parts_of(kinds.triangles, view, options);
  const KindParts<QuadrilateralPoints> of_quadrilaterals = parts_of(kinds.quadrilaterals, view, options);
  std::vector<WorstElement> worst = of_triangles.worst;
  worst.insert(worst.end(), of_quadrilaterals.worst.begin(), of_quadrilaterals.worst.end());
  std::ranges::sort(worst, is_worse);
  worst.resize(std::min(worst.size(), static_cast<std::size_t>(std::max(options.worst_count, 0))));
  return report_of(of_triangles.total(), of_quadrilaterals.total(), std::move(worst), view.exponent);
}

double smallest_shape(const TriangleView& view, int threads) {
  if (view.elements.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<double> smallest(block_count(view));
  for_each_block(view, threads, [&](std::size_t block) {
    const std::size_t begin = block * block_size;
    const std::size_t end = std::min(begin + block_size, view.elements.size());
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
