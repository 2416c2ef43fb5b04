// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/random_pieces.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/splitmix64.h"

#include "mpi/pieces.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

namespace mpi_tests {

using properties::for_random_meshes;
using properties::for_some_options;
using properties::Run;
using properties::SmoothingOptions;
using trismooth::mpi::Gather;

namespace {

/// The first thing in which what a rank has of a run in pieces differs from the run of the whole.
std::string difference(const Piece& piece, const std::vector<double>& xy, const trismooth::SmoothingResult& found,
                       const Run& whole) {
  for (std::size_t i = 0; i < piece.global.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double expected = whole.xy[2 * static_cast<std::size_t>(piece.global[i]) + k];
      if (!same_bits(xy[2 * i + k], expected)) {
        return fmt::format("vertex {} is at {} = {} instead of {}", piece.global[i], k == 0 ? "x" : "y", xy[2 * i + k],
                           expected);
      }
    }
  }
  const trismooth::SmoothingResult& expected = whole.result;
  const auto differ = [](const char* what, auto a, auto b) {
    return a == b ? std::string() : fmt::format("{}: {} instead of {}", what, a, b);
  };
  std::string wrong =
      differ("sweeps", found.sweeps, expected.sweeps) +
      differ("reason", to_string(found.stop_reason), to_string(expected.stop_reason)) +
      (found.backend == "cpu" ? differ("updates", found.vertex_updates, expected.vertex_updates) : std::string()) +
      differ("moved", found.moved_vertices, expected.moved_vertices) +
      differ("inverted in the result", found.inverted, expected.inverted) +
      differ("without area", found.degenerate, expected.degenerate) +
      differ("reverted", found.reverted_vertices, expected.reverted_vertices) +
      differ("rounds", found.guard_rounds, expected.guard_rounds) +
      differ("free", found.free_vertices, expected.free_vertices) + differ("colours", found.colours, expected.colours) +
      differ("records", found.history.size(), expected.history.size());
  for (std::size_t i = 0; wrong.empty() && i < found.history.size(); ++i) {
    const auto& a = found.history[i];
    const auto& b = expected.history[i];
    // (A device may evaluate vertices that stay.)
    wrong += found.backend == "cpu" ? differ("evaluated", a.evaluated, b.evaluated) : std::string();
    wrong += differ("moved in a sweep", a.moved, b.moved);
    wrong += same_bits(a.max_relative_move, b.max_relative_move) ? "" : "the largest move";
    // (A zero may have another sign: which of two is the smallest depends on who looks first.)
    wrong += same_bits(a.min_shape + 0.0, b.min_shape + 0.0) ? "" : "the smallest shape";
  }
  if (expected.untangling) {
    wrong +=
        found.untangling
            ? differ("inverted", found.untangling->inverted_after, expected.untangling->inverted_after) +
                  differ("inverted and held", found.untangling->inverted_fixed, expected.untangling->inverted_fixed)
            : "no word of untangling";
  }
  if (expected.sliding) {
    const auto& a = found.sliding;
    const auto& b = expected.sliding;
    wrong += a ? differ("chains", a->chains, b->chains) + differ("may slide", a->vertices, b->vertices) +
                     differ("in the same place", a->in_same_place, b->in_same_place) +
                     differ("at edges", a->at_edges, b->at_edges) + differ("slid", a->slid, b->slid) +
                     differ("given up", a->given_up, b->given_up)
               : "no word of sliding";
  }
  for (const auto& reverted : found.reverted) {
    const auto global = piece.global[static_cast<std::size_t>(reverted.vertex)];
    const auto place = std::ranges::find(expected.reverted, global, &trismooth::RevertedVertex::vertex);
    if (place == expected.reverted.end() || !same_bits(place->position, reverted.position)) {
      wrong += fmt::format("vertex {} went back", global);
    }
  }
  return wrong;
}

}  // namespace

std::string in_pieces(const RandomMesh& mesh, const SmoothingOptions& options, const Run& whole, Cut cut,
                      Gather gather) {
  const Piece piece = piece_of(mesh, cut, mesh.seed);
  std::vector<double> xy = piece.xy;
  const bool is_tangled = whole.result.untangling && whole.result.untangling->inverted_before > 0;
  trismooth::Constraints constraints = piece.constraints();
  constraints.slide = mesh.slide;
  try {
    trismooth::mpi::Plan plan(MPI_COMM_WORLD, piece.mesh(), constraints, options, gather);
    const auto result = plan.smooth(xy);
    std::string wrong =
        is_tangled && gather == Gather::never ? "a tangled mesh was taken" : difference(piece, xy, result, whole);
    if (said_by_any(wrong).empty()) {
      // The plan again, after another mesh: mirrored.
      std::vector<double> other = xy;
      for (std::size_t i = 0; i < other.size(); i += 2) {
        other[i] = -other[i];
      }
      try {
        plan.smooth(other);
      } catch (const std::invalid_argument&) {
        // It is tangled, on all ranks.
      }
      xy = piece.xy;
      const auto again = plan.smooth(xy);
      wrong = difference(piece, xy, again, whole);
      wrong = wrong.empty() ? wrong : "the plan again: " + wrong;
    }
    return said_by_any(wrong);
  } catch (const std::invalid_argument& error) {
    const bool is_meant =
        is_tangled && gather == Gather::never && std::string(error.what()).find("inverted") != std::string::npos;
    return said_by_any(is_meant ? (xy == piece.xy ? "" : "refused, and moved") : error.what());
  }
}

bool is_for_this_job(std::uint64_t seed) {
  constexpr std::uint64_t jobs = 3;
  return trismooth::splitmix64(seed) % jobs == static_cast<std::uint64_t>(ranks()) % jobs ||
         properties::meshes_of(100) == 0;
}

void check_random_meshes(std::int64_t count, Gather gather, bool slides, const trismooth::Backend* backend) {
  for_random_meshes(count, [&](RandomMesh mesh) -> std::string {
    if (!is_for_this_job(mesh.seed)) {
      return {};
    }
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.record_min_shape = random.below(2) == 0;
      options.guard = random.below(5) != 0;
      if (random.below(4) == 0) {
        options.target_quality = random.between(0, 1);
      }
      if (slides) {
        mesh.slide = properties::any_sliding(random);
      }
      const Run whole = properties::run(mesh, options);
      const auto cut = static_cast<Cut>(random.below(cuts));
      options.backend = backend;
      const std::string wrong = in_pieces(mesh, options, whole, cut, gather);
      return wrong.empty() ? wrong : fmt::format("{} (cut {})", wrong, static_cast<int>(cut));
    });
  });
}

}  // namespace mpi_tests
