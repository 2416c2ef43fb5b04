// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <vtkPoints.h>

namespace trismooth {

std::size_t count_shared_places(std::span<const VtkXmlPiece> pieces, vtkPoints& points) {
  using Place = std::array<double, 3>;
  std::vector<std::pair<Place, std::size_t>> listed;  // with the piece
  vtkIdType point = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    for (std::uint64_t i = 0; i < pieces[piece].points; ++i) {
      Place place{};
      points.GetPoint(point++, place.data());
      if (std::ranges::all_of(place, [](double x) { return std::isfinite(x); })) {
        listed.emplace_back(place, piece);
      }
    }
  }
  std::ranges::sort(listed);
  std::size_t shared = 0;
  for (std::size_t begin = 0; begin < listed.size();) {
    std::size_t end = begin + 1;
    while (end < listed.size() && listed[end].first == listed[begin].first) {
      ++end;
    }
    shared += listed[begin].second != listed[end - 1].second ? 1 : 0;
    begin = end;
  }
  return shared;
}

}  // namespace trismooth
