// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

namespace trismooth::python {

/// A NumPy array of that shape that owns `values`, rows first. `Element`: what NumPy is told that they are, of the same
/// size. Constant time.
template <class Element, std::size_t dimensions, class T>
nanobind::object new_array(std::vector<T> values, const std::array<std::size_t, dimensions>& shape) {
  static_assert(sizeof(T) % sizeof(Element) == 0);
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  void* const first = kept->data();
  const nanobind::capsule owner(kept.release(), [](void* memory) noexcept {
    const std::unique_ptr<std::vector<T>> gone(static_cast<std::vector<T>*>(memory));
  });
  return nanobind::cast(nanobind::ndarray<nanobind::numpy, Element>(first, dimensions, shape.data(), owner));
}

}  // namespace trismooth::python
