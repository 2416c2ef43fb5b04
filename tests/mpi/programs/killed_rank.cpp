// SPDX-License-Identifier: BSD-3-Clause
// Rank 1 dies in the middle of smoothing: the others must not wait for it for ever.

#include <csignal>
#include <cstdlib>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/plan.h"

#include "support/test_meshes.h"

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int rank = 0;
  int ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  // Every rank has all vertices, and its share of the triangles.
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 1);
  std::vector<std::int64_t> ids;
  for (std::int64_t v = 0; v < mesh.vertex_count(); ++v) {
    ids.push_back(v);
  }
  std::vector<trismooth::Triangle> triangles;
  for (std::size_t t = static_cast<std::size_t>(rank); t < mesh.triangles.size();
       t += static_cast<std::size_t>(ranks)) {
    triangles.push_back(mesh.triangles[t]);
  }
  trismooth::SmoothingOptions options;
  options.threads = 1;
  options.progress = [rank](const trismooth::SweepRecord& record) {
    if (rank == 1 && record.sweep == 2) {
      std::raise(SIGKILL);
    }
    return trismooth::Progress::proceed;
  };
  std::vector<double> xy = mesh.xy();
  trismooth::mpi::Plan(MPI_COMM_WORLD, {triangles, ids}, options).smooth(xy);
  MPI_Finalize();
  return EXIT_SUCCESS;
}
