// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_promotion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/exact_integers.h"

namespace trismooth {

bool holds_coordinates(const VtkLegacyLayout& layout, std::span<const double> points) {
  return visit_scalar_type(layout.coordinates.type, [points](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_integral_v<T>) {
      return std::ranges::all_of(points, &holds_exactly<T>);
    } else {
      return true;
    }
  });
}

VtkLegacyPromotion promote_coordinates(std::string_view bytes, const VtkLegacyLayout& layout) {
  constexpr std::string_view type = "double";
  VtkLegacyPromotion promotion{std::string(bytes.substr(0, layout.type_offset)), layout.coordinates};
  NumberSites& sites = promotion.coordinates;
  sites.type = ScalarType::float64;
  promotion.bytes += type;
  const std::size_t behind_type = layout.type_offset + layout.type_length;
  if (!layout.binary) {
    for (std::uint64_t& offset : sites.offsets) {
      offset += type.size() - layout.type_length;  // may wrap around, which adds up
    }
    promotion.bytes += bytes.substr(behind_type);
    return promotion;
  }
  // The numbers of a BINARY file stand one after the other.
  const std::size_t first = sites.offsets.empty() ? behind_type : sites.offsets.front();
  promotion.bytes += bytes.substr(behind_type, first - behind_type);
  for (std::uint64_t& offset : sites.offsets) {
    const double value = visit_scalar_type(layout.coordinates.type, [&](auto zero) {
      return static_cast<double>(load<std::endian::big, decltype(zero)>(bytes.data() + offset));
    });
    offset = promotion.bytes.size();
    const auto stored = std::bit_cast<std::array<char, sizeof(double)>>(in_byte_order<std::endian::big>(value));
    promotion.bytes.append(stored.data(), stored.size());
  }
  promotion.bytes += bytes.substr(first + sites.offsets.size() * size_of(layout.coordinates.type));
  return promotion;
}

}  // namespace trismooth
