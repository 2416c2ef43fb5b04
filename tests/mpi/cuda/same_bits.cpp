// SPDX-License-Identifier: BSD-3-Clause
// So it does where devices make the sweeps, each rank on one, with quadrilaterals as well.

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"

#include "catch.h"
#include "mpi/random_pieces.h"

const char* reason_to_skip();
const char* reason_to_skip() {
  return trismooth::cuda::survey_devices().devices.empty() ? "no CUDA device" : nullptr;
}

// (See quadrilaterals.cpp, whose tests are among those of this program.)
const trismooth::Backend* backend_of_pieces();
const trismooth::Backend* backend_of_pieces() {
  return &trismooth::cuda::backend();
}

using mpi_tests::check_random_meshes;
using trismooth::mpi::Gather;

TEST_CASE("random meshes in pieces on devices come out with the bits of the whole on the CPU") {
  check_random_meshes(1000, Gather::never, false, &trismooth::cuda::backend());
}

TEST_CASE("on devices, too, what has to be untangled is gathered on one rank") {
  check_random_meshes(100, Gather::where_needed, false, &trismooth::cuda::backend());
}
