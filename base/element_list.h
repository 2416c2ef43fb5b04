// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// The elements of a mesh as they are listed: all of them as Triangle, or all as MixedElement. A view; the caller owns
/// them. Code that asks for corners one element after the other takes it as a range of spans of three or four corners;
/// code that is compiled for each list goes by visit().
class ElementList {
  class Iterator;

 public:
  /// None.
  ElementList() = default;
  /// Triangles.
  ElementList(std::span<const Triangle> triangles) : triangles_(triangles) {}
  /// Elements of either kind.
  ElementList(std::span<const MixedElement> elements) : mixed_(elements), is_mixed_(true) {}
  /// Triangles of a vector that stays as it is.
  ElementList(const std::vector<Triangle>& triangles) : triangles_(triangles) {}
  /// Elements of either kind of a vector that stays as it is.
  ElementList(const std::vector<MixedElement>& elements) : mixed_(elements), is_mixed_(true) {}

  /// How many there are.
  [[nodiscard]] std::size_t size() const { return is_mixed_ ? mixed_.size() : triangles_.size(); }
  /// Whether there are none.
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Whether they are listed as Triangle; else quadrilaterals may be among them.
  [[nodiscard]] bool are_triangles() const { return !is_mixed_; }

  /// The corners of one, in turn: three or four.
  std::span<const std::int32_t> operator[](std::size_t element) const {
    return is_mixed_ ? std::span<const std::int32_t>(mixed_[element])
                           .first(static_cast<std::size_t>(corner_count(mixed_[element])))
                     : std::span<const std::int32_t>(triangles_[element]);
  }
  /// The first one; while the list is there. Gives the corners of each.
  [[nodiscard]] Iterator begin() const;
  /// Behind the last one.
  [[nodiscard]] Iterator end() const;

  /// How many are quadrilaterals. Complexity: linear.
  [[nodiscard]] std::int64_t count_quadrilaterals() const {
    return std::ranges::count_if(mixed_, [](const MixedElement& element) { return element[3] != no_corner; });
  }

  /// All of them, where they are listed so.
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  /// All of them, where they are listed so, as Triangle or as MixedElement; else none.
  template <class Corners>
  [[nodiscard]] std::span<const Corners> as() const {
    if constexpr (std::same_as<Corners, Triangle>) {
      return triangles_;
    } else {
      return mixed_;
    }
  }

  /// What body() returns of the list: a std::span of Triangle, or of MixedElement.
  template <class Body>
  decltype(auto) visit(const Body& body) const {
    return is_mixed_ ? body(mixed_) : body(triangles_);
  }

 private:
  std::span<const Triangle> triangles_;
  std::span<const MixedElement> mixed_;
  bool is_mixed_ = false;
};

/// Goes over a list.
class ElementList::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = std::span<const std::int32_t>;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = value_type;

  /// At that element of the list, or behind its last.
  Iterator(const ElementList& elements, std::size_t element) : elements_(&elements), element_(element) {}
  std::span<const std::int32_t> operator*() const { return (*elements_)[element_]; }
  Iterator& operator++() {
    ++element_;
    return *this;
  }
  Iterator operator++(int) {
    Iterator before = *this;
    ++element_;
    return before;
  }
  bool operator==(const Iterator& other) const { return element_ == other.element_; }

 private:
  const ElementList* elements_;
  std::size_t element_;
};

inline ElementList::Iterator ElementList::begin() const {
  return {*this, 0};
}
inline ElementList::Iterator ElementList::end() const {
  return {*this, size()};
}

/// The elements of a mesh in memory of its own, listed all as Triangle or all as MixedElement.
class OwnElements {
 public:
  /// None.
  OwnElements() = default;
  /// These triangles.
  OwnElements(std::vector<Triangle> triangles) : listed_(std::move(triangles)) {}
  /// These elements of either kind.
  OwnElements(std::vector<MixedElement> elements) : listed_(std::move(elements)) {}
  /// A copy of what is listed, as it is listed. Complexity: linear.
  explicit OwnElements(const ElementList& elements) {
    elements.visit([this]<class Corners>(std::span<const Corners> listed) {
      listed_.template emplace<std::vector<Corners>>(listed.begin(), listed.end());
    });
  }

  /// They, while this is there and stays as it is.
  [[nodiscard]] ElementList list() const {
    return std::visit([](const auto& listed) { return ElementList(listed); }, listed_);
  }
  /// Makes these its own: a copy, where they are not yet. Complexity: linear, or constant.
  void keep(const ElementList& elements) {
    const bool are_own = elements.are_triangles() == list().are_triangles() &&
                         elements.visit([this]<class Corners>(std::span<const Corners> listed) {
                           return list().template as<Corners>().data() == listed.data();
                         });
    if (!are_own) {
      *this = OwnElements(elements);
    }
  }

  /// Has memory for so many.
  void reserve(std::size_t count) {
    std::visit([count](auto& listed) { listed.reserve(count); }, listed_);
  }
  /// Lists one more element of either kind. They are listed as Triangle until the first quadrilateral comes.
  /// Complexity: constant on the average; once linear.
  void append(const MixedElement& element);
  /// A triangle.
  void append(const Triangle& triangle);

 private:
  std::variant<std::vector<Triangle>, std::vector<MixedElement>> listed_;
};

/// The elements listed as Corners: those that are there where they are, else a copy in `converted`, which keeps it.
/// What `converted` had may be what is copied. Listed as Triangle, none may be a quadrilateral. Complexity: constant,
/// or linear.
template <class Corners>
std::span<const Corners> listed_as(const ElementList& elements, OwnElements& converted) {
  return elements.visit([&]<class Listed>(std::span<const Listed> listed) -> std::span<const Corners> {
    if constexpr (std::same_as<Listed, Corners>) {
      return listed;
    } else {
      std::vector<Corners> all(listed.size());
      std::ranges::transform(listed, all.begin(), [](const Listed& element) {
        Corners corners{};
        corners.back() = no_corner;
        std::copy_n(element.begin(), 3, corners.begin());
        return corners;
      });
      converted = OwnElements(std::move(all));
      return converted.list().template as<Corners>();
    }
  });
}

/// The elements listed as Triangle where all of them are triangles, else as they are. `converted` as above. Complexity:
/// constant, or linear.
inline ElementList as_triangles_where_all_are(const ElementList& elements, OwnElements& converted) {
  return elements.are_triangles() || elements.count_quadrilaterals() > 0
             ? elements
             : ElementList(listed_as<Triangle>(elements, converted));
}

inline void OwnElements::append(const MixedElement& element) {
  if (auto* const triangles = std::get_if<std::vector<Triangle>>(&listed_)) {
    if (element[3] == no_corner) {
      triangles->push_back({element[0], element[1], element[2]});
      return;
    }
    const std::size_t capacity = triangles->capacity();
    listed_as<MixedElement>(list(), *this);
    reserve(capacity);
  }
  std::get<std::vector<MixedElement>>(listed_).push_back(element);
}

inline void OwnElements::append(const Triangle& triangle) {
  if (auto* const triangles = std::get_if<std::vector<Triangle>>(&listed_)) {
    triangles->push_back(triangle);
  } else {
    std::get<std::vector<MixedElement>>(listed_).push_back(as_mixed(triangle));
  }
}

/// The corner behind corner i of an element, in turn.
inline std::int32_t next_corner(std::span<const std::int32_t> corners, std::size_t i) {
  return corners[i + 1 < corners.size() ? i + 1 : 0];
}
/// The corner before corner i of an element, in turn.
inline std::int32_t previous_corner(std::span<const std::int32_t> corners, std::size_t i) {
  return corners[i > 0 ? i - 1 : corners.size() - 1];
}

/// The elements of one mesh for evaluation, of whichever kinds. All views; the caller owns.
struct MeshView {
  std::span<const Point2<double>> points;    ///< in the local frame
  ElementList elements;                      ///< corners within points, in the order of the file
  std::span<const std::uint8_t> reversed{};  ///< 1 where the element is listed clockwise relative to the positive
                                             ///< orientation of its component; empty: none is
  int exponent = 0;                          ///< of the local frame: lengths in the file are local * 2^exponent

  /// No mesh.
  MeshView() = default;
  /// Elements of either kind over these points, which have room for all their corners.
  MeshView(std::span<const Point2<double>> all_points, const ElementList& all_elements,
           std::span<const std::uint8_t> are_reversed = {}, int frame_exponent = 0)
      : points(all_points), elements(all_elements), reversed(are_reversed), exponent(frame_exponent) {}
  /// Triangles.
  MeshView(const TriangleView& view)
      : points(view.points), elements(view.elements), reversed(view.reversed), exponent(view.exponent) {}

  /// What body() returns of an ElementView: of Triangle, or of MixedElement with triangles among them.
  template <class Body>
  decltype(auto) visit(const Body& body) const {
    return elements.visit([&]<class Corners>(std::span<const Corners> listed) -> decltype(auto) {
      return body(ElementView<Corners>{points, listed, reversed, exponent});
    });
  }
};

}  // namespace trismooth
