#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/stl/point_welder.h"
#include "trismooth/mesh_io/stl/stl.h"
#include "trismooth/mesh_io/stl/stl_layout.h"
#include "trismooth/mesh_io/stl/stl_plain_facets.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

using stl_layout::number_at;

/// True where the token is `word`, which is in lower case, in any case.
bool is_word(std::string_view token, std::string_view word) {
  return std::ranges::equal(token, word, {}, [](char c) { return 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c; });
}

/// Makes triangles of corners, three after three, and remembers where each corner stands in the file.
class FacetCollector {
 public:
  FacetCollector(const std::filesystem::path& path, NumberEncoding encoding, ScalarType type) : path_(path) {
    sites_.encoding = encoding;
    document_.point_type = sites_.type = type;
  }

  void add_corner(const std::array<double, 3>& point, const std::array<std::uint64_t, 3>& offsets) {
    if (sites_.vertices.size() == std::numeric_limits<std::int32_t>::max()) {
      throw ReadError(path_, "has more facets than are supported (" +
                                 std::to_string(std::numeric_limits<std::int32_t>::max() / 3) + ")");
    }
    sites_.vertices.push_back(welder_.weld(point));
    sites_.offsets.insert(sites_.offsets.end(), offsets.begin(), offsets.end());
    if (sites_.vertices.size() % 3 == 0) {
      document_.cells.append(cell_type::triangle, std::span(sites_.vertices).last(3));
    }
  }

  /// Facets that others have read, in place of those so far: none.
  void adopt(PlainFacets facets, const FileWorkers& workers) {
    CellList& cells = document_.cells;
    sites_.offsets = std::move(facets.offsets);
    sites_.vertices = std::move(facets.corners.vertices);
    points_ = std::move(facets.corners.points);
    const std::size_t count = sites_.vertices.size() / 3;
    shared_resize(cells.connectivity, 3 * count, cells.offsets, count + 1, workers.workers);
    shared_resize(cells.types, count, workers.workers);
    for_file_blocks(workers, count, stl_layout::facet_bytes, [&](std::size_t first, std::size_t last) {
      for (std::size_t facet = first; facet < last; ++facet) {
        for (std::size_t corner = 3 * facet; corner < 3 * facet + 3; ++corner) {
          cells.connectivity[corner] = sites_.vertices[corner];
        }
        cells.offsets[facet + 1] = static_cast<std::int64_t>(3 * facet + 3);
        cells.types[facet] = cell_type::triangle;
      }
    });
  }

  std::size_t facets() const { return document_.cells.size(); }

  MeshDocument finish(FileBytes bytes) {
    document_.points = points_ ? std::move(*points_) : welder_.take_points();
    document_.original = make_patched_original(std::move(bytes), std::move(sites_));
    return std::move(document_);
  }

 private:
  const std::filesystem::path& path_;
  MeshDocument document_;
  NumberSites sites_;
  PointWelder welder_;
  std::optional<std::vector<double>> points_;  ///< of facets that others have read
};

/// Returns the attributes of the facets.
std::vector<std::uint16_t> read_one_by_one(const std::filesystem::path& path, std::string_view bytes, std::size_t count,
                                           FacetCollector& collector) {
  std::vector<std::uint16_t> attributes(count);
  for (std::size_t facet = 0; facet < count; ++facet) {
    std::size_t offset = stl_layout::header_bytes + facet * stl_layout::facet_bytes + stl_layout::vector_bytes;
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> point{};
      std::array<std::uint64_t, 3> offsets{};
      for (std::size_t axis = 0; axis < 3; ++axis, offset += sizeof(float)) {
        point[axis] = static_cast<double>(number_at<float>(bytes, offset));
        offsets[axis] = offset;
        if (!std::isfinite(point[axis])) {
          throw ReadError(path, "byte " + std::to_string(offset) + ": facet " + std::to_string(facet) +
                                    " has a coordinate that is not a finite number");
        }
      }
      collector.add_corner(point, offsets);
    }
    attributes[facet] = number_at<std::uint16_t>(bytes, offset);
  }
  return attributes;
}

MeshDocument read_binary(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  FacetCollector collector(path, NumberEncoding::little_endian, ScalarType::float32);
  const auto count = number_at<std::uint32_t>(bytes, stl_layout::title_bytes);
  std::vector<std::uint16_t> attributes;
  if (auto plain = read_plain_binary_facets(bytes, count, workers)) {
    collector.adopt(std::move(plain->facets), workers);
    attributes = std::move(plain->attributes);
  } else {
    attributes = read_one_by_one(path, bytes, count, collector);
  }
  MeshDocument document = collector.finish(std::move(bytes));
  if (std::ranges::any_of(attributes, [](std::uint16_t attribute) { return attribute != 0; })) {
    document.cell_arrays.push_back(make_data_array("attribute", 1, std::move(attributes)));
  }
  return document;
}

/// What some editors put in front of a text is no part of it.
std::size_t begin_of_text(std::string_view bytes) {
  return bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
}

class TextReader {
 public:
  TextReader(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers)
      : bytes_(std::move(bytes)),
        workers_(workers),
        scanner_(bytes_, path, TextScanner::Comments::none, begin_of_text(bytes_)),
        collector_(path, NumberEncoding::text, ScalarType::float64) {}

  /// Reads the whole text, once.
  MeshDocument read() {
    std::int32_t solids = 0;
    std::vector<std::int32_t> solid_of_facet;
    std::string names;
    expect("solid");
    do {
      names.append(names.empty() ? "" : ", ").append(quoted(trimmed(scanner_.next_line())));
      if (solids == 0) {
        read_plain_facets();
      }
      read_solid();
      solid_of_facet.resize(collector_.facets(), solids);
      ++solids;
    } while (begins_another_solid());
    const std::string unknown = unknown_words();
    MeshDocument document = collector_.finish(std::move(bytes_));
    if (!has_end_) {
      document.notes.emplace_back("does not end with 'endsolid': nothing says whether facets are missing");
    }
    if (!unknown.empty()) {
      document.notes.push_back("holds lines that STL does not know, which STL output keeps: " + unknown);
    }
    if (solids > 1) {
      document.cell_arrays.push_back(make_data_array("solid", 1, std::move(solid_of_facet)));
      document.notes.push_back("holds " + std::to_string(solids) +
                               " solids, numbered from 0 in the cell array 'solid': " + names);
    }
    return document;
  }

 private:
  /// Reads all facets, where nothing but their 'endsolid' follows.
  void read_plain_facets() {
    if (auto plain = read_plain_text_facets(bytes_, scanner_.offset(), workers_)) {
      collector_.adopt(std::move(plain->facets), workers_);
      scanner_.resume(plain->last_word, plain->end);
    }
  }

  /// Reads the facets up to 'endsolid' with its line, to the next 'solid', or to the end of the file: some programs
  /// write no 'endsolid'.
  void read_solid() {
    has_end_ = false;
    while (true) {
      skip_unknown_lines();
      if (collector_.facets() > 0 && scanner_.at_end()) {
        return;
      }
      const std::string_view word = scanner_.next_token("facet or endsolid");
      if (is_word(word, "facet")) {
        read_facet();
      } else if (is_word(word, "endsolid")) {
        has_end_ = true;
        scanner_.next_line();
        return;
      } else if (is_word(word, "solid") && collector_.facets() > 0) {
        scanner_.seek(scanner_.token_offset());
        return;
      } else {
        scanner_.fail("expected facet or endsolid, got " + quoted(word));
      }
    }
  }

  bool begins_another_solid() {
    skip_unknown_lines();
    if (scanner_.at_end()) {
      return false;
    }
    expect("solid");
    return true;
  }

  void read_facet() {
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) {
      // Not checked: degenerate facets have normals of NaN in many spellings, and normals are not used.
      scanner_.next_token("a normal of three numbers");
    }
    expect_statement("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect_statement("vertex");
      std::array<double, 3> point{};
      std::array<std::uint64_t, 3> offsets{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] = scanner_.next_double("a coordinate");
        offsets[axis] = scanner_.token_offset();
      }
      collector_.add_corner(point, offsets);
    }
    expect_statement("endloop");
    expect_statement("endfacet");
  }

  void expect(std::string_view word) {
    const std::string_view token = scanner_.next_token(word);
    if (!is_word(token, word)) {
      scanner_.fail("expected " + std::string(word) + ", got " + quoted(token));
    }
  }

  void expect_statement(std::string_view word) {
    const std::string_view token = next_word(word);
    if (!is_word(token, word)) {
      scanner_.fail("expected " + std::string(word) + ", got " + quoted(token));
    }
  }

  /// The first word of the next statement.
  std::string_view next_word(std::string_view what) {
    skip_unknown_lines();
    return scanner_.next_token(what);
  }

  /// Passes over lines that begin with a word that STL does not know, such as 'color'.
  void skip_unknown_lines() {
    while (is_at_begin_of_line() && is_unknown(scanner_.peek_token())) {
      const std::string_view word = scanner_.next_token("a word");
      if (unknown_.size() < most_words_named) {
        unknown_.insert(word);
      }
      scanner_.next_line();
    }
  }

  /// True where the next token is the first of its line.
  bool is_at_begin_of_line() {
    if (scanner_.at_end_of_line() || scanner_.offset() == 0) {
      return true;
    }
    const std::size_t before = scanner_.text().find_last_not_of(" \t\v\f", scanner_.offset() - 1);
    const std::string_view text = scanner_.text();
    return before == text.npos || text[before] == '\n' || text[before] == '\r';
  }

  static bool is_unknown(std::string_view token) {
    constexpr std::array<std::string_view, 9> known{"solid",  "facet",   "normal",   "outer",   "loop",
                                                    "vertex", "endloop", "endfacet", "endsolid"};
    const char first = token.empty() ? '\0' : token.front();
    const bool is_name = ('a' <= first && first <= 'z') || ('A' <= first && first <= 'Z');
    return is_name && std::ranges::none_of(known, [token](std::string_view word) { return is_word(token, word); });
  }

  /// Those that were passed over, for a note.
  std::string unknown_words() const {
    std::string list;
    for (const std::string_view word : unknown_) {
      list.append(list.empty() ? "" : ", ").append(quoted(word));
    }
    return list;
  }

  static constexpr std::size_t most_words_named = 8;

  FileBytes bytes_;
  FileWorkers workers_;
  TextScanner scanner_;
  FacetCollector collector_;
  std::set<std::string_view> unknown_;  ///< first words of lines that were passed over
  bool has_end_ = false;                ///< the last solid has its 'endsolid'
};

bool begins_with_solid(std::string_view bytes) {
  constexpr std::string_view word = "solid";
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\v\f\r\n", begin_of_text(bytes)), bytes.size());
  return is_word(bytes.substr(begin, word.size()), word);
}

/// True where the bytes behind the facets that a binary file declares look like more of them: finite numbers, and
/// either as many bytes as facets have, not all of them zero, or a normal of length 1. The declared number is wrong
/// then, and a part of the mesh would be missing.
bool is_another_facet(std::string_view bytes) {
  if (bytes.size() < stl_layout::facet_bytes) {
    return false;
  }
  std::array<double, 12> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = static_cast<double>(number_at<float>(bytes, i * sizeof(float)));
    if (!std::isfinite(numbers[i])) {
      return false;
    }
  }
  constexpr double tolerance = 1e-3;  // of programs that round normals
  const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
  const bool is_zero = std::ranges::all_of(bytes, [](char byte) { return byte == '\0'; });
  return std::abs(length - 1) < tolerance || (bytes.size() % stl_layout::facet_bytes == 0 && !is_zero);
}

/// Binary files may begin with "solid" too, but text has no zero bytes.
bool has_zero_byte(std::string_view bytes) {
  return bytes.substr(0, stl_layout::header_bytes).find('\0') != bytes.npos;
}

/// The bytes that a file with the declared number of facets has, where it is binary.
std::uint64_t binary_size(std::string_view bytes) {
  return stl_layout::header_bytes +
         std::uint64_t{number_at<std::uint32_t>(bytes, stl_layout::title_bytes)} * stl_layout::facet_bytes;
}

}  // namespace

bool is_stl(std::string_view bytes) {
  if (bytes.size() > stl_layout::header_bytes && bytes.size() == binary_size(bytes)) {
    return true;
  }
  if (!begins_with_solid(bytes) || has_zero_byte(bytes)) {
    return false;
  }
  TextScanner scanner(text_head(bytes), {});
  scanner.next_line();
  const std::string_view word = scanner.peek_token();
  return is_word(word, "facet") || is_word(word, "endsolid");
}

MeshDocument read_stl(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const bool may_be_binary = bytes.size() >= stl_layout::header_bytes;
  const std::uint64_t count = may_be_binary ? number_at<std::uint32_t>(bytes, stl_layout::title_bytes) : 0;
  const std::uint64_t end = may_be_binary ? binary_size(bytes) : stl_layout::header_bytes;
  if (may_be_binary && bytes.size() == end) {
    return read_binary(path, std::move(bytes), workers);
  }
  if (begins_with_solid(bytes) && !has_zero_byte(bytes)) {
    return TextReader(path, std::move(bytes), workers).read();
  }
  if (!may_be_binary) {
    throw ReadError(path, "is not an STL file: it does not begin with 'solid' and is too short to be binary");
  }
  if (bytes.size() > end && count > 0 && !is_another_facet(std::string_view(bytes).substr(end))) {
    const std::string note =
        "bytes follow the last facet, at byte " + std::to_string(end) + ": they are not read; STL output keeps them";
    MeshDocument document = read_binary(path, std::move(bytes), workers);
    document.notes.push_back(note);
    return document;
  }
  throw ReadError(path, "byte 80: declares " + std::to_string(count) + " facets, but the file has room for " +
                            std::to_string((bytes.size() - stl_layout::header_bytes) / stl_layout::facet_bytes) +
                            " and is " + std::to_string(bytes.size()) + " bytes long where " + std::to_string(end) +
                            " are expected");
}

}  // namespace trismooth
