// SPDX-License-Identifier: BSD-3-Clause
// A mesh with quadrilaterals in pieces comes out with the bits of the whole, for every number of ranks and every cut.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mpi/moving_mesh.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "mpi/pieces.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "support/fake_backend.h"
#include "support/mixed_meshes.h"
#include "support/same_bits.h"
#include "support/says.h"

using mixed_meshes::Element;
using mixed_meshes::MixedMesh;
using mpi_tests::rank;
using mpi_tests::ranks;
using mpi_tests::said_by_any;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::mpi::Gather;
using trismooth::mpi::LocalMesh;
using trismooth::mpi::Plan;

/// Who makes the sweeps of pieces; null: the CPU. Weak: a program of devices has its own.
[[gnu::weak]] const trismooth::Backend* backend_of_pieces() {
  return nullptr;
}

namespace trismooth::mpi_quadrilaterals_test {

/// A mesh, and what is said of it.
struct Whole {
  MixedMesh mesh;
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> regions;
  std::vector<double> lengths;
};

/// Where elements are, and who owns vertices; drawn alike on all ranks.
struct Cut {
  std::vector<int> rank_of_element;
  std::vector<std::uint8_t> has_copy;  ///< of the element, on the next rank
  std::vector<std::int32_t> owners;    ///< empty: not said
  bool says_ids = true;                ///< else elements are numbered rank by rank
};

/// What a rank hands in.
struct Piece {
  std::vector<Element> elements;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owners;
  std::vector<std::uint8_t> ghosts;
  std::vector<std::int64_t> element_ids;
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> regions;
  std::vector<double> lengths;
  std::vector<double> xy;

  LocalMesh mesh() const { return {elements, ids, owners, ghosts, element_ids}; }
};

struct Run {
  std::vector<double> xy;
  SmoothingResult result;
};

Run run_whole(const Whole& whole, SmoothingOptions options) {
  options.mean_ratio.target_lengths = whole.lengths;
  Run run{whole.mesh.xy(), {}};
  run.result = trismooth::plan(whole.mesh.vertex_count(), whole.mesh.elements,
                               Constraints{.fixed = whole.fixed, .regions = whole.regions}, options)
                   .smooth(run.xy);
  return run;
}

Piece piece_of(const Whole& whole, const Cut& cut, std::uint64_t seed) {
  std::mt19937_64 random(seed + static_cast<std::uint64_t>(rank()));
  const auto& elements = whole.mesh.elements;
  std::vector<std::size_t> here;
  std::vector<std::uint8_t> is_here(whole.mesh.points.size(), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const bool is_copy = !cut.has_copy.empty() && cut.has_copy[e] != 0 && ranks() > 1;
    if (cut.rank_of_element[e] == rank() || (is_copy && (cut.rank_of_element[e] + 1) % ranks() == rank())) {
      here.push_back(e);
      for (const std::int32_t v : whole.mesh.corners(e)) {
        is_here[static_cast<std::size_t>(v)] = 1;
      }
    }
  }
  Piece piece;
  for (std::size_t v = 0; v < is_here.size(); ++v) {
    // Isolated ones, and some more, are somewhere.
    if (is_here[v] != 0 || v % static_cast<std::size_t>(ranks()) == static_cast<std::size_t>(rank())) {
      piece.ids.push_back(static_cast<std::int64_t>(v));
    }
  }
  if (cut.says_ids) {
    std::shuffle(here.begin(), here.end(), random);
    std::shuffle(piece.ids.begin(), piece.ids.end(), random);
  }
  std::vector<std::int32_t> number(is_here.size(), -1);
  for (std::size_t i = 0; i < piece.ids.size(); ++i) {
    const auto v = static_cast<std::size_t>(piece.ids[i]);
    number[v] = static_cast<std::int32_t>(i);
    piece.xy.insert(piece.xy.end(), {whole.mesh.points[v][0], whole.mesh.points[v][1]});
    const auto take = [v](const auto& all, auto& mine) {
      if (!all.empty()) {
        mine.push_back(all[v]);
      }
    };
    take(cut.owners, piece.owners);
    take(whole.fixed, piece.fixed);
    take(whole.lengths, piece.lengths);
  }
  for (const std::size_t e : here) {
    Element element = elements[e];
    for (std::int32_t& v : element) {
      v = v < 0 ? v : number[static_cast<std::size_t>(v)];
    }
    piece.elements.push_back(element);
    piece.ghosts.push_back(cut.rank_of_element[e] == rank() ? 0 : 1);
    if (cut.says_ids) {
      piece.element_ids.push_back(static_cast<std::int64_t>(e));
    }
    if (!whole.regions.empty()) {
      piece.regions.push_back(whole.regions[e]);
    }
  }
  return piece;
}

std::string figures(const SmoothingResult& r) {
  return fmt::format(
      "{} sweeps, {}, {} moved, {} back in {} rounds, {} free, {} colours, {} inverted, {} without area, "
      "{} quadrilaterals, layers: {} kept, {} left, {} records",
      r.sweeps, to_string(r.stop_reason), r.moved_vertices, r.reverted_vertices, r.guard_rounds, r.free_vertices,
      r.colours, r.inverted, r.degenerate, r.quadrilaterals, r.layers.kept, r.layers.left, r.history.size());
}

/// What is not as in the run of the whole; empty: nothing.
std::string difference(const Piece& piece, const std::vector<double>& xy, const SmoothingResult& found,
                       const Run& whole) {
  for (std::size_t i = 0; i < xy.size(); ++i) {
    const double expected = whole.xy[2 * static_cast<std::size_t>(piece.ids[i / 2]) + i % 2];
    if (!same_bits(xy[i], expected)) {
      return fmt::format("vertex {} is at {} = {} instead of {}", piece.ids[i / 2], i % 2 == 0 ? "x" : "y", xy[i],
                         expected);
    }
  }
  if (figures(found) != figures(whole.result)) {
    return figures(found) + " instead of " + figures(whole.result);
  }
  // (Devices evaluate all vertices while many move.)
  const bool is_of_cpu = found.backend == "cpu";
  if (is_of_cpu && found.vertex_updates != whole.result.vertex_updates) {
    return fmt::format("{} updates instead of {}", found.vertex_updates, whole.result.vertex_updates);
  }
  for (std::size_t i = 0; i < found.history.size(); ++i) {
    const SweepRecord& a = found.history[i];
    const SweepRecord& b = whole.result.history[i];
    if ((is_of_cpu && a.evaluated != b.evaluated) || a.moved != b.moved ||
        !same_bits(a.max_relative_move, b.max_relative_move) || !same_bits(a.min_shape + 0.0, b.min_shape + 0.0)) {
      return fmt::format("sweep {} of the history", i + 1);
    }
  }
  return {};
}

/// Smooths the pieces twice by one plan, and says what is not as in the whole, alike on all ranks. Collective.
std::string in_pieces(const Whole& whole, const Cut& cut, SmoothingOptions options, const Run& expected,
                      std::uint64_t seed = 1) {
  const Piece piece = piece_of(whole, cut, seed);
  options.mean_ratio.target_lengths = piece.lengths;
  options.backend = backend_of_pieces();
  std::string wrong;
  try {
    Plan plan(MPI_COMM_WORLD, piece.mesh(), Constraints{.fixed = piece.fixed, .regions = piece.regions}, options,
              Gather::where_needed);
    for (int call = 0; call < 2 && said_by_any(wrong).empty(); ++call) {
      std::vector<double> xy = piece.xy;
      const SmoothingResult result = plan.smooth(xy);
      wrong = difference(piece, xy, result, expected);
    }
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  return said_by_any(wrong);
}

Cut any_cut(const Whole& whole, std::mt19937_64& random) {
  const auto count = static_cast<std::uint64_t>(ranks());
  const bool is_in_strips = random() % 2 == 0;
  double width = 0;
  for (const auto& [x, y] : whole.mesh.points) {
    width = std::max(width, x);
  }
  Cut cut;
  for (const Element& element : whole.mesh.elements) {
    const double x = whole.mesh.points[static_cast<std::size_t>(element[0])][0];
    const auto drawn = static_cast<int>(random() % count);
    const int strip = std::clamp(static_cast<int>(ranks() * x / width), 0, ranks() - 1);
    cut.rank_of_element.push_back(is_in_strips ? strip : drawn);
    cut.has_copy.push_back(random() % 8 == 0 ? 1 : 0);
  }
  if (random() % 2 == 0) {
    for (std::size_t v = 0; v < whole.mesh.points.size(); ++v) {
      cut.owners.push_back(static_cast<std::int32_t>(random() % count));
    }
  }
  return cut;
}

Whole any_mesh(std::mt19937_64& random) {
  Whole whole;
  whole.mesh = mixed_meshes::random_mesh(random());
  if (random() % 3 == 0) {
    whole.mesh = whole.mesh.listed_from_other_corners(random(), true);
  }
  for (std::size_t v = 0; v < whole.mesh.points.size(); ++v) {
    whole.fixed.push_back(random() % 10 == 0 ? 1 : 0);
    whole.lengths.push_back(0.5 + static_cast<double>(random() % 100) / 100);
  }
  if (random() % 2 == 0) {
    for (const Element& element : whole.mesh.elements) {
      whole.regions.push_back(whole.mesh.points[static_cast<std::size_t>(element[0])][1] > 3 ? 7 : 2);
    }
  }
  if (random() % 2 == 0) {
    whole.lengths.clear();
  }
  return whole;
}

SmoothingOptions any_options(std::uint64_t number, std::mt19937_64& random) {
  SmoothingOptions options = properties::combination(number);
  options.layers = random() % 2 == 0 ? Layers::automatic : Layers::smooth;
  options.max_sweeps = static_cast<std::int64_t>(1 + random() % 20);
  options.tolerance = random() % 3 == 0 ? 1e-2 : 0;
  options.guard = random() % 4 != 0;
  options.record_min_shape = random() % 2 == 0;
  options.untangle = static_cast<Untangle>(random() % 3);
  options.evaluation = random() % 4 == 0 ? Evaluation::all : Evaluation::changed;
  options.mean_ratio.target = random() % 2 == 0 ? TargetShape::input : TargetShape::uniform;
  if (random() % 4 == 0) {
    options.target_quality = 0.4;
  }
  return options;
}

TEST_CASE("random meshes with quadrilaterals in pieces come out with the bits of the whole") {
  std::mt19937_64 random(20);
  const auto meshes = static_cast<std::uint64_t>(properties::meshes_of(600));
  for (std::uint64_t number = 0; number < meshes; ++number) {
    const Whole whole = any_mesh(random);
    const SmoothingOptions options = any_options(number, random);
    const Cut cut = any_cut(whole, random);
    const std::string wrong = in_pieces(whole, cut, options, run_whole(whole, options), number);
    INFO(fmt::format("mesh {}: {}", number, properties::text_of(options)));
    REQUIRE(wrong == "");
  }
}

TEST_CASE("so does a larger one, by every method, form and precision") {
  Whole whole;
  whole.mesh = MixedMesh(70, 70, 0.35, 3);
  std::mt19937_64 random(5);
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    SmoothingOptions options = properties::combination(index);
    options.max_sweeps = 8;
    INFO(properties::text_of(options));
    REQUIRE(in_pieces(whole, any_cut(whole, random), options, run_whole(whole, options)) == "");
  }
}

TEST_CASE("where neighbours and the corners opposite are all of other ranks, a move of any of them is seen") {
  Whole whole;
  whole.mesh = MixedMesh(12, 12, 0.3, 4, 0);
  Cut cut;
  for (std::size_t e = 0; e < whole.mesh.elements.size(); ++e) {
    cut.rank_of_element.push_back(static_cast<int>(e) % ranks());
  }
  // Two rows below the same columns are those of other ranks.
  for (std::int32_t v = 0; v < whole.mesh.vertex_count(); ++v) {
    cut.owners.push_back((v % 13 + 2 * (v / 13)) % ranks());
  }
  for (const Form form : {Form::swap, Form::in_place}) {
    SmoothingOptions options;
    options.form = form;
    options.threads = 1;
    options.tolerance = 0;
    CHECK(in_pieces(whole, cut, options, run_whole(whole, options)) == "");
  }
}

TEST_CASE("layers of quadrilaterals are kept as in the whole, wherever they are cut") {
  // The lowest rows are rectangles eight times as long as high.
  Whole whole;
  whole.mesh = MixedMesh(30, 20, 0.2, 6, 0);
  for (auto& [x, y] : whole.mesh.points) {
    const bool is_low = y < 8.5;
    x = is_low ? std::round(x) : x;
    y = is_low ? std::round(y) / 8 : y - 7;
  }
  std::mt19937_64 random(7);
  SmoothingOptions options;
  options.threads = 1;
  options.max_sweeps = 5;
  const Run expected = run_whole(whole, options);
  CHECK(expected.result.layers.kept > 0);
  for (int i = 0; i < 6; ++i) {
    CHECK(in_pieces(whole, any_cut(whole, random), options, expected) == "");
  }
}

TEST_CASE("quadrilaterals in pieces follow their boundary to the bits of the whole") {
  Whole whole;
  whole.mesh = MixedMesh(20, 16, 0.2, 9);
  std::mt19937_64 random(10);
  const auto bent = [](std::vector<double> xy) {
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      xy[i + 1] += 0.02 * xy[i] * (20 - xy[i]) * xy[i + 1] / 16;
    }
    return xy;
  };
  std::vector<double> expected = bent(whole.mesh.xy());
  const FollowResult of_whole =
      trismooth::MovingMesh(whole.mesh.points, whole.mesh.elements).follow(xy_points(expected));
  REQUIRE(of_whole.is_valid());
  for (int i = 0; i < 4; ++i) {
    const Piece piece = piece_of(whole, any_cut(whole, random), 1);
    trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, xy_points(piece.xy), piece.mesh());
    std::vector<double> xy = bent(piece.xy);
    const FollowResult result = moving.follow(xy_points(xy));
    CHECK(result.is_valid());
    CHECK(same_bits(result.mean_relative_shape, of_whole.mean_relative_shape));
    std::string wrong;
    for (std::size_t k = 0; k < xy.size(); ++k) {
      if (!same_bits(xy[k], expected[2 * static_cast<std::size_t>(piece.ids[k / 2]) + k % 2])) {
        wrong = fmt::format("vertex {}", piece.ids[k / 2]);
      }
    }
    REQUIRE(said_by_any(wrong) == "");
  }
}

TEST_CASE("some ranks may list triangles by three numbers, and others four of each element") {
  // Quadrilaterals on rank 0, triangles on the others.
  const MixedMesh grid(16, 16, 0.3, 8);
  Whole whole;
  Cut cut;
  cut.says_ids = false;
  whole.mesh.points = grid.points;
  for (int r = 0; r < ranks(); ++r) {
    for (std::size_t e = 0; e < grid.elements.size(); ++e) {
      const int to = grid.is_triangle(e) ? static_cast<int>(e) % ranks() : 0;
      if (to == r) {
        whole.mesh.elements.push_back(grid.elements[e]);
        cut.rank_of_element.push_back(r);
      }
    }
  }
  SmoothingOptions options;
  options.threads = 1;
  const Run expected = run_whole(whole, options);
  const Piece piece = piece_of(whole, cut, 1);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Element& element : piece.elements) {
    triangles.push_back({element[0], element[1], element[2]});
  }
  LocalMesh local = piece.mesh();
  if (rank() > 0) {
    local.triangles = triangles;
  }
  std::vector<double> xy = piece.xy;
  const SmoothingResult result = Plan(MPI_COMM_WORLD, local, options).smooth(xy);
  CHECK(said_by_any(difference(piece, xy, result, expected)) == "");
}

TEST_CASE("triangles that are listed by four numbers are smoothed as triangles are") {
  Whole whole;
  whole.mesh = MixedMesh(10, 10, 0.3, 9, 3);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Element& element : whole.mesh.elements) {
    triangles.push_back({element[0], element[1], element[2]});
  }
  std::mt19937_64 random(10);
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.threads = 1;
  Run expected{whole.mesh.xy(), {}};
  expected.result = trismooth::plan(whole.mesh.vertex_count(), triangles, options).smooth(expected.xy);
  CHECK(in_pieces(whole, any_cut(whole, random), options, expected) == "");
}

/// The error of a plan whose elements `spoil` changes on this rank, and whether all ranks say the same.
std::string error_of(const std::function<void(Piece&)>& spoil, const SmoothingOptions& options = {}) {
  Whole whole;
  whole.mesh = MixedMesh(8, 8, 0.2, 11, 0);
  Cut cut;
  for (std::size_t e = 0; e < whole.mesh.elements.size(); ++e) {
    cut.rank_of_element.push_back(static_cast<int>(e) % ranks());
  }
  cut.says_ids = false;
  Piece piece = piece_of(whole, cut, 1);
  spoil(piece);
  std::string said = "nothing";
  try {
    (void)Plan(MPI_COMM_WORLD, piece.mesh(), options);
  } catch (const MeshError& error) {
    said = std::string("MeshError: ") + error.what();
  } catch (const std::invalid_argument& error) {
    said = std::string("invalid_argument: ") + error.what();
  }
  return mpi_tests::say_the_same(said) ? said : "something else on each rank";
}

TEST_CASE("a quadrilateral that is none on one rank is told of on all") {
  const int last = ranks() - 1;
  const std::string on_last = ranks() > 1 ? fmt::format("MeshError: rank {}: ", last) : "MeshError: ";
  const auto on_last_rank = [last](const auto& spoil) {
    return error_of([&](Piece& piece) {
      if (rank() == last) {
        spoil(piece);
      }
    });
  };
  CHECK(on_last_rank([](Piece& piece) { piece.elements[3][2] = piece.elements[3][0]; }) ==
        on_last + "element 3 repeats a vertex");
  CHECK(on_last_rank([](Piece& piece) { piece.elements[2][3] = piece.elements[2][2]; }) ==
        on_last + "element 2 repeats a vertex; of a triangle the last of four numbers is -1");
  CHECK(on_last_rank([](Piece& piece) { piece.elements[1][1] = -1; }) ==
        on_last + "element 1 names vertex -1, which is no vertex: only the last of four numbers is -1, of a triangle");
  CHECK(says(on_last_rank([](Piece& piece) { piece.elements[0][3] = 5000; }), on_last + "element 0 names vertex 5000"));
}

TEST_CASE("a quadrilateral on two ranks that neither calls a copy is refused by the ids of its corners") {
  if (ranks() == 1) {
    return;
  }
  const std::string said = error_of([](Piece& piece) {
    // The first one, of vertices 0, 1, 9 and 10, on rank 1 as well.
    if (rank() == 1) {
      Element copy{};
      for (std::size_t i = 0; const std::int64_t id : {0, 1, 10, 9}) {
        const auto place = std::ranges::find(piece.ids, id);
        copy[i++] = static_cast<std::int32_t>(place - piece.ids.begin());
        if (place == piece.ids.end()) {
          const auto column = static_cast<double>(id % 9);
          piece.ids.push_back(id);
          piece.xy.insert(piece.xy.end(), {column, 0});
        }
      }
      piece.elements.push_back(copy);
      piece.ghosts.push_back(0);
    }
  });
  CHECK(says(said,
             "the quadrilateral of vertex ids 0, 1, 9 and 10 is on rank 0 and "
             "on rank 1; copies are to be in ghost_triangles"));
}

TEST_CASE("corners that are not listed in turn are named as what may be wrong") {
  // Of an element in the middle, which contradicts those on two sides of it then.
  constexpr int middle = 27;
  const std::string said = error_of([](Piece& piece) {
    if (rank() == middle % ranks()) {
      Element& element = piece.elements[static_cast<std::size_t>(middle / ranks())];
      std::swap(element[1], element[2]);
    }
  });
  CHECK(says(said, "MeshError"));
  CHECK(says(said, "or a quadrilateral whose corners are not listed in turn"));
}

TEST_CASE(
    "a backend that has no way for quadrilaterals in pieces is refused, or rank 0's CPU smooths all and says so") {
  const fakes::FakeBackend fake;
  SmoothingOptions options;
  options.threads = 1;
  options.backend = &fake;
  CHECK(says(error_of([](Piece&) {}, options), "Gather::where_needed"));
  Whole whole;
  whole.mesh = MixedMesh(9, 9, 0.3, 12);
  std::mt19937_64 random(13);
  const Cut cut = any_cut(whole, random);
  const Piece piece = piece_of(whole, cut, 1);
  std::vector<double> xy = piece.xy;
  const SmoothingResult result = Plan(MPI_COMM_WORLD, piece.mesh(), options, Gather::where_needed).smooth(xy);
  options.backend = nullptr;
  CHECK(said_by_any(difference(piece, xy, result, run_whole(whole, options))) == "");
  CHECK(says(result.backend_note, "the CPU of rank 0"));
}

}  // namespace trismooth::mpi_quadrilaterals_test
