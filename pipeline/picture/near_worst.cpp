// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/near_worst.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "trismooth/base/box.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t marking_grain = 16384;

bool is_inside(const Box& box, Point2<double> p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
}

void mark_inside(std::span<const Point2<double>> points, const std::vector<Box>& squares,
                 std::vector<std::uint8_t>& marks, Workers& workers) {
  workers.for_blocks(std::ssize(points), marking_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      const Point2<double> p = points[v];
      for (const Box& square : squares) {
        if (is_inside(square, p)) {
          marks[v] = 1;
        }
      }
    }
  });
}

/// Marks the corners of these elements and the vertices in a square around each: fewer than thousands, as elements may
/// be as long as the mesh is wide.
void mark_around(const MeshPicture& picture, std::span<const std::int64_t> numbers,
                 std::span<const Point2<double>> points, std::vector<std::uint8_t>& marks, Workers& workers) {
  constexpr double reach = 12;
  constexpr std::size_t sample = 16;  // of the vertices that many are counted one
  constexpr std::int64_t most = 4000 / sample;
  const ElementList elements = picture.elements.list();
  std::vector<Box> squares;
  for (const std::int64_t number : numbers) {
    Box box;
    for (const std::int32_t v : elements[picture.place_of(number)]) {
      marks[v] = 1;
      box.add(points[v]);
    }
    const Point2<double> centre{box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2};
    double wide = reach * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    const auto square = [&] { return Box{{centre.x - wide, centre.y - wide}, {centre.x + wide, centre.y + wide}}; };
    const auto is_crowded = [&] {
      const Box around = square();
      std::int64_t count = 0;
      for (std::size_t v = 0; v < points.size() && count <= most; v += sample) {
        count += is_inside(around, points[v]) ? 1 : 0;
      }
      return count > most;
    };
    for (int halvings = 0; halvings < 40 && is_crowded(); ++halvings) {
      wide /= 2;
    }
    squares.push_back(square());
  }
  mark_inside(points, squares, marks, workers);
}

}  // namespace

std::vector<std::int32_t> elements_near_worst(const MeshPicture& picture, Workers& workers) {
  std::vector<std::uint8_t> marks(picture.before.size(), 0);
  mark_around(picture, picture.worst_before, picture.before, marks, workers);
  if (!picture.after.empty()) {
    mark_around(picture, picture.worst_after, picture.after, marks, workers);
  }
  std::vector<std::int32_t> near;
  const ElementList elements = picture.elements.list();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (std::ranges::any_of(elements[e], [&](std::int32_t v) { return marks[v] != 0; })) {
      near.push_back(static_cast<std::int32_t>(e));
    }
  }
  return near;
}

}  // namespace trismooth
