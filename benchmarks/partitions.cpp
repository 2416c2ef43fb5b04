// SPDX-License-Identifier: BSD-3-Clause
// How many copies of others' vertices ranks hold of a mesh that is bisected, and that METIS partitions: as one file,
// whose vertices it partitions, and as pieces, of whose blocks it does. Every rank reads the mesh.
//
//     mpirun -n 8 partitions MESH...
//
// Prints rows of a table: own vertices and ghosts of the rank that has most, ghosts of all, seconds.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <mpi.h>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mpi/plan.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/ranks/partition/vertex_owners.h"

namespace {

using namespace trismooth;

/// What a rank has of the mesh.
struct Share {
  std::vector<Point2<double>> points;
  std::vector<std::int64_t> ids;
  std::vector<Triangle> triangles;
};

/// The triangles from `begin` to `end`, with their vertices.
Share share_of(const PlanarMesh& mesh, std::size_t begin, std::size_t end) {
  Share share;
  for (const Triangle& triangle : mesh.elements.triangles().subspan(begin, end - begin)) {
    share.ids.insert(share.ids.end(), triangle.begin(), triangle.end());
  }
  std::ranges::sort(share.ids);
  share.ids.erase(std::unique(share.ids.begin(), share.ids.end()), share.ids.end());
  for (const std::int64_t id : share.ids) {
    share.points.push_back(mesh.points[static_cast<std::size_t>(id)]);
  }
  const auto place = [&](std::int64_t id) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(share.ids, id) - share.ids.begin());
  };
  for (const auto& [a, b, c] : mesh.elements.triangles().subspan(begin, end - begin)) {
    share.triangles.push_back({place(a), place(b), place(c)});
  }
  return share;
}

void measure(const std::string& name, const Share& share, Partition partition, const mpi::Communicator& ranks) {
  const Stopwatch watch;
  const std::vector<std::int32_t> owners = find_owners(partition, {share.points, share.triangles, {}}, ranks);
  const double seconds = watch.milliseconds() / 1000;
  const mpi::Plan plan(ranks.handle(), {share.triangles, share.ids, owners});
  std::array<std::int64_t, 2> most{plan.own_vertices(), plan.ghost_vertices()};
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 2, MPI_INT64_T, MPI_MAX, ranks.handle());
  const std::int64_t ghosts = ranks.sum(plan.ghost_vertices());
  if (ranks.rank() == 0) {
    fmt::print("| {} | {} | {} | {} | {} | {:.2f} |\n", name, ranks.size(), most[0], most[1], ghosts, seconds);
    std::fflush(stdout);
  }
}

void compare(const std::filesystem::path& path, const mpi::Communicator& ranks) {
  const MeshDocument document = read_mesh(path);
  const PlanarMesh mesh = planar_mesh(document, path, Quads::hold);
  const std::size_t count = mesh.elements.triangles().size();
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  const Share as_one_file = rank == 0 ? share_of(mesh, 0, count) : Share{};
  const Share as_pieces = share_of(mesh, count * rank / size, count * (rank + 1) / size);
  const std::string name = path.filename().string();
  measure(name + ", bisect", as_pieces, Partition::bisect, ranks);
  measure(name + ", metis of pieces", as_pieces, Partition::metis, ranks);
  measure(name + ", metis of one file", as_one_file, Partition::metis, ranks);
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  {
    const mpi::Communicator ranks(MPI_COMM_WORLD);
    ranks.together([&] {
      for (int i = 1; i < argc; ++i) {
        compare(argv[i], ranks);
      }
    });
  }
  MPI_Finalize();
}
