// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_text_reader.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/text/careful_numbers.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

bool begins_medit_keyword(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

class MeditTextReader {
 public:
  MeditTextReader(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::hash, begin_of_text(bytes)),
        plain_rows_(bytes, workers),
        mesh_(workers) {}

  MeditMesh read() {
    read_version();
    while (!scanner_.at_end()) {
      read_section();
    }
    if (!mesh_.has_vertices) {
      scanner_.next_token("the keyword Vertices");
    }
    if (const auto wrong = mesh_.finish()) {
      fail_number(*wrong);
    }
    return std::move(mesh_);
  }

 private:
  /// A section in front of the vertices, whose number its indices depend on.
  struct Waiting {
    const MeditKeyword* keyword;
    std::size_t offset;  ///< of its count
  };

  void read_version() {
    constexpr std::int64_t newest = 4;
    const std::string_view token = scanner_.next_token("the keyword MeshVersionFormatted");
    const MeditKeyword* const keyword = find_medit_keyword(token);
    if (keyword == nullptr || keyword->role != MeditRole::version) {
      scanner_.fail("is no Medit file: expected the keyword MeshVersionFormatted, got " + quoted(token));
    }
    mesh_.begin_section(*keyword);
    scanner_.next_integer("a version of the format", 0, newest);
    after_ = "MeshVersionFormatted";
  }

  void read_section() {
    const std::string_view word = scanner_.next_token("a keyword");
    if (!begins_medit_keyword(word.front())) {
      scanner_.fail("expected a keyword after " + after_ + ", got " + quoted(word));
    }
    const MeditKeyword* const keyword = find_medit_keyword(word);
    if (keyword == nullptr || keyword->role == MeditRole::other || keyword->role == MeditRole::precision) {
      constexpr std::size_t longest_name = 40;
      mesh_.add_other(word.substr(0, std::min(longest_name, word.find_first_of("\"'<>"))));
      pass_to_keyword();
      return;
    }
    if (keyword->role == MeditRole::unsupported) {
      scanner_.fail(std::string(keyword->name) + " are not read");
    }
    if (!mesh_.begin_section(*keyword)) {
      scanner_.fail("a second " + std::string(keyword->name));
    }
    read_known(*keyword);
  }

  void read_known(const MeditKeyword& keyword) {
    after_ = keyword.name;
    switch (keyword.role) {
      case MeditRole::dimension:
        mesh_.set_dimension(static_cast<std::size_t>(scanner_.next_integer("the dimension", 2, 3)));
        break;
      case MeditRole::vertices:
        read_vertices();
        read_waiting();
        break;
      case MeditRole::cells:
        if (mesh_.has_vertices) {
          read_cells(keyword);
        } else {
          waiting_.push_back({&keyword, scanner_.offset()});
          pass_to_keyword();
        }
        break;
      case MeditRole::vertex_set:
      case MeditRole::cell_set:
        read_set(keyword);
        break;
      default:
        mesh_.has_end = true;
    }
  }

  std::size_t read_count(std::string_view name, std::size_t numbers_each) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const auto count = static_cast<std::size_t>(scanner_.next_integer("the number of " + std::string(name), 0, most));
    // Every number takes a digit and a separator, except for the separator at the end of the file.
    require_room(scanner_.path(), name, count, 2 * numbers_each, scanner_.text().size() - scanner_.offset() + 1);
    after_ = "the declared " + std::to_string(count) + " of " + std::string(name);
    return count;
  }

  void read_vertices() {
    const std::size_t dimension = mesh_.dimension();
    if (dimension == 0) {
      scanner_.fail("Vertices stand before the keyword Dimension");
    }
    const std::size_t count = read_count("Vertices", dimension + 1);
    mesh_.resize_vertices(count);
    read_rows(plain_rows_, scanner_, count, dimension + 1, "vertices", [&](auto& numbers, std::size_t vertex) {
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        if (!numbers.next_real(mesh_.document.points[3 * vertex + axis], "a coordinate")) {
          return false;
        }
        mesh_.sites.offsets[dimension * vertex + axis] = numbers.token_offset();
      }
      return numbers.next_whole(mesh_.vertex_refs[vertex], "a reference");
    });
  }

  /// Those that were passed over.
  void read_waiting() {
    const std::size_t last_number = scanner_.token_offset();
    const std::size_t offset = scanner_.offset();
    const std::string after = after_;
    for (const Waiting& section : waiting_) {
      scanner_.seek(section.offset);
      read_cells(*section.keyword);
      if (!scanner_.at_end() && !begins_medit_keyword(scanner_.peek_token().front())) {
        const std::string_view token = scanner_.next_token("a keyword");
        scanner_.fail("expected a keyword after " + after_ + ", got " + quoted(token));
      }
    }
    scanner_.resume(last_number, offset);
    after_ = after;
  }

  void read_cells(const MeditKeyword& keyword) {
    const std::size_t count = read_count(keyword.name, keyword.vertices + 1);
    mesh_.append_cells(keyword, count);
    const auto corners = std::span(mesh_.document.cells.connectivity).last(count * keyword.vertices);
    const auto references = std::span(mesh_.cell_refs).last(count);
    const auto vertices = static_cast<std::int64_t>(mesh_.document.point_count());
    const auto wrong_corner = [vertices](std::string_view token) {
      return "expected a vertex number, got " + quoted(token) + "; the file has " + std::to_string(vertices) +
             " vertices, counted from 1";
    };
    read_rows(plain_rows_, scanner_, count, keyword.vertices + 1, keyword.name, [&](auto& numbers, std::size_t cell) {
      for (std::int32_t& corner : corners.subspan(cell * keyword.vertices, keyword.vertices)) {
        if (!numbers.next_index(corner, "a vertex number", 1, vertices, wrong_corner)) {
          return false;
        }
        --corner;
      }
      return numbers.next_whole(references[cell], "a reference");
    });
  }

  void read_set(const MeditKeyword& keyword) {
    const std::size_t count = read_count(keyword.name, 1);
    scanner_.at_end();
    MeditMesh::Set set{&keyword, scanner_.offset(), {}};
    set.numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      set.numbers.push_back(scanner_.next_integer("a number", 1, std::numeric_limits<std::int32_t>::max()));
    }
    mesh_.add_set(std::move(set));
  }

  /// Passes what a section holds up to the next word, which is the next keyword. Texts in quotation marks are no words.
  void pass_to_keyword() {
    while (!scanner_.at_end()) {
      const std::string_view token = scanner_.peek_token();
      if (begins_medit_keyword(token.front())) {
        return;
      }
      if (token.front() == '"') {
        const std::string_view text = scanner_.text();
        const std::size_t close = std::min(text.find_first_of("\"\r\n", scanner_.offset() + 1), text.size());
        scanner_.seek(close < text.size() && text[close] == '"' ? close + 1 : close);
      } else {
        scanner_.next_token("a number");
      }
    }
  }

  [[noreturn]] void fail_number(const MeditMesh::WrongNumber& wrong) {
    scanner_.seek(wrong.set->place);
    for (std::size_t i = 0; i <= wrong.index; ++i) {
      scanner_.next_token("a number");
    }
    scanner_.fail(std::string(wrong.set->keyword->name) + ": expected a number from 1 to that of the " +
                  std::string(wrong.things) + ", " + std::to_string(wrong.count) + ", got '" +
                  std::to_string(wrong.set->numbers[wrong.index]) + "'");
  }

  TextScanner scanner_;
  PlainRows plain_rows_;
  MeditMesh mesh_;
  std::vector<Waiting> waiting_;
  std::string after_;  ///< what was read last, for messages
};

}  // namespace

MeditMesh read_medit_text(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers) {
  return MeditTextReader(path, bytes, workers).read();
}

}  // namespace trismooth
