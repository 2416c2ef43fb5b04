// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_regions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <mpi.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/pipeline/input/region_judge.h"
#include "trismooth/pipeline/input/value_names.h"
#include "trismooth/pipeline/input/value_numbers.h"
#include "trismooth/pipeline/ranks/joined/overlap_triangles.h"

namespace trismooth {

namespace {

constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63U;
constexpr std::uint64_t not_a_number = std::numeric_limits<std::uint64_t>::max();

/// A value as a number without sign that stands in the values' order: not-a-numbers last, all alike, -0 as 0.
template <class T>
std::uint64_t key_of(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(value)) {
      return not_a_number;
    }
    const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value) + 0.0);
    return (bits & sign_bit) != 0 ? ~bits : bits | sign_bit;
  } else if constexpr (std::is_signed_v<T>) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value)) ^ sign_bit;
  } else {
    return value;
  }
}

template <class T>
T value_of_key(std::uint64_t key) {
  if constexpr (std::is_floating_point_v<T>) {
    if (key == not_a_number) {
      return std::numeric_limits<T>::quiet_NaN();
    }
    return static_cast<T>(std::bit_cast<double>((key & sign_bit) != 0 ? key ^ sign_bit : ~key));
  } else if constexpr (std::is_signed_v<T>) {
    return static_cast<T>(static_cast<std::int64_t>(key ^ sign_bit));
  } else {
    return static_cast<T>(key);
  }
}

std::string text_of_key(std::uint64_t key, ScalarType type, bool is_zero_negative) {
  return visit_scalar_type(type, [&](auto zero) {
    using T = decltype(zero);
    T value = value_of_key<T>(key);
    if constexpr (std::is_floating_point_v<T>) {
      value = value == 0 && is_zero_negative ? -value : value;
    }
    return value_text(make_data_array<T>("", 1, {value}), 0);
  });
}

bool is_whole_key(std::uint64_t key, ScalarType type) {
  if (type != ScalarType::float32 && type != ScalarType::float64) {
    return true;
  }
  const auto value = value_of_key<double>(key);
  return std::isfinite(value) && value == std::floor(value);
}

/// The values of one array at the triangles of all pieces.
class RankValues {
 public:
  RankValues(const PieceFiles& files, const PieceArray& array, const RankTopology& topology,
             OverlapTriangles& triangles)
      : files_(files), topology_(topology), ranks_(topology.ranks()), overlap_triangles_(triangles), type_(array.type) {
    std::size_t count = 0;
    for (const Piece& piece : files.pieces) {
      count += piece.mesh.elements.size();
    }
    keys_.reserve(count);
    std::size_t own = 0;  // triangles before, but for copies
    for (const Piece& piece : files.pieces) {
      const DataArray* const values = find_array(piece.document.cell_arrays, array.name);
      if (values == nullptr) {
        continue;  // of an empty piece
      }
      visit_scalar_type(type_, [&](auto zero) {
        const auto numbers = values->as<decltype(zero)>();
        for (std::size_t t = 0; t < piece.mesh.elements.size(); ++t) {
          const auto value = numbers[static_cast<std::size_t>(piece.mesh.cells[t])];
          keys_.push_back(key_of(value));
          if constexpr (std::is_floating_point_v<decltype(zero)>) {
            if (!first_zero_ && value == 0 && !piece.is_ghost(t)) {
              first_zero_ = {own, std::signbit(value)};
            }
          }
          own += piece.is_ghost(t) ? 0 : 1;
        }
      });
    }
  }

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  ScalarType type() const { return type_; }

  /// Whether the first triangle of the mesh that has a zero has -0: as a value it is the same, and it is called so.
  bool is_zero_negative() const {
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    std::int64_t told = none;
    if (first_zero_) {
      told = 2 * topology_.own_id(first_zero_->own_triangle) + (first_zero_->is_negative ? 1 : 0);
    }
    MPI_Allreduce(MPI_IN_PLACE, &told, 1, MPI_INT64_T, MPI_MIN, ranks_.handle());
    return told != none && told % 2 == 1;
  }

  bool differ() const {
    std::array<std::uint64_t, 2> ends{not_a_number, not_a_number};  // the lowest, and what the highest lacks of it
    for_own([&](std::uint64_t key) { ends = {std::min(ends[0], key), std::min(ends[1], not_a_number - key)}; });
    MPI_Allreduce(MPI_IN_PLACE, ends.data(), static_cast<int>(ends.size()), MPI_UINT64_T, MPI_MIN, ranks_.handle());
    return ends[0] < not_a_number - ends[1];
  }

  std::int64_t count() {
    if (!count_) {
      auto sent = mpi::lists_by_rank<std::uint64_t>(ranks_);
      for (const std::uint64_t key : distinct()) {
        sent[static_cast<std::size_t>(splitmix64(key) % static_cast<std::uint64_t>(ranks_.size()))].push_back(key);
      }
      std::vector<std::uint64_t> here;
      for (const auto& list : ranks_.exchanged(sent)) {
        here.insert(here.end(), list.begin(), list.end());
      }
      std::ranges::sort(here);
      count_ = ranks_.sum(std::unique(here.begin(), here.end()) - here.begin());
    }
    return *count_;
  }

  bool are_whole() {
    return !ranks_.any(!std::ranges::all_of(distinct(), [&](std::uint64_t key) { return is_whole_key(key, type_); }));
  }

  std::int64_t vertices_between() {
    if (!between_) {
      const mpi::Overlap& overlap = topology_.overlap();
      const std::vector<std::uint64_t>& values = at_overlap();
      std::vector<std::optional<std::uint64_t>> seen(overlap.ids.size());
      std::vector<std::uint8_t> is_between(overlap.ids.size(), 0);
      std::size_t t = 0;
      for (const std::span<const std::int32_t> corners : overlap.elements()) {
        for (const std::int32_t v : corners) {
          std::optional<std::uint64_t>& first = seen[static_cast<std::size_t>(v)];
          first = first.value_or(values[t]);
          if (*first != values[t] && overlap.is_own(v)) {
            is_between[static_cast<std::size_t>(v)] = 1;
          }
        }
        ++t;
      }
      between_ = ranks_.sum(std::ranges::count(is_between, 1));
    }
    return *between_;
  }

  double fraction_between() {
    const mpi::Overlap& overlap = topology_.overlap();
    const std::vector<std::uint64_t>& values = at_overlap();
    const ElementList elements = overlap.elements();
    const std::size_t sides = elements.are_triangles() ? 3 : 4;
    std::int64_t edges = 0;
    std::int64_t changes = 0;
    for (std::size_t t = 0; t < elements.size(); ++t) {
      const std::span<const std::int32_t> corners = elements[t];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t twin = topology_.topology().twins[sides * t + i];
        if (twin > static_cast<std::int32_t>(sides * t + i) &&
            overlap.is_own(std::min(corners[i], next_corner(corners, i)))) {
          ++edges;
          changes += values[t] != values[static_cast<std::size_t>(twin) / sides] ? 1 : 0;
        }
      }
    }
    edges = ranks_.sum(edges);
    changes = ranks_.sum(changes);
    return edges == 0 ? 0 : static_cast<double>(changes) / static_cast<double>(edges);
  }

 private:
  /// visit(key) for triangles that are no copies.
  template <class Visit>
  void for_own(const Visit& visit) const {
    std::size_t t = 0;
    for (const Piece& piece : files_.pieces) {
      for (std::size_t i = 0; i < piece.mesh.elements.size(); ++i, ++t) {
        if (!piece.is_ghost(i)) {
          visit(keys_[t]);
        }
      }
    }
  }

  const std::vector<std::uint64_t>& distinct() {
    if (!distinct_) {
      distinct_.emplace();
      for_own([&](std::uint64_t key) { distinct_->push_back(key); });
      std::ranges::sort(*distinct_);
      distinct_->erase(std::unique(distinct_->begin(), distinct_->end()), distinct_->end());
    }
    return *distinct_;
  }

  const std::vector<std::uint64_t>& at_overlap() {
    if (!at_overlap_) {
      at_overlap_ = overlap_triangles_.of_overlap<std::uint64_t>(keys_);
    }
    return *at_overlap_;
  }

  const PieceFiles& files_;
  const RankTopology& topology_;
  const mpi::Communicator& ranks_;
  OverlapTriangles& overlap_triangles_;
  ScalarType type_;
  struct Zero {
    std::size_t own_triangle;
    bool is_negative;
  };

  std::optional<Zero> first_zero_;                        ///< of the rank's own triangles
  std::vector<std::uint64_t> keys_;                       ///< of the triangles of the rank's mesh
  std::optional<std::vector<std::uint64_t>> distinct_;    ///< those of triangles that are no copies, ascending
  std::optional<std::vector<std::uint64_t>> at_overlap_;  ///< of the triangles of the overlap, where it was asked for
  std::optional<std::int64_t> count_;
  std::optional<std::int64_t> between_;
};

class RankRegionFinder {
 public:
  RankRegionFinder(const PieceFiles& files, const RankTopology& topology)
      : files_(files), topology_(topology), ranks_(topology.ranks()), overlap_triangles_(topology) {
    for (const PieceArray& array : files.arrays) {
      if (array.of == PieceArray::Of::cells && !array.is_added) {
        candidates_.push_back(&array);
      }
    }
  }

  /// (What is thrown for the names is thrown on all ranks.)
  Regions find(std::span<const std::string> names) {
    std::vector<TriangleValues> arrays;
    std::ranges::transform(candidates_, std::back_inserter(arrays),
                           [this](const PieceArray* array) { return asked_of(*array); });
    try {
      choose_regions(
          arrays, names, {}, [this](std::size_t place, RegionReason reason) { obey(*candidates_[place], reason); },
          regions_.notes, names_parallel_file(files_.path) ? ArrayOwner{"the pieces have", "they have"} : ArrayOwner{});
    } catch (const std::invalid_argument&) {
      throw mpi::KnownToAll{std::current_exception()};
    }
    return take();
  }

 private:
  TriangleValues asked_of(const PieceArray& array) {
    return {array.name,
            array.components,
            topology_.triangle_count(),
            [this, &array] { return values_of(array).differ(); },
            [this, &array] { return values_of(array).count(); },
            [this, &array] { return values_of(array).are_whole(); },
            [this, &array] { return values_of(array).vertices_between(); },
            [this, &array] { return values_of(array).fraction_between(); }};
  }

  /// Those of one array at a time are kept.
  RankValues& values_of(const PieceArray& array) {
    if (of_last_ != &array) {
      last_.emplace(files_, array, topology_, overlap_triangles_);
      of_last_ = &array;
    }
    return *last_;
  }

  void obey(const PieceArray& array, RegionReason reason) {
    RankValues& values = values_of(array);
    regions_.arrays.push_back(
        {array.name, reason, static_cast<std::int32_t>(values.count()), values.vertices_between()});
    const bool is_first = names_.empty();
    const std::vector<std::uint64_t> all = values_of_all(values.keys());
    const std::vector<std::int32_t> numbers = places_in(all, values.keys());
    std::vector<RegionName> texts;
    const ValueNames names = names_of_values(array.name);
    const bool is_zero_negative = values.is_zero_negative();
    for (const std::uint64_t key : all) {
      const std::string value = text_of_key(key, values.type(), is_zero_negative);
      const std::string name = names.of(value);
      texts.push_back(name.empty() ? RegionName{value, value} : RegionName{name, fmt::format("{} ({})", name, value)});
    }
    if (is_first) {
      of_mesh_ = numbers;
      names_ = std::move(texts);
      return;
    }
    // Together with what the arrays before it say: pairs, ascending by the first, then by the second.
    const auto width = static_cast<std::uint64_t>(std::max<std::size_t>(all.size(), 1));
    std::vector<std::uint64_t> pairs(numbers.size());
    for (std::size_t t = 0; t < pairs.size(); ++t) {
      pairs[t] = static_cast<std::uint64_t>(of_mesh_[t]) * width + static_cast<std::uint64_t>(numbers[t]);
    }
    const std::vector<std::uint64_t> all_pairs = values_of_all(pairs);
    of_mesh_ = places_in(all_pairs, pairs);
    std::vector<RegionName> pair_names;
    for (const std::uint64_t pair : all_pairs) {
      const RegionName& first = names_[pair / width];
      const RegionName& second = texts[pair % width];
      pair_names.push_back({first.plain + ", " + second.plain, first.with_value + ", " + second.with_value});
    }
    names_ = std::move(pair_names);
  }

  /// What the file calls values of the array.
  ValueNames names_of_values(const std::string& array) const {
    for (const Piece& piece : files_.pieces) {
      if (const DataArray* const values = find_array(piece.document.cell_arrays, array)) {
        return {*values, 2};
      }
    }
    return {{}, 2};
  }

  Regions take() {
    regions_.names = tell_apart(std::move(names_));
    if (!regions_.arrays.empty()) {
      regions_.of_triangle = overlap_triangles_.of_overlap<std::int32_t>(of_mesh_);
    }
    return std::move(regions_);
  }

  /// The different values that triangles of the whole mesh have, ascending, on all ranks. Copies have no say.
  std::vector<std::uint64_t> values_of_all(std::span<const std::uint64_t> of_triangle) const {
    std::vector<std::uint64_t> own;
    std::size_t t = 0;
    for (const Piece& piece : files_.pieces) {
      for (std::size_t i = 0; i < piece.mesh.elements.size(); ++i, ++t) {
        if (!piece.is_ghost(i) && (own.empty() || own.back() != of_triangle[t])) {
          own.push_back(of_triangle[t]);
        }
      }
    }
    make_unique(own);
    std::vector<std::uint64_t> all = ranks_.of_all(own);
    make_unique(all);
    return all;
  }

  static void make_unique(std::vector<std::uint64_t>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  /// A copy that differs from its triangle may have a value of its own; as it has no say, it gets any other.
  static std::vector<std::int32_t> places_in(const std::vector<std::uint64_t>& all,
                                             std::span<const std::uint64_t> values) {
    std::vector<std::int32_t> places(values.size());
    std::ranges::transform(values, places.begin(), [&](std::uint64_t value) {
      const auto place = std::ranges::lower_bound(all, value);
      return place == all.end() ? 0 : static_cast<std::int32_t>(place - all.begin());
    });
    return places;
  }

  const PieceFiles& files_;
  const RankTopology& topology_;
  const mpi::Communicator& ranks_;
  OverlapTriangles overlap_triangles_;
  std::vector<const PieceArray*> candidates_;
  std::optional<RankValues> last_;       ///< the values of the array that was asked for last
  const PieceArray* of_last_ = nullptr;  ///< that one
  Regions regions_;
  std::vector<std::int32_t> of_mesh_;  ///< the region of each triangle of the RankMesh
  std::vector<RegionName> names_;
};

}  // namespace

Regions find_rank_regions(const PieceFiles& files, const RankTopology& topology, std::span<const std::string> names) {
  return RankRegionFinder(files, topology).find(names);
}

}  // namespace trismooth
