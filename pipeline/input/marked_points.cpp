#include "trismooth/pipeline/input/marked_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

#include "trismooth/base/splitmix64.h"
#include "trismooth/pipeline/input/inner_neighbours.h"

namespace trismooth {

namespace {

constexpr std::string_view triangle_markers = "triangle:marker";
constexpr std::array<std::string_view, 3> marker_arrays{triangle_markers, "medit:ref", "freefem:label"};

bool has_markers(const DataArray& array) {
  return array.components == 1 && array.type != ScalarType::float32 && array.type != ScalarType::float64 &&
         std::ranges::find(marker_arrays, array.name) != marker_arrays.end();
}

/// Flags of the points that are inside, as a rule: of those each neighbour is met twice, and what is met twice leaves
/// nothing behind. That of a point on the boundary is 0.
std::vector<std::uint8_t> inner_points(std::size_t count, std::span<const Triangle> triangles) {
  std::vector<std::uint64_t> left(count, 0);
  std::vector<std::uint8_t> inside(count, 0);
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [v, before, after] : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}}) {
      left[static_cast<std::size_t>(v)] ^=
          splitmix64(static_cast<std::uint64_t>(before)) ^ splitmix64(static_cast<std::uint64_t>(after));
      inside[static_cast<std::size_t>(v)] = 1;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    inside[v] = left[v] == 0 ? inside[v] : std::uint8_t{0};
  }
  return inside;
}

/// What most points inside have, or 0 where any has it.
double usual_value(std::vector<double> values) {
  if (std::ranges::find(values, 0.0) != values.end()) {
    return 0;
  }
  std::ranges::sort(values);
  double usual = 0;
  std::ptrdiff_t most = 0;
  for (auto begin = values.begin(); begin != values.end();) {
    const auto end = std::upper_bound(begin, values.end(), *begin);
    if (end - begin > most) {
      most = end - begin;
      usual = *begin;
    }
    begin = end;
  }
  return usual;
}

/// Whether an array gives its points numbers, rather than mark some of them.
bool are_numbers(const std::vector<std::int32_t>& marked, std::size_t inside, const DataArray& array) {
  if (2 * marked.size() <= inside) {
    return false;
  }
  std::vector<double> values;
  std::ranges::transform(marked, std::back_inserter(values),
                         [&](std::int32_t v) { return array.value(static_cast<std::size_t>(v)); });
  std::ranges::sort(values);
  const auto different = std::unique(values.begin(), values.end()) - values.begin();
  return 2 * different > std::ssize(marked);
}

/// The points inside that the array marks.
std::vector<std::int32_t> marked_by(const DataArray& array, std::span<const Triangle> triangles,
                                    std::span<const std::uint8_t> inside) {
  std::vector<double> values;
  for (std::size_t v = 0; v < inside.size(); ++v) {
    if (inside[v] != 0) {
      values.push_back(array.value(v));
    }
  }
  const std::size_t inner = values.size();
  const double usual = usual_value(std::move(values));
  std::vector<std::int32_t> marked;
  std::vector<std::uint8_t> is_marked(inside.size(), 0);
  for (std::size_t v = 0; v < inside.size(); ++v) {
    if (inside[v] != 0 && array.value(v) != usual) {
      is_marked[v] = 1;
      marked.push_back(static_cast<std::int32_t>(v));
    }
  }
  if (marked.empty() || are_numbers(marked, inner, array)) {
    return {};
  }
  if (array.name == triangle_markers && usual == 0) {
    return marked;
  }
  const InnerNeighbours neighbours(triangles, is_marked);
  std::vector<std::uint8_t> is_of_part(inside.size(), 0);
  for (const std::int32_t v : marked) {
    const auto around = neighbours[v];
    const double value = array.value(static_cast<std::size_t>(v));
    if (std::ranges::all_of(around,
                            [&](std::int32_t n) { return array.value(static_cast<std::size_t>(n)) == value; })) {
      is_of_part[static_cast<std::size_t>(v)] = 1;
      for (const std::int32_t n : around) {
        is_of_part[static_cast<std::size_t>(n)] = 1;
      }
    }
  }
  std::erase_if(marked, [&](std::int32_t v) { return is_of_part[static_cast<std::size_t>(v)] != 0; });
  return marked;
}

}  // namespace

std::vector<NamedSet> find_marked_points(const MeshDocument& document, std::span<const Triangle> triangles) {
  std::vector<NamedSet> sets;
  std::vector<std::uint8_t> inside;
  for (const DataArray& array : document.point_arrays) {
    if (!has_markers(array)) {
      continue;
    }
    if (inside.empty()) {
      inside = inner_points(document.point_count(), triangles);
    }
    if (std::vector<std::int32_t> marked = marked_by(array, triangles, inside); !marked.empty()) {
      sets.push_back({array.name, std::move(marked)});
    }
  }
  return sets;
}

}  // namespace trismooth
