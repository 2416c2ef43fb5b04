// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/index_view.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/mesh_size.h"

namespace trismooth {

void IndexView::require_whole_triangles(std::size_t numbers) {
  if (numbers % 3 != 0) {
    throw std::invalid_argument("triangles has " + std::to_string(numbers) + " entries, not three a triangle");
  }
}

void IndexView::check(std::size_t columns) const {
  if (columns != 3) {
    throw std::invalid_argument("triangles: " + std::to_string(columns) + " vertex numbers each, expected three");
  }
  if (first_ == nullptr && size_ > 0) {
    throw std::invalid_argument("triangles: a null pointer for " + std::to_string(size_) + " triangles");
  }
}

template <class T>
void IndexView::convert(std::int64_t vertex_count, std::vector<Triangle>& converted) const {
  converted.resize(size_);
  for (std::size_t t = 0; t < size_; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      T index;
      std::memcpy(&index,
                  first_ + static_cast<std::ptrdiff_t>(t) * triangle_stride_ +
                      static_cast<std::ptrdiff_t>(corner) * corner_stride_,
                  sizeof(T));
      if (!std::in_range<std::int32_t>(index)) {
        throw_no_such_vertex(static_cast<std::int64_t>(t), std::to_string(index), vertex_count);
      }
      converted[t][corner] = static_cast<std::int32_t>(index);
    }
  }
}

std::span<const Triangle> IndexView::triangles(std::int64_t vertex_count, std::vector<Triangle>& converted) const {
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
  const bool are_triangles = !is_wide_ && is_signed_ && triangle_stride_ == sizeof(Triangle) &&
                             corner_stride_ == sizeof(std::int32_t) &&
                             reinterpret_cast<std::uintptr_t>(first_) % alignof(Triangle) == 0;
  if (are_triangles) {
    return {reinterpret_cast<const Triangle*>(first_), size_};
  }
  if (is_wide_) {
    is_signed_ ? convert<std::int64_t>(vertex_count, converted) : convert<std::uint64_t>(vertex_count, converted);
  } else {
    is_signed_ ? convert<std::int32_t>(vertex_count, converted) : convert<std::uint32_t>(vertex_count, converted);
  }
  return converted;
}

}  // namespace trismooth
