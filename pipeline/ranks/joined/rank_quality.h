// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/pipeline/ranks/joined/reported_elements.h"
#include "trismooth/quality/precision_loss.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/quality/region_quality.h"
#include "trismooth/quality/size_change.h"

namespace trismooth {

/// Reports on the whole mesh. Elements go to the ranks in blocks by their numbers (ReportedElements), and what blocks
/// contribute is added up from rank to rank in the order of the blocks: every figure is that of the reports of the mesh
/// as one file, to the bit, for every number of ranks. What is said of each kind of element is said of blocks of that
/// kind. All points are of the overlap, in a local frame.
class RankQuality {
 public:
  /// All is of the overlap. `reversed` and `held` as RankTopology has them; `regions`: a number an element, or none.
  /// The topology and `reversed` outlive it. Collective.
  RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
              std::span<const std::int32_t> regions, std::int32_t region_count);

  /// WorstElement::element is a number in the whole mesh, and the centroid in the units of the file. Collective.
  QualityReport report(std::span<const Point2<double>> points, const LocalFrame& frame, int threads) const;
  /// Of each region; empty where there are no two. Collective.
  std::vector<RegionQuality> regions(std::span<const Point2<double>> points) const;
  /// How sizes changed: size_change(). Collective.
  SizeChange size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                         std::span<const Point2<double>> after, const LocalFrame& frame_after, int threads) const;
  /// What single precision loses: single_precision_loss(). Collective.
  PrecisionLoss precision_loss(std::span<const Point2<double>> points, int exponent, int threads) const;

 private:
  /// What is known of the elements that are reported here, by their places.
  struct KnownElements {
    struct Facts {
      std::int32_t region;
      std::uint8_t all_fixed;
      std::uint8_t corners;
    };
    void resize(std::size_t size);
    void take(std::size_t place, const Facts& facts);

    bool has_regions;                     ///< there are two of them
    bool are_mixed;                       ///< quadrilaterals are among them
    std::vector<std::uint8_t> all_fixed;  ///< 1 where no corner can move
    std::vector<std::int32_t> regions;    ///< or empty
    std::vector<std::uint8_t> corners{};  ///< how many; empty: triangles alone
  };
  /// The elements of each kind, where there are both.
  struct Kinds {
    std::vector<std::int64_t> numbers;  ///< of those that the rank counts, among those of their kind
    ReportedElements<MixedElement> triangles;
    ReportedElements<MixedElement> quadrilaterals;
  };

  template <class Corners>
  ReportedElements<Corners> shared_elements(std::span<const std::uint8_t> held, std::span<const std::int32_t> regions);
  /// Numbers the elements of each kind by themselves.
  Kinds share_kinds(const ReportedElements<MixedElement>& all) const;
  /// The elements of a round that are reported here, numbered from corner to corner: corners_of_round() has their
  /// points.
  template <class Corners>
  std::vector<Corners> elements_of_round(const ReportedElements<Corners>& all, std::int64_t round) const;
  /// Calls visit(view, number) for what is reported here, those of a round after those of the last: `number`, of the
  /// first one of the view, is that among all that are reported here.
  template <class Visit>
  void for_rounds(std::span<const Point2<double>> points, int exponent, const Visit& visit) const;
  QualityReport report_of_kinds(std::span<const Point2<double>> points, const LocalFrame& frame, int threads) const;
  /// Gives each of these, which has its number among those of so many corners, that in the whole mesh.
  void number_in_whole(std::span<WorstElement> worst, std::size_t corners) const;
  /// Tells of each of these, by its number in the whole mesh, the region and whether it can move.
  void describe(std::span<WorstElement> worst) const;

  const RankTopology& topology_;
  const mpi::Communicator& ranks_;
  std::span<const std::uint8_t> reversed_;
  KnownElements known_;
  std::int32_t region_count_;
  std::variant<ReportedElements<Triangle>, ReportedElements<MixedElement>> all_;
  std::optional<Kinds> kinds_;
};

}  // namespace trismooth
