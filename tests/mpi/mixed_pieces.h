// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mpi/plan.h"
#include "trismooth/smoothing/smooth.h"

#include "mpi/pieces.h"
#include "properties/smoothing_cases.h"
#include "support/mixed_meshes.h"
#include "support/same_bits.h"

/// Who makes the sweeps of pieces; null: the CPU.
const trismooth::Backend* backend_of_pieces();

/// A mesh with quadrilaterals cut into pieces, one a rank; every rank knows the whole and takes its own.
namespace trismooth::mixed_pieces {

using mixed_meshes::Element;
using mixed_meshes::MixedMesh;
using mpi::Gather;
using mpi::LocalMesh;
using mpi::Plan;
using mpi_tests::rank;
using mpi_tests::ranks;
using mpi_tests::said_by_any;

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

inline Run run_whole(const Whole& whole, SmoothingOptions options) {
  options.mean_ratio.target_lengths = whole.lengths;
  Run run{whole.mesh.xy(), {}};
  run.result = trismooth::plan(whole.mesh.vertex_count(), whole.mesh.elements,
                               Constraints{.fixed = whole.fixed, .regions = whole.regions}, options)
                   .smooth(run.xy);
  return run;
}

inline Piece piece_of(const Whole& whole, const Cut& cut, std::uint64_t seed) {
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

inline std::string figures(const SmoothingResult& r) {
  return fmt::format(
      "{} sweeps, {}, {} moved, {} back in {} rounds, {} free, {} colours, {} inverted, {} without area, "
      "{} quadrilaterals, layers: {} kept, {} left, {} records",
      r.sweeps, to_string(r.stop_reason), r.moved_vertices, r.reverted_vertices, r.guard_rounds, r.free_vertices,
      r.colours, r.inverted, r.degenerate, r.quadrilaterals, r.layers.kept, r.layers.left, r.history.size());
}

/// What is not as in the run of the whole; empty: nothing.
inline std::string difference(const Piece& piece, const std::vector<double>& xy, const SmoothingResult& found,
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
inline std::string in_pieces(const Whole& whole, const Cut& cut, SmoothingOptions options, const Run& expected,
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

inline Cut any_cut(const Whole& whole, std::mt19937_64& random) {
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

inline Whole any_mesh(std::mt19937_64& random) {
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

inline SmoothingOptions any_options(std::uint64_t number, std::mt19937_64& random) {
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

}  // namespace trismooth::mixed_pieces
