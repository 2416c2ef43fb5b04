// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/obj/obj_reader.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/obj/obj_plain_reader.h"
#include "trismooth/mesh_io/obj/obj_statements.h"
#include "trismooth/mesh_io/text/careful_numbers.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::filesystem::path& path)
      : scanner_(bytes, path, TextScanner::Comments::hash, begin_of_text(bytes), TextScanner::Continuation::backslash) {
  }

  std::pair<MeshDocument, NumberSites> read() {
    bool has_statements = false;
    while (!scanner_.at_end()) {
      read_statement(scanner_.next_token("a statement"));
      has_statements = true;
    }
    // Any text can pass for statements that are not known here. Comments alone are a mesh of nothing.
    if (document_.points.empty() && (has_statements || scanner_.text().empty())) {
      scanner_.fail_at(0, "is not an OBJ mesh: it has no vertices");
    }
    check_forward_references();
    statements_.move_to(document_);
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (const std::size_t least = least_vertices(keyword); least > 0) {
      read_element(least == 1 ? "point" : least == 2 ? "line" : "face", least);
    } else if (keyword == "usemtl") {
      statements_.start_material(read_name(), document_.cells.size());
    } else if (keyword == "g") {
      statements_.start_group(read_name(), document_.cells.size());
    } else if (is_obj_keyword(keyword)) {
      statements_.add_other(keyword);
      read_name();
    } else {
      scanner_.fail("expected a statement of OBJ, got " + quoted(keyword));
    }
  }

  void read_vertex() {
    if (document_.point_count() >= std::numeric_limits<std::int32_t>::max()) {
      scanner_.fail("has more vertices than 32-bit indices can tell apart");
    }
    const std::size_t vertex = document_.point_count();
    document_.points.resize(3 * vertex + 3);
    sites_.offsets.resize(3 * vertex + 3);
    bool has_more = false;
    CarefulNumbers numbers(scanner_);
    read_obj_vertex(numbers, vertex, document_, sites_, has_more);
    if (has_more) {
      statements_.add_colours_or_weights();
    }
  }

  /// Apart from that of the plain reader, which counts all statements first: here room is made vertex by vertex, and
  /// whether a vertex that stands further behind exists is known at the end alone.
  void read_element(const char* what, std::size_t least) {
    CellList& cells = document_.cells;
    const std::size_t statement = scanner_.token_offset();
    const std::size_t begin = cells.connectivity.size();
    while (!scanner_.at_end_of_line()) {
      cells.connectivity.push_back(read_reference(scanner_.next_token("a vertex index")));
    }
    const std::size_t count = cells.connectivity.size() - begin;
    if (count < least) {
      scanner_.fail_at(statement, std::string("expected ") + std::to_string(least) + " or more vertices of a " + what +
                                      ", got " + std::to_string(count));
    }
    cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
    cells.types.push_back(obj_cell_type(least, count));
  }

  /// The vertex of "v", "v/vt", "v//vn" or "v/vt/vn"; the parts behind may be missing.
  std::int32_t read_reference(std::string_view token) {
    const std::size_t slash = std::min(token.find('/'), token.size());
    std::string_view rest = token.substr(slash);
    for (int part = 0; !rest.empty(); ++part) {
      rest.remove_prefix(1);
      const std::size_t length = std::min(rest.find('/'), rest.size());
      if (part == 2 || (length > 0 && !parse_integer(rest.substr(0, length)))) {
        scanner_.fail("expected a vertex as v, v/vt, v//vn or v/vt/vn with whole numbers, got " + quoted(token));
      }
      rest.remove_prefix(length);
    }
    const std::optional<std::int64_t> index = parse_integer(token.substr(0, slash));
    const auto count = static_cast<std::int64_t>(document_.point_count());
    if (!index || *index == 0 || *index < -count || *index > std::numeric_limits<std::int32_t>::max()) {
      scanner_.fail("expected a vertex index, got " + quoted(token) + "; " + std::to_string(count) +
                    " vertices stand before this line, counted from 1");
    }
    if (*index > count && *index > highest_reference_) {
      highest_reference_ = *index;
      highest_reference_offset_ = scanner_.token_offset();
    }
    return static_cast<std::int32_t>(*index > 0 ? *index - 1 : count + *index);
  }

  void check_forward_references() const {
    if (highest_reference_ > static_cast<std::int64_t>(document_.point_count())) {
      scanner_.fail_at(highest_reference_offset_, "vertex index " + std::to_string(highest_reference_) +
                                                      " is out of range: the file has " +
                                                      std::to_string(document_.point_count()) + " vertices");
    }
  }

  /// The rest of the statement, its words one blank apart. A name may contain '#', so there are no comments here.
  std::string read_name() {
    std::string name;
    for (bool more = true; more;) {
      std::string_view line = scanner_.next_line();
      more = line.ends_with('\\') && scanner_.offset() < scanner_.text().size();
      line.remove_suffix(more ? 1 : 0);
      append_name(name, line);
    }
    return name;
  }

  TextScanner scanner_;
  MeshDocument document_;
  NumberSites sites_;
  ObjStatements statements_;
  std::int64_t highest_reference_ = 0;
  std::size_t highest_reference_offset_ = 0;
};

}  // namespace

MeshDocument read_obj(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  auto plain = read_plain_obj(bytes, workers);
  auto [document, sites] = plain ? std::move(*plain) : ObjReader(bytes, path).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
