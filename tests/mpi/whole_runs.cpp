// Larger meshes, cut as programs cut them and as none would: the bits are those of a run of the whole.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/pipeline/generate/delaunay.h"
#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "mpi/pieces.h"
#include "properties/smoothing_cases.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using namespace mpi_tests;
using properties::Run;
using test_meshes::Random;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Triangle;
using trismooth::mpi::Plan;

namespace {

constexpr std::int32_t large = 20000;

/// The Delaunay mesh of random points.
RandomMesh delaunay_mesh(std::int32_t vertices, std::uint64_t seed) {
  Random random(seed);
  std::set<trismooth::GridPoint> known;
  std::vector<trismooth::GridPoint> points;
  while (static_cast<std::int32_t>(points.size()) < vertices) {
    const trismooth::GridPoint point{random.below(1 << 28), random.below(1 << 28)};
    if (known.insert(point).second) {
      points.push_back(point);
    }
  }
  RandomMesh mesh;
  mesh.mesh.triangles = trismooth::delaunay(points);
  for (const auto& [x, y] : points) {
    mesh.mesh.points.push_back({x * 0x1p-28, y * 0x1p-28});
  }
  return mesh;
}

/// By the place of its first corner.
std::vector<int> cut_by(const RandomMesh& mesh, const std::function<int(trismooth::Point2<double>)>& rank_at) {
  std::vector<int> rank_of_triangle;
  for (const Triangle& t : mesh.mesh.triangles) {
    rank_of_triangle.push_back(std::clamp(rank_at(mesh.mesh.points[static_cast<std::size_t>(t[0])]), 0, ranks() - 1));
  }
  return rank_of_triangle;
}

std::vector<int> in_strips(const RandomMesh& mesh) {
  return cut_by(mesh, [](auto p) { return static_cast<int>(p.x * ranks()); });
}

std::vector<int> in_sectors(const RandomMesh& mesh) {
  return cut_by(mesh,
                [](auto p) { return static_cast<int>((std::atan2(p.y - 0.5, p.x - 0.5) / 6.2832 + 0.5) * ranks()); });
}

std::vector<int> scattered(const RandomMesh& mesh) {
  std::vector<int> rank_of_triangle;
  for (std::uint64_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    rank_of_triangle.push_back(static_cast<int>(trismooth::splitmix64(t) % static_cast<std::uint64_t>(ranks())));
  }
  return rank_of_triangle;
}

/// What is not as in the run of the whole.
std::string not_as_whole(const Piece& piece, const std::vector<double>& xy, const SmoothingResult& found,
                         const Run& whole) {
  for (std::size_t i = 0; i < piece.global.size(); ++i) {
    const auto v = static_cast<std::size_t>(piece.global[i]);
    if (!same_bits(xy[2 * i], whole.xy[2 * v]) || !same_bits(xy[2 * i + 1], whole.xy[2 * v + 1])) {
      return fmt::format("vertex {} is at ({}, {}) instead of ({}, {})", v, xy[2 * i], xy[2 * i + 1], whole.xy[2 * v],
                         whole.xy[2 * v + 1]);
    }
  }
  const auto figures = [](const SmoothingResult& r) {
    return fmt::format("{} sweeps, {}, {} updates, {} moved, {} reverted in {} rounds, {} free, {} colours", r.sweeps,
                       to_string(r.stop_reason), r.vertex_updates, r.moved_vertices, r.reverted_vertices,
                       r.guard_rounds, r.free_vertices, r.colours);
  };
  return figures(found) == figures(whole.result)
             ? ""
             : fmt::format("{} instead of {}", figures(found), figures(whole.result));
}

/// Smooths the pieces, and says what is not as in the run of the whole.
std::string smoothed_piece(const Piece& piece, const SmoothingOptions& options, const Run& whole) {
  std::vector<double> xy = piece.xy;
  std::string wrong;
  try {
    const SmoothingResult result = Plan(MPI_COMM_WORLD, piece.mesh(), piece.constraints(), options).smooth(xy);
    wrong = not_as_whole(piece, xy, result, whole);
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  return said_by_any(wrong);
}

SmoothingOptions options_of(Method method, Form form, std::int64_t sweeps = 8) {
  SmoothingOptions options;
  options.method = method;
  options.form = form;
  options.max_sweeps = sweeps;
  options.threads = 1;
  return options;
}

/// Owners drawn among all ranks, whether they have the vertex or not.
void draw_owners(Piece& piece) {
  piece.owners.clear();
  for (const std::int64_t id : piece.ids) {
    piece.owners.push_back(
        static_cast<std::int32_t>(trismooth::splitmix64(static_cast<std::uint64_t>(id) + 77) % ranks()));
  }
}

void all_owned_by(Piece& piece, std::int32_t owner) {
  piece.owners.assign(piece.ids.size(), owner);
}

/// A mesh folded along its middle: as many triangles are listed one way as the other.
RandomMesh folded(std::uint64_t seed) {
  RandomMesh mesh;
  mesh.mesh = test_meshes::jittered_grid(13, 9, 0.2, seed);
  for (auto& p : mesh.mesh.points) {
    p.x = std::abs(p.x - 0.5);
  }
  for (std::int32_t row = 0; row < 9; ++row) {
    mesh.mesh.points[13 * static_cast<std::size_t>(row) + 6].x = 0;
  }
  return mesh;
}

/// The same mesh with its triangles in another order: number order[t] becomes number t.
RandomMesh with_triangles_in_order(RandomMesh mesh, const std::vector<std::size_t>& order) {
  const std::vector<Triangle> old = mesh.mesh.triangles;
  for (std::size_t t = 0; t < order.size(); ++t) {
    mesh.mesh.triangles[t] = old[order[t]];
  }
  return mesh;
}

double smallest_shape(const std::vector<Triangle>& triangles, const std::vector<double>& xy) {
  double smallest = 1;
  const auto point = [&](std::int32_t v) {
    return trismooth::Point2<double>{xy[2 * static_cast<std::size_t>(v)], xy[2 * static_cast<std::size_t>(v) + 1]};
  };
  for (const auto& [a, b, c] : triangles) {
    smallest = std::min(smallest, trismooth::shape(point(a), point(b), point(c)));
  }
  return smallest;
}

}  // namespace

TEST_CASE("every method, form and precision, with and without the guard, gives a large mesh in strips the same bits") {
  const RandomMesh mesh = delaunay_mesh(large, 1);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    for (const bool guard : {false, true}) {
      SmoothingOptions options = properties::combination(index);
      options.max_sweeps = 6;
      options.guard = guard;
      INFO(properties::text_of(options));
      CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
    }
  }
}

TEST_CASE("so does every cut, whoever owns what") {
  const RandomMesh mesh = delaunay_mesh(large, 2);
  SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  const Run whole = properties::run(mesh, options);
  options.threads = 3;
  const std::vector<std::pair<const char*, std::vector<int>>> named_cuts{
      {"strips", in_strips(mesh)}, {"sectors", in_sectors(mesh)}, {"scattered", scattered(mesh)}};
  for (const auto& [name, cut] : named_cuts) {
    INFO(name);
    Piece piece = plain_piece(mesh, cut);
    CHECK(smoothed_piece(piece, options, whole) == "");
    draw_owners(piece);
    CHECK(smoothed_piece(piece, options, whole) == "");
    all_owned_by(piece, ranks() - 1);
    CHECK(smoothed_piece(piece, options, whole) == "");
  }
}

TEST_CASE("ranks that have nothing, or ghosts alone, are ranks like others") {
  const RandomMesh mesh = delaunay_mesh(2000, 3);
  for (const Form form : {Form::swap, Form::in_place}) {
    const SmoothingOptions options = options_of(Method::mean_ratio, form, 40);
    const Run whole = properties::run(mesh, options);
    const std::vector<int> on_first(mesh.mesh.triangles.size(), 0);
    const std::vector<int> on_last(mesh.mesh.triangles.size(), ranks() - 1);
    CHECK(smoothed_piece(plain_piece(mesh, on_last), options, whole) == "");
    Piece piece = plain_piece(mesh, on_first);
    // The last rank owns all, and has none of it.
    all_owned_by(piece, ranks() - 1);
    CHECK(smoothed_piece(piece, options, whole) == "");
    // It has all triangles as copies, and owns none of their vertices.
    if (ranks() > 1 && rank() == ranks() - 1) {
      std::vector<int> mine(mesh.mesh.triangles.size(), rank());
      piece = plain_piece(mesh, mine);
      piece.ghosts.assign(piece.triangles.size(), 1);
    }
    all_owned_by(piece, 0);
    CHECK(smoothed_piece(piece, options, whole) == "");
  }
}

TEST_CASE("meshes of as many vertices as ranks, and of fewer, come out as whole ones") {
  // A star: its middle alone is free. The rank of its middle is the last one, that of the others is drawn.
  for (std::int32_t size = 3; size <= 3 + ranks(); ++size) {
    RandomMesh star;
    star.mesh = test_meshes::star(size);
    std::vector<int> in_turn(star.mesh.triangles.size());
    for (std::size_t t = 0; t < in_turn.size(); ++t) {
      in_turn[t] = static_cast<int>(t) % ranks();
    }
    Piece piece = plain_piece(star, in_turn);
    draw_owners(piece);
    for (const Form form : {Form::swap, Form::in_place}) {
      const SmoothingOptions options = options_of(Method::smart, form);
      CHECK(smoothed_piece(piece, options, properties::run(star, options)) == "");
    }
  }
  // A vertex a rank: each owns the one whose number it has.
  RandomMesh few;
  few.mesh = test_meshes::star(std::max(3, ranks() - 1));
  Piece piece = plain_piece(few, std::vector<int>(few.mesh.triangles.size(), 0));
  for (const std::int64_t id : piece.ids) {
    piece.owners.push_back(static_cast<std::int32_t>(id % ranks()));
  }
  const SmoothingOptions options = options_of(Method::smart, Form::in_place);
  CHECK(smoothed_piece(piece, options, properties::run(few, options)) == "");
  // Nothing anywhere.
  const RandomMesh none;
  CHECK(smoothed_piece(plain_piece(none, {}), options, properties::run(none, options)) == "");
}

TEST_CASE("numbers that are left out between ids are vertices that nobody has") {
  constexpr std::int32_t stride = 7;
  constexpr std::int32_t offset = 1000;
  const RandomMesh mesh = delaunay_mesh(3000, 4);
  RandomMesh with_gaps;
  with_gaps.mesh.points.resize(static_cast<std::size_t>(offset) +
                               static_cast<std::size_t>(stride) * mesh.mesh.points.size());
  for (std::size_t v = 0; v < mesh.mesh.points.size(); ++v) {
    with_gaps.mesh.points[offset + stride * v] = mesh.mesh.points[v];
  }
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    with_gaps.mesh.triangles.push_back({offset + stride * a, offset + stride * b, offset + stride * c});
  }
  Piece piece = plain_piece(mesh, in_sectors(mesh));
  for (std::int64_t& id : piece.ids) {
    id = offset + stride * id;
  }
  for (std::int32_t& v : piece.global) {
    v = offset + stride * v;
  }
  draw_owners(piece);
  for (const Form form : {Form::swap, Form::in_place}) {
    const SmoothingOptions options = options_of(Method::smart, form, 1000);
    CHECK(smoothed_piece(piece, options, properties::run(with_gaps, options)) == "");
  }
}

TEST_CASE("ids beyond 32 bits give the same bits on every number of ranks") {
  const RandomMesh mesh = delaunay_mesh(3000, 5);
  const auto far_away = [](std::int64_t id) { return (std::int64_t{1} << 40) + 1000003 * id; };
  const auto with_far_ids = [&](Piece piece) {
    std::ranges::transform(piece.ids, piece.ids.begin(), far_away);
    for (std::int64_t& id : piece.triangle_ids) {
      id += std::int64_t{1} << 50;
    }
    return piece;
  };
  const Piece piece = with_far_ids(plain_piece(mesh, in_strips(mesh)));
  // The whole, by each rank alone.
  std::vector<std::int64_t> ids(mesh.mesh.points.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::ranges::transform(ids, ids.begin(), far_away);
  const trismooth::mpi::LocalMesh all{mesh.mesh.triangles, ids};
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    SmoothingOptions options = properties::combination(index);
    INFO(properties::text_of(options));
    options.max_sweeps = 30;
    Run alone{mesh.mesh.xy(), {}};
    alone.result = Plan(MPI_COMM_SELF, all, options).smooth(alone.xy);
    CHECK(smoothed_piece(piece, options, alone) == "");
    const double before = smallest_shape(mesh.mesh.triangles, mesh.mesh.xy());
    const double after = smallest_shape(mesh.mesh.triangles, alone.xy);
    CHECK(said_by_any(after >= before ? "" : fmt::format("{} is worse than {}", after, before)) == "");
    // Without colours nothing depends on what the ids are but their order.
    if (options.form == Form::swap) {
      CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
    }
  }
}

TEST_CASE("points of float, and of three numbers, are smoothed as those of the whole") {
  const RandomMesh mesh = delaunay_mesh(3000, 6);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  const auto check = [&]<class T>(T height) {
    const bool has_heights = height != 0;
    const auto numbers_of = [&](const std::vector<double>& xy) {
      std::vector<T> numbers;
      for (std::size_t i = 0; i < xy.size(); i += 2) {
        numbers.insert(numbers.end(), {static_cast<T>(xy[i]), static_cast<T>(xy[i + 1])});
        if (has_heights) {
          numbers.push_back(height);
        }
      }
      return numbers;
    };
    const auto view_of = [&](std::vector<T>& numbers) {
      return has_heights ? trismooth::xyz_points(numbers) : trismooth::xy_points(numbers);
    };
    std::vector<T> whole = numbers_of(mesh.mesh.xy());
    trismooth::smooth(view_of(whole), mesh.mesh.triangles, options);
    std::vector<T> own = numbers_of(piece.xy);
    Plan(MPI_COMM_WORLD, piece.mesh(), options).smooth(view_of(own));
    const std::size_t numbers = has_heights ? 3 : 2;
    std::string wrong;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto v = static_cast<std::size_t>(piece.global[i / numbers]);
      if (!same_bits(own[i], whole[numbers * v + i % numbers])) {
        wrong = fmt::format("vertex {} is elsewhere", v);
      }
    }
    CHECK(said_by_any(wrong) == "");
  };
  check(0.0F);
  check(0.0);
  check(2.5F);
  check(2.5);
}

TEST_CASE("double points that are to be stored as float are rounded as those of the whole") {
  const RandomMesh mesh = delaunay_mesh(3000, 7);
  const Piece piece = plain_piece(mesh, scattered(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::swap, 1000);
  const Run whole = properties::run(mesh, options, trismooth::Storage::float32);
  std::vector<double> xy = piece.xy;
  const auto result = Plan(MPI_COMM_WORLD, piece.mesh(), options).smooth(xy, trismooth::Storage::float32);
  CHECK(said_by_any(not_as_whole(piece, xy, result, whole)) == "");
}

TEST_CASE("a plan aims at sizes that are asked for, at other ones in the next call") {
  const RandomMesh mesh = delaunay_mesh(3000, 8);
  Piece piece = plain_piece(mesh, in_sectors(mesh));
  draw_owners(piece);
  std::vector<double> all_lengths(mesh.mesh.points.size());
  std::vector<double> lengths(piece.ids.size());
  SmoothingOptions options = options_of(Method::mean_ratio, Form::in_place, 30);
  options.mean_ratio.target_lengths = lengths;
  Plan plan(MPI_COMM_WORLD, piece.mesh(), options);
  for (const double power : {1.0, -2.0}) {
    for (std::size_t v = 0; v < all_lengths.size(); ++v) {
      all_lengths[v] = std::pow(1.1 + mesh.mesh.points[v].x, power);
    }
    std::ranges::copy(piece.local(all_lengths), lengths.begin());
    SmoothingOptions of_whole = options;
    of_whole.mean_ratio.target_lengths = all_lengths;
    std::vector<double> xy = piece.xy;
    const auto result = plan.smooth(xy);
    CHECK(said_by_any(not_as_whole(piece, xy, result, properties::run(mesh, of_whole))) == "");
  }
}

TEST_CASE("a plan is used again where the boundary has moved, and where the mesh is turned over") {
  const RandomMesh mesh = delaunay_mesh(3000, 9);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  Plan plan(MPI_COMM_WORLD, piece.mesh(), options);
  std::vector<double> xy = piece.xy;
  RandomMesh moved = mesh;
  for (int step = 1; step <= 4; ++step) {
    const auto move = [step](double& x, double& y) {
      y *= 1 + 0.05 * step * x;
      x = step == 3 ? -x : x;
    };
    for (auto& p : moved.mesh.points) {
      move(p.x, p.y);
    }
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      move(xy[i], xy[i + 1]);
    }
    const Run whole = properties::run(moved, options);
    const auto result = plan.smooth(xy);
    CHECK(said_by_any(not_as_whole(piece, xy, result, whole)) == "");
    moved = properties::at_points(moved, whole.xy);
  }
}

TEST_CASE("limits end all ranks after the same sweep") {
  const RandomMesh mesh = delaunay_mesh(3000, 10);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  for (const Form form : {Form::swap, Form::in_place}) {
    SmoothingOptions options = options_of(Method::smart, form, 0);
    const auto check = [&] { CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == ""); };
    check();
    options.max_sweeps = 1;
    check();
    options.max_sweeps = 0;
    options.time_limit_seconds = 0;
    check();
    options.time_limit_seconds = std::numeric_limits<double>::infinity();
    options.target_quality = 0.01;
    check();
    options.target_quality = -1;  // it is there before the first sweep
    check();
    options.target_quality.reset();
    options.tolerance = 0.1;
    check();
  }
}

TEST_CASE("where as many triangles are listed one way as the other, triangle ids decide") {
  bool do_ids_matter = false;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomMesh mesh = folded(seed);
    Random random(seed);
    std::vector<std::size_t> order(mesh.mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    random.shuffle(order);
    mesh = with_triangles_in_order(mesh, order);
    const std::vector<int> cut = scattered(mesh);
    const SmoothingOptions options = options_of(Method::smart, Form::in_place);
    Piece piece = plain_piece(mesh, cut);
    const Run whole = properties::run(mesh, options);
    CHECK(smoothed_piece(piece, options, whole) == "");
    std::ranges::reverse(order);
    do_ids_matter |= !same_bits(properties::run(with_triangles_in_order(folded(seed), order), options).xy, whole.xy);
    // Without ids they are numbered rank by rank.
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t t) { return std::pair(cut[t], t); });
    piece.triangle_ids.clear();
    CHECK(smoothed_piece(piece, options, properties::run(with_triangles_in_order(mesh, order), options)) == "");
  }
  CHECK(do_ids_matter);
}

TEST_CASE("a component that goes from rank to rank many times is listed one way on all of them") {
  for (const std::size_t period : {std::size_t{2}, std::size_t{3}, std::size_t{7}}) {
    RandomMesh band;
    band.mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(301, 3, 0.2, 1), period);
    // Squares one after the other, first along one row of them and then along the other.
    std::vector<int> in_turn(band.mesh.triangles.size());
    for (std::size_t t = 0; t < in_turn.size(); ++t) {
      in_turn[t] = static_cast<int>(t / 2) % ranks();
    }
    const SmoothingOptions options = options_of(Method::smart, Form::in_place);
    CHECK(smoothed_piece(plain_piece(band, in_turn), options, properties::run(band, options)) == "");
  }
}

TEST_CASE("regions and vertices that are held are so on all ranks, whoever says so") {
  RandomMesh mesh = delaunay_mesh(3000, 11);
  for (const Triangle& t : mesh.mesh.triangles) {
    mesh.regions.push_back(mesh.mesh.points[static_cast<std::size_t>(t[0])].y < 0.4 ? 3 : -1);
  }
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); v += 50) {
    mesh.fixed_ids.push_back(v);
  }
  Piece piece = plain_piece(mesh, in_strips(mesh));
  for (const std::int64_t t : piece.triangle_ids) {
    piece.regions.push_back(mesh.regions[static_cast<std::size_t>(t)]);
  }
  // Of the ranks that have a vertex the highest says that it is held.
  std::vector<int> last(mesh.mesh.points.size(), -1);
  const std::vector<int> cut = in_strips(mesh);
  for (std::size_t t = 0; t < cut.size(); ++t) {
    for (const std::int32_t v : mesh.mesh.triangles[t]) {
      last[static_cast<std::size_t>(v)] = std::max(last[static_cast<std::size_t>(v)], cut[t]);
    }
  }
  for (std::size_t i = 0; i < piece.global.size(); ++i) {
    if (const std::int32_t v = piece.global[i]; v % 50 == 0 && last[static_cast<std::size_t>(v)] == rank()) {
      piece.fixed_ids.push_back(static_cast<std::int32_t>(i));
    }
  }
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
}
