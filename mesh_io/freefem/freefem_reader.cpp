// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/freefem/freefem_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/cells/uniform_cells.h"
#include "trismooth/mesh_io/document/integer_array.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/careful_numbers.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Cells of one kind, as the file lists them.
struct FreeFemCells {
  std::string_view name;  ///< of one, for messages
  std::uint8_t type;
  std::size_t vertices;
};
constexpr FreeFemCells freefem_triangles{"triangle", cell_type::triangle, 3};
constexpr FreeFemCells freefem_edges{"edge", cell_type::line, 2};
constexpr std::size_t freefem_vertex_numbers = 3;  // x, y and the label

class FreeFemReader {
 public:
  FreeFemReader(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::none, begin_of_text(bytes)),
        workers_(workers),
        plain_rows_(bytes, workers) {
    sites_.columns.resize(2);
  }

  std::pair<MeshDocument, NumberSites> read() {
    read_counts();
    read_vertices();
    read_cells(freefem_triangles, triangle_count_);
    read_cells(freefem_edges, edge_count_);
    if (!scanner_.at_end()) {
      const std::string_view token = scanner_.next_token("the end of the file");
      scanner_.fail("expected the end of the file after the declared " + std::to_string(vertex_count_) + " vertices, " +
                    std::to_string(triangle_count_) + " triangles and " + std::to_string(edge_count_) + " edges, got " +
                    quoted(token));
    }
    add_labels(document_.point_arrays, std::move(vertex_labels_));
    add_labels(document_.cell_arrays, std::move(cell_labels_));
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void read_counts() {
    const auto next_count = [this](std::string_view what) {
      constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
      return static_cast<std::size_t>(scanner_.next_integer(what, 0, most));
    };
    vertex_count_ = next_count("the number of vertices");
    triangle_count_ = next_count("the number of triangles");
    edge_count_ = next_count("the number of edges");
    // Every number takes a digit and a separator, except for the separator at the end of the file.
    std::size_t left = scanner_.text().size() - scanner_.offset() + 1;
    const auto require = [&](std::string_view what, std::size_t count, std::size_t numbers_each) {
      require_room(scanner_.path(), what, count, 2 * numbers_each, left);
      left -= 2 * numbers_each * count;
    };
    require("vertices", vertex_count_, freefem_vertex_numbers);
    require("triangles", triangle_count_, freefem_triangles.vertices + 1);
    require("edges", edge_count_, freefem_edges.vertices + 1);
  }

  void read_vertices() {
    shared_resize(document_.points, 3 * vertex_count_, sites_.offsets, 2 * vertex_count_, workers_.workers);
    shared_resize(vertex_labels_, vertex_count_, workers_.workers);
    read_rows(plain_rows_, scanner_, vertex_count_, freefem_vertex_numbers, {}, [&](auto& numbers, std::size_t vertex) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!numbers.next_real(document_.points[3 * vertex + axis], "a coordinate")) {
          return false;
        }
        sites_.offsets[2 * vertex + axis] = numbers.token_offset();
      }
      return numbers.next_whole(vertex_labels_[vertex], "a label");
    });
  }

  void read_cells(const FreeFemCells& kind, std::size_t count) {
    CellList& cells = document_.cells;
    const std::size_t first_cell = append_uniform_cells(cells, kind.type, kind.vertices, count, workers_);
    shared_resize(cell_labels_, first_cell + count, workers_.workers);
    const auto corners = std::span(cells.connectivity).last(kind.vertices * count);
    const auto labels = std::span(cell_labels_).last(count);
    const auto vertices = static_cast<std::int64_t>(vertex_count_);
    read_rows(plain_rows_, scanner_, count, kind.vertices + 1, {}, [&](auto& numbers, std::size_t cell) {
      const auto wrong_corner = [&](std::string_view token) {
        return std::string(kind.name) + " " + std::to_string(cell + 1) + " of " + std::to_string(count) +
               ": expected a vertex number, got " + quoted(token) + "; the file has " + std::to_string(vertices) +
               " vertices, counted from 1";
      };
      for (std::int32_t& corner : corners.subspan(cell * kind.vertices, kind.vertices)) {
        if (!numbers.next_index(corner, "a vertex number", 1, vertices, wrong_corner)) {
          return false;
        }
        --corner;
      }
      return numbers.next_whole(labels[cell], "a label");
    });
  }

  /// 0 is what all have where a file tells nothing apart.
  static void add_labels(std::vector<DataArray>& arrays, std::vector<std::int64_t> labels) {
    if (std::ranges::any_of(labels, [](std::int64_t label) { return label != 0; })) {
      arrays.push_back(make_integer_array("freefem:label", std::move(labels)));
    }
  }

  TextScanner scanner_;
  FileWorkers workers_;
  PlainRows plain_rows_;
  MeshDocument document_;
  NumberSites sites_;
  std::vector<std::int64_t> vertex_labels_;
  std::vector<std::int64_t> cell_labels_;
  std::size_t vertex_count_ = 0;
  std::size_t triangle_count_ = 0;
  std::size_t edge_count_ = 0;
};

/// The numbers of the next line, which has as many whole ones as `columns`, behind `reals` of any kind.
template <std::size_t columns>
std::optional<std::array<std::int64_t, columns>> next_freefem_line(TextScanner& scanner, std::size_t reals = 0) {
  for (std::size_t i = 0; i < reals; ++i) {
    if (scanner.at_end_of_line() || !parse_number<double>(scanner.next_token("a number"))) {
      return std::nullopt;
    }
  }
  std::array<std::int64_t, columns> numbers{};
  for (std::int64_t& number : numbers) {
    const auto whole = scanner.at_end_of_line() ? std::nullopt : parse_integer(scanner.next_token("a number"));
    if (!whole) {
      return std::nullopt;
    }
    number = *whole;
  }
  const bool ends = scanner.at_end_of_line();
  scanner.at_end();
  return ends ? std::optional(numbers) : std::nullopt;
}

constexpr std::size_t enough = std::size_t{1} << 14;  // of a file's beginning or end to tell what it is

/// Whether the last rows of a file without edges are triangles, whose first number is a vertex, and not faces of OFF,
/// whose first number is that of their corners.
bool ends_in_freefem_triangles(std::string_view bytes, std::int64_t vertices, std::int64_t triangles) {
  constexpr std::string_view white_space = " \t\v\f\r\n\x1a";
  constexpr std::int64_t corners = 3;
  bool has_vertex_first = false;
  std::string_view rest = trimmed(bytes.substr(bytes.size() - std::min(bytes.size(), enough)), white_space);
  for (std::int64_t row = 0; row < triangles; ++row) {
    const std::size_t end = rest.find_last_of("\r\n");
    if (end == std::string_view::npos) {
      break;  // that row may be cut
    }
    TextScanner scanner(rest.substr(end + 1), {});
    const auto numbers = next_freefem_line<4>(scanner);
    if (!numbers || !std::ranges::all_of(std::span(*numbers).first(3), [vertices](std::int64_t number) {
          return 1 <= number && number <= vertices;
        })) {
      return false;
    }
    has_vertex_first = has_vertex_first || numbers->front() != corners;
    rest = trimmed(rest.substr(0, end), white_space);
  }
  return has_vertex_first;
}

}  // namespace

bool begins_as_freefem(std::string_view bytes) {
  const bool is_whole = bytes.size() <= enough;
  // No line that is cut.
  const std::string_view head = is_whole ? bytes : bytes.substr(0, bytes.find_last_of("\r\n", enough) + 1);
  TextScanner scanner(head, {}, TextScanner::Comments::none, begin_of_text(head));
  if (scanner.at_end()) {
    return false;
  }
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const auto counts = next_freefem_line<3>(scanner);
  if (!counts || std::ranges::any_of(*counts, [](std::int64_t count) { return count < 0 || count > most; }) ||
      (*counts)[1] == 0) {
    return false;
  }
  const auto [vertices, triangles, edges] = *counts;
  const auto is_vertex = [vertex_count = vertices](std::int64_t number) {
    return 1 <= number && number <= vertex_count;
  };
  std::int64_t rows = 0;
  for (; rows < vertices && !scanner.at_end(); ++rows) {
    if (!next_freefem_line<1>(scanner, 2)) {
      return false;
    }
  }
  for (; rows < vertices + triangles && !scanner.at_end(); ++rows) {
    const auto row = next_freefem_line<4>(scanner);
    if (!row || !std::ranges::all_of(std::span(*row).first(3), is_vertex)) {
      return false;
    }
  }
  for (; rows < vertices + triangles + edges && !scanner.at_end(); ++rows) {
    const auto row = next_freefem_line<3>(scanner);
    if (!row || !std::ranges::all_of(std::span(*row).first(2), is_vertex)) {
      return false;
    }
  }
  // The beginning of a long OFF file without a keyword looks alike, but for its edges, which it leaves at 0.
  const bool is_all = rows == vertices + triangles && is_whole && scanner.at_end();
  return rows > 0 && (edges > 0 || is_all || (!is_whole && ends_in_freefem_triangles(bytes, vertices, triangles)));
}

MeshDocument read_freefem(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  auto [document, sites] = FreeFemReader(bytes, path, workers).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
