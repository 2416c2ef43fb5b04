// SPDX-License-Identifier: BSD-3-Clause
// Universal files (I-deas): data sets between lines with -1. Read are the nodes (2411, 781), the elements (2412, 780)
// and the groups (2435, 2452, 2467, 2477, and the older 2417, 2429, 2430, 2432) as the reference of the format
// describes their records.
#include "trismooth/mesh_io/unv/unv_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/expected_number.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/unv/unv_elements.h"
#include "trismooth/mesh_io/unv/unv_groups.h"

namespace trismooth {

namespace {

constexpr std::int64_t any_unv_integer = std::numeric_limits<std::int64_t>::max();
/// Of a coordinate: 1P3D25.16.
constexpr std::size_t unv_field_columns = 25;
constexpr std::string_view end_of_data_set = "-1";

class UnvReader {
 public:
  UnvReader(std::string_view bytes, const std::filesystem::path& path)
      : scanner_(bytes, path, TextScanner::Comments::none, begin_of_text(bytes)) {
    sites_.is_in_columns = true;
  }

  std::pair<MeshDocument, NumberSites> read() {
    if (scanner_.peek_token() != end_of_data_set) {
      scanner_.fail_at(scanner_.offset(), "is not a universal file: expected a line with -1, which begins a data set");
    }
    while (!skip_text_between()) {
      scanner_.next_token(end_of_data_set);
      if (!is_end()) {
        scanner_.fail("expected a line with -1, which begins a data set, got " + quoted(token()));
      }
      read_data_set(scanner_.next_token("the number of a data set"));
      require_end();
    }
    if (!has_nodes_) {
      throw_without_nodes();
    }
    resolve();
    add_notes();
    return {std::move(document_), std::move(sites_)};
  }

 private:
  /// Lines of text behind a data set: remarks of the program that wrote it. One that begins with a number may be of a
  /// data set whose -1 is missing, and is not passed over. True at the end of the file.
  bool skip_text_between() {
    // (A file that is cut off may end with a minus.)
    while (!scanner_.at_end() && scanner_.peek_token() != "-" && !parse_fortran_number<double>(scanner_.peek_token())) {
      scanner_.next_line();
      has_text_between_ = true;
    }
    return scanner_.at_end();
  }

  void read_data_set(std::string_view number) {
    begin_ = scanner_.token_offset();
    if (number == "2411" || number == "781") {
      has_nodes_ = true;
      read_records([this] { read_node(); });
    } else if (number == "2412" || number == "780") {
      read_records([this, is_old = number == "780"] { read_element(is_old); });
    } else if (number == "2435" || number == "2452" || number == "2467" || number == "2477") {
      read_records([this] { read_group(false); });
    } else if (number == "2417" || number == "2429" || number == "2430" || number == "2432") {
      read_records([this] { read_group(true); });
    } else if (number == "2420") {
      read_systems();
    } else if (number == "15" || number == "71") {
      scanner_.fail("the " + std::string(number == "15" ? "nodes" : "elements") + " of data set " +
                    std::string(number) + ", which is obsolete, are not read; write them as data set " +
                    (number == "15" ? "2411" : "2412"));
    } else {
      constexpr std::int64_t most = 999'999;  // six columns
      const auto known = parse_integer(number);
      if (!known || *known < 1 || *known > most) {
        scanner_.fail("expected the number of a data set, got " + quoted(number));
      }
      kept_.emplace(number);
      skip_data_set();
    }
  }

  template <class ReadRecord>
  void read_records(const ReadRecord& read_record) {
    scanner_.next_line();
    while (!scanner_.at_end() && !is_end_next()) {
      read_record();
    }
  }

  std::string_view token() const {
    const std::string_view text = scanner_.text().substr(scanner_.token_offset());
    return text.substr(0, std::min(text.find_first_of(" \t\v\f\r\n"), text.size()));
  }

  /// Whether the token that was read last, with nothing else on its line, is -1.
  bool is_end() { return token() == end_of_data_set && scanner_.at_end_of_line(); }

  bool is_end_next() {
    if (scanner_.peek_token() != end_of_data_set) {
      return false;
    }
    const std::size_t offset = scanner_.offset();
    scanner_.next_token(end_of_data_set);
    const bool is = scanner_.at_end_of_line();
    scanner_.seek(offset);
    return is;
  }

  void require_end() {
    if (scanner_.at_end()) {
      scanner_.fail_at(begin_, "is cut off: the data set that begins here has no end, a line with -1");
    }
    scanner_.next_token(end_of_data_set);
  }

  void skip_data_set() {
    scanner_.next_line();
    while (!scanner_.at_end()) {
      const std::size_t offset = scanner_.offset();
      if (trimmed(scanner_.next_line()) == end_of_data_set) {
        scanner_.seek(offset);
        return;
      }
    }
  }

  void read_node() {
    if (node_ids_.size() == std::numeric_limits<std::int32_t>::max()) {
      scanner_.fail("has more nodes than 32-bit indices can tell apart");
    }
    node_ids_.push_back(scanner_.next_integer("the label of a node", 0, any_unv_integer));
    const std::size_t offset = scanner_.token_offset();
    const std::int64_t system = next_in_line("the coordinate system of a node");
    next_in_line("the system of a node's displacements");
    next_in_line("the colour of a node");
    const bool is_another = systems_.empty() || systems_.back().first != system;
    if (is_another && known_systems_.insert(system).second) {
      systems_.emplace_back(system, offset);
    }
    end_line();
    for (const char* const what : {"x of a node", "y of a node", "z of a node"}) {
      read_coordinate(what);
    }
    end_line();
  }

  /// Right in its columns: the field begins behind the number before, or 25 columns before its end.
  void read_coordinate(const char* what) {
    const std::size_t behind_last = scanner_.offset();
    require_more(what);
    const std::string_view text = scanner_.next_token(what);
    document_.points.push_back(
        finite_number(text, what, [this](const std::string& message) { scanner_.fail(message); }));
    const std::size_t begin = scanner_.token_offset();
    const std::string_view before = scanner_.text().substr(behind_last, begin - behind_last);
    const std::size_t blanks = before.size() - (before.find_last_not_of(" \t") + 1);
    const std::size_t most = unv_field_columns - std::min(text.size(), unv_field_columns);
    sites_.offsets.push_back(begin - std::min(blanks, most));
  }

  /// The next number of this line.
  std::int64_t next_in_line(const char* what, std::int64_t lowest = -any_unv_integer) {
    require_more(what);
    return scanner_.next_integer(what, lowest, any_unv_integer);
  }

  void require_more(const char* what) {
    if (scanner_.at_end_of_line()) {
      scanner_.fail_at(scanner_.offset(), "expected " + std::string(what) + ", got the end of the line");
    }
  }

  void end_line() {
    if (!scanner_.at_end_of_line()) {
      scanner_.fail("expected the end of the line, got " + quoted(scanner_.next_token("the end of the line")));
    }
    scanner_.next_line();
  }

  void read_element(bool is_old) {
    if (element_ids_.size() == std::numeric_limits<std::int32_t>::max()) {
      scanner_.fail("has more elements than 32-bit indices can tell apart");
    }
    element_ids_.push_back(scanner_.next_integer("the label of an element", 0, any_unv_integer));
    element_offsets_.push_back(scanner_.token_offset());
    const std::int64_t descriptor = next_in_line("the descriptor of an element");
    // Of the old data set there are two numbers for a property, and for a material.
    if (is_old) {
      next_in_line("the physical property of an element");
    }
    properties_.push_back(next_in_line("the physical property of an element"));
    if (is_old) {
      next_in_line("the material of an element");
    }
    next_in_line("the material of an element");
    next_in_line("the colour of an element");
    const std::int64_t nodes = next_in_line("the number of nodes of an element", 1);
    require_room(scanner_.path(), "nodes of an element", static_cast<std::uint64_t>(nodes), 2,
                 scanner_.text().size() - scanner_.offset() + 1);
    end_line();
    if (is_unv_beam(descriptor)) {
      for (const char* const what : {"the orientation of a beam", "an end of a beam", "an end of a beam"}) {
        next_in_line(what);
      }
      end_line();
    }
    read_nodes_of_element(unv_shape(descriptor, nodes), static_cast<std::size_t>(nodes));
    if (document_.cells.types.back() == cell_type::poly_vertex) {
      unknown_.emplace(descriptor, nodes);
    }
  }

  void read_nodes_of_element(const UnvShape& shape, std::size_t nodes) {
    const std::size_t first = references_.size();
    for (std::size_t i = 0; i < nodes; ++i) {
      constexpr std::size_t most_in_line = 8;
      if (i > 0 && i % most_in_line == 0) {
        end_line();
      }
      references_.push_back(next_in_line("a node of an element", 0));
    }
    end_line();
    if (shape.nodes > 0) {
      std::array<std::int64_t, most_unv_nodes> listed{};
      std::copy_n(references_.begin() + static_cast<std::ptrdiff_t>(first), nodes, listed.begin());
      for (std::size_t i = 0; i < nodes; ++i) {
        references_[first + i] = listed.at(shape.place(i));
      }
    }
    document_.cells.types.push_back(shape.nodes > 0 ? shape.type : cell_type::poly_vertex);
    document_.cells.offsets.push_back(static_cast<std::int64_t>(references_.size()));
  }

  /// Members of old groups are a kind and a number, others have two numbers more.
  void read_group(bool is_old) {
    UnvGroup& group = groups_.emplace_back();
    group.number = scanner_.next_integer("the number of a group", 0, any_unv_integer);
    constexpr std::size_t other_numbers = 6;  // of sets of constraints, loads and so on
    for (std::size_t i = 0; i < other_numbers; ++i) {
      next_in_line("a number of a group");
    }
    const std::int64_t members = next_in_line("the number of members of a group", 0);
    require_room(scanner_.path(), "members of a group", static_cast<std::uint64_t>(members), is_old ? 4 : 8,
                 scanner_.text().size() - scanner_.offset() + 1);
    end_line();
    group.name = std::string(trimmed(scanner_.next_line()));
    for (std::int64_t i = 0; i < members; ++i) {
      // Two to a line, or four; some programs write one.
      if (i > 0 && scanner_.at_end_of_line()) {
        end_line();
      }
      const std::int64_t kind = next_in_line("the kind of a member of a group");
      const std::int64_t id = next_in_line("a member of a group");
      for (int k = 0; k < 2 && !is_old; ++k) {
        next_in_line("a number of a member of a group");
      }
      constexpr std::int64_t node = 7;
      constexpr std::int64_t element = 8;
      if (kind == node || kind == element) {
        (kind == node ? group.nodes : group.elements).push_back(id);
      } else {
        has_other_members_ = true;
      }
    }
    if (members > 0) {
      end_line();
    }
  }

  /// The systems that a part states: which of them are round.
  void read_systems() {
    scanner_.next_line();
    scanner_.next_line();  // the number of the part
    scanner_.next_line();  // its name
    while (!scanner_.at_end() && !is_end_next()) {
      const std::int64_t system =
          scanner_.next_integer("the label of a coordinate system", -any_unv_integer, any_unv_integer);
      const std::int64_t kind = next_in_line("the kind of a coordinate system");
      constexpr std::int64_t cartesian = 0;
      if (kind != cartesian) {
        round_systems_.insert(system);
      }
      scanner_.next_line();
      scanner_.next_line();  // its name
      constexpr int rows_of_matrix = 4;
      for (int row = 0; row < rows_of_matrix && !is_end_next(); ++row) {
        scanner_.next_line();
      }
    }
    states_systems_ = true;
  }

  [[noreturn]] void throw_without_nodes() const {
    scanner_.fail_at(0, "is not a mesh: it has no nodes (data set 2411)");
  }

  void resolve() {
    for (const auto& [system, offset] : systems_) {
      if (round_systems_.contains(system)) {
        scanner_.fail_at(offset, "the node's coordinates are in the system " + std::to_string(system) +
                                     ", which is cylindrical or spherical; write them in a rectangular one");
      }
      if (states_systems_ && systems_.size() > 1) {
        scanner_.fail_at(systems_[1].second, "this node's coordinates are in the system " +
                                                 std::to_string(systems_[1].first) + ", those before it in " +
                                                 std::to_string(systems_[0].first) + ": write all in one");
      }
    }
    const PointIds nodes(node_ids_);
    if (const auto repeated = nodes.first_repeated()) {
      scanner_.fail_at(sites_.offsets[3 * *repeated],
                       "node " + std::to_string(node_ids_[*repeated]) + " stands in the file twice");
    }
    set_point_labels(document_, node_ids_);
    const PointIds elements(element_ids_);
    if (const auto repeated = elements.first_repeated()) {
      scanner_.fail_at(element_offsets_[*repeated],
                       "element " + std::to_string(element_ids_[*repeated]) + " stands in the file twice");
    }
    CellList& cells = document_.cells;
    cells.connectivity.reserve(references_.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      for (auto i = cells.offsets[cell]; i < cells.offsets[cell + 1]; ++i) {
        const std::int64_t id = references_[static_cast<std::size_t>(i)];
        const auto point = nodes.find(id);
        if (!point) {
          scanner_.fail_at(element_offsets_[cell],
                           "the element names node " + std::to_string(id) + ", which is none of the file");
        }
        cells.connectivity.push_back(*point);
      }
    }
    add_unv_groups(std::move(groups_), nodes, elements, document_);
    if (std::ranges::any_of(properties_, [](std::int64_t property) { return property != 0; })) {
      document_.cell_arrays.push_back(make_data_array("unv:pid", 1, std::move(properties_)));
    }
  }

  void add_notes() {
    if (!unknown_.empty()) {
      std::string names;
      for (const auto& [descriptor, nodes] : unknown_) {
        if (names.size() > 200) {
          names += ", ...";
          break;
        }
        add_to_list(names, std::to_string(descriptor) + " with " + counted(nodes, "node", "nodes"));
      }
      document_.notes.push_back("Elements of descriptors that are not known hold their nodes: " + names + ".");
    }
    if (!kept_.empty()) {
      std::string names;
      for (const std::string& number : kept_) {
        if (names.size() > 100) {
          names += ", ...";
          break;
        }
        add_to_list(names, number);
      }
      document_.notes.push_back("What the data sets " + names + " say is kept in UNV output only.");
    }
    if (has_text_between_) {
      document_.notes.emplace_back("Text between the data sets is kept in UNV output only.");
    }
    if (has_other_members_) {
      document_.notes.emplace_back(
          "Members of groups that are neither nodes nor elements are kept in UNV output only.");
    }
  }

  TextScanner scanner_;
  MeshDocument document_;
  NumberSites sites_;
  std::size_t begin_ = 0;  ///< of the data set that is read
  bool has_nodes_ = false;
  std::vector<std::int64_t> node_ids_;
  std::vector<std::pair<std::int64_t, std::size_t>> systems_;  ///< of nodes, each with where it comes first
  std::set<std::int64_t> known_systems_;
  std::set<std::int64_t> round_systems_;
  bool states_systems_ = false;
  std::vector<std::int64_t> element_ids_;
  std::vector<std::size_t> element_offsets_;
  std::vector<std::int64_t> properties_;
  std::vector<std::int64_t> references_;                     ///< the labels of the vertices of all cells
  std::set<std::pair<std::int64_t, std::int64_t>> unknown_;  ///< descriptors and numbers of nodes
  std::vector<UnvGroup> groups_;
  bool has_other_members_ = false;
  bool has_text_between_ = false;
  std::set<std::string, std::less<>> kept_;  ///< numbers of data sets
};

}  // namespace

MeshDocument read_unv(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& /*workers*/) {
  auto [document, sites] = UnvReader(bytes, path).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
