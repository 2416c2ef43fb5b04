// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/index_view.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/base/mesh_size.h"

namespace trismooth {

void IndexView::require_whole_triangles(std::size_t numbers) {
  if (numbers % 3 != 0) {
    throw std::invalid_argument("triangles has " + std::to_string(numbers) + " entries, not three a triangle");
  }
}

void IndexView::check() const {
  if (columns_ != 3 && columns_ != 4) {
    throw std::invalid_argument("triangles: " + std::to_string(columns_) +
                                " vertex numbers each, expected three or four");
  }
  if (first_ == nullptr && size_ > 0) {
    throw std::invalid_argument("triangles: a null pointer for " + std::to_string(size_) + " triangles");
  }
}

template <class T, class Corners>
void IndexView::convert(std::int64_t vertex_count, std::vector<Corners>& converted) const {
  converted.resize(size_);
  for (std::size_t e = 0; e < size_; ++e) {
    for (std::size_t corner = 0; corner < columns_; ++corner) {
      T index;
      std::memcpy(&index,
                  first_ + static_cast<std::ptrdiff_t>(e) * element_stride_ +
                      static_cast<std::ptrdiff_t>(corner) * corner_stride_,
                  sizeof(T));
      const bool is_none = corner == 3 && index == static_cast<T>(no_corner);
      if (!is_none && !std::in_range<std::int32_t>(index)) {
        throw_no_such_vertex(static_cast<std::int64_t>(e), std::to_string(index), vertex_count,
                             columns_ == 3 ? "triangle" : "element");
      }
      converted[e][corner] = static_cast<std::int32_t>(index);
    }
  }
}

template <class Corners>
ElementList IndexView::listed(std::int64_t vertex_count, OwnElements& converted) const {
  static_assert(sizeof(Corners) == std::tuple_size_v<Corners> * sizeof(std::int32_t));
  const bool is_as_it_is = !is_wide_ && is_signed_ && element_stride_ == sizeof(Corners) &&
                           corner_stride_ == sizeof(std::int32_t) &&
                           reinterpret_cast<std::uintptr_t>(first_) % alignof(Corners) == 0;
  if (is_as_it_is) {
    return std::span(reinterpret_cast<const Corners*>(first_), size_);
  }
  std::vector<Corners> all;
  if (is_wide_) {
    is_signed_ ? convert<std::int64_t>(vertex_count, all) : convert<std::uint64_t>(vertex_count, all);
  } else {
    is_signed_ ? convert<std::int32_t>(vertex_count, all) : convert<std::uint32_t>(vertex_count, all);
  }
  converted = std::move(all);
  return converted.list();
}

ElementList IndexView::list(std::int64_t vertex_count, OwnElements& converted) const {
  return columns_ == 3 ? listed<Triangle>(vertex_count, converted) : listed<MixedElement>(vertex_count, converted);
}

OwnElements own_elements(const IndexView& indices, std::int64_t vertex_count) {
  OwnElements own;
  own.keep(indices.list(vertex_count, own));
  return own;
}

}  // namespace trismooth
