// SPDX-License-Identifier: BSD-3-Clause
// What smoothing a mesh in pieces costs on so many ranks: seconds, ghosts, messages and bytes of a sweep, memory. Every
// rank makes its own block of mirrored Delaunay tiles; nobody has the whole.
//
// Memory is what a rank has at its most beside the caller's arrays (mesh and points), of which there is nothing else
// by then: measured alike with --serial, by what Linux counts.
//
//     mpirun -n 4 ranks --vertices 1000000              the same mesh for every number of ranks
//     mpirun -n 4 ranks --vertices-per-rank 250000      a larger mesh for more ranks
//
// Prints JSON. "coordinates" is a sum over all vertices of what their ids and coordinates give, the same for every
// number of ranks where the mesh is the same.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <mpi.h>
#include <nlohmann/json.hpp>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/splitmix64.h"
#ifdef TRISMOOTH_HAS_CUDA
#include "trismooth/cuda/backend.h"
#endif
#include "trismooth/mpi/plan.h"
#include "trismooth/smoothing/smooth.h"

#include "memory_growth.h"
#include "run_reporting.h"
#include "tile_blocks.h"

namespace {

using namespace trismooth;
using Json = nlohmann::ordered_json;

struct Settings {
  std::int64_t vertices = 0;
  std::int64_t vertices_per_rank = 0;
  std::string method = "smart";
  std::string form = "b";
  std::string precision = "double";
  std::string evaluation = "all";
  std::int64_t sweeps = 20;
  std::string backend = "cpu";
  int runs = 3;
  int threads = 1;
  bool guard = true;
  bool serial = false;
  bool elsewhere = false;
};

/// Tiles along each axis: of the whole mesh, and with --vertices-per-rank of every rank's block.
constexpr std::int64_t tiles_of_mesh = 16;
constexpr std::int64_t tiles_of_rank = 4;

int call(int (*function)(MPI_Comm, int*)) {
  int value = 0;
  function(MPI_COMM_WORLD, &value);
  return value;
}

double largest(double own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return own;
}

/// One number a rank, in their order.
std::vector<std::int64_t> of_ranks(std::int64_t own) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(call(MPI_Comm_size)));
  MPI_Allgather(&own, 1, MPI_INT64_T, all.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
  return all;
}

SquareTile tile_of(std::int64_t vertices) {
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(vertices))) - 1;
  if (side < 1) {
    throw std::invalid_argument("a tile has 4 vertices at least: ask for more of them");
  }
  std::mt19937_64 generator(1);
  return random_tile(vertices - 2 * side - 1, side, GeneratedBoundary::resolved, generator);
}

/// The mesh: tiles, and who has which of them.
struct Layout {
  SquareTile tile;
  tile_blocks::TileGrid tiles;
  tile_blocks::TileGrid ranks;
};

Layout layout_of(const Settings& settings) {
  std::array<int, 2> sides{};
  MPI_Dims_create(call(MPI_Comm_size), 2, sides.data());
  const tile_blocks::TileGrid ranks{sides[0], sides[1]};
  const bool is_weak = settings.vertices_per_rank > 0;
  const tile_blocks::TileGrid tiles =
      is_weak ? tile_blocks::TileGrid{tiles_of_rank * ranks.columns, tiles_of_rank * ranks.rows}
              : tile_blocks::TileGrid{tiles_of_mesh, tiles_of_mesh};
  const std::int64_t in_tile = is_weak ? settings.vertices_per_rank / (tiles_of_rank * tiles_of_rank)
                                       : settings.vertices / (tiles_of_mesh * tiles_of_mesh);
  return {tile_of(in_tile), tiles, ranks};
}

/// Owners that have next to nothing of what they own: the rank after the one in whose block the first tile of a vertex
/// is.
std::vector<std::int32_t> owners_elsewhere(const tile_blocks::BlockMesh& mesh, const Layout& layout) {
  const int count = call(MPI_Comm_size);
  std::vector<std::int32_t> next_of_tile(static_cast<std::size_t>(layout.tiles.columns * layout.tiles.rows));
  for (int rank = 0; rank < count; ++rank) {
    const tile_blocks::TileBlock block = tile_blocks::block_of(rank, layout.ranks, layout.tiles);
    for (std::int64_t row = block.first[1]; row < block.end[1]; ++row) {
      for (std::int64_t column = block.first[0]; column < block.end[0]; ++column) {
        next_of_tile[static_cast<std::size_t>(row * layout.tiles.columns + column)] = (rank + 1) % count;
      }
    }
  }
  std::vector<std::int32_t> owners;
  owners.reserve(mesh.ids.size());
  for (const std::int64_t id : mesh.ids) {
    owners.push_back(next_of_tile[static_cast<std::size_t>(id / std::ssize(layout.tile.points))]);
  }
  return owners;
}

/// The same for every number of ranks: no order of adding matters.
std::uint64_t hash_of(const tile_blocks::BlockMesh& mesh, const std::vector<double>& xy) {
  std::uint64_t sum = 0;
  for (std::size_t v = 0; v < mesh.ids.size(); ++v) {
    if (mesh.counts_here[v] != 0) {
      std::uint64_t mixed = splitmix64(static_cast<std::uint64_t>(mesh.ids[v]));
      for (const double number : {xy[2 * v], xy[2 * v + 1]}) {
        mixed = splitmix64(mixed ^ std::bit_cast<std::uint64_t>(number));
      }
      sum += mixed;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

mpi::Traffic between(const mpi::Traffic& before, const mpi::Traffic& after) {
  return {after.exchanges - before.exchanges, after.messages - before.messages, after.bytes - before.bytes,
          after.joins - before.joins};
}

Json json_of(const mpi::Traffic& all, double parts) {
  const auto of_each = [&](std::int64_t own) {
    std::vector<double> numbers;
    for (const std::int64_t number : of_ranks(own)) {
      numbers.push_back(static_cast<double>(number) / parts);
    }
    return numbers;
  };
  return {{"exchanges", of_each(all.exchanges)},
          {"messages", of_each(all.messages)},
          {"bytes", of_each(all.bytes)},
          {"joins", of_each(all.joins)}};
}

/// When the sweeps of a call ended, and what had been sent by then.
struct SweepLog {
  std::vector<double> seconds;
  std::vector<mpi::Traffic> traffic;

  /// Of the sweeps from the second one on.
  double sweeps() const { return static_cast<double>(seconds.size()) - 1; }
  double seconds_of_a_sweep() const { return (seconds.back() - seconds.front()) / sweeps(); }
  mpi::Traffic between_sweeps() const {
    mpi::Traffic all = between(traffic.front(), traffic.back());
    // A callback takes a join of its own, to hear whether any rank says stop.
    all.joins -= static_cast<std::int64_t>(sweeps());
    return all;
  }
};

int measure_serial(const Settings& settings, const SmoothingOptions& options, const tile_blocks::BlockMesh& mesh) {
  if (call(MPI_Comm_size) != 1) {
    throw std::invalid_argument("--serial is for one rank");
  }
  std::vector<double> xy = mesh.xy;
  const MemoryGrowth memory;
  const Stopwatch planning;
  SmoothingPlan plan(std::ssize(mesh.ids), mesh.triangles, options);
  const double plan_seconds = planning.seconds();
  const std::int64_t memory_of_plan = memory.most();
  SmoothingResult result;
  double first_seconds = 0;
  double fastest = 0;
  for (int run = 0; run <= settings.runs; ++run) {
    std::ranges::copy(mesh.xy, xy.begin());
    const Stopwatch watch;
    result = plan.smooth(xy);
    const double seconds = watch.seconds();
    (run == 0 ? first_seconds : fastest) = run < 2 ? seconds : std::min(fastest, seconds);
  }
  const Json report{{"vertices", std::ssize(mesh.ids)},
                    {"threads", result.threads},
                    {"sweeps", result.sweeps},
                    {"seconds",
                     {{"plan", plan_seconds},
                      {"first_call", first_seconds},
                      {"call", fastest},
                      {"sweeps_of_it", result.timings.smooth / 1000}}},
                    {"memory_of_plan_bytes", memory_of_plan},
                    {"memory_bytes", memory.most()},
                    {"coordinates", fmt::format("{:016x}", hash_of(mesh, xy))}};
  fmt::print("{}\n", report.dump(2));
  return EXIT_SUCCESS;
}

int measure(int argc, char** argv) {
  CLI::App app("What smoothing a mesh in pieces costs");
  Settings settings;
  auto* const strong = app.add_option("--vertices", settings.vertices, "of the whole mesh, about");
  app.add_option("--vertices-per-rank", settings.vertices_per_rank, "about")->excludes(strong);
  app.add_option("--method", settings.method);
  app.add_option("--form", settings.form);
  app.add_option("--precision", settings.precision);
  app.add_option("--evaluation", settings.evaluation);
  app.add_option("--sweeps", settings.sweeps, "at most; 2 at least")->check(CLI::Range(2, 1000000));
  app.add_option("--runs", settings.runs, "the fastest counts")->check(CLI::Range(1, 1000));
  app.add_option("--backend", settings.backend, "cpu or cuda: a device a rank");
  app.add_option("--threads", settings.threads, "of a rank");
  app.add_flag("--guard,!--no-guard", settings.guard);
  app.add_flag("--serial", settings.serial,
               "by the plan of a whole mesh, on one rank: what the others are measured by");
  app.add_flag("--elsewhere", settings.elsewhere, "ranks own what others have: nearly all goes over the network");
  CLI11_PARSE(app, argc, argv);
  if (settings.vertices <= 0 && settings.vertices_per_rank <= 0) {
    throw std::invalid_argument("say --vertices or --vertices-per-rank");
  }
  SmoothingOptions options;
  options.method = parse_enum<Method>(settings.method);
  options.form = parse_enum<Form>(settings.form);
  options.precision = parse_enum<Precision>(settings.precision);
  options.evaluation = parse_enum<Evaluation>(settings.evaluation);
  options.max_sweeps = settings.sweeps;
  options.threads = settings.threads;
  options.guard = settings.guard;
  options.untangle = Untangle::off;

#ifdef TRISMOOTH_HAS_CUDA
  if (settings.backend == "cuda") {
    options.backend = &cuda::backend();
  }
#endif
  if (settings.backend != "cpu" && options.backend == nullptr) {
    throw std::invalid_argument("no such backend here: " + settings.backend);
  }

  const Layout layout = layout_of(settings);
  const tile_blocks::BlockMesh mesh = tile_blocks::block_mesh(
      layout.tile, layout.tiles, tile_blocks::block_of(call(MPI_Comm_rank), layout.ranks, layout.tiles));
  if (settings.serial) {
    return measure_serial(settings, options, mesh);
  }
  const std::vector<std::int32_t> owners =
      settings.elsewhere ? owners_elsewhere(mesh, layout) : std::vector<std::int32_t>();
  std::vector<double> xy = mesh.xy;
  const MemoryGrowth growth;
  std::optional<mpi::Plan> plan;
  MPI_Barrier(MPI_COMM_WORLD);
  const Stopwatch planning;
  SweepLog log;
  const Stopwatch since_start;
  options.progress = [&](const SweepRecord& /*record*/) {
    log.seconds.push_back(since_start.seconds());
    log.traffic.push_back(plan->traffic());
    return Progress::proceed;
  };
  plan.emplace(MPI_COMM_WORLD, mpi::LocalMesh{mesh.triangles, mesh.ids, owners}, options);
  const double plan_seconds = largest(planning.seconds());
  const std::int64_t memory_of_plan = growth.most();

  SmoothingResult result;
  double first_seconds = 0;
  double fastest_sweep = 0;
  double fastest_call = 0;
  mpi::Traffic traffic;
  for (int run = 0; run <= settings.runs; ++run) {
    std::ranges::copy(mesh.xy, xy.begin());
    log = {};
    const mpi::Traffic before = plan->traffic();
    MPI_Barrier(MPI_COMM_WORLD);
    const Stopwatch watch;
    result = plan->smooth(xy);
    const double seconds = largest(watch.seconds());
    const double sweep = largest(log.seconds_of_a_sweep());
    traffic = between(before, plan->traffic());
    if (run == 0) {
      first_seconds = seconds;  // it colours and packs as well
      continue;
    }
    fastest_call = run == 1 ? seconds : std::min(fastest_call, seconds);
    fastest_sweep = run == 1 ? sweep : std::min(fastest_sweep, sweep);
  }
  const std::vector<std::int64_t> own = of_ranks(plan->own_vertices());
  const std::vector<std::int64_t> ghosts = of_ranks(plan->ghost_vertices());
  const std::vector<std::int64_t> memory = of_ranks(growth.most());
  plan.reset();
  std::int64_t vertices = 0;
  for (const std::int64_t of_rank : own) {
    vertices += of_rank;
  }
  const Json report{
      {"ranks", own.size()},
      {"vertices", vertices},
      {"method", settings.method},
      {"form", settings.form},
      {"precision", settings.precision},
      {"evaluation", settings.evaluation},
      {"backend", result.backend},
      {"device", result.device},
      {"threads", result.threads},
      {"colours", result.colours},
      {"sweeps", result.sweeps},
      {"stop_reason", to_string(result.stop_reason)},
      {"guard_rounds", result.guard_rounds},
      {"seconds",
       {{"plan", plan_seconds}, {"first_call", first_seconds}, {"call", fastest_call}, {"sweep", fastest_sweep}}},
      {"own_vertices", own},
      {"ghosts", ghosts},
      {"traffic_of_a_call", json_of(traffic, 1)},
      {"traffic_of_a_sweep", json_of(log.between_sweeps(), log.sweeps())},
      {"memory_of_plan_bytes", of_ranks(memory_of_plan)},
      {"memory_bytes", memory},
      {"coordinates", fmt::format("{:016x}", hash_of(mesh, xy))}};
  if (call(MPI_Comm_rank) == 0) {
    fmt::print("{}\n", report.dump(2));
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  const int code = run_reporting("ranks", measure, argc, argv);
  MPI_Finalize();
  return code;
}
