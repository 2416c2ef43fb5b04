// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/su2/su2_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/su2/su2_elements.h"
#include "trismooth/mesh_io/su2/su2_keyword_line.h"
#include "trismooth/mesh_io/su2/su2_rows.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::int64_t most_of_anything = std::numeric_limits<std::int32_t>::max();

/// Markers of all zones: a number for every name, from 1 in the file's order.
class MarkerNames {
 public:
  std::int32_t number_of(std::string_view name) {
    return numbers_.try_emplace(std::string(name), static_cast<std::int32_t>(numbers_.size()) + 1).first->second;
  }

  /// That cells of that dimension have that marker.
  void add_cells(std::int32_t number, int dimension) {
    dimensions_[number].at(static_cast<std::size_t>(dimension)) = true;
  }

  /// A name for every dimension of a marker's cells; one without cells has boundary's of that dimension.
  std::vector<ValueName> value_names(int boundary_dimension) const {
    std::vector<ValueName> names;
    for (const auto& [name, number] : numbers_) {
      const auto found = dimensions_.find(number);
      for (int dimension = 0; dimension < 3; ++dimension) {
        const bool has_cells = found != dimensions_.end() && found->second.at(static_cast<std::size_t>(dimension));
        if (has_cells || (found == dimensions_.end() && dimension == boundary_dimension)) {
          names.push_back({number, dimension, name});
        }
      }
    }
    std::ranges::sort(names, {}, [](const ValueName& name) { return std::pair(name.value, name.dimension); });
    return names;
  }

  bool empty() const { return numbers_.empty(); }

 private:
  std::map<std::string, std::int32_t, std::less<>> numbers_;
  std::map<std::int32_t, std::array<bool, 3>> dimensions_;
};

/// What is known of the zone that is being read.
struct ReadZone {
  std::int32_t number = 0;  ///< that IZONE states; 0: a file without zones
  std::int32_t first_point = 0;
  std::optional<std::int64_t> points;   ///< that NPOIN declares, which may stand further on
  std::optional<std::int64_t> markers;  ///< that NMARK declares
  std::int64_t markers_found = 0;
  bool is_begun = false;
  bool has_dimension = false;
  bool has_points = false;
  bool has_elements = false;
};

class Su2Reader {
 public:
  Su2Reader(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::percent, begin_of_text(bytes)),
        workers_(workers),
        rows_(scanner_, workers) {}

  std::pair<MeshDocument, NumberSites> read() {
    while (!scanner_.at_end()) {
      const std::string_view line = scanner_.next_line();
      if (const auto found = parse_su2_keyword_line(line)) {
        read_section(*found);
      } else {
        require_no_row(line);
      }
    }
    finish_zone();
    if (declared_zones_ && *declared_zones_ != zones_found_) {
      fail_file("NZONE= declares " + std::to_string(*declared_zones_) + " zones, the file has " +
                std::to_string(zones_found_));
    }
    add_cell_arrays();
    add_note();
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void read_section(const Su2KeywordLine& line) {
    const auto is = [&line](std::string_view keyword) { return line.keyword == keyword; };
    behind_rows_ = {};
    if (is("NZONE")) {
      require_once(declared_zones_.has_value(), line);
      declared_zones_ = count_of(line, "the number of zones", 1);
    } else if (is("IZONE")) {
      begin_numbered_zone(line);
    } else if (is("NDIME") && !zone_.is_begun && zones_follow()) {
      require_once(dimension_of_zones_.has_value(), line);
      dimension_of_zones_ = dimension_of(line);
    } else if (is("NDIME") || is("NPOIN") || is("NELEM") || is("NMARK") || is("MARKER_TAG") || is("MARKER_ELEMS")) {
      if (!zone_.is_begun) {
        begin_zone(scanner_.token_offset());
      }
      read_section_of_zone(line);
    } else if (!is("SEND_RECV") && !is("SEND_TO")) {
      note_section(line.keyword);
    }
  }

  /// Whether the next line with a keyword says that zones are to come: what stands before it is said of all of them.
  bool zones_follow() const {
    TextScanner ahead = scanner_;
    while (!ahead.at_end()) {
      if (const auto line = parse_su2_keyword_line(ahead.next_line())) {
        return line->keyword == "NZONE" || line->keyword == "IZONE";
      }
    }
    return false;
  }

  std::int64_t dimension_of(const Su2KeywordLine& line) const { return integer_of(line, "the dimension", 2, 3); }

  void read_section_of_zone(const Su2KeywordLine& line) {
    if (line.keyword == "NDIME") {
      require_once(std::exchange(zone_.has_dimension, true), line);
    } else if (line.keyword == "NPOIN") {
      require_once(std::exchange(zone_.has_points, true), line);
      read_points();
    } else if (line.keyword == "NELEM") {
      require_once(std::exchange(zone_.has_elements, true), line);
      const auto count = static_cast<std::size_t>(count_of(line, "the number of elements", 0));
      read_cells(Su2Section::elements, count);
      markers_.resize(document_.cells.size(), 0);
      behind_rows_ = "elements";
    } else if (line.keyword == "NMARK") {
      require_once(zone_.markers.has_value(), line);
      zone_.markers = count_of(line, "the number of markers", 0);
    } else if (line.keyword == "MARKER_TAG") {
      if (line.value.empty()) {
        scanner_.fail("expected the marker's name behind MARKER_TAG=");
      }
      require_marker_read();
      marker_ = line.value;
    } else if (line.keyword == "MARKER_ELEMS") {
      read_marker(line);
    }
  }

  void begin_numbered_zone(const Su2KeywordLine& line) {
    if (zone_.is_begun && zone_.number == 0) {
      scanner_.fail("IZONE= stands behind sections of a mesh that are in no zone");
    }
    finish_zone();
    const auto number = static_cast<std::int32_t>(count_of(line, "the number of the zone", 1));
    if (declared_zones_ && number > *declared_zones_) {
      scanner_.fail("zone " + std::to_string(number) + " is none of the " + std::to_string(*declared_zones_) +
                    " that NZONE= declares");
    }
    if (!zone_numbers_.insert(number).second) {
      scanner_.fail("zone " + std::to_string(number) + " stands in the file twice");
    }
    zone_.number = number;
    begin_zone(scanner_.offset());
  }

  /// Elements may stand before the points: how many there will be, and of which dimension, is looked up from `offset`
  /// on. Each zone is looked through once at most.
  void begin_zone(std::size_t offset) {
    zone_.is_begun = true;
    zone_.first_point = static_cast<std::int32_t>(document_.point_count());
    ++zones_found_;
    std::optional<std::int64_t> dimension;
    const std::string_view text = without_end_mark(scanner_.text());
    while (offset < text.size() && !(dimension && zone_.points)) {
      const std::size_t end = find_line_end(text, offset);
      const std::size_t begin = text.find_first_not_of(blanks, offset);
      if (begin < end && (text[begin] == 'N' || text[begin] == 'I')) {
        const auto line = parse_su2_keyword_line(text.substr(begin, end - begin));
        if (line && line->keyword == "IZONE") {
          break;
        }
        if (line && line->keyword == "NDIME" && !dimension) {
          dimension = dimension_of(*line);
        } else if (line && line->keyword == "NPOIN" && !zone_.points) {
          zone_.points = point_count_of(*line);
        }
      }
      offset = end + 1;
    }
    dimension = dimension ? dimension : dimension_of_zones_;
    if (!dimension || !zone_.points) {
      scanner_.fail(name_of_zone() + " has no " + (dimension ? "NPOIN=" : "NDIME=") +
                    ": it is cut off, or no SU2 mesh");
    }
    if (dimension_ != 0 && dimension_ != *dimension) {
      scanner_.fail(name_of_zone() + " has another dimension (NDIME=) than the zones before it");
    }
    dimension_ = static_cast<int>(*dimension);
    sites_.columns.resize(static_cast<std::size_t>(dimension_));
  }

  /// Behind the number of all points that of the points without halo may stand.
  std::int64_t point_count_of(const Su2KeywordLine& line) const {
    const std::size_t blank = std::min(line.value.find_first_of(blanks), line.value.size());
    const Su2KeywordLine all{line.keyword, line.value.substr(0, blank)};
    const Su2KeywordLine own{line.keyword, trimmed(line.value.substr(blank))};
    const std::int64_t count = integer_of(all, "the number of points", 0, most_of_anything - zone_.first_point);
    if (!own.value.empty()) {
      integer_of(own, "the number of points without halo", 0, count);
    }
    return count;
  }

  void finish_zone() {
    if (!zone_.is_begun) {
      if (zones_found_ == 0 && scanner_.at_end()) {
        fail_file("has no NDIME=: it is no SU2 mesh, or is cut off");
      }
      return;
    }
    require_marker_read();
    const char* const missing = !zone_.has_points     ? "NPOIN="
                                : !zone_.has_elements ? "NELEM="
                                : !zone_.markers      ? "NMARK="
                                                      : nullptr;
    if (missing != nullptr) {
      scanner_.fail(name_of_zone() + " has no " + missing + ": it is cut off, or no SU2 mesh");
    }
    if (zone_.markers_found != *zone_.markers) {
      scanner_.fail("NMARK= declares " + std::to_string(*zone_.markers) + " markers, but " + name_of_zone() + " has " +
                    std::to_string(zone_.markers_found) + ": it is cut off, or that number is wrong");
    }
    zones_.resize(document_.cells.size(), zone_.number);
    zone_ = {};
  }

  void read_points() {
    const std::size_t first = document_.point_count();
    const auto count = static_cast<std::size_t>(*zone_.points);
    const auto dimension = static_cast<std::size_t>(dimension_);
    require_room(scanner_.path(), "points", count, 2 * dimension, bytes_left() + 1);
    shared_resize(document_.points, 3 * (first + count), sites_.offsets, dimension * (first + count), workers_.workers);
    rows_.read_points(first, document_, sites_);
    behind_rows_ = "points";
  }

  void read_marker(const Su2KeywordLine& line) {
    if (!marker_) {
      scanner_.fail("MARKER_ELEMS= stands without a MARKER_TAG= before it");
    }
    const auto count = static_cast<std::size_t>(count_of(line, "the number of the marker's elements", 0));
    // Between the number of halo points and their list stands with whom they are exchanged.
    const std::size_t offset = scanner_.offset();
    const auto next = scanner_.at_end() ? std::nullopt : parse_su2_keyword_line(scanner_.next_line());
    if (!next || !(next->keyword == "SEND_RECV" || next->keyword == "SEND_TO")) {
      scanner_.seek(offset);
    }
    const std::int32_t number = names_.number_of(*marker_);
    const std::size_t before = document_.cells.size();
    read_cells(Su2Section::marker, count);
    markers_.resize(document_.cells.size(), number);
    for (std::size_t cell = before; cell < document_.cells.size(); ++cell) {
      names_.add_cells(number, cell_type::dimension(document_.cells.types[cell]));
    }
    marker_.reset();
    ++zone_.markers_found;
    behind_rows_ = "elements of the marker";
  }

  void read_cells(Su2Section section, std::size_t count) {
    constexpr std::size_t least_row_bytes = 4;  // a type and a point
    require_room(scanner_.path(), "elements", count, least_row_bytes, bytes_left() + 1);
    rows_.read_cells({section, dimension_, zone_.first_point, static_cast<std::int32_t>(*zone_.points), name_of_zone()},
                     count, document_.cells);
  }

  /// Rows behind those that a count declares mean that the count is wrong.
  void require_no_row(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line.substr(0, line.find('%')));
    if (!behind_rows_.empty() && !words.empty() && parse_number<double>(words.front())) {
      scanner_.fail("expected a keyword behind the declared " + std::string(behind_rows_) + ", got " +
                    quoted(words.front()) + ": the number of " + std::string(behind_rows_) + " is wrong");
    }
  }

  void require_marker_read() const {
    if (marker_) {
      scanner_.fail("the marker " + quoted(*marker_) + " has no MARKER_ELEMS=");
    }
  }

  void require_once(bool is_there, const Su2KeywordLine& line) const {
    if (is_there) {
      scanner_.fail(std::string(line.keyword) + "= stands twice" + (zone_.number == 0 ? "" : " in " + name_of_zone()));
    }
  }

  std::int64_t count_of(const Su2KeywordLine& line, const std::string& what, std::int64_t least) const {
    return integer_of(line, what, least, most_of_anything);
  }

  std::int64_t integer_of(const Su2KeywordLine& line, const std::string& what, std::int64_t least,
                          std::int64_t most) const {
    const std::optional<std::int64_t> value = parse_integer(line.value);
    if (!value || *value < least || *value > most) {
      scanner_.fail_at(static_cast<std::size_t>(line.keyword.data() - scanner_.text().data()),
                       "expected " + what + " behind " + std::string(line.keyword) + "=, from " +
                           std::to_string(least) + " to " + std::to_string(most) + ", got " + quoted(line.value));
    }
    return *value;
  }

  std::string name_of_zone() const {
    return zone_.number == 0 ? std::string("the file") : "zone " + std::to_string(zone_.number);
  }

  [[noreturn]] void fail_file(const std::string& message) const { throw ReadError(scanner_.path(), message); }

  /// What belongs to no section that is read. Boxes and periodic boundaries have a dozen keywords each.
  void note_section(std::string_view keyword) {
    std::string name(keyword.starts_with("FFD_")                ? "free-form deformation boxes"
                     : keyword.find("PERIODIC") != keyword.npos ? "periodic boundaries"
                                                                : keyword);
    if (other_sections_.insert(name).second) {
      add_to_list(other_list_, name);
    }
  }

  void add_note() {
    if (!other_list_.empty()) {
      document_.notes.push_back("What the file says beside its mesh is kept in SU2 output only: " + other_list_ + ".");
    }
  }

  void add_cell_arrays() {
    if (!names_.empty()) {
      DataArray array = make_data_array("su2:marker", 1, std::move(markers_));
      auto description = std::make_shared<ArrayDescription>();
      description->value_names = names_.value_names(dimension_ - 1);
      array.description = std::move(description);
      document_.cell_arrays.push_back(std::move(array));
    }
    if (!zone_numbers_.empty()) {
      document_.cell_arrays.push_back(make_data_array("su2:zone", 1, std::move(zones_)));
    }
  }

  std::size_t bytes_left() const { return scanner_.text().size() - scanner_.offset(); }

  TextScanner scanner_;
  FileWorkers workers_;
  Su2Rows rows_;
  MeshDocument document_;
  NumberSites sites_;
  int dimension_ = 0;  ///< 0: not known yet
  ReadZone zone_;
  std::optional<std::int64_t> declared_zones_;
  std::optional<std::int64_t> dimension_of_zones_;  ///< that stands before the first of them, for those without one
  std::int64_t zones_found_ = 0;
  std::set<std::int32_t> zone_numbers_;
  std::optional<std::string_view> marker_;  ///< whose elements are to come
  MarkerNames names_;
  std::vector<std::int32_t> markers_;  ///< of the cells so far
  std::vector<std::int32_t> zones_;
  std::string_view behind_rows_;  ///< rows of what have just ended; empty elsewhere
  std::set<std::string> other_sections_;
  std::string other_list_;
};

}  // namespace

MeshDocument read_su2(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  auto [document, sites] = Su2Reader(bytes, path, workers).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
