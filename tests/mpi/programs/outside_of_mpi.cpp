// SPDX-License-Identifier: BSD-3-Clause
// A plan is refused before MPI is there and when it has gone, and one that outlives it frees what it has.

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/plan.h"

#include "support/says.h"
#include "support/test_meshes.h"

namespace {

bool is_refused() {
  try {
    const std::vector<trismooth::Triangle> no_triangles;
    const trismooth::mpi::Plan plan(MPI_COMM_WORLD, {no_triangles, {}});
  } catch (const std::logic_error& error) {
    return says(error.what(), "MPI has to be initialised");
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_refused_before = is_refused();
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  const test_meshes::Mesh mesh = test_meshes::star(6);
  const std::vector<std::int64_t> ids{0, 1, 2, 3, 4, 5, 6};
  std::optional<trismooth::mpi::Plan> plan;
  plan.emplace(MPI_COMM_SELF, trismooth::mpi::LocalMesh{mesh.triangles, ids});
  std::vector<double> xy = mesh.xy();
  plan->smooth(xy);
  MPI_Finalize();
  plan.reset();
  const bool is_refused_after = is_refused();
  if (!is_refused_before || !is_refused_after) {
    std::fputs("a plan without MPI was not refused\n", stderr);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
