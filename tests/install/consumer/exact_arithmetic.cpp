// SPDX-License-Identifier: BSD-3-Clause
// A program of a user, compiled with what makes programs fast (-O3 -march=native: the processor can multiply and add at
// once): what the headers compute inline in it has the bits of their formulas. The oracle is the compiler's own
// arithmetic of constants, which rounds after every operation.
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "trismooth/quality/triangle_quality.h"

namespace {

using Point = trismooth::Point2<double>;

constexpr std::size_t triangles = 500;

constexpr std::array<Point, 3 * triangles> random_points() {
  std::array<Point, 3 * triangles> points{};
  std::uint64_t state = 1;
  const auto number = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11U) * 0x1p-53;
  };
  for (Point& point : points) {
    point.x = number();
    point.y = number();
  }
  return points;
}

constexpr auto points = random_points();

constexpr std::array<double, triangles> quotients_by_compiler() {
  std::array<double, triangles> quotients{};
  for (std::size_t t = 0; t < triangles; ++t) {
    quotients[t] = trismooth::shape_quotient(points[3 * t], points[3 * t + 1], points[3 * t + 2]);
  }
  return quotients;
}

constexpr auto expected = quotients_by_compiler();

}  // namespace

int main() {
  // The loop is the processor's: nobody knows the numbers before it runs.
  std::array<Point, 3 * triangles> unknown = points;
  asm volatile("" : : "r"(unknown.data()) : "memory");
  int wrong = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    const double found = trismooth::shape_quotient(unknown[3 * t], unknown[3 * t + 1], unknown[3 * t + 2]);
    wrong += std::bit_cast<std::uint64_t>(found) == std::bit_cast<std::uint64_t>(expected[t]) ? 0 : 1;
  }
  std::printf("%d of %zu quotients have other bits than the formula\n", wrong, triangles);
  return wrong == 0 ? 0 : 1;
}
