// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "mpi/pieces.h"
#include "properties/smoothing_cases.h"

/// Pieces of larger meshes that are smoothed, and held against runs of the whole. What smooths is collective.
namespace mpi_tests {

using properties::Run;

/// The Delaunay mesh of so many random points.
RandomMesh delaunay_mesh(std::int32_t vertices, std::uint64_t seed);

/// Of every triangle its rank: along x, around the middle of the unit square, drawn.
std::vector<int> in_strips(const RandomMesh& mesh);
std::vector<int> in_sectors(const RandomMesh& mesh);
std::vector<int> scattered(const RandomMesh& mesh);

/// Owners drawn among all ranks, whether they have the vertex or not.
void draw_owners(Piece& piece);
void all_owned_by(Piece& piece, std::int32_t owner);

/// On one thread.
trismooth::SmoothingOptions options_of(trismooth::Method method, trismooth::Form form, std::int64_t sweeps = 8);

/// What is not as in the run of the whole; empty: nothing.
std::string not_as_whole(const Piece& piece, const std::vector<double>& xy, const trismooth::SmoothingResult& found,
                         const Run& whole);

/// Smooths the pieces, and says what is not as in the run of the whole, alike on all ranks.
std::string smoothed_piece(const Piece& piece, const trismooth::SmoothingOptions& options, const Run& whole);

}  // namespace mpi_tests
