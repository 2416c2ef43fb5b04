// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_shared_arrays.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Name, number among the arrays of that name, values, type, components.
using ArrayKey = std::tuple<std::string, std::size_t, int, int, std::uint64_t>;

/// An array and the pieces that have it.
struct Found {
  std::vector<std::pair<std::size_t, const XmlElement*>> in_pieces;
};

}  // namespace

VtkXmlSharedArrays find_shared_arrays(const std::filesystem::path& path, std::span<const VtkXmlPiece> pieces,
                                      const std::string& section, std::uint64_t VtkXmlPiece::*rows,
                                      std::vector<std::string>& losses) {
  VtkXmlSharedArrays shared;
  shared.of_piece.resize(pieces.size());
  const auto first = std::ranges::find_if(pieces, [rows](const VtkXmlPiece& piece) { return piece.*rows > 0; });
  const auto first_piece = static_cast<std::size_t>(first == pieces.end() ? 0 : first - pieces.begin());
  shared.first_section = pieces[first_piece].element->child(section);

  std::map<ArrayKey, std::size_t> index_of;
  std::vector<Found> found;
  std::size_t pieces_with_rows = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (p != first_piece && pieces[p].*rows == 0) {
      continue;
    }
    ++pieces_with_rows;
    std::map<std::string, std::size_t> count_of;
    for (const XmlElement* const array : vtk_xml_arrays_of(pieces[p].element->child(section))) {
      const VtkXmlArrayType type = vtk_xml_array_type_of(path, *array);
      if (array->attribute("Name") == nullptr) {
        throw ReadError(path, array->line, "an array of <" + section + "> has no Name");
      }
      const ArrayKey key(type.name, count_of[type.name]++, static_cast<int>(type.values), static_cast<int>(type.type),
                         type.components);
      const auto [at, is_new] = index_of.emplace(key, found.size());
      if (is_new) {
        found.emplace_back();
      }
      found[at->second].in_pieces.emplace_back(p, array);
    }
  }
  for (const Found& array : found) {
    const XmlElement& element = *array.in_pieces.front().second;
    if (array.in_pieces.size() < pieces_with_rows) {
      losses.push_back("the array " + trismooth::quoted(*element.attribute("Name")) + " of <" + section + "> in line " +
                       std::to_string(element.line) +
                       " is not in every piece, or not of one type there: it is not kept and holds no vertices");
      continue;
    }
    shared.of_first.push_back(&element);
    for (const auto& [piece, place] : array.in_pieces) {
      shared.of_piece[piece].push_back(place);
    }
  }
  return shared;
}

}  // namespace trismooth
