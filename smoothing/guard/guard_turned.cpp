#include "trismooth/smoothing/guard/guard_turned.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trismooth {

namespace {

/// The corners of the components that the untangling has turned over, ascending.
std::vector<std::int32_t> turned_vertices(std::span<const Triangle> elements, std::span<const std::uint8_t> turned) {
  std::vector<std::int32_t> vertices;
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] != 0) {
      vertices.insert(vertices.end(), elements[t].begin(), elements[t].end());
    }
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

GuardOutcome guard_turned(std::int32_t vertex_count, std::span<const Triangle> elements,
                          std::optional<UntanglingResult>& untangling, const GuardedMeshOf& mesh_of, Workers& workers) {
  const std::vector<std::uint8_t> turned = untangling ? untangling->turned : std::vector<std::uint8_t>{};
  const std::unique_ptr<GuardedMesh> mesh = mesh_of(turned);
  GuardOutcome outcome = guard_in_rounds(vertex_count, elements, *mesh, workers);
  const std::vector<std::int32_t> of_turned = turned_vertices(elements, turned);
  const bool is_disturbed =
      std::ranges::any_of(outcome.reverted, [&](std::int32_t v) { return std::ranges::binary_search(of_turned, v); });
  if (!is_disturbed) {
    return outcome;
  }
  for (const std::int32_t v : of_turned) {
    if (mesh->has_moved(v)) {
      mesh->put_back(v);
      outcome.reverted.push_back(v);
    }
  }
  untangling->turned.clear();
  untangling->turned_components = 0;
  const std::unique_ptr<GuardedMesh> as_listed = mesh_of({});
  const GuardOutcome more = guard_in_rounds(vertex_count, elements, *as_listed, workers);
  outcome.reverted.insert(outcome.reverted.end(), more.reverted.begin(), more.reverted.end());
  outcome.rounds += more.rounds;
  return outcome;
}

std::int64_t count_inverted(std::span<const Triangle> elements, std::span<const std::uint8_t> fixed,
                            const std::function<double(std::int32_t)>& quotient_of) {
  std::int64_t inverted = 0;
  for (std::int32_t t = 0; t < std::ssize(elements); ++t) {
    const bool has_free_vertex = std::ranges::any_of(elements[static_cast<std::size_t>(t)], [fixed](std::int32_t v) {
      return fixed[static_cast<std::size_t>(v)] == 0;
    });
    inverted += has_free_vertex && !(quotient_of(t) > 0) ? 1 : 0;
  }
  return inverted;
}

}  // namespace trismooth
