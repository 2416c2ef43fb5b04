// SPDX-License-Identifier: BSD-3-Clause
// A stage of one's own between reading and smoothing: it marks every vertex with its distance from the nearest
// interface, in edges, found by circulating around vertices of the run's OpenMesh mesh, and holds those that are near.
// Usage: hold_near_interface INPUT OUTPUT EDGES. Link with trismooth::pipeline.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <utility>
#include <vector>

#include "trismooth/pipeline/halfedge_stage.h"
#include "trismooth/pipeline/pipeline.h"

namespace {

/// How many edges each point of the file is away from an edge between two regions; -1: none can be reached.
std::vector<std::int32_t> distances_from_interfaces(const trismooth::HalfedgeStage& stage) {
  std::vector<std::int32_t> distances(stage.document.point_count(), -1);
  std::vector<OpenMesh::VertexHandle> front;
  const auto reach = [&](OpenMesh::VertexHandle vertex, std::int32_t distance) {
    std::int32_t& known = distances[static_cast<std::size_t>(stage.point_of(vertex))];
    if (known < 0) {
      known = distance;
      front.push_back(vertex);
    }
  };
  const auto region = [&](const OpenMesh::SmartFaceHandle& face) {
    return stage.regions[static_cast<std::size_t>(face.idx())];
  };
  for (const auto edge : stage.mesh.edges()) {
    if (!stage.regions.empty() && !edge.is_boundary() && region(edge.h0().face()) != region(edge.h1().face())) {
      reach(edge.v0(), 0);
      reach(edge.v1(), 0);
    }
  }
  for (std::int32_t distance = 1; !front.empty(); ++distance) {
    for (const OpenMesh::VertexHandle vertex : std::exchange(front, {})) {
      for (const auto neighbour : stage.mesh.vv_range(vertex)) {
        reach(neighbour, distance);
      }
    }
  }
  return distances;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: hold_near_interface INPUT OUTPUT EDGES\n", stderr);
    return 2;
  }
  const long edges = std::strtol(argv[3], nullptr, 10);
  try {
    trismooth::PipelineOptions options;
    options.input = argv[1];
    options.output = argv[2];
    options.halfedge_stage = [edges](trismooth::HalfedgeStage& stage) {
      std::vector<std::int32_t> distances = distances_from_interfaces(stage);
      for (const std::int32_t distance : distances) {
        stage.fixed.push_back(distance >= 0 && distance <= edges ? 1 : 0);
      }
      stage.point_arrays.push_back(trismooth::make_data_array("distance_from_interface", 1, std::move(distances)));
    };
    const trismooth::PipelineResult result = trismooth::run_pipeline(options);
    std::printf("%lld vertices on interfaces, %lld held by this program; %lld of %lld moved\n",
                static_cast<long long>(result.input.held.interface), static_cast<long long>(result.input.held.named),
                static_cast<long long>(result.smoothing->moved_vertices),
                static_cast<long long>(result.input.vertices));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
