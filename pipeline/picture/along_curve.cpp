// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/along_curve.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/base/counting_sort.h"
#include "trismooth/base/hilbert_curve.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t ordering_grain = 16384;
constexpr int curve_order = 15;

bool is_set(const std::vector<std::uint8_t>& flags, std::int32_t place) {
  return !flags.empty() && flags[place] != 0;
}

class CurveOrder {
 public:
  CurveOrder(const MeshPicture& picture, std::span<const std::int32_t> shown, Workers& workers)
      : picture_(picture), shown_(shown), workers_(workers) {}

  OrderedPicture ordered() {
    find_vertices();
    order_vertices();
    put_vertices();
    picture_.elements.list().visit([this](const auto& elements) { put_elements(elements); });
    MeshPicture& mesh = result_.mesh;
    mesh.region_names = picture_.region_names;
    mesh.worst_before = picture_.worst_before;
    mesh.worst_after = picture_.worst_after;
    return std::move(result_);
  }

 private:
  /// body(i) for the numbers i of [0, size).
  template <class Body>
  void for_all(std::size_t size, const Body& body) {
    workers_.for_blocks(static_cast<std::int64_t>(size), ordering_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        body(i);
      }
    });
  }

  /// Those that elements use, in the order of the file.
  void find_vertices() {
    const std::size_t count = picture_.before.size();
    result_.place_of_vertex.resize(count);
    std::span<std::int32_t> marks = result_.place_of_vertex;
    for_all(count, [&](std::int64_t v) { marks[v] = -1; });
    picture_.elements.list().visit([&](const auto& elements) {
      for_all(shown_.size(), [&](std::int64_t i) {
        for (const std::int32_t v : elements[shown_[i]]) {
          if (v >= 0) {  // (Several threads write the same.)
            std::atomic_ref(marks[v]).store(0, std::memory_order_relaxed);
          }
        }
      });
    });
    const Blocks blocks(static_cast<std::int64_t>(count), ordering_grain, workers_);
    std::vector<std::size_t> begins(static_cast<std::size_t>(blocks.count()) + 1);
    blocks.for_each(workers_, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      begins[block + 1] = static_cast<std::size_t>(std::count(marks.begin() + begin, marks.begin() + end, 0));
    });
    for (std::size_t block = 1; block < begins.size(); ++block) {
      begins[block] += begins[block - 1];
    }
    vertices_.resize(begins.back());
    blocks.for_each(workers_, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      std::size_t place = begins[block];
      for (std::int64_t v = begin; v < end; ++v) {
        if (marks[v] == 0) {
          vertices_[place++] = {0, static_cast<std::int32_t>(v)};
        }
      }
    });
  }

  void order_vertices() {
    if (vertices_.empty()) {
      return;
    }
    const Box box = joined_blocks(
        std::ssize(vertices_), ordering_grain, workers_, Box{},
        [this](std::int64_t begin, std::int64_t end, Box& found) {
          for (std::int64_t i = begin; i < end; ++i) {
            found.add(picture_.before[vertices_[i].number]);
            found.add(picture_.now()[vertices_[i].number]);
          }
        },
        [](Box& all, const Box& found) { all.add(found); });
    const LocalFrame frame = local_frame(box.low, box.high);
    const Point2<double> low = frame.enter(box.low);
    result_.frame = frame;
    result_.low = low;
    // (The extent is 1 at most there.)
    constexpr double last_cell = (1 << curve_order) - 1;
    for_all(vertices_.size(), [&](std::int64_t i) {
      const Point2<double> from_low = frame.enter(picture_.now()[vertices_[i].number]) - low;
      vertices_[i].key =
          static_cast<std::uint32_t>(hilbert_index(static_cast<std::uint32_t>(from_low.x * last_cell),
                                                   static_cast<std::uint32_t>(from_low.y * last_cell), curve_order));
    });
    radix_sort(vertices_, 2 * curve_order, workers_);
  }

  void put_vertices() {
    MeshPicture& mesh = result_.mesh;
    const bool has_moved = !picture_.after.empty();
    mesh.before.resize(vertices_.size());
    mesh.after.resize(has_moved ? vertices_.size() : 0);
    mesh.held.resize(picture_.held.empty() ? 0 : vertices_.size());
    for_all(vertices_.size(), [&](std::int64_t place) {
      const std::int32_t v = vertices_[place].number;
      result_.place_of_vertex[v] = static_cast<std::int32_t>(place);
      mesh.before[place] = result_.frame.enter(picture_.before[v]);
      if (has_moved) {
        mesh.after[place] = result_.frame.enter(picture_.after[v]);
      }
      if (!mesh.held.empty()) {
        mesh.held[place] = picture_.held[v];
      }
    });
  }

  template <class Corners>
  void put_elements(std::span<const Corners> listed) {
    const auto bits = static_cast<unsigned>(std::bit_width(vertices_.size()));
    BulkVector<KeyedNumber> keyed(shown_.size());
    BulkVector<Corners> turned(shown_.size());
    for_all(shown_.size(), [&](std::int64_t i) {
      Corners corners = listed[shown_[i]];
      for (std::int32_t& v : corners) {
        v = v < 0 ? v : result_.place_of_vertex[v];
      }
      turned[i] = canonical_corners(corners, is_set(picture_.reversed_now(), shown_[i]));
      const std::uint32_t kind = corner_count(corners) == 4 ? 1U << bits : 0;
      keyed[i] = {kind | static_cast<std::uint32_t>(turned[i][0]), static_cast<std::int32_t>(i)};
    });
    radix_sort(keyed, static_cast<int>(bits) + 1, workers_);

    MeshPicture& mesh = result_.mesh;
    std::vector<Corners> elements(shown_.size());
    const bool has_regions = !picture_.regions.empty();
    const bool may_turn = !picture_.after.empty() && picture_.reversed_before != picture_.reversed_after;
    mesh.numbers.resize(shown_.size());
    mesh.regions.resize(has_regions ? shown_.size() : 0);
    mesh.reversed_before.resize(may_turn ? shown_.size() : 0);
    for_all(shown_.size(), [&](std::int64_t place) {
      elements[place] = turned[keyed[place].number];
      const std::int32_t element = shown_[keyed[place].number];
      mesh.numbers[place] = picture_.numbers.empty() ? element : picture_.numbers[element];
      if (has_regions) {
        mesh.regions[place] = picture_.regions[element];
      }
      if (may_turn) {
        mesh.reversed_before[place] =
            is_set(picture_.reversed_before, element) != is_set(picture_.reversed_after, element) ? 1 : 0;
      }
    });
    mesh.elements = OwnElements(std::move(elements));
  }

  const MeshPicture& picture_;
  const std::span<const std::int32_t> shown_;
  Workers& workers_;
  BulkVector<KeyedNumber> vertices_;  ///< in their new order
  OrderedPicture result_;
};

}  // namespace

OrderedPicture along_curve(const MeshPicture& picture, std::span<const std::int32_t> shown, Workers& workers) {
  return CurveOrder(picture, shown, workers).ordered();
}

}  // namespace trismooth
