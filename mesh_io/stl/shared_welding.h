#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_blocks.h"
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
    block_ = std::max(std::size_t{1}, part_bytes / sizeof(Dealt));
    blocks_ = corners / block_ + (corners % block_ == 0 ? 0 : 1);
    shares_ = std::min(std::bit_ceil(std::max(blocks_, std::size_t{1})), most_shares);
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

  static std::array<double, 3> as_double(const std::array<T, 3>& point) { return {point[0], point[1], point[2]}; }

  std::size_t share_of(const std::array<T, 3>& point) const {
    return (PointWelder::hash_of(as_double(point)) >> 56) & (shares_ - 1);
  }

  /// Calls body(block, first, last) for every block of corners.
  template <class Body>
  void for_all_blocks(const Body& body) {
    workers_.for_blocks(static_cast<std::int64_t>(blocks_), 1, [&](std::int64_t from, std::int64_t to) {
      for (auto block = static_cast<std::size_t>(from); block < static_cast<std::size_t>(to); ++block) {
        body(block, block * block_, std::min(corners_, (block + 1) * block_));
      }
    });
  }

  /// Sorts the corners by their shares, those of a share in order.
  void deal_out() {
    std::vector<std::uint8_t> share_of_corner;
    shared_resize(share_of_corner, corners_, dealt_, corners_, workers_);
    std::vector<std::size_t> places(blocks_ * shares_);  // of the next corner, by block and share
    for_all_blocks([&](std::size_t block, std::size_t first, std::size_t last) {
      for (std::size_t corner = first; corner < last; ++corner) {
        const std::size_t share = share_of(point_of_(corner));
        share_of_corner[corner] = static_cast<std::uint8_t>(share);
        ++places[block * shares_ + share];
      }
    });
    std::size_t place = 0;
    for (std::size_t share = 0; share < shares_; ++share) {
      begins_.push_back(place);
      for (std::size_t block = 0; block < blocks_; ++block) {
        std::size_t& count = places[block * shares_ + share];
        const std::size_t begin = place;
        place += count;
        count = begin;
      }
    }
    begins_.push_back(place);
    for_all_blocks([&](std::size_t block, std::size_t first, std::size_t last) {
      for (std::size_t corner = first; corner < last; ++corner) {
        dealt_[places[block * shares_ + share_of_corner[corner]]++] = {point_of_(corner),
                                                                       static_cast<std::int32_t>(corner)};
      }
    });
  }

  /// Gives each corner the first one at its point.
  void weld_shares() {
    shared_resize(result_.vertices, corners_, workers_);
    workers_.for_blocks(static_cast<std::int64_t>(shares_), 1, [this](std::int64_t from, std::int64_t to) {
      for (auto share = static_cast<std::size_t>(from); share < static_cast<std::size_t>(to); ++share) {
        PointWelder welder;
        std::vector<std::int32_t> first_corners;
        for (std::size_t i = begins_[share]; i < begins_[share + 1]; ++i) {
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
    std::vector<std::size_t> before(blocks_ + 1);
    const auto is_first = [this](std::size_t corner) {
      return static_cast<std::size_t>(result_.vertices[corner]) == corner;
    };
    for_all_blocks([&](std::size_t block, std::size_t first, std::size_t last) {
      std::size_t count = 0;
      for (std::size_t corner = first; corner < last; ++corner) {
        count += is_first(corner) ? 1 : 0;
      }
      before[block + 1] = count;
    });
    for (std::size_t block = 0; block < blocks_; ++block) {
      before[block + 1] += before[block];
    }
    std::vector<std::int32_t> numbers;  // of the first corners
    shared_resize(numbers, corners_, result_.points, 3 * before[blocks_], workers_);
    for_all_blocks([&](std::size_t block, std::size_t first, std::size_t last) {
      std::size_t number = before[block];
      for (std::size_t corner = first; corner < last; ++corner) {
        if (is_first(corner)) {
          std::ranges::copy(as_double(point_of_(corner)),
                            result_.points.begin() + static_cast<std::ptrdiff_t>(3 * number));
          numbers[corner] = static_cast<std::int32_t>(number++);
        }
      }
    });
    for_all_blocks([&](std::size_t /*block*/, std::size_t first, std::size_t last) {
      for (std::size_t corner = first; corner < last; ++corner) {
        std::int32_t& vertex = result_.vertices[corner];
        vertex = numbers[static_cast<std::size_t>(vertex)];
      }
    });
  }

  std::size_t corners_;
  const PointOf& point_of_;
  Workers& workers_;
  std::size_t block_;  ///< corners of a block
  std::size_t blocks_;
  std::size_t shares_;  ///< a power of two
  std::vector<Dealt> dealt_;
  std::vector<std::size_t> begins_;  ///< of the shares in it, and its end
  WeldedCorners result_;
};

/// See SharedWelding.
template <class T, class PointOf>
WeldedCorners weld_corners(std::size_t corners, const PointOf& point_of, const FileWorkers& workers) {
  return SharedWelding<T, PointOf>(corners, point_of, workers).weld();
}

}  // namespace trismooth
