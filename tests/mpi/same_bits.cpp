// SPDX-License-Identifier: BSD-3-Clause
// A mesh in pieces comes out with the bits of the whole, for every number of ranks and every way of cutting.

#include "catch.h"
#include "mpi/random_pieces.h"

using mpi_tests::check_random_meshes;
using trismooth::mpi::Gather;

TEST_CASE("random meshes in pieces come out with the bits of the whole") {
  check_random_meshes(1000, Gather::never, false);
}

TEST_CASE("so do those that have to be untangled, gathered on one rank") {
  check_random_meshes(500, Gather::where_needed, false);
}

TEST_CASE("so do those whose boundaries slide, gathered on one rank") {
  check_random_meshes(500, Gather::where_needed, true);
}
