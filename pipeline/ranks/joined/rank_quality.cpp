// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_quality.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

#include <mpi.h>

#include "trismooth/quality/area_ratios.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_part.h"
#include "trismooth/quality/region_part.h"

namespace trismooth {

namespace {

/// Hands a state from rank to rank, each of which adds what it has; all get what comes out at the end. The bytes of a
/// state are copied; all ranks have as many of them.
template <class State, class Add>
std::vector<State> passed_on(std::vector<State> states, const mpi::Communicator& ranks, const Add& add) {
  static_assert(std::is_trivially_copyable_v<State>);
  constexpr int tag = 7311;
  const auto bytes = static_cast<int>(states.size() * sizeof(State));
  const int last = ranks.size() - 1;
  if (ranks.rank() > 0) {
    MPI_Recv(states.data(), bytes, MPI_BYTE, ranks.rank() - 1, tag, ranks.handle(), MPI_STATUS_IGNORE);
  }
  add(states);
  if (ranks.rank() < last) {
    MPI_Send(states.data(), bytes, MPI_BYTE, ranks.rank() + 1, tag, ranks.handle());
  }
  MPI_Bcast(states.data(), bytes, MPI_BYTE, last, ranks.handle());
  return states;
}

/// The worst elements of all ranks, from those of each.
std::vector<WorstElement> worst_of_all(const std::vector<WorstElement>& own, std::size_t count,
                                       const mpi::Communicator& ranks) {
  std::vector<WorstElement> all = ranks.of_all(own);
  std::ranges::sort(all, is_worse);
  all.resize(std::min(all.size(), count));
  return all;
}

/// Elements whose corners stand one behind the other, `stride` of them for each.
template <class Corners>
std::vector<Corners> corner_numbers(std::size_t count, std::size_t stride) {
  std::vector<Corners> elements(count);
  for (std::size_t e = 0; e < count; ++e) {
    std::iota(elements[e].begin(), elements[e].end(), static_cast<std::int32_t>(stride * e));
  }
  return elements;
}

/// Of who reports on elements and knows all of them already.
struct NothingKept {
  struct Facts {};
  void resize(std::size_t /*size*/) {}
  void take(std::size_t /*place*/, const Facts& /*facts*/) {}
};

/// What elements contribute to the report of their kind, and the worst, known by their numbers among those.
template <class Points>
struct KindTotal {
  KindPart<Points> total;
  std::vector<WorstElement> worst;
};

/// What the elements of one kind contribute; `kind`: these, whose corners are Corners. Collective.
template <class Corners, class Points, class Reported>
KindTotal<Points> total_of(const ReportedElements<Reported>& kind, std::span<const Point2<double>> points,
                           const LocalFrame& frame, const QualityOptions& options, const mpi::Communicator& ranks) {
  KindParts<Points> all;
  std::vector<Corners> numbers;
  for (std::int64_t round = 0; round < kind.rounds(); ++round) {
    const BulkVector<Point2<double>> corners = kind.corners_of_round(points, round);
    numbers = corner_numbers<Corners>(corners.size() / std::tuple_size_v<Reported>, std::tuple_size_v<Reported>);
    KindParts<Points> made = quality_parts(ElementView<Corners>{corners, numbers, {}, frame.exponent}, options);
    all.parts.insert(all.parts.end(), made.parts.begin(), made.parts.end());
    for (WorstElement& element : made.worst) {
      element.element += kind.first_number(ranks.rank()) + kind.first_of_round(round);
      element.centroid = frame.leave(element.centroid);
      all.worst.push_back(element);
    }
  }
  const std::vector<KindPart<Points>> total =
      passed_on(std::vector<KindPart<Points>>(1), ranks, [&](std::vector<KindPart<Points>>& states) {
        for (const KindPart<Points>& part : all.parts) {
          states.front().append(part);
        }
      });
  return {total.front(), worst_of_all(all.worst, static_cast<std::size_t>(options.worst_count), ranks)};
}

}  // namespace

void RankQuality::KnownElements::resize(std::size_t size) {
  all_fixed.resize(size);
  regions.resize(has_regions ? size : 0);
  corners.resize(are_mixed ? size : 0);
}

void RankQuality::KnownElements::take(std::size_t place, const Facts& facts) {
  all_fixed[place] = facts.all_fixed;
  if (has_regions) {
    regions[place] = facts.region;
  }
  if (are_mixed) {
    corners[place] = facts.corners;
  }
}

template <class Corners>
ReportedElements<Corners> RankQuality::shared_elements(std::span<const std::uint8_t> held,
                                                       std::span<const std::int32_t> regions) {
  const mpi::Overlap& overlap = topology_.overlap();
  const std::span<const Corners> elements = overlap.elements().as<Corners>();
  const auto for_counted = [&](const auto& visit) {
    auto id = overlap.triangle_ids.begin();
    for (std::size_t e = 0; e < elements.size(); ++e, ++id) {
      if (topology_.counts(e)) {
        visit(e, *id,
              KnownElements::Facts{regions.empty() ? 0 : regions[e],
                                   static_cast<std::uint8_t>(all_are_fixed(elements[e], held) ? 1 : 0),
                                   static_cast<std::uint8_t>(corner_count(elements[e]))});
      }
    }
  };
  return {topology_, reversed_, topology_.triangle_count(), for_counted, known_};
}

RankQuality::RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed,
                         std::span<const std::uint8_t> held, std::span<const std::int32_t> regions,
                         std::int32_t region_count)
    : topology_(topology),
      ranks_(topology.ranks()),
      reversed_(reversed),
      known_{region_count > 1, !topology.overlap().elements().are_triangles(), {}, {}, {}},
      region_count_(region_count),
      all_(known_.are_mixed ? decltype(all_)(shared_elements<MixedElement>(held, regions))
                            : decltype(all_)(shared_elements<Triangle>(held, regions))) {
  if (known_.are_mixed) {
    kinds_ = share_kinds(std::get<ReportedElements<MixedElement>>(all_));
  }
}

RankQuality::Kinds RankQuality::share_kinds(const ReportedElements<MixedElement>& all) const {
  // Who reports on elements knows which come before them here, and how many there are on the ranks before.
  const std::int64_t quadrilaterals = std::ranges::count(known_.corners, 4);
  const std::int64_t triangles = std::ssize(known_.corners) - quadrilaterals;
  std::int64_t triangle = ranks_.sum_before(triangles);
  std::int64_t quadrilateral = ranks_.sum_before(quadrilaterals);
  std::vector<std::int64_t> here;
  here.reserve(known_.corners.size());
  for (const std::uint8_t corners : known_.corners) {
    here.push_back(corners == 3 ? triangle++ : quadrilateral++);
  }
  auto answers = mpi::lists_by_rank<std::int64_t>(ranks_);
  for (std::size_t r = 0; r < answers.size(); ++r) {
    for (const std::int32_t place : all.places()[r]) {
      answers[r].push_back(here[static_cast<std::size_t>(place)]);
    }
  }
  std::vector<std::int64_t> numbers;
  for (const auto& of_rank : ranks_.exchanged(std::move(answers))) {
    numbers.insert(numbers.end(), of_rank.begin(), of_rank.end());
  }
  const ElementList elements = topology_.overlap().elements();
  const auto of_kind = [&](std::size_t corners, std::int64_t count) {
    const auto for_counted = [&](const auto& visit) {
      auto number = numbers.begin();
      for (const auto& of_rank : all.sent()) {
        for (const std::int32_t e : of_rank) {
          if (elements[static_cast<std::size_t>(e)].size() == corners) {
            visit(static_cast<std::size_t>(e), *number, NothingKept::Facts{});
          }
          ++number;
        }
      }
    };
    return ReportedElements<MixedElement>(topology_, reversed_, count, for_counted, NothingKept{});
  };
  const std::int64_t all_quadrilaterals = ranks_.sum(quadrilaterals);
  ReportedElements<MixedElement> of_triangles = of_kind(3, topology_.triangle_count() - all_quadrilaterals);
  ReportedElements<MixedElement> of_quadrilaterals = of_kind(4, all_quadrilaterals);
  return {std::move(numbers), std::move(of_triangles), std::move(of_quadrilaterals)};
}

template <class Corners>
std::vector<Corners> RankQuality::elements_of_round(const ReportedElements<Corners>& all, std::int64_t round) const {
  const auto first = static_cast<std::size_t>(all.first_of_round(round));
  const auto count = static_cast<std::size_t>(all.first_of_round(round + 1)) - first;
  std::vector<Corners> elements = corner_numbers<Corners>(count, std::tuple_size_v<Corners>);
  for (std::size_t e = 0; e < count && known_.are_mixed; ++e) {
    elements[e].back() = known_.corners[first + e] == 3 ? no_corner : elements[e].back();
  }
  return elements;
}

template <class Visit>
void RankQuality::for_rounds(std::span<const Point2<double>> points, int exponent, const Visit& visit) const {
  const auto go_over = [&](const auto& all) {
    for (std::int64_t round = 0; round < all.rounds(); ++round) {
      const BulkVector<Point2<double>> corners = all.corners_of_round(points, round);
      const auto elements = elements_of_round(all, round);
      visit(MeshView(corners, elements, {}, exponent), static_cast<std::size_t>(all.first_of_round(round)));
    }
  };
  std::visit(go_over, all_);
}

void RankQuality::describe(std::span<WorstElement> worst) const {
  const std::int64_t first = std::visit([this](const auto& all) { return all.first_number(ranks_.rank()); }, all_);
  std::vector<std::int64_t> facts(2 * worst.size(), 0);
  for (std::size_t w = 0; w < worst.size(); ++w) {
    // The one rank that reports on it knows it, the others say 0.
    const std::int64_t place = worst[w].element - first;
    if (place >= 0 && place < std::ssize(known_.all_fixed)) {
      facts[2 * w] = known_.all_fixed[static_cast<std::size_t>(place)];
      facts[2 * w + 1] = known_.has_regions ? known_.regions[static_cast<std::size_t>(place)] + 1 : 0;
    }
  }
  ranks_.sum(facts);
  for (std::size_t w = 0; w < worst.size(); ++w) {
    worst[w].all_fixed = facts[2 * w] != 0;
    worst[w].region = static_cast<std::int32_t>(facts[2 * w + 1] - 1);
  }
}

void RankQuality::number_in_whole(std::span<WorstElement> worst, std::size_t corners) const {
  // The one rank that counts each knows which it is, the others say 0.
  std::vector<std::int64_t> ids(worst.size(), 0);
  const mpi::Overlap& overlap = topology_.overlap();
  const ElementList elements = overlap.elements();
  std::size_t i = 0;
  for (const auto& of_rank : std::get<ReportedElements<MixedElement>>(all_).sent()) {
    for (const std::int32_t e : of_rank) {
      const std::int64_t number = kinds_->numbers[i++];
      const auto place = std::ranges::find(worst, number, &WorstElement::element);
      const auto element = static_cast<std::size_t>(e);
      if (place != worst.end() && elements[element].size() == corners) {
        ids[static_cast<std::size_t>(place - worst.begin())] = overlap.triangle_ids[element];
      }
    }
  }
  ranks_.sum(ids);
  for (std::size_t w = 0; w < worst.size(); ++w) {
    worst[w].element = ids[w];
  }
}

QualityReport RankQuality::report_of_kinds(std::span<const Point2<double>> points, const LocalFrame& frame,
                                           int threads) const {
  const QualityOptions options{.threads = threads};
  KindTotal<CornerPoints> triangles =
      total_of<Triangle, CornerPoints>(kinds_->triangles, points, frame, options, ranks_);
  KindTotal<QuadrilateralPoints> quadrilaterals =
      total_of<MixedElement, QuadrilateralPoints>(kinds_->quadrilaterals, points, frame, options, ranks_);
  number_in_whole(triangles.worst, 3);
  number_in_whole(quadrilaterals.worst, 4);
  std::vector<WorstElement> worst = std::move(triangles.worst);
  worst.insert(worst.end(), quadrilaterals.worst.begin(), quadrilaterals.worst.end());
  std::ranges::sort(worst, is_worse);
  worst.resize(std::min(worst.size(), static_cast<std::size_t>(options.worst_count)));
  describe(worst);
  return report_of(triangles.total, quadrilaterals.total, std::move(worst), frame.exponent);
}

QualityReport RankQuality::report(std::span<const Point2<double>> points, const LocalFrame& frame, int threads) const {
  if (kinds_) {
    return report_of_kinds(points, frame, threads);
  }
  const QualityOptions options{.threads = threads};
  KindTotal<CornerPoints> all =
      total_of<Triangle, CornerPoints>(std::get<ReportedElements<Triangle>>(all_), points, frame, options, ranks_);
  describe(all.worst);
  return report_of(all.total, std::move(all.worst), frame.exponent);
}

std::vector<RegionQuality> RankQuality::regions(std::span<const Point2<double>> points) const {
  std::vector<RegionQuality> qualities;
  if (region_count_ < 2) {
    return qualities;
  }
  struct Value {
    double shape;
    double angle;
    ElementKind kind;
  };
  std::vector<Value> values;
  values.reserve(known_.regions.size());
  for_rounds(points, 0, [&](const MeshView& mesh, std::size_t /*first*/) {
    mesh.visit([&](const auto& view) {
      for (std::size_t e = 0; e < view.elements.size(); ++e) {
        with_points(view, e, [&]<class Points>(const Points& corners) {
          values.push_back(
              {evaluate(Metric::shape, corners), evaluate(Metric::min_angle, corners), KindMetrics<Points>::kind});
        });
      }
    });
  });
  const std::vector<RegionPart> parts = passed_on(
      std::vector<RegionPart>(static_cast<std::size_t>(region_count_)), ranks_, [&](std::vector<RegionPart>& states) {
        for (std::size_t e = 0; e < values.size(); ++e) {
          states[static_cast<std::size_t>(known_.regions[e])].add(values[e].shape, values[e].angle, values[e].kind);
        }
      });
  std::ranges::transform(parts, std::back_inserter(qualities), &RegionPart::quality);
  return qualities;
}

SizeChange RankQuality::size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                                    std::span<const Point2<double>> after, const LocalFrame& frame_after,
                                    int threads) const {
  AreaRatios made;
  const auto go_over = [&](const auto& all) {
    for (std::int64_t round = 0; round < all.rounds(); ++round) {
      const BulkVector<Point2<double>> old_corners = all.corners_of_round(before, round);
      const BulkVector<Point2<double>> corners = all.corners_of_round(after, round);
      const auto elements = elements_of_round(all, round);
      const AreaRatios of_round = area_ratios(MeshView(old_corners, elements, {}, frame_before.exponent),
                                              MeshView(corners, elements, {}, frame_after.exponent), threads);
      made.ratios.insert(made.ratios.end(), of_round.ratios.begin(), of_round.ratios.end());
      made.sums.insert(made.sums.end(), of_round.sums.begin(), of_round.sums.end());
    }
  };
  std::visit(go_over, all_);
  const double sum = passed_on(std::vector<double>(1), ranks_, [&](std::vector<double>& states) {
                       for (const double part : made.sums) {
                         states.front() += part;
                       }
                     }).front();
  return size_change_of(
      made.ratios, sum, [this](std::vector<std::int64_t>& counts) { ranks_.sum(counts); }, threads);
}

PrecisionLoss RankQuality::precision_loss(std::span<const Point2<double>> points, int exponent, int threads) const {
  PrecisionLoss loss;
  for_rounds(points, exponent, [&](const MeshView& view, std::size_t /*first*/) {
    const PrecisionLoss of_round = single_precision_loss(view, threads);
    loss.elements += of_round.elements;
    loss.collapsed += of_round.collapsed;
    loss.distorted += of_round.distorted;
  });
  return {ranks_.sum(loss.elements), ranks_.sum(loss.collapsed), ranks_.sum(loss.distorted)};
}

}  // namespace trismooth
