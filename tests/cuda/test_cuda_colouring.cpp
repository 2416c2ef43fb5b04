// SPDX-License-Identifier: BSD-3-Clause
// The colours are the host's, and the device gives up before a numbering makes it work for each vertex.

#include <cstdint>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/packing/colouring.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "support/hostile_meshes.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using trismooth::Workers;

namespace cuda = trismooth::cuda;

namespace {

/// Colours on both sides; answers the rounds on the device.
int check_colours(const Mesh& mesh) {
  Workers workers(0);
  const trismooth::MeshRings found = trismooth::find_mesh_rings(mesh.points, mesh.triangles, {}, workers);
  const trismooth::Colouring expected = trismooth::colour_free_vertices(found.rings.view(), workers);
  cuda::Context context;
  const std::vector<std::uint32_t> offsets(found.rings.offsets.begin(), found.rings.offsets.end());
  const cuda::DeviceBuffer<std::uint32_t> device_offsets(context, offsets);
  const cuda::DeviceBuffer<std::int32_t> neighbours(context, found.rings.neighbours);
  const cuda::DeviceColouring colouring =
      cuda::colour_vertices(context, cuda::RingsView{mesh.vertex_count(), device_offsets.data(), neighbours.data()});
  CHECK(colouring.count == expected.count);
  CHECK(cuda::download(context, colouring.colours.data(), colouring.colours.size()) == expected.colours);
  return colouring.rounds;
}

}  // namespace

TEST_CASE("ordinary meshes are coloured in few rounds") {
  CHECK(check_colours(test_meshes::jittered_grid(300, 300, 0.3, 1)) < 20);
  CHECK(check_colours(test_meshes::shuffled(test_meshes::jittered_grid(130, 130, 0.3, 1), 2)) < 20);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    check_colours(mesh);
  }
}

TEST_CASE("a chain against the order takes no round for each of its vertices") {
  for (const std::int32_t length : {10, 1000, 100000}) {
    CAPTURE(length);
    CHECK(check_colours(hostile_meshes::chain(length)) <= cuda::DeviceColouring::most_rounds);
  }
}

TEST_CASE("a hub of many neighbours is coloured as on the host") {
  check_colours(hostile_meshes::wheel(20000));
}
