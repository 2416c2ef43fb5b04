// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/vertex_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/splitmix64.h"
#include "trismooth/mesh_io/document/global_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/ranks/agreement.h"

namespace trismooth {

namespace {

/// Of an array of 64 bits the numbers are its own.
SharedNumbers numbers_of(const DataArray& array, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw ReadError(path, "the array of global ids '" + array.name + "' " + what);
  };
  const bool are_own = array.type == ScalarType::int64;
  std::vector<std::int64_t> ids(are_own ? 0 : array.rows());
  visit_scalar_type(array.type, [&](auto zero) {
    using Number = decltype(zero);
    if constexpr (std::is_floating_point_v<Number>) {
      refuse("holds no whole numbers");
    } else {
      if (array.components != 1) {
        refuse("has " + std::to_string(array.components) + " components; one is expected");
      }
      const auto values = array.as<Number>();
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::in_range<std::int64_t>(values[i]) || values[i] < 0) {
          refuse("gives point " + std::to_string(i) + " the number " + std::to_string(values[i]) +
                 "; numbers are from 0 to 2^63 - 1");
        }
        if (are_own) {
          continue;
        }
        // It is not negative.
        ids[i] = static_cast<std::int64_t>(static_cast<std::make_unsigned_t<Number>>(values[i]));
      }
    }
  });
  return are_own ? SharedNumbers(array.as<std::int64_t>(), array.owner) : SharedNumbers(std::move(ids));
}

void require_once(std::span<const std::int64_t> ids, const DataArray& array, const std::filesystem::path& path) {
  if (std::ranges::adjacent_find(ids, std::greater_equal<>()) == ids.end()) {
    return;
  }
  std::vector<std::int32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  const auto id_of = [&](std::int32_t point) { return ids[static_cast<std::size_t>(point)]; };
  std::ranges::sort(order, {}, [&](std::int32_t point) { return std::pair(id_of(point), point); });
  const auto twice = std::ranges::adjacent_find(order, {}, id_of);
  if (twice != order.end()) {
    throw ReadError(path, "the array of global ids '" + array.name + "' gives points " + std::to_string(*twice) +
                              " and " + std::to_string(*std::next(twice)) + " the same number " +
                              std::to_string(id_of(*twice)));
  }
}

/// A point on its way to the rank that knows its place.
struct PlacedPoint {
  std::array<std::uint64_t, 3> place;  ///< the bits of the coordinates
  std::int64_t position;               ///< among all points of all pieces
  std::int64_t piece;
};

/// Numbers points by their places.
class PlaceNumbers {
 public:
  PlaceNumbers(PieceFiles& files, const mpi::Communicator& ranks) : files_(files), ranks_(ranks) {
    for (const Piece& piece : files_.pieces) {
      own_ += static_cast<std::int64_t>(piece.document.point_count());
    }
    begin_ = ranks_.sum_before(own_);
  }

  void number() {
    const std::vector<std::int64_t> firsts = first_positions();
    // Who comes first is a vertex.
    std::vector<std::int64_t> numbers(firsts.size());
    std::int64_t vertices = 0;
    for (std::size_t p = 0; p < firsts.size(); ++p) {
      vertices += firsts[p] == position(p) ? 1 : 0;
    }
    std::int64_t next = ranks_.sum_before(vertices);
    for (std::size_t p = 0; p < firsts.size(); ++p) {
      numbers[p] = firsts[p] == position(p) ? next++ : 0;
    }
    ask_for_others(firsts, numbers);
    auto number = numbers.begin();
    for (Piece& piece : files_.pieces) {
      const auto end = number + static_cast<std::ptrdiff_t>(piece.document.point_count());
      piece.ids = std::vector<std::int64_t>(number, end);
      number = end;
    }
  }

 private:
  std::int64_t position(std::size_t point) const { return begin_ + static_cast<std::int64_t>(point); }

  static std::size_t home_of(const std::array<std::uint64_t, 3>& place, const mpi::Communicator& ranks) {
    const std::uint64_t hash = splitmix64(place[0] ^ splitmix64(place[1] ^ splitmix64(place[2])));
    return static_cast<std::size_t>(hash % static_cast<std::uint64_t>(ranks.size()));
  }

  /// For each of this rank's points, the position of the first one that is the same vertex.
  std::vector<std::int64_t> first_positions() const {
    auto sent = mpi::lists_by_rank<PlacedPoint>(ranks_);
    std::vector<std::size_t> homes;
    for (const Piece& piece : files_.pieces) {
      const std::vector<double>& xyz = piece.document.points;
      for (std::size_t i = 0; i < xyz.size(); i += 3) {
        const std::array place{std::bit_cast<std::uint64_t>(xyz[i]), std::bit_cast<std::uint64_t>(xyz[i + 1]),
                               std::bit_cast<std::uint64_t>(xyz[i + 2])};
        const std::size_t home = home_of(place, ranks_);
        sent[home].push_back({place, position(homes.size()), static_cast<std::int64_t>(piece.number)});
        homes.push_back(home);
      }
    }
    mpi::ByRank<PlacedPoint> heard = ranks_.exchanged(sent);
    sent = {};
    auto answers = mpi::lists_by_rank<std::int64_t>(ranks_);
    agree(ranks_, [&] {
      std::vector<std::pair<std::size_t, std::size_t>> order;  // rank and place in its list
      for (std::size_t r = 0; r < heard.size(); ++r) {
        answers[r].resize(heard[r].size());
        for (std::size_t i = 0; i < heard[r].size(); ++i) {
          order.emplace_back(r, i);
        }
      }
      const auto point_of = [&](const auto& at) -> const PlacedPoint& { return heard[at.first][at.second]; };
      std::ranges::sort(order, [&](const auto& a, const auto& b) {
        return std::tie(point_of(a).place, point_of(a).position) < std::tie(point_of(b).place, point_of(b).position);
      });
      for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && point_of(order[end]).place == point_of(order[begin]).place) {
          ++end;
        }
        const bool are_apart = are_several_of_one_piece(std::span(order).subspan(begin, end - begin), point_of);
        for (std::size_t i = begin; i < end; ++i) {
          answers[order[i].first][order[i].second] = point_of(order[are_apart ? i : begin]).position;
        }
      }
    });
    const mpi::ByRank<std::int64_t> told = ranks_.exchanged(answers);
    std::vector<std::size_t> next(told.size(), 0);
    std::vector<std::int64_t> firsts(homes.size());
    std::ranges::transform(homes, firsts.begin(), [&](std::size_t home) { return told[home][next[home]++]; });
    return firsts;
  }

  /// Whether points at one place are different vertices: those of a slit, all in the same piece. Throws ReadError where
  /// other pieces have some there, too: then nobody knows which are one.
  template <class PointOf>
  bool are_several_of_one_piece(std::span<const std::pair<std::size_t, std::size_t>> points,
                                const PointOf& point_of) const {
    bool repeats = false;
    for (std::size_t i = 1; i < points.size(); ++i) {
      repeats = repeats || point_of(points[i]).piece == point_of(points[i - 1]).piece;
    }
    if (repeats && point_of(points.front()).piece != point_of(points.back()).piece) {
      const auto& place = point_of(points.front()).place;
      const auto path_of = [&](const auto& at) { return files_.path_of(static_cast<std::size_t>(point_of(at).piece)); };
      throw ReadError(path_of(points.front()), "several points are at (" +
                                                   std::to_string(std::bit_cast<double>(place[0])) + ", " +
                                                   std::to_string(std::bit_cast<double>(place[1])) + "), and " +
                                                   path_of(points.back()).string() +
                                                   " has points there, too, or the other way round: which of them are "
                                                   "one vertex is not known; give points global ids "
                                                   "(a point array GlobalNodeIds)");
    }
    return repeats;
  }

  /// Fills in the numbers of points that are vertices of other ranks.
  void ask_for_others(const std::vector<std::int64_t>& firsts, std::vector<std::int64_t>& numbers) const {
    auto own_begin = mpi::lists_by_rank<std::int64_t>(ranks_);
    for (auto& list : own_begin) {
      list = {begin_};
    }
    const mpi::ByRank<std::int64_t> begins = ranks_.exchanged(own_begin);
    const auto rank_of = [&](std::int64_t wanted) {
      const auto after = std::ranges::upper_bound(begins, wanted, {}, [](const auto& list) { return list.front(); });
      return static_cast<std::size_t>(after - begins.begin() - 1);
    };
    auto asked = mpi::lists_by_rank<std::int64_t>(ranks_);
    for (std::size_t p = 0; p < firsts.size(); ++p) {
      if (firsts[p] != position(p)) {
        asked[rank_of(firsts[p])].push_back(firsts[p]);
      }
    }
    mpi::ByRank<std::int64_t> heard = ranks_.exchanged(asked);
    for (auto& list : heard) {
      for (std::int64_t& wanted : list) {
        wanted = numbers[static_cast<std::size_t>(wanted - begin_)];
      }
    }
    const mpi::ByRank<std::int64_t> told = ranks_.exchanged(heard);
    std::vector<std::size_t> next(told.size(), 0);
    for (std::size_t p = 0; p < firsts.size(); ++p) {
      if (firsts[p] != position(p)) {
        const std::size_t rank = rank_of(firsts[p]);
        numbers[p] = told[rank][next[rank]++];
      }
    }
  }

  PieceFiles& files_;
  const mpi::Communicator& ranks_;
  std::int64_t own_ = 0;
  std::int64_t begin_ = 0;  ///< the position of this rank's first point
};

}  // namespace

void number_vertices(PieceFiles& files, const mpi::Communicator& ranks) {
  std::deque<Piece>& pieces = files.pieces;
  const auto lacks_ids = [](const Piece& piece) {
    return piece.document.point_count() > 0 && find_global_ids(piece.document) == nullptr;
  };
  const auto lacking = std::ranges::find_if(pieces, lacks_ids);
  const auto having = std::ranges::find_if(pieces, [](const Piece& piece) {
    return find_global_ids(piece.document) != nullptr && piece.document.point_count() > 0;
  });
  const bool some_lack = ranks.any(lacking != pieces.end());
  const bool some_have = ranks.any(having != pieces.end());
  files.have_labels = some_have;
  agree(ranks, [&] {
    if (some_lack && some_have && lacking != pieces.end()) {
      throw ReadError(lacking->path, "marks no point array as global ids, as other pieces do");
    }
    if (some_have) {
      for (Piece& piece : pieces) {
        const DataArray* const array = find_global_ids(piece.document);
        if (array != nullptr && piece.document.point_count() > 0) {
          piece.ids = numbers_of(*array, piece.path);
          require_once(piece.ids, *array, piece.path);
        }
      }
    }
  });
  if (!some_have) {
    PlaceNumbers(files, ranks).number();
  }
}

}  // namespace trismooth
