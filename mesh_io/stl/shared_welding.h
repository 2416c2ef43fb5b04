// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/stl/point_welder.h"

namespace trismooth {

/// What PointWelder makes of corners.
struct WeldedCorners {
  std::vector<double> points;          ///< x, y, z of every distinct point, in the order of first appearance
  std::vector<std::int32_t> vertices;  ///< the point of every corner
};

/// Welds corners as one PointWelder would that gets them in order, by all workers: their points are dealt out by their
/// hashes, and each share has a welder of its own, whose table is small enough for a processor's cache. Corner c is
/// point_of(c), of floating-point type T; there are no more than 2^31 - 1. Takes time linear in the corners, and memory
/// for a copy of them.
template <class T, class PointOf>
class SharedWelding {
 public:
  SharedWelding(std::size_t corners, const PointOf& point_of, const FileWorkers& workers)
      : corners_(corners), point_of_(point_of), workers_(workers.workers) {
    const std::size_t part_bytes = std::clamp(workers.part_bytes, std::size_t{1}, FileWorkers::default_part_bytes);
    shares_ = std::min(std::bit_ceil(corners / std::max(std::size_t{1}, part_bytes / sizeof(Dealt)) + 1), most_shares);
  }

  WeldedCorners weld() {
    deal_out();
    weld_shares();
    number_points();
    return std::move(result_);
  }

 private:
  struct Dealt {
    std::array<T, 3> point;
    std::int32_t corner;
  };

  static constexpr std::size_t most_shares = 256;
  static constexpr std::int64_t welding_grain = 16384;  ///< corners that a thread takes at a time

  static std::array<double, 3> as_double(const std::array<T, 3>& point) { return {point[0], point[1], point[2]}; }

  std::size_t share_of(std::int64_t corner) const {
    const std::uint64_t hash = PointWelder::hash_of(as_double(point_of_(static_cast<std::size_t>(corner))));
    return (hash >> 56) & (shares_ - 1);
  }

  /// Sorts the corners by their shares, those of a share in order.
  void deal_out() {
    dealt_.resize(corners_);
    begins_ = counting_sort(
        static_cast<std::int64_t>(corners_), static_cast<std::int64_t>(shares_),
        [this](std::int64_t corner) { return share_of(corner); },
        [this](std::int64_t corner, std::int64_t place) {
          dealt_[static_cast<std::size_t>(place)] = {point_of_(static_cast<std::size_t>(corner)),
                                                     static_cast<std::int32_t>(corner)};
        },
        workers_);
  }

  /// Gives each corner the first one at its point.
  void weld_shares() {
    shared_resize(result_.vertices, corners_, workers_);
    workers_.for_blocks(static_cast<std::int64_t>(shares_), 1, [this](std::int64_t from, std::int64_t to) {
      for (auto share = static_cast<std::size_t>(from); share < static_cast<std::size_t>(to); ++share) {
        PointWelder welder;
        std::vector<std::int32_t> first_corners;
        for (auto i = static_cast<std::size_t>(begins_[share]); i < static_cast<std::size_t>(begins_[share + 1]); ++i) {
          const auto number = static_cast<std::size_t>(welder.weld(as_double(dealt_[i].point)));
          if (number == first_corners.size()) {
            first_corners.push_back(dealt_[i].corner);
          }
          result_.vertices[static_cast<std::size_t>(dealt_[i].corner)] = first_corners[number];
        }
      }
    });
    dealt_ = {};
  }

  /// Numbers the first corners in order, and gives every corner the number of its first one.
  void number_points() {
    const auto is_first = [this](std::int64_t corner) {
      return result_.vertices[static_cast<std::size_t>(corner)] == corner;
    };
    BulkVector<std::int32_t> first_corners = numbers_of(static_cast<std::int64_t>(corners_), is_first, workers_);
    shared_resize(result_.points, 3 * first_corners.size(), workers_);
    BulkVector<std::int32_t> numbers(corners_);  // of the first corners
    workers_.for_blocks(std::ssize(first_corners), welding_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t number = begin; number < end; ++number) {
        const auto corner = static_cast<std::size_t>(first_corners[static_cast<std::size_t>(number)]);
        std::ranges::copy(as_double(point_of_(corner)), result_.points.begin() + 3 * number);
        numbers[corner] = static_cast<std::int32_t>(number);
      }
    });
    workers_.for_blocks(static_cast<std::int64_t>(corners_), welding_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto corner = static_cast<std::size_t>(begin); corner < static_cast<std::size_t>(end); ++corner) {
        std::int32_t& vertex = result_.vertices[corner];
        vertex = numbers[static_cast<std::size_t>(vertex)];
      }
    });
  }

  std::size_t corners_;
  const PointOf& point_of_;
  Workers& workers_;
  std::size_t shares_;  ///< a power of two
  BulkVector<Dealt> dealt_;
  std::vector<std::int64_t> begins_;  ///< of the shares in it, and its end
  WeldedCorners result_;
};

/// See SharedWelding.
template <class T, class PointOf>
WeldedCorners weld_corners(std::size_t corners, const PointOf& point_of, const FileWorkers& workers) {
  return SharedWelding<T, PointOf>(corners, point_of, workers).weld();
}

}  // namespace trismooth
