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

/// A square around the box: its longer side, so often, on each side of it.
Box square_around(const Box& box, double reach) {
  const double wide = reach * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return {{box.low.x - wide, box.low.y - wide}, {box.high.x + wide, box.high.y + wide}};
}

/// The squares around these elements, none with many vertices: long elements may be among far smaller ones.
std::vector<Box> squares_around(const MeshPicture& picture, std::span<const std::int64_t> numbers,
                                std::span<const Point2<double>> points) {
  constexpr double widest = 12;
  constexpr double narrowest = 0.2;
  constexpr std::size_t sample = 16;  // of the vertices that many are counted one
  constexpr std::int64_t most = 4000 / sample;
  const ElementList elements = picture.elements.list();
  std::vector<Box> squares;
  for (const std::int64_t number : numbers) {
    const auto place =
        picture.numbers.empty()
            ? static_cast<std::size_t>(number)
            : static_cast<std::size_t>(std::ranges::lower_bound(picture.numbers, number) - picture.numbers.begin());
    Box box;
    for (const std::int32_t v : elements[place]) {
      box.add(points[v]);
    }
    double reach = widest;
    const auto is_crowded = [&] {
      const Box square = square_around(box, reach);
      std::int64_t count = 0;
      for (std::size_t v = 0; v < points.size() && count <= most; v += sample) {
        count += is_inside(square, points[v]) ? 1 : 0;
      }
      return count > most;
    };
    while (reach > narrowest && is_crowded()) {
      reach /= 2;
    }
    squares.push_back(square_around(box, reach));
  }
  return squares;
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

}  // namespace

std::vector<std::int32_t> elements_near_worst(const MeshPicture& picture, Workers& workers) {
  std::vector<std::uint8_t> marks(picture.before.size(), 0);
  mark_inside(picture.before, squares_around(picture, picture.worst_before, picture.before), marks, workers);
  if (!picture.after.empty()) {
    mark_inside(picture.after, squares_around(picture, picture.worst_after, picture.after), marks, workers);
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
