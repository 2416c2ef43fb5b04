// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth::python {

/// An array of the caller's in memory of the host, by Python's buffer protocol: nothing is copied, and as long as this
/// lives the caller cannot change its size. Made and destroyed with the GIL.
class HostArray {
 public:
  enum class Access : std::uint8_t { read, write };

  /// `argument` is its name in messages. Raises TypeError for what is no such array or has no plain numbers of this
  /// machine's byte order, ValueError where it is to be written and cannot be.
  HostArray(nanobind::handle array, std::string argument, Access access = Access::read);
  HostArray(const HostArray&) = delete;
  HostArray& operator=(const HostArray&) = delete;
  ~HostArray();

  const std::string& argument() const { return argument_; }
  /// 'f', 'i', 'u', '?': what the numbers are.
  char kind() const { return kind_; }
  std::size_t item_size() const { return static_cast<std::size_t>(buffer_.itemsize); }
  std::size_t dimensions() const { return static_cast<std::size_t>(buffer_.ndim); }
  std::size_t extent(std::size_t dimension) const { return static_cast<std::size_t>(buffer_.shape[dimension]); }
  std::ptrdiff_t stride(std::size_t dimension) const { return buffer_.strides[dimension]; }
  std::byte* data() const { return static_cast<std::byte*>(buffer_.buf); }
  /// "(3, 2)", "int64": for messages.
  std::string shape_text() const;
  std::string type_text() const;
  /// Whether the numbers lie one behind the other, rows first.
  bool is_contiguous() const;

  [[noreturn]] void raise_value(const std::string& what) const;
  [[noreturn]] void raise_type(const std::string& what) const;

 private:
  Py_buffer buffer_{};
  std::string argument_;
  char kind_ = 0;
};

/// The array as points: two or three float64 or float32 a row. Raises otherwise.
class PointArray {
 public:
  explicit PointArray(const HostArray& array);

  std::size_t size() const { return array_.extent(0); }
  std::size_t components() const { return array_.extent(1); }
  Storage storage() const { return array_.item_size() == sizeof(float) ? Storage::float32 : Storage::float64; }
  std::size_t bytes() const { return size() * components() * array_.item_size(); }

  /// Copies the numbers, rows first, to or from memory for bytes() bytes. Linear, on all workers; needs no GIL. The
  /// copy to it answers the digest.
  std::uint64_t copy_to(std::byte* numbers, Workers& workers) const;
  void copy_from(const std::byte* numbers, Workers& workers) const;
  /// A number that is another one where one of the numbers is, and hardly ever the same where several are. Linear, on
  /// all workers; needs no GIL.
  std::uint64_t digest(Workers& workers) const;

 private:
  template <class Visit>
  std::uint64_t for_blocks(Workers& workers, const Visit& visit) const;
  template <class Visit>
  void for_numbers(std::size_t begin, std::size_t end, const Visit& visit) const;

  const HostArray& array_;
};

/// The rows of `numbers`, which lie as PointArray::copy_to() gives them.
PointView packed_points(std::byte* numbers, std::size_t size, std::size_t components, Storage storage);

/// Raises TypeError for an array of integers, of the host or of a device, whose type has no room for no_corner.
template <class Array>
void require_no_corner(const Array& array) {
  if (array.kind() == 'u' && array.item_size() < sizeof(std::uint32_t)) {
    array.raise_type(
        "unsigned integers of 8 or 16 bits have no -1, which is behind the last one of a triangle: int32 has");
  }
}

/// Vertex numbers of elements, of any integer type, as the library takes them: three of triangles; four of triangles
/// and quadrilaterals, -1 behind those of a triangle; six of triangles with middles; eight or nine of any of these,
/// with -1 behind them (see ElementNodes).
class TriangleArray {
 public:
  /// Raises for another shape or type. Views the array, or copies it where its numbers are of a type, or lie in a way,
  /// that IndexView does not take.
  explicit TriangleArray(const HostArray& array);

  std::size_t size() const { return size_; }
  std::size_t nodes() const { return nodes_; }
  /// Whether some may have nodes in the middle of their sides.
  bool may_have_middles() const { return has_middles_; }
  /// Corners: of triangles of six nodes the first three; four where quadrilaterals may be among them.
  IndexView corners() const;
  /// All numbers, where there may be middles. Throws MeshError for one that is none of the vertices and has no place in
  /// 32 bits.
  std::vector<ElementNodes> element_nodes(std::int64_t vertex_count) const;

 private:
  void copy_unless_taken(const HostArray& array);
  template <class Visit>
  auto with_rows(const Visit& visit) const;
  template <class Visit>
  void for_each_row(const Visit& visit) const;

  std::size_t size_;
  std::size_t nodes_;
  bool has_middles_ = false;
  const std::byte* first_;
  std::ptrdiff_t row_stride_;
  std::ptrdiff_t column_stride_;
  bool is_wide_;
  bool is_signed_;
  std::vector<std::int64_t> copied_;
  std::vector<std::int64_t> corners_;  ///< four of each, where there are eight or nine numbers
};

/// One flag a vertex, from an array of bool for each vertex or from vertex numbers. Empty for None. Raises ValueError
/// for numbers out of range.
std::vector<std::uint8_t> vertex_flags(nanobind::handle array, const std::string& argument, std::size_t vertex_count);

/// The integers of an array of one dimension and `count` of them, one for each `of_what`, as int32. Empty for None.
/// Raises where they are of another type, number, or do not fit.
std::vector<std::int32_t> integers(nanobind::handle array, const std::string& argument, std::size_t count,
                                   const char* of_what);

/// The vertex numbers of an array of integers of shape (K, 2), pair by pair. Empty for None. Raises for another type or
/// shape and for numbers out of range.
std::vector<std::int32_t> vertex_pairs(nanobind::handle array, const std::string& argument, std::size_t vertex_count);

/// The numbers of an array of float of one dimension and `count` of them. Empty for None.
std::vector<double> reals(nanobind::handle array, const std::string& argument, std::size_t count);

}  // namespace trismooth::python
