// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/still_picture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/picture/plane_view.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr double still_edge_width = 0.8;
constexpr double still_line_width = 2;
/// Edges of elements whose mean edge is so long begin to be seen, and are seen as they are.
constexpr double faint_edge = 6;
constexpr double full_edge = 12;
constexpr double edge_strength = 0.75;

/// Of several threads that write, the largest value is left, whoever comes first.
inline void raise(std::uint8_t& byte, std::uint8_t value) {
  const std::atomic_ref shared(byte);
  std::uint8_t found = shared.load(std::memory_order_relaxed);
  while (value > found && !shared.compare_exchange_weak(found, value, std::memory_order_relaxed)) {
  }
}

/// The part from `first` to `second` of a line, from 0 to 1, that is between `low` and `high` along one axis.
void narrow(double from, double to, double low, double high, double& first, double& second) {
  if (from == to) {
    second = from < low || from > high ? -1 : second;
    return;
  }
  const double a = (low - from) / (to - from);
  const double b = (high - from) / (to - from);
  first = std::max(first, std::min(a, b));
  second = std::min(second, std::max(a, b));
}

/// Bytes for the pixels of a picture.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width), height_(height), bytes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  const Pixels& bytes() const { return bytes_; }

  /// The pixels whose middle is inside. Whether there are any.
  template <std::size_t count>
  bool fill(const std::array<Point2<double>, count>& corners, const Box& box, std::uint8_t value) {
    const int end = pixel_from(box.high.y, height_);
    const int first = pixel_from(box.low.y, height_);
    const int left = pixel_from(box.low.x, width_);
    const int columns = pixel_from(box.high.x, width_) - left;
    if (first == end || columns == 0) {
      return false;
    }
    bool has_any = false;
    if constexpr (count == 3) {
      constexpr int few = 4;
      if (columns * (end - first) <= few) {  // (Sooner asked one by one.)
        for (int row = first; row < end; ++row) {
          for (int column = left; column < left + columns; ++column) {
            if (is_inside(corners, {column + 0.5, row + 0.5})) {
              raise(at(column, row), value);
              has_any = true;
            }
          }
        }
        return has_any;
      }
    }
    for (int row = first; row < end; ++row) {
      std::array<double, 4> crossings{};
      const std::size_t found = crossings_of(corners, row + 0.5, crossings);
      for (std::size_t i = 0; i + 1 < found; i += 2) {
        const int right = pixel_from(crossings[i + 1], width_);
        for (int column = pixel_from(crossings[i], width_); column < right; ++column) {
          raise(at(column, row), value);
          has_any = true;
        }
      }
    }
    return has_any;
  }

  /// The pixel of that place, if it is on the canvas.
  void mark(Point2<double> place, std::uint8_t value) {
    if (place.x >= 0 && place.x < width_ && place.y >= 0 && place.y < height_) {
      raise(at(static_cast<int>(place.x), static_cast<int>(place.y)), value);
    }
  }

  /// Every pixel that it comes through, but for some of those that it cuts a corner of.
  void mark_thin(Point2<double> from, Point2<double> to, std::uint8_t value) {
    if (!clip(from, to, 0)) {
      return;
    }
    // (Less than a pixel from one to the next, whatever is rounded.)
    const Point2<double> along = to - from;
    const int steps = static_cast<int>(std::max(std::abs(along.x), std::abs(along.y))) + 1;
    const double part = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
      raise(at(within(from.x + i * part * along.x, width_), within(from.y + i * part * along.y, height_)), value);
    }
    raise(at(within(to.x, width_), within(to.y, height_)), value);
  }

  /// A line whose rims are smooth: `strength` in its middle, from 0 to 1.
  void stroke(Point2<double> from, Point2<double> to, double width, double strength) {
    if (!clip(from, to, width)) {
      return;
    }
    const bool is_steep = std::abs(to.y - from.y) > std::abs(to.x - from.x);
    if (is_steep) {
      std::swap(from.x, from.y);
      std::swap(to.x, to.y);
    }
    if (from.x > to.x) {
      std::swap(from, to);
    }
    const Point2<double> along = to - from;
    const double length = std::hypot(along.x, along.y);
    const double slope = along.x > 0 ? along.y / along.x : 0;
    const double across = length > 0 ? along.x / length : 1;  // of a distance along the other axis
    const double reach = (width / 2 + 0.5) / across;
    const int columns = is_steep ? height_ : width_;
    const int rows = is_steep ? width_ : height_;
    const int end = pixel_from(to.x + 1, columns);
    for (int i = pixel_from(from.x - 0.5, columns); i < end; ++i) {
      const double y = from.y + (i + 0.5 - from.x) * slope;
      const int last = pixel_from(y + reach, rows);
      for (int j = pixel_from(y - reach, rows); j < last; ++j) {
        const double cover = std::min(width / 2 + 0.5 - std::abs(j + 0.5 - y) * across, 1.0);
        if (cover > 0) {
          raise(is_steep ? at(j, i) : at(i, j), static_cast<std::uint8_t>(std::lround(255 * strength * cover)));
        }
      }
    }
  }

 private:
  std::uint8_t& at(int column, int row) {
    return bytes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)];
  }
  /// The first pixel whose middle is not before that place.
  static int pixel_from(double place, int count) {
    const double middle = std::clamp(place - 0.5, 0.0, static_cast<double>(count));
    const int pixel = static_cast<int>(middle);
    return pixel < middle ? pixel + 1 : pixel;
  }
  static int within(double place, int count) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
  }

  static bool is_inside(const std::array<Point2<double>, 3>& corners, Point2<double> place) {
    const auto& [a, b, c] = corners;
    const double of_a = cross(b - a, place - a);
    const double of_b = cross(c - b, place - b);
    const double of_c = cross(a - c, place - c);
    return (of_a >= 0 && of_b >= 0 && of_c >= 0) || (of_a <= 0 && of_b <= 0 && of_c <= 0);
  }

  template <std::size_t corner_count>
  static std::size_t crossings_of(const std::array<Point2<double>, corner_count>& corners, double y,
                                  std::array<double, 4>& crossings) {
    std::size_t count = 0;
    Point2<double> from = corners.back();
    for (const Point2<double> to : corners) {
      if ((from.y <= y) != (to.y <= y)) {
        crossings[count++] = from.x + (y - from.y) * ((to.x - from.x) / (to.y - from.y));
      }
      from = to;
    }
    for (std::size_t i = 1; i < count; ++i) {
      for (std::size_t j = i; j > 0 && crossings[j] < crossings[j - 1]; --j) {
        std::swap(crossings[j], crossings[j - 1]);
      }
    }
    return count;
  }

  /// Leaves the part that is on the canvas, or no further from it than `room`. False where there is none.
  bool clip(Point2<double>& from, Point2<double>& to, double room) const {
    const auto is_inside = [&](Point2<double> place) {
      return place.x >= 0 && place.x <= width_ && place.y >= 0 && place.y <= height_;
    };
    if (is_inside(from) && is_inside(to)) {
      return true;
    }
    double first = 0;
    double second = 1;
    narrow(from.x, to.x, -room, width_ + room, first, second);
    narrow(from.y, to.y, -room, height_ + room, first, second);
    if (!(first <= second)) {
      return false;
    }
    const Point2<double> along = to - from;
    to = {from.x + second * along.x, from.y + second * along.y};
    from = {from.x + first * along.x, from.y + first * along.y};
    return true;
  }

  int width_;
  int height_;
  Pixels bytes_;
};

/// Draws one element after the other.
class ElementPainter {
 public:
  ElementPainter(const ElementShades& shades, std::span<const Point2<double>> pixels, const StillOptions& options,
                 Canvas& fills, Canvas& edges)
      : shades_(shades),
        pixels_(pixels),
        screen_{{0, 0}, {static_cast<double>(options.width), static_cast<double>(options.height)}},
        lines_(options.lines),
        fills_(fills),
        edges_(edges) {}

  template <class Corners>
  void paint(std::size_t element, const Corners& listed) {
    with_kind(listed, [&](const auto& corners) {
      const auto points = points_of(corners, pixels_);
      Box box;
      for (const Point2<double> point : points) {
        box.add(point);
      }
      if (overlap(box, screen_)) {
        paint(element, points, box);
      }
    });
  }

 private:
  template <std::size_t count>
  void paint(std::size_t element, const std::array<Point2<double>, count>& points, const Box& box) {
    const std::uint8_t shade = shades_.shade(element);
    const bool is_seen = fills_.fill(points, box, shade);
    double area = 0;  // twice
    double longest = -1;
    std::pair<Point2<double>, Point2<double>> ends;
    for (std::size_t i = 0; i < count; ++i) {
      if (i + 1 < count) {
        area += cross(points[i] - points[0], points[i + 1] - points[0]);
      }
      for (std::size_t j = i + 1; j < count; ++j) {
        if (const double length = squared_length(points[j] - points[i]); length > longest) {
          longest = length;
          ends = {points[i], points[j]};
        }
      }
    }
    constexpr double short_one = 2;
    if (longest < short_one * short_one) {
      if (!is_seen) {
        fills_.mark({(ends.first.x + ends.second.x) / 2, (ends.first.y + ends.second.y) / 2}, shade);
      }
    } else if (area * area < longest) {  // narrower than a pixel
      fills_.mark_thin(ends.first, ends.second, shade);
    }
    if (lines_ && (box.high.x - box.low.x) + (box.high.y - box.low.y) > faint_edge) {
      draw_edges(points);
    }
  }

  void draw_edges(std::span<const Point2<double>> points) {
    double around = 0;
    Point2<double> from = points.back();
    for (const Point2<double> to : points) {
      around += std::sqrt(squared_length(to - from));
      from = to;
    }
    const double mean_edge = around / static_cast<double>(points.size());
    const double strength = std::min((mean_edge - faint_edge) / (full_edge - faint_edge), 1.0);
    if (strength > 0) {
      for (const Point2<double> to : points) {
        edges_.stroke(from, to, still_edge_width, strength);
        from = to;
      }
    }
  }

  const ElementShades& shades_;
  std::span<const Point2<double>> pixels_;  ///< of vertices
  Box screen_;
  bool lines_;
  Canvas& fills_;
  Canvas& edges_;
};

}  // namespace

Box with_room(const Box& elements) {
  if (elements.low.x > elements.high.x) {
    return {{0, 0}, {1, 1}};
  }
  constexpr double part = 0.02;
  // (Of halves: the largest meshes are wider than any number.)
  const double room =
      2 * part * std::max(elements.high.x / 2 - elements.low.x / 2, elements.high.y / 2 - elements.low.y / 2);
  constexpr double most = std::numeric_limits<double>::max();
  return {{std::max(elements.low.x - room, -most), std::max(elements.low.y - room, -most)},
          {std::min(elements.high.x + room, most), std::min(elements.high.y + room, most)}};
}

StillPicture draw_still(const MeshPicture& picture, const StillOptions& options) {
  const ElementShades shades(picture, options.value, options.threads, options.before);
  const MeshLines lines = options.lines ? mesh_lines(picture, options.threads) : MeshLines{};
  return draw_still(shades, &lines, options);
}

StillPicture draw_still(const ElementShades& shades, const MeshLines* lines, const StillOptions& options) {
  const PlaneView view(options.window.value_or(with_room(shades.box())), options.width, options.height);
  Canvas fills(options.width, options.height);
  Canvas edges(options.lines ? options.width : 0, options.height);
  Canvas dark(options.lines ? options.width : 0, options.height);
  Workers workers(options.threads);
  constexpr std::int64_t grain = 16384;
  BulkVector<Point2<double>> pixels(shades.picture().before.size());
  workers.for_blocks(std::ssize(pixels), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      pixels[v] = view.pixel(shades.point(static_cast<std::int32_t>(v)));
    }
  });
  shades.elements().visit([&]<class Corners>(std::span<const Corners> elements) {
    workers.for_blocks(std::ssize(elements), grain, [&](std::int64_t begin, std::int64_t end) {
      ElementPainter painter(shades, pixels, options, fills, edges);
      for (auto e = static_cast<std::size_t>(begin); e < static_cast<std::size_t>(end); ++e) {
        painter.paint(e, elements[e]);
      }
    });
  });
  if (options.lines && lines != nullptr) {
    for (const auto* const edges_of_lines : {&lines->boundary, &lines->interfaces}) {
      for (const auto& [from, to] : *edges_of_lines) {
        dark.stroke(view.pixel(shades.point(from)), view.pixel(shades.point(to)), still_line_width, 1);
      }
    }
  }
  StillPicture still{options.width, options.height, {}};
  still.rgb.resize(3 * fills.bytes().size());
  const auto colour_pixel = [&](std::size_t i) {
    Colour colour = shades.colour(fills.bytes()[i]);
    if (options.lines && edges.bytes()[i] != 0) {
      colour = mixed(colour, edge_colour, edge_strength * edges.bytes()[i] / 255);
    }
    if (options.lines && dark.bytes()[i] != 0) {
      colour = mixed(colour, line_colour, dark.bytes()[i] / 255.0);
    }
    still.rgb[3 * i] = colour.red;
    still.rgb[3 * i + 1] = colour.green;
    still.rgb[3 * i + 2] = colour.blue;
  };
  workers.for_blocks(std::ssize(fills.bytes()), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      colour_pixel(i);
    }
  });
  return still;
}

}  // namespace trismooth
