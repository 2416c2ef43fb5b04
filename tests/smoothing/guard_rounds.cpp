#include "trismooth/smoothing/guard/guard_rounds.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/guard_rule.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Point;
using trismooth::guard_in_rounds;
using trismooth::Workers;

namespace {

/// A mesh of plain triangles with two places for each vertex.
class TwoPlaces : public trismooth::GuardedMesh {
 public:
  TwoPlaces(const Mesh& mesh, std::vector<Point> after) : mesh_(mesh), after_(std::move(after)) {}

  bool has_moved(std::int32_t vertex) const override { return !(after_[vertex] == mesh_.points[vertex]); }
  double quotient_before(std::int32_t element) const override {
    return naive::element_quotient(mesh_.points, mesh_.triangles[element]);
  }
  double worsened(std::int32_t element) const override {
    return trismooth::worsened_quotient(quotient_before(element),
                                        naive::element_quotient(after_, mesh_.triangles[element]));
  }
  void put_back(std::int32_t vertex) override { after_[vertex] = mesh_.points[vertex]; }

  const std::vector<Point>& after() const { return after_; }

 private:
  const Mesh& mesh_;
  std::vector<Point> after_;
};

std::vector<Point> shaken(const Mesh& mesh, double reach, test_meshes::Random& random) {
  std::vector<Point> points = mesh.points;
  for (Point& p : points) {
    if (random.below(3) > 0) {
      const double distance = random.below(6) == 0 ? reach : reach / 10;
      p = {p.x + random.between(-distance, distance), p.y + random.between(-distance, distance)};
    }
  }
  return points;
}

}  // namespace

TEST_CASE("rounds over listed elements take back what a look at every element in every round does") {
  test_meshes::Random random(3);
  std::int64_t most_rounds = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Mesh mesh = test_meshes::jittered_grid(4 + random.below(9), 4 + random.below(9), random.between(0.1, 0.7),
                                                 static_cast<std::uint64_t>(trial));
    const std::vector<Point> moved = shaken(mesh, random.between(0.01, 0.2), random);
    std::vector<Point> expected_points = moved;
    const naive::Guarded expected = naive::guard(mesh.triangles, mesh.points, expected_points);
    TwoPlaces places(mesh, moved);
    Workers workers(trial % 3 + 1);
    const auto outcome = guard_in_rounds(mesh.vertex_count(), mesh.triangles, places, workers);
    CAPTURE(trial);
    REQUIRE(outcome.reverted == expected.reverted);
    REQUIRE(outcome.rounds == expected.rounds);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      REQUIRE(same_bits(places.after()[v], expected_points[v]));
    }
    most_rounds = std::max(most_rounds, outcome.rounds);
  }
  CHECK(most_rounds > 2);
}

TEST_CASE("where nothing moved or nothing is listed nothing goes back") {
  const Mesh mesh = test_meshes::jittered_grid(5, 5, 0.3, 1);
  Workers alone(1);
  TwoPlaces same(mesh, mesh.points);
  CHECK(guard_in_rounds(mesh.vertex_count(), mesh.triangles, same, alone).rounds == 0);
  CHECK(guard_in_rounds(mesh.vertex_count(), {}, same, alone).reverted.empty());
}
