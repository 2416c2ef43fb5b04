// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/adcirc/adcirc_reader.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/adcirc/adcirc_boundary.h"
#include "trismooth/mesh_io/adcirc/list_directed_lines.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::int64_t lowest_id = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t highest_id = std::numeric_limits<std::int64_t>::max();

class AdcircReader {
 public:
  AdcircReader(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
      : scanner_(bytes, path), lines_(scanner_), workers_(workers), plain_rows_(bytes, workers) {
    sites_.columns = {{.component = 0}, {.component = 1}, {.array = "depth"}};
  }

  std::pair<MeshDocument, NumberSites> read() {
    scanner_.next_line();  // the title
    read_counts();
    read_nodes();
    read_elements();
    read_boundaries();
    document_.arrays_of_places.emplace_back("depth");
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void read_counts() {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    lines_.next_line("the numbers of elements and nodes");
    element_count_ = static_cast<std::size_t>(lines_.next_integer("the number of elements", 0, most));
    node_count_ = static_cast<std::size_t>(lines_.next_integer("the number of nodes", 0, most));
    // "1 0 0 0" and "1 3 1 2 3", each with a line end, which the last line may lack.
    constexpr std::size_t node_bytes = 8;
    constexpr std::size_t element_bytes = 10;
    require_room(scanner_.path(), "nodes", node_count_, node_bytes, bytes_left() + 1);
    require_room(scanner_.path(), "elements", element_count_, element_bytes,
                 bytes_left() + 1 - node_count_ * node_bytes);
  }

  void read_nodes() {
    std::vector<std::int64_t> ids;
    std::vector<double> depths;
    shared_resize(document_.points, 3 * node_count_, sites_.offsets, 3 * node_count_, workers_.workers);
    shared_resize(ids, node_count_, depths, node_count_, workers_.workers);
    if (!read_plain_nodes(ids, depths)) {
      for (std::size_t node = 0; node < node_count_; ++node) {
        lines_.next_line("node " + std::to_string(node + 1) + " of " + std::to_string(node_count_));
        ids[node] = lines_.next_integer("the number of a node", lowest_id, highest_id);
        document_.points[3 * node] = next_site("x", 3 * node);
        document_.points[3 * node + 1] = next_site("y", 3 * node + 1);
        document_.points[3 * node + 2] = 0;
        depths[node] = lines_.next_number_or_none("the depth");
        sites_.offsets[3 * node + 2] = lines_.value_offset();
      }
    }
    ids_.emplace(ids);
    if (const auto repeated = ids_->first_repeated()) {
      scanner_.fail_at(sites_.offsets[3 * *repeated],
                       "node " + std::to_string(ids[*repeated]) + " stands in the file twice");
    }
    document_.point_arrays.push_back(make_data_array("depth", 1, std::move(depths)));
    set_point_labels(document_, std::move(ids));
  }

  double next_site(std::string_view what, std::size_t site) {
    const double value = lines_.next_number(what);
    sites_.offsets[site] = lines_.value_offset();
    return value;
  }

  bool read_plain_nodes(std::vector<std::int64_t>& ids, std::vector<double>& depths) {
    constexpr std::size_t node_numbers = 4;
    if (node_count_ == 0) {
      return true;
    }
    const auto end = plain_rows_.read(scanner_.offset(), node_count_, node_numbers,
                                      [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                                        bool plain = true;
                                        for (std::size_t node = first; node < last && plain; ++node) {
                                          std::array<double, 3> values{};
                                          plain = numbers.next(ids[node]);
                                          for (std::size_t i = 0; i < 3; ++i) {
                                            plain = plain && !numbers.at_end_of_line() && numbers.next(values[i]) &&
                                                    (std::isfinite(values[i]) || (i == 2 && std::isnan(values[i])));
                                            sites_.offsets[3 * node + i] = numbers.token_offset();
                                          }
                                          document_.points[3 * node] = values[0];
                                          document_.points[3 * node + 1] = values[1];
                                          document_.points[3 * node + 2] = 0;
                                          depths[node] = values[2];
                                          plain = plain && numbers.at_end_of_line();
                                        }
                                        return plain;
                                      });
    if (end) {
      scanner_.resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  void read_elements() {
    if (read_plain_elements()) {
      return;
    }
    CellList& cells = document_.cells;
    cells = {};
    cells.offsets.reserve(element_count_ + 1);
    cells.types.reserve(element_count_);
    cells.connectivity.reserve(3 * element_count_);
    for (std::size_t element = 0; element < element_count_; ++element) {
      const std::string what = "element " + std::to_string(element + 1) + " of " + std::to_string(element_count_);
      lines_.next_line(what);
      lines_.next_integer("the number of an element", lowest_id, highest_id);
      const auto corners =
          static_cast<std::size_t>(lines_.next_integer("the number of the nodes of " + what, 3, most_corners));
      std::array<std::int32_t, most_corners> vertices{};
      for (std::size_t corner = 0; corner < corners; ++corner) {
        vertices.at(corner) = next_node(what);
      }
      cells.append(cell_type::of_face(corners), std::span(vertices).first(corners));
    }
  }

  bool read_plain_elements() {
    constexpr std::size_t element_numbers = 5;
    if (element_count_ == 0) {
      return true;
    }
    if (workers_.part_bytes == FileWorkers::serial) {
      return false;
    }
    CellList& cells = document_.cells;
    shared_resize(cells.connectivity, 3 * element_count_, cells.offsets, element_count_ + 1, workers_.workers);
    shared_resize(cells.types, element_count_, workers_.workers);
    const auto end = plain_rows_.read(scanner_.offset(), element_count_, element_numbers,
                                      [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                                        bool plain = true;
                                        for (std::size_t element = first; element < last && plain; ++element) {
                                          plain = read_plain_triangle(numbers, element);
                                        }
                                        return plain;
                                      });
    if (end) {
      scanner_.resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  bool read_plain_triangle(PlainNumbers& numbers, std::size_t element) {
    CellList& cells = document_.cells;
    std::int64_t number = 0;
    std::int64_t corners = 0;
    bool plain = numbers.next(number) && !numbers.at_end_of_line() && numbers.next(corners) && corners == 3;
    for (std::size_t i = 3 * element; i < 3 * element + 3 && plain; ++i) {
      std::int64_t id = 0;
      plain = !numbers.at_end_of_line() && numbers.next(id);
      const auto vertex = plain ? ids_->find(id) : std::nullopt;
      plain = vertex.has_value();
      cells.connectivity[i] = vertex.value_or(0);
    }
    cells.offsets[element + 1] = static_cast<std::int64_t>(3 * element + 3);
    cells.types[element] = cell_type::triangle;
    return plain && numbers.at_end_of_line();
  }

  /// The node that is named next on the line.
  std::int32_t next_node(const std::string& where) {
    const std::int64_t id = lines_.next_integer("a node of " + where, lowest_id, highest_id);
    const auto point = ids_->find(id);
    if (!point) {
      lines_.fail(where + " names node " + std::to_string(id) + ", which is none of the file");
    }
    return *point;
  }

  void read_boundaries() {
    lines_.end_line();
    const auto open_count = next_boundary_count("open boundaries");
    for (std::size_t i = 1; i <= open_count.value_or(0); ++i) {
      read_boundary({.is_open = true, .number = i});
    }
    const auto land_count = open_count ? next_boundary_count("land boundaries") : std::nullopt;
    for (std::size_t i = 1; i <= land_count.value_or(0); ++i) {
      read_boundary({.is_open = false, .number = i});
    }
    lines_.end_line();
    if (land_count && !scanner_.at_end()) {
      document_.notes.emplace_back(
          "The file goes on after its boundaries; what stands there is kept in ADCIRC output only.");
    }
    if (has_weirs_) {
      document_.notes.emplace_back("Heights and coefficients of weirs are kept in ADCIRC output only.");
    }
  }

  /// Nothing where the file ends.
  std::optional<std::size_t> next_boundary_count(const std::string& what) {
    if (scanner_.at_end()) {
      return std::nullopt;
    }
    lines_.next_line("the number of " + what);
    const std::int64_t count = lines_.next_integer("the number of " + what, 0, highest_id);
    const std::size_t count_offset = lines_.value_offset();
    refuse_further_element();
    require_lines(count_offset, "the number of " + what, count);
    lines_.next_line("the number of all nodes of " + what);
    lines_.next_integer("the number of all nodes of " + what, 0, highest_id);
    return static_cast<std::size_t>(count);
  }

  /// A line like one of an element in the place of a count, which stands alone on its line.
  void refuse_further_element() const {
    ListDirectedLines rest = lines_;
    const auto corners = rest.next_integer_if_any();
    std::size_t nodes = 0;
    while (nodes < most_corners && rest.next_integer_if_any()) {
      ++nodes;
    }
    if (corners && *corners >= 3 && nodes >= static_cast<std::uint64_t>(*corners)) {
      lines_.fail("expected the end of the elements after the declared " + std::to_string(element_count_) +
                  ", got another one");
    }
  }

  void read_boundary(AdcircBoundary boundary) {
    const std::string kind = (boundary.is_open ? "open boundary " : "land boundary ") + std::to_string(boundary.number);
    const std::string what = "the number of nodes of " + kind;
    lines_.next_line(what);
    const std::int64_t count = lines_.next_integer(what, 0, highest_id);
    require_lines(lines_.value_offset(), what, count);
    boundary.type = boundary.is_open ? lines_.next_integer_if_any().value_or(0)
                                     : lines_.next_integer("the type of " + kind, lowest_id, highest_id);
    NamedSet set{name_of(boundary), {}};
    const bool has_pairs = !boundary.is_open && has_adcirc_pairs(boundary.type);
    const bool is_weir = !boundary.is_open && is_adcirc_weir(boundary.type);
    has_weirs_ = has_weirs_ || is_weir;
    for (std::int64_t i = 0; i < count; ++i) {
      lines_.next_line("node " + std::to_string(i + 1) + " of " + std::to_string(count) + " of " + kind);
      set.members.push_back(next_node(kind));
      if (has_pairs) {
        set.members.push_back(next_node(kind));
      } else if (is_weir) {
        lines_.next_number("the height of a weir");
        lines_.next_number("the coefficient of a weir");
      }
    }
    document_.point_sets.push_back(std::move(set));
  }

  /// That many lines follow at least.
  void require_lines(std::size_t offset, const std::string& what, std::int64_t count) const {
    const std::size_t room = (bytes_left() + 1) / 2;
    if (static_cast<std::uint64_t>(count) > room) {
      scanner_.fail_at(offset, "expected " + what + ", got " + std::to_string(count) + "; the file has room for " +
                                   std::to_string(room) + " at most");
    }
  }

  std::size_t bytes_left() const { return scanner_.text().size() - scanner_.offset(); }

  static constexpr std::size_t most_corners = 4;

  TextScanner scanner_;
  ListDirectedLines lines_;
  FileWorkers workers_;
  PlainRows plain_rows_;
  MeshDocument document_;
  NumberSites sites_;
  std::optional<PointIds> ids_;
  std::size_t node_count_ = 0;
  std::size_t element_count_ = 0;
  bool has_weirs_ = false;
};

}  // namespace

MeshDocument read_adcirc(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  auto [document, sites] = AdcircReader(bytes, path, workers).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
