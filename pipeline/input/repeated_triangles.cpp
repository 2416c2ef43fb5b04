#include "trismooth/pipeline/input/repeated_triangles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/splitmix64.h"
#include "trismooth/base/workers.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

namespace {

constexpr std::int64_t repeat_grain = 16384;

Triangle sorted(Triangle vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

/// The same for all copies of a triangle.
std::uint64_t print_of(const Triangle& triangle) {
  const auto [low, middle, high] = sorted(triangle);
  const auto two = static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(middle);
  return splitmix64(splitmix64(two) ^ static_cast<std::uint64_t>(high));
}

/// Bits that many threads set.
class SharedBits {
 public:
  explicit SharedBits(std::uint64_t size) : words_(std::bit_ceil(std::max<std::uint64_t>(size, 64)) / 64, 0) {}

  /// Sets the bit of a print. Returns whether it was set.
  bool set(std::uint64_t print) {
    return (std::atomic_ref(word(print)).fetch_or(bit(print), std::memory_order_relaxed) & bit(print)) != 0;
  }
  bool has(std::uint64_t print) const { return (words_[place(print)] & bit(print)) != 0; }

 private:
  static std::uint64_t bit(std::uint64_t print) { return std::uint64_t{1} << (print & 63U); }
  std::size_t place(std::uint64_t print) const { return static_cast<std::size_t>((print >> 6U) & (words_.size() - 1)); }
  std::uint64_t& word(std::uint64_t print) { return words_[place(print)]; }

  std::vector<std::uint64_t> words_;
};

/// The triangles that share their print with another one, and few that do not.
BulkVector<std::int32_t> with_common_prints(std::span<const Triangle> triangles, Workers& workers) {
  constexpr std::uint64_t bits_a_triangle = 8;
  SharedBits met(bits_a_triangle * triangles.size());
  SharedBits met_again(bits_a_triangle * triangles.size());
  workers.for_blocks(std::ssize(triangles), repeat_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      if (const std::uint64_t print = print_of(triangles[static_cast<std::size_t>(t)]); met.set(print)) {
        met_again.set(print);
      }
    }
  });
  return numbers_of(
      std::ssize(triangles),
      [&](std::int64_t t) { return met_again.has(print_of(triangles[static_cast<std::size_t>(t)])); }, workers);
}

/// A triangle that may be there more than once. Those of the same vertices are copies.
struct ListedTriangle {
  Triangle corners;
  Triangle middles;  ///< of six nodes; else -1
  std::int32_t number;

  auto vertices() const { return std::tie(corners, middles); }
  bool operator<(const ListedTriangle& other) const {
    return std::tie(corners, middles, number) < std::tie(other.corners, other.middles, other.number);
  }
};

/// A copy and the triangle that is listed first, by their numbers in the list; ascending by the copies.
std::vector<std::pair<std::int32_t, std::int32_t>> find_copies(const PlanarMesh& mesh, Workers& workers) {
  std::vector<ListedTriangle> listed;
  for (const std::int32_t t : with_common_prints(mesh.triangles, workers)) {
    const auto quadratic = std::ranges::lower_bound(mesh.quadratics, t, {}, &QuadraticTriangle::triangle);
    const bool is_quadratic = quadratic != mesh.quadratics.end() && quadratic->triangle == t;
    listed.push_back({sorted(mesh.triangles[static_cast<std::size_t>(t)]),
                      is_quadratic ? sorted(quadratic->middles) : Triangle{-1, -1, -1}, t});
  }
  std::ranges::sort(listed, std::less<>{});
  std::vector<std::pair<std::int32_t, std::int32_t>> copies;
  for (std::size_t i = 1, first = 0; i < listed.size(); ++i) {
    if (listed[i].vertices() == listed[first].vertices()) {
      copies.emplace_back(listed[i].number, listed[first].number);
    } else {
      first = i;
    }
  }
  std::ranges::sort(copies);
  return copies;
}

}  // namespace

void take_out_repeats(PlanarMesh& mesh, Workers& workers) {
  const auto copies = find_copies(mesh, workers);
  if (copies.empty()) {
    return;
  }
  std::vector<Triangle> triangles;
  BulkVector<std::int32_t> cells;
  std::vector<QuadraticTriangle> quadratics;
  std::vector<std::int32_t> numbers(mesh.triangles.size());  // of the triangles that stay
  auto copy = copies.begin();
  auto quadratic = mesh.quadratics.begin();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool is_quadratic = quadratic != mesh.quadratics.end() && quadratic->triangle == static_cast<std::int32_t>(t);
    if (copy != copies.end() && copy->first == static_cast<std::int32_t>(t)) {
      mesh.repeats.push_back({numbers[static_cast<std::size_t>(copy->second)], mesh.cells[t]});
      ++copy;
    } else {
      numbers[t] = static_cast<std::int32_t>(triangles.size());
      triangles.push_back(mesh.triangles[t]);
      cells.push_back(mesh.cells[t]);
      if (is_quadratic) {
        quadratics.push_back({numbers[t], quadratic->middles});
      }
    }
    quadratic += is_quadratic ? 1 : 0;
  }
  mesh.triangles_of_cells = std::move(triangles);
  mesh.triangles = mesh.triangles_of_cells;
  mesh.cells = std::move(cells);
  mesh.quadratics = std::move(quadratics);
  const auto [triangle, cell] = mesh.repeats.front();
  const bool is_one = mesh.repeats.size() == 1;
  mesh.notes.push_back(fmt::format(
      "{} triangle{} listed again (the first is cell {}, a copy of cell {}): {} once, and all copies stay in the file; "
      "where copies are of several regions, these together are one of their own",
      mesh.repeats.size(), is_one ? " is" : "s are", cell, mesh.cells[static_cast<std::size_t>(triangle)],
      is_one ? "it is counted and smoothed" : "each is counted and smoothed"));
  std::ranges::stable_sort(mesh.repeats, {}, &RepeatedTriangle::triangle);
}

ValueNumbers number_values_of_triangles(const DataArray& array, const PlanarMesh& mesh) {
  if (mesh.repeats.empty()) {
    return number_values(array, mesh.cells);
  }
  std::vector<std::int32_t> rows(mesh.cells.begin(), mesh.cells.end());
  std::ranges::transform(mesh.repeats, std::back_inserter(rows), &RepeatedTriangle::cell);
  const ValueNumbers of_rows = number_values(array, rows);
  std::vector<std::int32_t> kinds(of_rows.of_item.begin(), of_rows.of_item.begin() + std::ssize(mesh.cells));
  std::map<std::vector<std::int32_t>, std::int32_t> sets;
  for (std::size_t begin = 0, end = 0; begin < mesh.repeats.size(); begin = end) {
    const std::int32_t triangle = mesh.repeats[begin].triangle;
    std::vector<std::int32_t> values{kinds[static_cast<std::size_t>(triangle)]};
    for (; end < mesh.repeats.size() && mesh.repeats[end].triangle == triangle; ++end) {
      values.push_back(of_rows.of_item[mesh.cells.size() + end]);
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (values.size() > 1) {
      const auto next = static_cast<std::int32_t>(of_rows.example.size() + sets.size());
      kinds[static_cast<std::size_t>(triangle)] = sets.try_emplace(std::move(values), next).first->second;
    }
  }
  // Values that only copies have are left out.
  ValueNumbers numbers;
  numbers.of_item.resize(kinds.size());
  std::vector<std::int32_t> examples(of_rows.example.size() + sets.size(), -1);
  for (std::size_t t = kinds.size(); t-- > 0;) {
    examples[static_cast<std::size_t>(kinds[t])] = static_cast<std::int32_t>(t);
  }
  std::vector<std::int32_t> number_of(examples.size(), -1);
  for (std::size_t kind = 0; kind < examples.size(); ++kind) {
    if (examples[kind] >= 0) {
      number_of[kind] = numbers.count();
      numbers.example.push_back(examples[kind]);
    }
  }
  std::ranges::transform(kinds, numbers.of_item.begin(),
                         [&](std::int32_t kind) { return number_of[static_cast<std::size_t>(kind)]; });
  return numbers;
}

std::span<const RepeatedTriangle> copies_of(const PlanarMesh& mesh, std::int32_t triangle) {
  const auto first = std::ranges::lower_bound(mesh.repeats, triangle, {}, &RepeatedTriangle::triangle);
  const auto last = std::ranges::upper_bound(mesh.repeats, triangle, {}, &RepeatedTriangle::triangle);
  return {first, last};
}

}  // namespace trismooth
