// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/obj/obj_plain_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/obj/obj_statements.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/plain_numbers.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/text/token_count.h"

namespace trismooth {

namespace {

/// The statements of text[begin, end), which ends at the end of a line.
class StatementLines {
 public:
  StatementLines(std::string_view text, std::size_t begin, std::size_t end) : text_(text.substr(0, end)), at_(begin) {}

  /// Goes to the next line that holds more than a comment; false where there is none.
  bool next() {
    for (;;) {
      while (at_ < text_.size() && is_white_space(text_[at_])) {
        ++at_;
      }
      if (at_ == text_.size()) {
        return false;
      }
      if (text_[at_] != '#') {
        break;
      }
      at_ = find_line_end(text_, at_);
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_white_space(text_[at_])) {
      ++at_;
    }
    keyword_ = text_.substr(begin, at_ - begin);
    return true;
  }

  /// The first word of the line.
  std::string_view keyword() const { return keyword_; }
  /// Byte offset behind what has been read of the line.
  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }

  /// What is left of the line.
  std::string_view rest() {
    const std::size_t begin = at_;
    at_ = find_line_end(text_, at_);
    return text_.substr(begin, at_ - begin);
  }
  /// The tokens in it.
  std::size_t count_rest() {
    const std::size_t begin = at_;
    at_ = find_line_end(text_, at_);
    return count_tokens(text_, begin, at_);
  }

  bool at_end_of_line() {
    while (at_ < text_.size() && is_white_space(text_[at_]) && text_[at_] != '\n' && text_[at_] != '\r') {
      ++at_;
    }
    return at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '\r';
  }

  /// The vertex of "v", "v/vt", "v//vn" or "v/vt/vn", parts of which may be missing, as the file writes it: counted
  /// from 1, or backwards. False where the token is anything else.
  bool reference(std::int32_t& vertex) {
    const char* const end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, vertex);
    at_ = static_cast<std::size_t>(stop - text_.data());
    for (int part = 0; error == std::errc() && at_ < text_.size() && text_[at_] == '/'; ++part) {
      ++at_;
      if (part == 2 || !pass_whole_number()) {
        return false;
      }
    }
    return error == std::errc() && (at_ == text_.size() || is_white_space(text_[at_]));
  }

 private:
  /// One that fits into 64 bits for sure, or none at all.
  bool pass_whole_number() {
    const bool negative = at_ < text_.size() && text_[at_] == '-';
    at_ += negative ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') {
      ++at_;
    }
    return at_ - begin <= std::numeric_limits<std::int64_t>::digits10 && (at_ > begin || !negative);
  }

  std::string_view text_;
  std::size_t at_;
  std::string_view keyword_;
};

/// A statement usemtl or g.
struct Start {
  bool of_group;
  std::string_view name;
  std::size_t cell;  ///< the first one of its part behind it
};

/// How many of each there are in a part, or in front of it.
struct Counts {
  std::size_t vertices = 0;
  std::size_t cells = 0;
  std::size_t corners = 0;
};

struct Part {
  Counts counts;
  Counts before;
  std::vector<Start> starts;
  std::vector<std::string_view> others;  ///< different keywords, as many as are named at most
  bool has_colours_or_weights = false;
};

class PlainObjReader {
 public:
  PlainObjReader(std::string_view text, const FileWorkers& workers)
      : text_(text), workers_(workers.workers), lines_(text, begin_of_text(text), workers), parts_(lines_.size()) {}

  bool read() {
    if (!lines_.all_of([this](std::size_t part) { return count(part); })) {
      return false;
    }
    for (Part& part : parts_) {
      part.before = all_;
      all_.vertices += part.counts.vertices;
      all_.cells += part.counts.cells;
      all_.corners += part.counts.corners;
    }
    // A vertex takes three digits, four separators and its keyword. Without vertices this may be anything.
    if (all_.vertices == 0 || all_.vertices > (text_.size() + 1) / 8 ||
        all_.vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      return false;
    }
    shared_resize(document_.points, 3 * all_.vertices, sites_.offsets, 3 * all_.vertices, workers_);
    shared_resize(document_.cells.connectivity, all_.corners, document_.cells.offsets, all_.cells + 1, workers_);
    shared_resize(document_.cells.types, all_.cells, workers_);
    return lines_.all_of([this](std::size_t part) { return fill(part); });
  }

  std::pair<MeshDocument, NumberSites> take() {
    ObjStatements statements;
    for (const Part& part : parts_) {
      for (const Start& start : part.starts) {
        std::string name;
        append_name(name, start.name);
        const std::size_t cell = part.before.cells + start.cell;
        start.of_group ? statements.start_group(std::move(name), cell)
                       : statements.start_material(std::move(name), cell);
      }
      for (const std::string_view keyword : part.others) {
        statements.add_other(keyword);
      }
      if (part.has_colours_or_weights) {
        statements.add_colours_or_weights();
      }
    }
    statements.move_to(document_);
    return {std::move(document_), std::move(sites_)};
  }

 private:
  bool count(std::size_t number) {
    Part& part = parts_[number];
    Counts counts;
    StatementLines lines(text_, lines_.begin(number), lines_.end(number));
    while (lines.next()) {
      const std::string_view keyword = lines.keyword();
      if (keyword == "v") {
        ++counts.vertices;
        lines.rest();
      } else if (least_vertices(keyword) > 0) {
        ++counts.cells;
        counts.corners += lines.count_rest();
      } else if (!add_statement(part, keyword, lines.rest(), counts.cells)) {
        return false;
      }
    }
    part.counts = counts;
    return true;
  }

  static bool add_statement(Part& part, std::string_view keyword, std::string_view rest, std::size_t cell) {
    if (!is_obj_keyword(keyword) || rest.ends_with('\\')) {
      return false;
    }
    if (keyword == "usemtl" || keyword == "g") {
      part.starts.push_back({keyword == "g", rest, cell});
    } else if (part.others.size() < ObjStatements::most_named && std::ranges::count(part.others, keyword) == 0) {
      part.others.push_back(keyword);
    }
    return true;
  }

  bool fill(std::size_t number) {
    Part& part = parts_[number];
    Counts at = part.before;
    StatementLines lines(text_, lines_.begin(number), lines_.end(number));
    bool plain = true;
    while (plain && lines.next()) {
      if (lines.keyword() == "v") {
        PlainNumbers numbers(text_, lines.offset());
        plain = read_obj_vertex(numbers, at.vertices, document_, sites_, part.has_colours_or_weights);
        lines.seek(numbers.offset());
        ++at.vertices;
      } else if (const std::size_t least = least_vertices(lines.keyword()); least > 0) {
        plain = read_element(lines, least, at);
      } else {
        lines.rest();
      }
    }
    return plain;
  }

  bool read_element(StatementLines& lines, std::size_t least, Counts& at) {
    const std::size_t begin = at.corners;
    const auto before = static_cast<std::int64_t>(at.vertices);
    const auto count = static_cast<std::int64_t>(all_.vertices);
    for (; !lines.at_end_of_line(); ++at.corners) {
      std::int32_t index = 0;
      if (!lines.reference(index) || index == 0 || index > count || index < -before) {
        return false;
      }
      document_.cells.connectivity[at.corners] =
          index > 0 ? index - 1 : static_cast<std::int32_t>(before + std::int64_t{index});
    }
    document_.cells.types[at.cells] = obj_cell_type(least, at.corners - begin);
    document_.cells.offsets[++at.cells] = static_cast<std::int64_t>(at.corners);
    return at.corners - begin >= least;
  }

  std::string_view text_;
  Workers& workers_;
  LineParts lines_;
  std::vector<Part> parts_;
  Counts all_;
  MeshDocument document_;
  NumberSites sites_;
};

}  // namespace

std::optional<std::pair<MeshDocument, NumberSites>> read_plain_obj(std::string_view text, const FileWorkers& workers) {
  if (workers.part_bytes == FileWorkers::serial) {
    return std::nullopt;
  }
  PlainObjReader reader(text, workers);
  return reader.read() ? std::optional(reader.take()) : std::nullopt;
}

}  // namespace trismooth
