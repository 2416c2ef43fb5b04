// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/displacements.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "trismooth/base/box.h"
#include "trismooth/base/point_squares.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/plain_name.h"
#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

using Vector = std::array<double, 3>;

/// One of a file's own, by the number of its vertex.
struct NumberedVector {
  std::int64_t vertex;
  Vector displacement;
};

bool is_text(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".csv" || extension == ".txt";
}

/// The first line of a text that is none of comments and not empty.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (const std::size_t begin = line.find_first_not_of(" \t\r"); begin != line.npos && line[begin] != '#') {
      return line;
    }
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return {};
}

/// Takes in the names that the first line of a table may have. `line`: no commas. Throws ReadError where they say that
/// the columns are not a vertex, dx, dy and perhaps dz, in this order.
bool is_line_of_names(std::string_view line, const std::filesystem::path& path) {
  constexpr std::string_view of_numbers = "0123456789+-.";
  std::vector<std::string> names;
  std::string name;
  for (const char c : std::string(line) + " ") {
    if (std::string_view(" \t\r\"").find(c) == std::string_view::npos) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  if (names.empty() || of_numbers.find(names.front().front()) != std::string_view::npos) {
    return false;
  }
  constexpr std::string_view axes = "xyz";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t axis = axes.find(names[i].back());
    const bool is_along = axis != std::string_view::npos && (names[i].size() <= 2 || names[i].ends_with("_x") ||
                                                             names[i].ends_with("_y") || names[i].ends_with("_z"));
    if (is_along && axis + 1 != i) {
      throw ReadError(
          path, fmt::format("has a column '{}' where {} is expected: columns are a vertex, dx, dy and perhaps "
                            "dz, in this order",
                            names[i], i == 0 ? "a vertex" : std::string("d") + axes[std::min(i, axes.size()) - 1]));
    }
  }
  return true;
}

/// Commas separate numbers, unless semicolons do: then they are those of decimals, which are not read.
void refuse_decimal_commas(std::string_view text, const std::filesystem::path& path) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::string_view stated = line.substr(0, line.find('#'));
    if (stated.find(';') != stated.npos && stated.find(',') != stated.npos) {
      throw ReadError(path, fmt::format("has both semicolons and commas in a line, '{}': numbers have points", stated));
    }
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
}

std::vector<NumberedVector> read_text(const std::filesystem::path& path) {
  const FileBytes bytes = read_file_bytes(path);
  std::string text(std::string_view(bytes).substr(begin_of_text(bytes)));
  refuse_decimal_commas(text, path);
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == ';'; }, ' ');
  TextScanner scanner(text, path, TextScanner::Comments::hash);
  if (const std::string_view line = first_line(text); is_line_of_names(line, path)) {
    scanner.seek(static_cast<std::size_t>(line.data() + line.size() - text.data()));
  }
  std::vector<NumberedVector> vectors;
  while (!scanner.at_end()) {
    NumberedVector vector{scanner.next_integer("a vertex number", std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max()),
                          {0, 0, 0}};
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == 2 && scanner.at_end_of_line()) {
        break;
      }
      if (scanner.at_end_of_line()) {
        scanner.fail("expected a vertex and its displacement, two or three numbers, in each line");
      }
      vector.displacement[i] = scanner.next_double("a displacement");
    }
    if (!scanner.at_end_of_line()) {
      scanner.fail(
          "expected a vertex and its displacement, two or three numbers, in each line; numbers are separated by "
          "blanks, "
          "commas or semicolons, and have points");
    }
    vectors.push_back(vector);
  }
  return vectors;
}

/// The arrays "disp_x", "disp_y" and perhaps "disp_z" as one array, as programs that write numbers alone have them
/// (Exodus II): names are compared by plain_name(). Nothing where there are none.
std::optional<DataArray> joined_components(const MeshDocument& document, const std::string& name) {
  std::vector<const DataArray*> components;
  std::string names;
  for (const char axis : {'x', 'y', 'z'}) {
    const auto found = std::ranges::find_if(document.point_arrays, [&](const DataArray& array) {
      return array.components == 1 && plain_name(array.name) == plain_name(name) + axis;
    });
    if (found == document.point_arrays.end()) {
      break;
    }
    components.push_back(&*found);
    add_to_list(names, found->name);
  }
  if (components.size() < 2) {
    return std::nullopt;
  }
  std::vector<double> values;
  values.reserve(components.size() * document.point_count());
  for (std::size_t row = 0; row < document.point_count(); ++row) {
    for (const DataArray* const component : components) {
      values.push_back(component->value(row));
    }
  }
  return make_data_array(names, components.size(), std::move(values));
}

/// The array of a document that has them. `whose`: "the file" or that of a step.
DataArray displacement_array(const MeshDocument& document, const std::string& name, const std::string& whose) {
  const DataArray* const array = find_array_loosely(document.point_arrays, name);
  if (array == nullptr) {
    if (std::optional<DataArray> joined = joined_components(document, name)) {
      return *std::move(joined);
    }
    throw std::invalid_argument(fmt::format("{} has no point array '{}' to take displacements from; it has: {}", whose,
                                            name, array_names(document.point_arrays)));
  }
  if (array->components != 2 && array->components != 3) {
    throw std::invalid_argument(
        fmt::format("the point array '{}' of {} has {}; displacements have two or three", array->name, whose,
                    counted(static_cast<std::int64_t>(array->components), "component", "components")));
  }
  return *array;
}

Vector vector_of(const DataArray& array, std::size_t row) {
  Vector vector{0, 0, 0};
  for (std::size_t i = 0; i < array.components; ++i) {
    vector[i] = array.value(row, i);
  }
  return vector;
}

bool is_finite(const Vector& vector) {
  return std::ranges::all_of(vector, [](double x) { return std::isfinite(x); });
}

/// The points of another file by their places.
class PointsOfFile {
 public:
  /// Both outlive it. `mesh`: that whose plane they are seen in.
  PointsOfFile(const MeshDocument& file, const PlanarMesh& mesh) : squares_(file.point_count()) {
    Box box;
    for (std::size_t i = 0; i < file.point_count(); ++i) {
      places_.push_back(mesh.plane.project(Eigen::Map<const Eigen::Vector3d>(file.points.data() + 3 * i)));
      box.add(places_.back());
    }
    // What writing as float32 does to a coordinate, of a mesh that is not far from the origin.
    constexpr double rounding = 1e-6;
    distance_ =
        rounding * std::max({box.high.x - box.low.x, box.high.y - box.low.y, std::numeric_limits<double>::min()});
    for (std::size_t i = 0; i < places_.size(); ++i) {
      squares_.add(places_[i], distance_, static_cast<std::int32_t>(i));
    }
  }

  /// Calls visit(row) for the points that are in that place, to rounding.
  template <class Visit>
  void visit_at(Point2<double> place, const Visit& visit) const {
    squares_.visit_near(place, distance_, distance_, [&](std::int32_t row) {
      if (is_at(static_cast<std::size_t>(row), place)) {
        visit(static_cast<std::size_t>(row));
      }
    });
  }

  bool is_at(std::size_t row, Point2<double> place) const {
    const Point2<double> way = places_[row] - place;
    return std::hypot(way.x, way.y) <= distance_;
  }

 private:
  std::vector<Point2<double>> places_;
  double distance_ = 0;
  PointSquares squares_;
};

/// Gathers what files say of vertices.
class Gathered {
 public:
  Gathered(const PlanarMesh& mesh, std::span<const Obeys> obeys) : mesh_(mesh), obeys_(obeys) {
    found_.of_vertex.assign(obeys.size(), {0, 0, 0});
    found_.is_given.assign(obeys.size(), 0);
  }

  /// By the array of the mesh's own file, or of one with the same points.
  void take_rows(const DataArray& array, const std::string& whose) {
    for (std::size_t v = 0; v < obeys_.size(); ++v) {
      take(v, vector_of(array, v), array.name, whose);
    }
  }

  /// By the places of points in another file.
  void take_places(const DataArray& array, const PointsOfFile& points, const std::string& whose) {
    for (std::size_t v = 0; v < obeys_.size(); ++v) {
      if (obeys_[v] == Obeys::never) {
        continue;
      }
      points.visit_at(mesh_.points[v], [&](std::size_t row) {
        const Vector vector = vector_of(array, row);
        if (found_.is_given[v] != 0 && vector != found_.of_vertex[v]) {
          throw std::invalid_argument(
              fmt::format("{} has several points where vertex {} is, with different displacements; a file with the "
                          "points of the mesh in their order, or a text of vertex numbers, tells which is meant",
                          whose, v));
        }
        take(v, vector, array.name, whose);
      });
    }
  }

  void take_numbered(std::span<const NumberedVector> vectors, std::span<const std::int32_t> vertices,
                     const std::filesystem::path& path) {
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      const auto v = static_cast<std::size_t>(vertices[i]);
      if (found_.is_given[v] != 0) {
        throw ReadError(path, fmt::format("gives vertex {} twice", vectors[i].vertex));
      }
      found_.is_given[v] = 1;
      found_.of_vertex[v] = vectors[i].displacement;
    }
  }

  /// What is found, with what is to be said of it. `whose`: the file's name.
  Displacements found(const std::string& whose) && {
    std::int64_t held = 0;
    std::int64_t without = 0;
    std::int64_t of_free = 0;
    bool is_any_told = false;
    for (std::size_t v = 0; v < obeys_.size(); ++v) {
      is_any_told = is_any_told || (obeys_[v] != Obeys::never && found_.is_given[v] != 0);
      const bool is_held = obeys_[v] == Obeys::always;
      held += is_held ? 1 : 0;
      without += is_held && found_.is_given[v] == 0 ? 1 : 0;
      of_free += obeys_[v] == Obeys::never && found_.is_given[v] != 0 && found_.of_vertex[v] != Vector{0, 0, 0} ? 1 : 0;
    }
    if (held > 0 && !is_any_told) {
      throw std::invalid_argument(whose + " gives no vertex of the boundary a displacement");
    }
    if (without > 0) {
      found_.notes.push_back(fmt::format("{} without a displacement, and {} where the mesh's file has {}",
                                         counted(without, "vertex that is held is", "vertices that are held are"),
                                         without == 1 ? "stays" : "stay", without == 1 ? "it" : "them"));
    }
    if (of_free > 0) {
      found_.notes.push_back(
          fmt::format("the {} not obeyed, as the mesh follows its boundary; --fixed-ids FILE or --fixed-array NAME has "
                      "vertices go where they are told",
                      counted(of_free, "displacement of a vertex inside is", "displacements of vertices inside are")));
    }
    return std::move(found_);
  }

 private:
  void take(std::size_t v, const Vector& vector, const std::string& array, const std::string& whose) {
    if (!is_finite(vector)) {
      if (obeys_[v] == Obeys::always) {
        throw std::invalid_argument(fmt::format(
            "the point array '{}' of {} has no finite displacement for vertex {}, which is held", array, whose, v));
      }
      return;
    }
    found_.of_vertex[v] = vector;
    found_.is_given[v] = 1;
  }

  const PlanarMesh& mesh_;
  std::span<const Obeys> obeys_;
  Displacements found_;
};

std::vector<std::int32_t> vertices_of(std::span<const NumberedVector> vectors, const MeshDocument& document,
                                      bool are_labels, const std::filesystem::path& path) {
  std::vector<std::int64_t> numbers;
  for (const NumberedVector& vector : vectors) {
    numbers.push_back(vector.vertex);
  }
  if (are_labels) {
    return vertices_of_labels(numbers, document, "'--displacement-labels'", "the text without it");
  }
  const auto count = static_cast<std::int64_t>(document.point_count());
  for (const std::int64_t number : numbers) {
    if (number < 0 || number >= count) {
      throw ReadError(path, fmt::format("names vertex {}, which is none of the {} vertices; they count from 0 in the "
                                        "order of the mesh's file{}",
                                        number, count,
                                        document.first_point_label ? ", unless --displacement-labels is given" : ""));
    }
  }
  return {numbers.begin(), numbers.end()};
}

}  // namespace

Displacements find_displacements(const MeshDocument& document, const PlanarMesh& mesh, const Deformation& deformation,
                                 std::size_t step, std::span<const Obeys> obeys, int threads) {
  Gathered gathered(mesh, obeys);
  if (deformation.steps.empty()) {
    gathered.take_rows(displacement_array(document, deformation.array, "the file"), "the file");
    return std::move(gathered).found("'" + deformation.array + "'");
  }
  const std::filesystem::path& path = deformation.steps.at(step);
  if (is_text(path)) {
    const std::vector<NumberedVector> vectors = read_text(path);
    gathered.take_numbered(vectors, vertices_of(vectors, document, deformation.labels, path), path);
  } else {
    if (deformation.array.empty()) {
      throw std::invalid_argument(path.string() +
                                  ": is no text (.csv, .txt), and of a mesh --displacement NAME is to tell " +
                                  "which point array has the displacements");
    }
    const MeshDocument file = read_mesh(path, FileOptions{threads, {}});
    const DataArray array = displacement_array(file, deformation.array, path.string());
    const PointsOfFile points(file, mesh);
    const auto is_same_point = [&](std::size_t v) { return points.is_at(v, mesh.points[v]); };
    bool has_same_points = file.point_count() == obeys.size();
    for (std::size_t v = 0; has_same_points && v < obeys.size(); ++v) {
      has_same_points = obeys[v] != Obeys::always || is_same_point(v);
    }
    if (has_same_points) {
      gathered.take_rows(array, path.string());
    } else {
      gathered.take_places(array, points, path.string());
    }
  }
  return std::move(gathered).found(path.string());
}

}  // namespace trismooth
