// SPDX-License-Identifier: BSD-3-Clause
// A mesh in pieces, one a rank, whose boundary moves: a channel whose floor bends into waves, in ten steps. Every rank
// has a stretch of the channel and nothing of the others', but for the column of vertices that two neighbours have in
// common, which they know by its ids. After every step the plan smooths all stretches together, across their ends. Link
// with trismooth::mpi, and run
//
//     mpirun -n 4 moving_boundary

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/plan.h"
#include "trismooth/quality/triangle_quality.h"

namespace {

constexpr std::int64_t columns = 200;  // of squares, each cut into two triangles
constexpr std::int64_t rows = 40;

/// What a rank has.
struct Stretch {
  std::vector<std::array<double, 2>> points;
  std::vector<std::int64_t> ids;  // numbers in the whole mesh
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The columns of vertices from `first` to `last`, both included.
Stretch stretch(std::int64_t first, std::int64_t last) {
  Stretch mine;
  for (std::int64_t column = first; column <= last; ++column) {
    for (std::int64_t row = 0; row <= rows; ++row) {
      // Who has the same vertex has to have the same coordinates, to the last bit: so both find them from the same
      // numbers, never from where their own stretch begins.
      mine.points.push_back({static_cast<double>(column) / rows, static_cast<double>(row) / rows});
      mine.ids.push_back(column * (rows + 1) + row);
      if (column < last && row < rows) {
        const auto a = static_cast<std::int32_t>((column - first) * (rows + 1) + row);
        const auto next = static_cast<std::int32_t>(a + rows + 1);
        mine.triangles.push_back({a, next, next + 1});
        mine.triangles.push_back({a, next + 1, a + 1});
      }
    }
  }
  return mine;
}

/// Moves the vertices of the floor, those of row 0; its ends stay.
void bend_floor(Stretch& mine, int step) {
  for (std::size_t v = 0; v < mine.points.size(); ++v) {
    if (mine.ids[v] % (rows + 1) == 0) {
      auto& [x, y] = mine.points[v];
      y = 0.01 * step * std::sin(6 * std::numbers::pi * x * rows / columns);
    }
  }
}

/// Of all triangles on all ranks: 1 is equilateral, 0 degenerate, negative inverted.
double smallest_shape(const Stretch& mine) {
  double smallest = 1;
  const auto point = [&](std::int32_t v) {
    const auto& [x, y] = mine.points[static_cast<std::size_t>(v)];
    return trismooth::Point2<double>{x, y};
  };
  for (const auto& [a, b, c] : mine.triangles) {
    smallest = std::min(smallest, trismooth::shape(point(a), point(b), point(c)));
  }
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
  return smallest;
}

/// Whether no step has made the smallest shape worse.
bool run(int rank, int ranks) {
  Stretch mine = stretch(columns * rank / ranks, columns * (rank + 1) / ranks);
  trismooth::SmoothingOptions options;
  options.method = trismooth::Method::mean_ratio;
  options.max_sweeps = 50;
  // Finds out, once, which rank owns what and who has to hear of it. Where two stretches meet is no boundary: vertices
  // there move as those inside do.
  trismooth::mpi::Plan plan(MPI_COMM_WORLD, {mine.triangles, mine.ids}, options);
  bool is_good = true;
  for (int step = 1; step <= 10; ++step) {
    bend_floor(mine, step);
    const double before = smallest_shape(mine);
    const trismooth::SmoothingResult result = plan.smooth(mine.points);
    const double after = smallest_shape(mine);
    is_good = is_good && before > 0 && after >= before;
    if (rank == 0) {
      std::printf("step %d: %lld sweeps, %lld vertices moved on all ranks, smallest shape %.3f -> %.3f\n", step,
                  static_cast<long long>(result.sweeps), static_cast<long long>(result.moved_vertices), before, after);
    }
  }
  return is_good;
}

}  // namespace

int main(int argc, char** argv) {
  // Threads of trismooth's make no calls of MPI.
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  bool is_good = false;
  try {
    is_good = run(rank, ranks);
  } catch (const std::exception& error) {
    // All ranks are here with the same message.
    if (rank == 0) {
      std::fprintf(stderr, "%s\n", error.what());
    }
  }
  MPI_Finalize();
  return is_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
