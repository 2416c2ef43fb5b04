// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "trismooth/base/box.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/pipeline/picture/colours.h"
#include "trismooth/pipeline/picture/mesh_picture.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

class Workers;

/// What the elements of a picture are coloured by.
enum class ShownKind : std::uint8_t { metric, region, moved };

struct PictureValue {
  ShownKind kind = ShownKind::metric;
  Metric metric = Metric::shape;  ///< where it is one

  /// As on the command line.
  [[nodiscard]] std::string_view name() const;
  /// Whether elements are better or worse by it.
  [[nodiscard]] bool is_quality() const { return kind == ShownKind::metric && metric != Metric::area; }
};

/// The metric of that name, "region" or "moved". Throws std::invalid_argument, which lists all.
PictureValue picture_value_named(std::string_view name);

/// The range that amounts (areas, distances) are shown on, in the file's units.
struct AmountRange {
  double low = 0;
  double high = 0;
  bool is_logarithmic = false;
};

/// The colours of a picture's elements, as bytes: of several in one place the largest is to be seen, which is the worst
/// element (of areas the smallest, of distances the longest). Views the picture.
class ElementShades {
 public:
  static constexpr std::uint8_t nothing = 0;     ///< no element is there
  static constexpr std::uint8_t lacking = 1;     ///< the element has none of the metric
  static constexpr std::uint8_t first = 2;       ///< the best of an element that has it
  static constexpr std::uint8_t last = 102;      ///< the worst
  static constexpr std::uint8_t inverted = 103;  ///< by shape, where a metric is shown

  /// Of the mesh as it is now, or as it was before. Complexity: linear. Throws std::invalid_argument where no element
  /// has the metric, and for ShownKind::moved where nothing was smoothed. `threads`: 0 is all.
  ElementShades(const MeshPicture& picture, PictureValue value, int threads, bool before = false);

  const MeshPicture& picture() const { return picture_; }
  const PictureValue& value_shown() const { return value_; }
  const ElementList& elements() const { return elements_; }
  /// All of the elements, in the file's unit.
  const Box& box() const { return box_; }
  /// Whether it is the mesh as it was before.
  bool is_before() const { return is_before_; }
  /// Of elements of that kind; null where they have none of the metric, or it is neither good nor bad.
  const QualityScale* scale(ElementKind kind) const {
    const auto& scale = scales_[static_cast<std::size_t>(kind)];
    return scale ? &*scale : nullptr;
  }
  /// Where amounts are shown.
  const AmountRange& range() const { return range_; }
  /// Whether some of the elements are of that kind.
  bool has(ElementKind kind) const { return has_[static_cast<std::size_t>(kind)]; }

  /// A vertex where it is shown, in the file's unit.
  Point2<double> point(std::int32_t vertex) const { return points_[static_cast<std::size_t>(vertex)]; }
  /// What the element has of the metric, of the distance, or the number of its region; NaN where it has none.
  double value(std::size_t element) const;
  /// How good the element is on the scale of a metric that is a quality: 1 is ideal, inverted elements are below 0; NaN
  /// where it has none.
  double place(std::size_t element) const;
  /// Between `lacking` and `inverted`. Complexity: constant.
  std::uint8_t shade(std::size_t element) const;
  /// White where there is nothing.
  Colour colour(std::uint8_t shade) const { return colours_[shade]; }

 private:
  void look_at_elements(Workers& workers);
  void measure_area();
  void measure_moves();
  template <class Element>
  double value_of(std::size_t number, const Element& corners) const;
  template <class Element>
  std::uint8_t shade_of(std::size_t number, const Element& corners) const;
  template <class Element>
  auto points_of_element(std::size_t number, const Element& corners) const;
  double amount_place(double value) const;

  const MeshPicture& picture_;
  ElementList elements_;
  PictureValue value_;
  bool is_before_;
  std::span<const Point2<double>> points_;
  std::span<const std::uint8_t> reversed_;
  Box box_;
  LocalFrame frame_;
  BulkVector<Point2<double>> local_;  ///< points_ in the frame
  double unit_ = 1;                   ///< of the frame, for areas in the file's
  AmountRange range_;
  std::array<bool, 2> has_{};
  std::array<std::optional<QualityScale>, 2> scales_;  ///< of triangles and of quadrilaterals
  std::array<Colour, inverted + 1> colours_;
};

/// Of elements that have none of the metric.
inline constexpr Colour lacking_colour{224, 224, 224};

}  // namespace trismooth
