#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/stl/shared_welding.h"

namespace trismooth {

// Facets of STL files, read in parts, by all workers. Nothing where anything is unusual or wrong: others read the file
// then, and say what is wrong.

/// Facets, three corners after three.
struct PlainFacets {
  WeldedCorners corners;
  std::vector<std::uint64_t> offsets;  ///< byte offsets of x, y and z of every corner
};

/// The `count` facets of a binary file, which has room for them, and their attributes.
struct PlainBinaryFacets {
  PlainFacets facets;
  std::vector<std::uint16_t> attributes;
};
std::optional<PlainBinaryFacets> read_plain_binary_facets(std::string_view bytes, std::size_t count,
                                                          const FileWorkers& workers);

/// The facets of a text from `offset` on, at the begin of a line, up to its end or to the line 'endsolid' in front of
/// that; where every facet begins a line.
struct PlainTextFacets {
  PlainFacets facets;
  std::size_t last_word;  ///< byte offset of the last 'endfacet'
  std::size_t end;        ///< byte offset behind it
};
std::optional<PlainTextFacets> read_plain_text_facets(std::string_view text, std::size_t offset,
                                                      const FileWorkers& workers);

}  // namespace trismooth
