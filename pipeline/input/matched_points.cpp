// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/matched_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

/// The nodes of an element: four corners, the middles of four sides and the centre, no_corner where it has none.
using Nodes = std::array<std::int32_t, 9>;

constexpr std::string_view what_to_do =
    "two meshes are compared that have the same points and the same elements; save both from one mesh, with no point "
    "or element added, renumbered, merged or left out";

/// The elements of a document, whatever becomes of quadrilaterals elsewhere.
class ListedElements {
 public:
  ListedElements(const MeshDocument& document, const std::filesystem::path& path, Workers& workers)
      : path_(path), points_(document.point_count()) {
    check_document_size(points_, document.cells.size(), path);
    cells_ = element_cells(document, workers);
  }

  std::size_t size() const { return cells_.elements.size(); }
  std::int64_t quadrilaterals() const { return cells_.count_quadrilaterals(); }
  std::size_t points() const { return points_; }

  /// "9 points and 12 triangles"
  std::string text() const {
    const std::int64_t quads = quadrilaterals();
    const auto [one, several] = element_words(static_cast<std::int64_t>(size()) - quads, quads);
    return counted(points_, "point", "points") + " and " + counted(size(), one, several);
  }

  /// As the element is listed.
  Nodes nodes(std::size_t element) const {
    Nodes all;
    all.fill(no_corner);
    std::ranges::copy(cells_.elements[element], all.begin());
    const auto found =
        std::ranges::lower_bound(cells_.quadratics, static_cast<std::int32_t>(element), {}, &QuadraticElement::element);
    if (found != cells_.quadratics.end() && found->element == static_cast<std::int32_t>(element)) {
      std::ranges::copy(found->middles, all.begin() + 4);
    }
    return all;
  }

  /// "points 4, 5, 9 (cell 37)"
  std::string text_of(std::size_t element) const {
    Nodes all = nodes(element);
    const std::span listed(all.begin(), std::remove(all.begin(), all.end(), no_corner));
    return fmt::format("points {} (cell {})", fmt::join(listed, ", "), cells_.cells[element]);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::size_t points_;
  ElementCells cells_;
};

/// The same for an element from whatever corner on and in whichever sense it is listed: from the smallest corner
/// towards the smaller of those beside it.
Nodes in_one_order(const Nodes& listed) {
  const std::size_t corners = listed[3] == no_corner ? 3 : 4;
  const auto first = static_cast<std::size_t>(std::ranges::min_element(std::span(listed).first(corners)) -
                                              std::span(listed).first(corners).begin());
  const std::size_t behind = (first + 1) % corners;
  const std::size_t before = (first + corners - 1) % corners;
  const bool is_turned = listed[before] < listed[behind];
  Nodes ordered;
  ordered.fill(no_corner);
  for (std::size_t i = 0; i < corners; ++i) {
    const std::size_t corner = (first + (is_turned ? corners - i : i)) % corners;
    ordered[i] = listed[corner];
    // Of the side to the corner that comes next.
    ordered[4 + i] = listed[4 + (is_turned ? (corner + corners - 1) % corners : corner)];
  }
  ordered[8] = listed[8];
  return ordered;
}

bool are_same_in_another_order(const ListedElements& mesh, const ListedElements& other) {
  std::vector<Nodes> first(mesh.size());
  std::vector<Nodes> second(mesh.size());
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    first[e] = in_one_order(mesh.nodes(e));
    second[e] = in_one_order(other.nodes(e));
  }
  std::ranges::sort(first);
  std::ranges::sort(second);
  return first == second;
}

/// The number of each point of the other mesh in the mesh, by the nodes of elements that are listed alike in both;
/// points that no element uses have none. Nothing where elements tell otherwise.
std::optional<std::vector<std::int32_t>> numbers_by_elements(const ListedElements& mesh, const ListedElements& other) {
  std::vector<std::int32_t> numbers(other.points(), no_corner);
  std::vector<std::uint8_t> is_taken(mesh.points(), 0);
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    const Nodes here = mesh.nodes(e);
    const Nodes there = other.nodes(e);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if ((here[i] == no_corner) != (there[i] == no_corner)) {
        return {};
      }
      if (here[i] == no_corner) {
        continue;
      }
      std::int32_t& number = numbers[static_cast<std::size_t>(there[i])];
      std::uint8_t& taken = is_taken[static_cast<std::size_t>(here[i])];
      if (number != here[i] && (number != no_corner || taken != 0)) {
        return {};
      }
      number = here[i];
      taken = 1;
    }
  }
  return numbers;
}

/// The first element that differs.
std::optional<std::size_t> first_other_element(const ListedElements& mesh, const ListedElements& other) {
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    if (in_one_order(mesh.nodes(e)) != in_one_order(other.nodes(e))) {
      return e;
    }
  }
  return {};
}

/// What is wrong with the other mesh, of another number of points or elements.
ReadError other_number(const ListedElements& mesh, const ListedElements& other) {
  const bool is_split = (mesh.quadrilaterals() > 0) != (other.quadrilaterals() > 0);
  return {other.path(),
          fmt::format(
              "holds {}, and {} holds {}; {}{}", other.text(), mesh.path().string(), mesh.text(), what_to_do,
              is_split ? "; formats without quadrilaterals (STL, FreeFem, Triangle) have two triangles for each" : "")};
}

}  // namespace

MatchedPoints match_points(const MeshDocument& mesh, const std::filesystem::path& path, const MeshDocument& other,
                           const std::filesystem::path& other_path, Workers& workers) {
  const ListedElements first(mesh, path, workers);
  const ListedElements second(other, other_path, workers);
  if (first.size() != second.size()) {
    throw other_number(first, second);
  }
  std::optional<std::size_t> differs;
  if (first.points() == second.points()) {
    differs = first_other_element(first, second);
    if (!differs) {
      return {other.points, {}};
    }
    if (are_same_in_another_order(first, second)) {
      return {other.points,
              {fmt::format("{} lists the elements in another order; their numbers here are those of {}",
                           other_path.string(), path.string())}};
    }
  }
  const auto numbers = numbers_by_elements(first, second);
  if (!numbers && differs) {
    throw ReadError(other_path,
                    fmt::format("element {} has the {}, and in {} the {}, all counted from 0; {}", *differs,
                                second.text_of(*differs), path.string(), first.text_of(*differs), what_to_do));
  }
  if (!numbers) {
    throw other_number(first, second);
  }
  MatchedPoints matched{mesh.points,
                        {fmt::format("{} has {} in other rows than {}: they are told by the corners of elements; those "
                                     "of no element are not compared",
                                     other_path.string(), counted(second.points(), "point", "points"), path.string())}};
  for (std::size_t v = 0; v < numbers->size(); ++v) {
    if ((*numbers)[v] != no_corner) {
      std::copy_n(other.points.begin() + 3 * static_cast<std::ptrdiff_t>(v), 3,
                  matched.points.begin() + 3 * static_cast<std::ptrdiff_t>((*numbers)[v]));
    }
  }
  return matched;
}

}  // namespace trismooth
