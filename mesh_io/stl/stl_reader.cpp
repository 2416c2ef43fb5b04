// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <set>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/stl/shared_welding.h"
#include "trismooth/mesh_io/stl/stl.h"
#include "trismooth/mesh_io/stl/stl_layout.h"
#include "trismooth/mesh_io/stl/stl_plain_facets.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

using stl_layout::number_at;

void require_supported(const std::filesystem::path& path, std::size_t facets) {
  if (facets > stl_layout::most_facets) {
    throw ReadError(path, "has more facets than are supported (" + std::to_string(stl_layout::most_facets) + ")");
  }
}

/// The triangles of corners, three after three, and where the numbers of each stand in the file.
MeshDocument make_document(WeldedCorners corners, NumberSites sites, FileBytes bytes, const FileWorkers& workers) {
  MeshDocument document;
  document.point_type = sites.type;
  document.points = std::move(corners.points);
  CellList& cells = document.cells;
  sites.vertices = std::move(corners.vertices);
  const std::size_t count = sites.vertices.size() / 3;
  shared_resize(cells.connectivity, 3 * count, cells.offsets, count + 1, workers.workers);
  shared_resize(cells.types, count, workers.workers);
  for_file_blocks(workers, count, stl_layout::facet_bytes, [&](std::size_t first, std::size_t last) {
    for (std::size_t facet = first; facet < last; ++facet) {
      for (std::size_t corner = 3 * facet; corner < 3 * facet + 3; ++corner) {
        cells.connectivity[corner] = sites.vertices[corner];
      }
      cells.offsets[facet + 1] = static_cast<std::int64_t>(3 * facet + 3);
      cells.types[facet] = cell_type::triangle;
    }
  });
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return document;
}

MeshDocument read_binary(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const std::size_t count = number_at<std::uint32_t>(bytes, stl_layout::title_bytes);
  require_supported(path, count);
  NumberSites sites;
  sites.encoding = NumberEncoding::little_endian;
  sites.type = ScalarType::float32;
  std::vector<std::uint16_t> attributes;
  shared_resize(sites.offsets, 9 * count, attributes, count, workers.workers);
  std::atomic<bool> all_finite = true;
  for_file_blocks(workers, count, stl_layout::facet_bytes, [&](std::size_t first, std::size_t last) {
    bool finite = true;
    for (std::size_t facet = first; facet < last; ++facet) {
      std::size_t offset = stl_layout::offset_of_corner(3 * facet);
      for (std::size_t i = 9 * facet; i < 9 * facet + 9; ++i, offset += sizeof(float)) {
        sites.offsets[i] = offset;
        finite = finite && std::isfinite(number_at<float>(bytes, offset));
      }
      attributes[facet] = number_at<std::uint16_t>(bytes, offset);
    }
    if (!finite) {
      all_finite = false;
    }
  });
  if (!all_finite) {
    const auto wrong = std::ranges::find_if(
        sites.offsets, [&](std::uint64_t offset) { return !std::isfinite(number_at<float>(bytes, offset)); });
    throw ReadError(path, "byte " + std::to_string(*wrong) + ": facet " +
                              std::to_string((wrong - sites.offsets.begin()) / 9) +
                              " has a coordinate that is not a finite number");
  }
  const auto point_of = [&bytes](std::size_t corner) {
    const std::size_t offset = stl_layout::offset_of_corner(corner);
    return std::array{number_at<float>(bytes, offset), number_at<float>(bytes, offset + sizeof(float)),
                      number_at<float>(bytes, offset + 2 * sizeof(float))};
  };
  WeldedCorners corners = weld_corners<float>(3 * count, point_of, workers);
  MeshDocument document = make_document(std::move(corners), std::move(sites), std::move(bytes), workers);
  if (std::ranges::any_of(attributes, [](std::uint16_t attribute) { return attribute != 0; })) {
    document.cell_arrays.push_back(make_data_array("attribute", 1, std::move(attributes)));
  }
  return document;
}

class TextReader {
 public:
  TextReader(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers)
      : bytes_(std::move(bytes)),
        workers_(workers),
        scanner_(bytes_, path, TextScanner::Comments::none, begin_of_text(bytes_)) {}

  /// Reads the whole text, once.
  MeshDocument read() {
    std::int32_t solids = 0;
    std::vector<std::int32_t> solid_of_facet;
    std::string names;
    expect("solid");
    do {
      add_to_list(names, quoted(trimmed(scanner_.next_line())));
      if (solids == 0) {
        read_plain_facets();
      }
      read_solid();
      solid_of_facet.resize(facets_.size(), solids);
      ++solids;
    } while (begins_another_solid());
    const std::string unknown = unknown_words();
    const auto point_of = [&points = facets_.points](std::size_t corner) {
      return std::array{points[3 * corner], points[3 * corner + 1], points[3 * corner + 2]};
    };
    WeldedCorners corners = weld_corners<double>(3 * facets_.size(), point_of, workers_);
    facets_.points = {};
    NumberSites sites;
    sites.offsets = std::move(facets_.offsets);
    MeshDocument document = make_document(std::move(corners), std::move(sites), std::move(bytes_), workers_);
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

  // The words of a facet, careful ones: see read_stl_facet().
  bool expect(std::string_view word) {
    const std::string_view token = scanner_.next_token(word);
    if (!same_letters(token, word)) {
      scanner_.fail("expected " + std::string(word) + ", got " + quoted(token));
    }
    return true;
  }
  bool expect_statement(std::string_view word) {
    skip_unknown_lines();
    return expect(word);
  }
  bool pass(int tokens, std::string_view what) {
    for (; tokens > 0; --tokens) {
      scanner_.next_token(what);
    }
    return true;
  }
  bool next(double& coordinate, std::string_view what) {
    coordinate = scanner_.next_double(what);
    return true;
  }
  std::size_t token_offset() const { return scanner_.token_offset(); }

 private:
  /// Reads all facets, where nothing but their 'endsolid' follows.
  void read_plain_facets() {
    if (auto plain = read_plain_text_facets(bytes_, scanner_.offset(), workers_)) {
      facets_ = std::move(plain->facets);
      scanner_.resume(plain->last_word, plain->end);
    }
  }

  /// Reads the facets up to 'endsolid' with its line, to the next 'solid', or to the end of the file: some programs
  /// write no 'endsolid'.
  void read_solid() {
    has_end_ = false;
    while (true) {
      skip_unknown_lines();
      if (facets_.size() > 0 && scanner_.at_end()) {
        return;
      }
      const std::string_view word = scanner_.next_token("facet or endsolid");
      if (same_letters(word, "facet")) {
        const std::size_t facet = facets_.size();
        require_supported(scanner_.path(), facet + 1);
        facets_.points.resize(9 * facet + 9);
        facets_.offsets.resize(9 * facet + 9);
        read_stl_facet(*this, facet, facets_);
      } else if (same_letters(word, "endsolid")) {
        has_end_ = true;
        scanner_.next_line();
        return;
      } else if (same_letters(word, "solid") && facets_.size() > 0) {
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
    return expect("solid");
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
    return is_name && std::ranges::none_of(known, [token](std::string_view word) { return same_letters(token, word); });
  }

  /// Those that were passed over, for a note.
  std::string unknown_words() const { return list_text(unknown_, trismooth::quoted); }

  static constexpr std::size_t most_words_named = 8;

  FileBytes bytes_;
  FileWorkers workers_;
  TextScanner scanner_;
  StlTextFacets facets_;
  std::set<std::string_view> unknown_;  ///< first words of lines that were passed over
  bool has_end_ = false;                ///< the last solid has its 'endsolid'
};

bool begins_with_solid(std::string_view bytes) {
  constexpr std::string_view word = "solid";
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\v\f\r\n", begin_of_text(bytes)), bytes.size());
  return same_letters(bytes.substr(begin, word.size()), word);
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
  return same_letters(word, "facet") || same_letters(word, "endsolid");
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
