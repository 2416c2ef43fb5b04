// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// Facets of a text.
struct StlTextFacets {
  std::vector<double> points;          ///< x, y and z of every corner, three corners after three
  std::vector<std::uint64_t> offsets;  ///< byte offsets of these numbers

  std::size_t size() const { return points.size() / 9; }
};

/// Reads the facet of that number, for which there is room, behind its first word. The words are plain or careful (see
/// PlainSource): expect(word) reads the next one of a statement, expect_statement(word) the first one, and both answer
/// whether it is that; pass(count, what) passes tokens.
template <class Words>
bool read_stl_facet(Words& words, std::size_t facet, StlTextFacets& facets) {
  // Numbers of normals are not checked: degenerate facets have NaN in many spellings, and normals are not used.
  if (!words.expect("normal") || !words.pass(3, "a normal of three numbers") || !words.expect_statement("outer") ||
      !words.expect("loop")) {
    return false;
  }
  for (std::size_t i = 9 * facet; i < 9 * facet + 9; ++i) {
    if ((i % 3 == 0 && !words.expect_statement("vertex")) || !words.next(facets.points[i], "a coordinate")) {
      return false;
    }
    facets.offsets[i] = words.token_offset();
  }
  return words.expect_statement("endloop") && words.expect_statement("endfacet");
}

/// The facets of a text from `offset` on, at the begin of a line, up to its end or to the line 'endsolid' in front of
/// that; where every facet begins a line. Read in parts, by all workers. Nothing where anything is unusual or wrong:
/// others read the file then, and say what is wrong.
struct PlainTextFacets {
  StlTextFacets facets;
  std::size_t last_word = 0;  ///< byte offset of the last 'endfacet'
  std::size_t end = 0;        ///< byte offset behind it
};
std::optional<PlainTextFacets> read_plain_text_facets(std::string_view text, std::size_t offset,
                                                      const FileWorkers& workers);

}  // namespace trismooth
