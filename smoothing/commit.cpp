// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/commit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/number_lists.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/untangle/untangle_mesh.h"

namespace trismooth {

namespace {

/// Vertices that a thread takes at a time.
constexpr std::int64_t commit_grain = 8192;

bool is_finite(Point2<double> point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

class Commit final : public FollowingNodes {
 public:
  Commit(const SweptMesh& mesh, const StoredImage& image, std::span<double> stored, std::span<Point2<double>> points,
         Workers& workers)
      : mesh_(mesh),
        image_(image),
        read_(stored.begin(), stored.end()),
        stored_(stored),
        points_(points),
        workers_(workers),
        after_(mesh.before.points),
        middles_of_corners_(points.size(), mesh.middles) {
    std::vector<std::pair<std::int32_t, std::int32_t>> corners;
    for (std::size_t q = 0; q < mesh.quadratics.size(); ++q) {
      for (const std::int32_t corner : mesh.elements[static_cast<std::size_t>(mesh.quadratics[q].element)]) {
        corners.emplace_back(corner, static_cast<std::int32_t>(q));
      }
    }
    quadratics_of_corners_ = NumberLists(0, static_cast<std::int32_t>(points.size()), corners);
  }

  void run(const SmoothingOptions& options, SmoothingResult& result) {
    place();
    TurnedComponents turned;
    if (result.untangling) {
      turned = {result.untangling->turned_components, std::move(result.untangling->turned)};
    }
    if (options.guard) {
      guard(turned, result);
    }
    if (result.untangling && !(options.guard && result.untangling->inverted_before == 0)) {
      result.untangling->inverted_after =
          inverted_elements(mesh_.rings.rings.view(), mesh_.elements, turned, after_, workers_);
      result.untangling->turned_components = turned.count;
      result.untangling->turned = std::move(turned.elements);
    }
    result.moved_vertices = settle();
    if (options.guard) {
      name_reverted(result, points_);
    }
  }

  void follow(std::int32_t corner) override {
    put_back(static_cast<std::size_t>(corner));
    for (const std::int32_t m : middles_of_corners_[corner]) {
      bring(mesh_.middles[static_cast<std::size_t>(m)]);
    }
  }

  bool is_spoiled(std::span<const std::int32_t> corners, bool is_turned) const override {
    return std::ranges::any_of(quadratics_of_corners_[corners[0]], [&](std::int32_t q) {
      const QuadraticElement& quadratic = mesh_.quadratics[static_cast<std::size_t>(q)];
      const auto e = static_cast<std::size_t>(quadratic.element);
      const std::span<const std::int32_t> listed = mesh_.elements[e];
      const bool was_reversed = mesh_.rings.reversed[e] != 0;
      if (!std::ranges::is_permutation(listed, corners)) {
        return false;
      }
      const JacobianBound now = jacobian_bound(quadratic, listed, was_reversed != is_turned, after_);
      if (now.is_valid()) {
        return false;
      }
      const JacobianBound was = jacobian_bound(quadratic, listed, was_reversed, before());
      return was.is_valid() || (now.is_invalid() && !was.is_invalid());
    });
  }

 private:
  std::span<const Point2<double>> before() const { return mesh_.before.points; }
  double* numbers(std::size_t v) const { return stored_.data() + image_.numbers * v; }
  const double* numbers_read(std::size_t v) const { return read_.data() + image_.numbers * v; }

  template <class Body>
  void for_blocks(std::size_t count, const Body& body) {
    workers_.for_blocks(static_cast<std::int64_t>(count), commit_grain, [&](std::int64_t begin, std::int64_t end) {
      body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
    });
  }

  void place() {
    for_blocks(points_.size(), [this](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (!(mesh_.swept[v] == points_[v])) {
          store(v);
        }
      }
    });
    for_blocks(mesh_.middles.size(), [this](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) {
        bring(mesh_.middles[m]);
      }
    });
  }

  void store(std::size_t v) {
    const double* const read = numbers_read(v);
    std::array<double, StoredImage::most_numbers> moved{};
    image_.move(read, points_[v], mesh_.swept[v], moved.data());
    std::transform(read, read + image_.numbers, moved.begin(), moved.begin(),
                   [this](double before, double now) { return image_.stored(before, now); });
    // Near the largest number, the step to a place within range may be beyond it.
    if (std::all_of(moved.begin(), moved.begin() + image_.numbers,
                    [](double number) { return std::isfinite(number); })) {
      std::copy_n(moved.begin(), image_.numbers, numbers(v));
      enter(v);
    }
  }

  void bring(const MiddleNode& middle) {
    follow_corners(middle, image_, read_, stored_);
    enter(static_cast<std::size_t>(middle.vertex));
  }

  bool is_elsewhere(std::size_t v) const { return !(after_[v] == before()[v]); }

  void put_back(std::size_t v) {
    std::copy_n(numbers_read(v), image_.numbers, numbers(v));
    after_[v] = before()[v];
  }

  /// Takes over where the vertex lies as it is stored.
  void enter(std::size_t v) {
    const Point2<double> place = image_.place(v, numbers(v));
    const bool stays = std::equal(numbers(v), numbers(v) + image_.numbers, numbers_read(v)) || !is_finite(place);
    after_[v] = stays ? before()[v] : mesh_.before.frame.enter(place);
    if (!is_elsewhere(v)) {
      put_back(v);
    }
  }

  void guard(TurnedComponents& turned, SmoothingResult& result) {
    const RingView rings = mesh_.rings.rings.view();
    FollowingNodes* const nodes = mesh_.middles.empty() ? nullptr : this;
    const GuardOutcome outcome =
        keep_never_worse(rings, mesh_.elements, mesh_.rings.reversed, turned, before(), after_, workers_, nodes);
    result.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      result.reverted.push_back({v, mesh_.swept[static_cast<std::size_t>(v)]});
    }
  }

  /// What went back gets the numbers that were read, the others their places in the plane: how many there are.
  std::int64_t settle() {
    const std::int64_t elsewhere =
        joined_sum(std::ssize(points_), commit_grain, workers_, [this](std::int64_t i) -> std::int64_t {
          const auto v = static_cast<std::size_t>(i);
          if (!is_elsewhere(v)) {
            put_back(v);
            return 0;
          }
          points_[v] = image_.place(v, numbers(v));
          return 1;
        });
    return elsewhere - std::ranges::count_if(mesh_.middles, [this](const MiddleNode& middle) {
             return is_elsewhere(static_cast<std::size_t>(middle.vertex));
           });
  }

  const SweptMesh& mesh_;
  const StoredImage& image_;
  std::vector<double> read_;
  std::span<double> stored_;
  std::span<Point2<double>> points_;  ///< as they were read, until all is settled
  Workers& workers_;
  BulkVector<Point2<double>> after_;  ///< as they are stored, in the local frame
  MiddlesOfCorners middles_of_corners_;
  NumberLists quadratics_of_corners_;
};

}  // namespace

void commit(const SweptMesh& mesh, const StoredImage& image, std::span<double> stored, std::span<Point2<double>> points,
            const SmoothingOptions& options, Workers& workers, SmoothingResult& result) {
  const Stopwatch watch;
  Commit(mesh, image, stored, points, workers).run(options, result);
  result.timings.commit += watch.milliseconds();
}

void follow_corners(const MiddleNode& middle, const StoredImage& image, std::span<const double> read,
                    std::span<double> stored) {
  for (std::size_t axis = 0; axis < image.numbers; ++axis) {
    const auto at = [&](std::int32_t v) { return image.numbers * static_cast<std::size_t>(v) + axis; };
    const std::size_t i = at(middle.vertex);
    const double move = move_of(
        middle, [&](std::int32_t v) { return read[at(v)]; }, [&](std::int32_t v) { return stored[at(v)]; });
    const double now = image.stored(read[i], read[i] + move);
    stored[i] = std::isfinite(now) ? now : read[i];
  }
}

}  // namespace trismooth
