// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/host_array.h"

#include <atomic>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trismooth/base/mesh_size.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/text.h"

namespace nb = nanobind;

namespace trismooth::python {

namespace {

/// 'f', 'i', 'u', '?' for the format of a buffer of single numbers, 0 for any other. See Python's module struct.
char kind_of(const char* format) {
  std::string_view code = format == nullptr ? "B" : format;
  if (!code.empty() && (code.front() == '@' || code.front() == '=' || code.front() == '<')) {
    code.remove_prefix(1);
  }
  if (code.size() != 1) {
    return 0;
  }
  const auto is_one_of = [&code](std::string_view codes) { return codes.find(code.front()) != std::string_view::npos; };
  return is_one_of("efdg") ? 'f' : is_one_of("bhilqn") ? 'i' : is_one_of("BHILQN") ? 'u' : code == "?" ? '?' : 0;
}

template <class T>
T number_at(const std::byte* place) {
  T number;
  std::memcpy(&number, place, sizeof(T));
  return number;
}

/// Calls visit(T{}) with T the type of integers of that kind and size.
template <class Visit>
void with_integer_type(char kind, std::size_t size, const Visit& visit) {
  const bool is_signed = kind == 'i';
  switch (size) {
    case 1:
      is_signed ? visit(std::int8_t{}) : visit(std::uint8_t{});
      break;
    case 2:
      is_signed ? visit(std::int16_t{}) : visit(std::uint16_t{});
      break;
    case 4:
      is_signed ? visit(std::int32_t{}) : visit(std::uint32_t{});
      break;
    default:
      is_signed ? visit(std::int64_t{}) : visit(std::uint64_t{});
      break;
  }
}

/// Calls visit(i, number) for the integers of an array of one dimension.
template <class Visit>
void for_integers(const HostArray& array, const Visit& visit) {
  with_integer_type(array.kind(), array.item_size(), [&]<class T>(T) {
    for (std::size_t i = 0; i < array.extent(0); ++i) {
      visit(i, number_at<T>(array.data() + static_cast<std::ptrdiff_t>(i) * array.stride(0)));
    }
  });
}

void require_list(const HostArray& array, std::size_t count, const char* of_what) {
  if (array.dimensions() != 1 || array.extent(0) != count) {
    array.raise_value("shape " + array.shape_text() + "; expected (" + std::to_string(count) + ",), one for each " +
                      of_what);
  }
}

/// A sum over the words of an array, each with the odd number of its place: another word at one place changes it.
/// Blocks of an array may be summed in any order.
class Digest {
 public:
  /// Adds the number of `size` bytes, 4 or 8, that begins so many bytes behind the first.
  void add(const std::byte* number, std::size_t offset, std::size_t size) {
    const std::uint64_t word =
        size == sizeof(std::uint64_t) ? number_at<std::uint64_t>(number) : number_at<std::uint32_t>(number);
    const std::uint64_t factor = first_factor + offset * step;
    sum_ += (word ^ factor) * factor;
  }
  std::uint64_t value() const { return sum_; }

 private:
  static constexpr std::uint64_t first_factor = 0xbf58476d1ce4e5b9;
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c16;  // even: factors stay odd

  std::uint64_t sum_ = 0;
};

/// What helps where rows and columns are the other way round, as scikit-fem has them; else nothing.
std::string transposed(const HostArray& array, const char* name, std::size_t rows) {
  const bool may_be = array.dimensions() == 2 && (array.extent(0) == rows || array.extent(0) == 3);
  return may_be ? std::string("; ") + name + ".T has them so" : std::string();
}

bool is_integer(const HostArray& array) {
  return array.kind() == 'i' || array.kind() == 'u';
}

/// Raises ValueError unless the number is that of a vertex.
template <class T>
void require_vertex(const HostArray& array, T number, std::size_t vertex_count) {
  if (!std::in_range<std::int64_t>(number) || std::cmp_less(number, 0) ||
      std::cmp_greater_equal(number, vertex_count)) {
    array.raise_value("vertex " + std::to_string(number) + " is not one of the " + std::to_string(vertex_count) +
                      " vertices");
  }
}

/// Raises TypeError for numbers that are 0 and 1 alone and as many as vertices: what was meant is a mask.
void require_no_mask(const HostArray& array, std::size_t vertex_count) {
  bool is_mask = array.extent(0) == vertex_count && vertex_count > 2;
  for_integers(array, [&is_mask](std::size_t, auto number) { is_mask = is_mask && (number == 0 || number == 1); });
  if (is_mask) {
    array.raise_type("0 and 1 for each vertex; say whether vertices are flagged (bool) or numbered");
  }
}

}  // namespace

HostArray::HostArray(nb::handle array, std::string argument, Access access) : argument_(std::move(argument)) {
  const int flags = PyBUF_FORMAT | PyBUF_STRIDES | (access == Access::write ? PyBUF_WRITABLE : 0);
  if (PyObject_GetBuffer(array.ptr(), &buffer_, flags) != 0) {
    const nb::python_error error;
    if (access == Access::write && PyObject_CheckBuffer(array.ptr()) != 0) {
      raise_value_error(argument_, "cannot be written: it is read-only");
    }
    raise_type_error(argument_, std::string("an array is needed, not ") + nb::inst_name(array).c_str());
  }
  kind_ = kind_of(buffer_.format);
  if (kind_ == 0) {
    const std::string format = buffer_.format;
    PyBuffer_Release(&buffer_);
    raise_type_error(argument_, "its elements are no plain numbers of this machine (format '" + format + "')");
  }
}

HostArray::~HostArray() {
  PyBuffer_Release(&buffer_);
}

std::string HostArray::shape_text() const {
  return shape_text_of(*this);
}

std::string HostArray::type_text() const {
  return type_text_of(*this, kind_);
}

bool HostArray::is_contiguous() const {
  return PyBuffer_IsContiguous(&buffer_, 'C') != 0;
}

void HostArray::raise_value(const std::string& what) const {
  raise_value_error(argument_, what);
}

void HostArray::raise_type(const std::string& what) const {
  raise_type_error(argument_, what);
}

PointArray::PointArray(const HostArray& array) : array_(array) {
  if (array.kind() != 'f' || (array.item_size() != sizeof(float) && array.item_size() != sizeof(double))) {
    array.raise_type("float64 or float32 is needed, not " + array.type_text());
  }
  if (array.dimensions() != 2 || (array.extent(1) != 2 && array.extent(1) != 3)) {
    array.raise_value("shape " + array.shape_text() + "; expected (N, 2) or (N, 3), a vertex a row" +
                      transposed(array, "points", 2));
  }
}

/// Calls visit(number in the array, its place among packed ones in bytes, its size as a constant) for every number of
/// the rows.
template <class Visit>
void PointArray::for_numbers(std::size_t begin, std::size_t end, const Visit& visit) const {
  const auto for_size = [&](auto size) {
    std::size_t place = begin * components() * size;
    for (std::size_t v = begin; v < end; ++v) {
      std::byte* const row = array_.data() + static_cast<std::ptrdiff_t>(v) * array_.stride(0);
      for (std::size_t k = 0; k < components(); ++k) {
        visit(row + static_cast<std::ptrdiff_t>(k) * array_.stride(1), place, size);
        place += size;
      }
    }
  };
  if (storage() == Storage::float32) {
    for_size(std::integral_constant<std::size_t, sizeof(float)>{});
  } else {
    for_size(std::integral_constant<std::size_t, sizeof(double)>{});
  }
}

/// Calls visit(begin, end) for blocks of rows, on all workers, and sums up what it answers.
template <class Visit>
std::uint64_t PointArray::for_blocks(Workers& workers, const Visit& visit) const {
  constexpr std::int64_t grain = 32768;
  std::atomic<std::uint64_t> sum{0};
  workers.for_blocks(static_cast<std::int64_t>(size()), grain, [&](std::int64_t begin, std::int64_t end) {
    sum += visit(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
  });
  return sum;
}

std::uint64_t PointArray::copy_to(std::byte* numbers, Workers& workers) const {
  return for_blocks(workers, [&](std::size_t begin, std::size_t end) {
    Digest digest;
    for_numbers(begin, end, [&](const std::byte* from, std::size_t to, auto size) {
      std::memcpy(numbers + to, from, size);
      digest.add(numbers + to, to, size);
    });
    return digest.value();
  });
}

void PointArray::copy_from(const std::byte* numbers, Workers& workers) const {
  for_blocks(workers, [&](std::size_t begin, std::size_t end) {
    for_numbers(begin, end,
                [numbers](std::byte* to, std::size_t from, auto size) { std::memcpy(to, numbers + from, size); });
    return std::uint64_t{0};
  });
}

std::uint64_t PointArray::digest(Workers& workers) const {
  return for_blocks(workers, [&](std::size_t begin, std::size_t end) {
    Digest digest;
    for_numbers(begin, end,
                [&digest](const std::byte* number, std::size_t place, auto size) { digest.add(number, place, size); });
    return digest.value();
  });
}

PointView packed_points(std::byte* numbers, std::size_t size, std::size_t components, Storage storage) {
  const auto rows = [&]<class T>(T* first) {
    return PointView(
        NumberRows<T>{first, size, components, static_cast<std::ptrdiff_t>(components * sizeof(T)), sizeof(T)});
  };
  return storage == Storage::float32 ? rows(reinterpret_cast<float*>(numbers))
                                     : rows(reinterpret_cast<double*>(numbers));
}

namespace {

/// -1, or of unsigned numbers the largest.
template <class T>
bool is_no_corner(T number) {
  return number == static_cast<T>(no_corner);
}

}  // namespace

TriangleArray::TriangleArray(const HostArray& array)
    : first_(array.data()), is_wide_(array.item_size() == sizeof(std::int64_t)), is_signed_(array.kind() == 'i') {
  if (array.dimensions() == 1 && array.extent(0) == 0) {
    size_ = 0;  // an empty list
    nodes_ = 3;
    row_stride_ = 3 * sizeof(std::int64_t);
    column_stride_ = sizeof(std::int64_t);
    is_wide_ = true;
    is_signed_ = true;
    return;
  }
  if (!is_integer(array)) {
    array.raise_type("integers are needed, not " + array.type_text());
  }
  if (array.dimensions() != 2 || corners_of_nodes(array.extent(1)) == 0) {
    array.raise_value("shape " + array.shape_text() +
                      "; expected (M, 3), (M, 4) with quadrilaterals, (M, 6) for triangles of six nodes, or (M, 8) "
                      "or (M, 9) with quadrilaterals of eight or nine" +
                      transposed(array, "triangles", 3));
  }
  if (array.extent(1) != 3 && array.extent(1) != 6) {
    require_no_corner(array);
  }
  size_ = array.extent(0);
  nodes_ = array.extent(1);
  row_stride_ = array.stride(0);
  column_stride_ = array.stride(1);
  copy_unless_taken(array);
  has_middles_ = nodes_ == 6;
  if (nodes_ > 6) {
    corners_.reserve(4 * size_);
    for_each_row([&](std::size_t element, const auto& number) {
      std::size_t count = 0;
      while (count < nodes_ && !is_no_corner(number(count))) {
        ++count;
      }
      std::size_t behind = count;
      while (behind < nodes_ && is_no_corner(number(behind))) {
        ++behind;
      }
      const std::size_t corners = corners_of_nodes(count);
      if (corners == 0 || behind < nodes_) {
        throw MeshError("triangles: " + no_element_text(element, count));
      }
      has_middles_ = has_middles_ || count != corners;
      for (std::size_t k = 0; k < 4; ++k) {
        corners_.push_back(k < corners ? static_cast<std::int64_t>(number(k)) : no_corner);
      }
    });
  }
}

void TriangleArray::copy_unless_taken(const HostArray& array) {
  const auto size = static_cast<std::ptrdiff_t>(array.item_size());
  const bool is_aligned = reinterpret_cast<std::uintptr_t>(first_) % array.item_size() == 0 &&
                          row_stride_ % size == 0 && column_stride_ % size == 0;
  if (array.item_size() >= sizeof(std::int32_t) && is_aligned) {
    return;
  }
  copied_.reserve(size_ * nodes_);
  with_integer_type(array.kind(), array.item_size(), [&]<class T>(T) {
    for (std::size_t t = 0; t < size_; ++t) {
      for (std::size_t k = 0; k < nodes_; ++k) {
        copied_.push_back(static_cast<std::int64_t>(number_at<T>(first_ + static_cast<std::ptrdiff_t>(t) * row_stride_ +
                                                                 static_cast<std::ptrdiff_t>(k) * column_stride_)));
      }
    }
  });
  first_ = reinterpret_cast<const std::byte*>(copied_.data());
  column_stride_ = sizeof(std::int64_t);
  row_stride_ = static_cast<std::ptrdiff_t>(nodes_ * sizeof(std::int64_t));
  is_wide_ = true;
  is_signed_ = true;
}

/// visit(rows) with the rows of the numbers' own type.
template <class Visit>
auto TriangleArray::with_rows(const Visit& visit) const {
  const auto rows = [this]<class T>(const T* first) {
    return NumberRows<const T>{first, size_, nodes_, row_stride_, column_stride_};
  };
  if (is_wide_) {
    return is_signed_ ? visit(rows(reinterpret_cast<const std::int64_t*>(first_)))
                      : visit(rows(reinterpret_cast<const std::uint64_t*>(first_)));
  }
  return is_signed_ ? visit(rows(reinterpret_cast<const std::int32_t*>(first_)))
                    : visit(rows(reinterpret_cast<const std::uint32_t*>(first_)));
}

/// visit(element, number) for each, where number(k) is its k-th one.
template <class Visit>
void TriangleArray::for_each_row(const Visit& visit) const {
  with_rows([&]<class T>(const NumberRows<const T>& rows) {
    for (std::size_t e = 0; e < rows.rows; ++e) {
      const std::byte* const row =
          reinterpret_cast<const std::byte*>(rows.first) + static_cast<std::ptrdiff_t>(e) * rows.row_stride;
      visit(e, [&](std::size_t k) {
        return *reinterpret_cast<const T*>(row + static_cast<std::ptrdiff_t>(k) * rows.column_stride);
      });
    }
    return 0;
  });
}

IndexView TriangleArray::corners() const {
  if (nodes_ > 6) {
    return IndexView(
        NumberRows<const std::int64_t>{corners_.data(), size_, 4, 4 * sizeof(std::int64_t), sizeof(std::int64_t)});
  }
  return with_rows([](auto rows) {
    rows.columns = rows.columns == 4 ? 4 : 3;
    return IndexView(rows);
  });
}

std::vector<ElementNodes> TriangleArray::element_nodes(std::int64_t vertex_count) const {
  std::vector<ElementNodes> elements(size_);
  for_each_row([&](std::size_t e, const auto& number) {
    elements[e].fill(no_corner);
    for (std::size_t k = 0; k < nodes_; ++k) {
      const auto node = number(k);
      if (!is_no_corner(node) && !std::in_range<std::int32_t>(node)) {
        throw_no_such_vertex(static_cast<std::int64_t>(e), std::to_string(node), vertex_count);
      }
      elements[e][k] = is_no_corner(node) ? no_corner : static_cast<std::int32_t>(node);
    }
  });
  return elements;
}

std::vector<std::uint8_t> vertex_flags(nb::handle object, const std::string& argument, std::size_t vertex_count) {
  if (object.is_none()) {
    return {};
  }
  const HostArray array(object, argument);
  if (array.dimensions() != 1) {
    array.raise_value("shape " + array.shape_text() +
                      "; expected one dimension: a bool for each vertex, or vertex numbers");
  }
  std::vector<std::uint8_t> flags(vertex_count, 0);
  if (array.extent(0) == 0 && array.kind() != '?') {
    return flags;  // of an empty list the type says nothing
  }
  if (array.kind() == '?') {
    require_list(array, vertex_count, "vertex");
    for (std::size_t v = 0; v < vertex_count; ++v) {
      flags[v] = number_at<std::uint8_t>(array.data() + static_cast<std::ptrdiff_t>(v) * array.stride(0)) != 0 ? 1 : 0;
    }
  } else if (is_integer(array)) {
    require_no_mask(array, vertex_count);
    for_integers(array, [&](std::size_t, auto number) {
      require_vertex(array, number, vertex_count);
      flags[static_cast<std::size_t>(number)] = 1;
    });
  } else {
    array.raise_type("bool for each vertex or integers, vertex numbers, are needed, not " + array.type_text());
  }
  return flags;
}

std::vector<std::int32_t> integers(nb::handle object, const std::string& argument, std::size_t count,
                                   const char* of_what) {
  if (object.is_none()) {
    return {};
  }
  const HostArray array(object, argument);
  if (!is_integer(array)) {
    array.raise_type("integers are needed, not " + array.type_text());
  }
  require_list(array, count, of_what);
  std::vector<std::int32_t> numbers(count);
  for_integers(array, [&](std::size_t i, auto number) {
    if (!std::in_range<std::int32_t>(number)) {
      array.raise_value("the number " + std::to_string(number) + " has no place in 32 bits");
    }
    numbers[i] = static_cast<std::int32_t>(number);  // NOLINT(bugprone-signed-char-misuse): int8 are numbers here
  });
  return numbers;
}

std::vector<std::int32_t> vertex_pairs(nb::handle object, const std::string& argument, std::size_t vertex_count) {
  if (object.is_none()) {
    return {};
  }
  const HostArray array(object, argument);
  if (array.dimensions() == 1 && array.extent(0) == 0) {
    return {};  // an empty list
  }
  if (!is_integer(array)) {
    array.raise_type("integers are needed, not " + array.type_text());
  }
  if (array.dimensions() != 2 || array.extent(1) != 2) {
    array.raise_value("shape " + array.shape_text() + "; expected (K, 2), two vertex numbers a row");
  }
  std::vector<std::int32_t> numbers;
  numbers.reserve(2 * array.extent(0));
  with_integer_type(array.kind(), array.item_size(), [&]<class T>(T) {
    for (std::size_t i = 0; i < array.extent(0); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto number = number_at<T>(array.data() + static_cast<std::ptrdiff_t>(i) * array.stride(0) +
                                         static_cast<std::ptrdiff_t>(end) * array.stride(1));
        require_vertex(array, number, vertex_count);
        numbers.push_back(static_cast<std::int32_t>(number));
      }
    }
  });
  return numbers;
}

std::vector<double> reals(nb::handle object, const std::string& argument, std::size_t count) {
  if (object.is_none()) {
    return {};
  }
  const HostArray array(object, argument);
  if (array.kind() != 'f' || (array.item_size() != sizeof(float) && array.item_size() != sizeof(double))) {
    array.raise_type("float64 or float32 is needed, not " + array.type_text());
  }
  require_list(array, count, "vertex");
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* const place = array.data() + static_cast<std::ptrdiff_t>(i) * array.stride(0);
    numbers[i] =
        array.item_size() == sizeof(float) ? static_cast<double>(number_at<float>(place)) : number_at<double>(place);
  }
  return numbers;
}

}  // namespace trismooth::python
