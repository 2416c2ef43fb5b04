#include <string>

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

TEST_CASE("no element gets worse, nothing moves that is held, every coordinate is finite, every count is true") {
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    const Connectivity connectivity = connectivity_of(mesh);
    return for_some_options(mesh, 6, [&](SmoothingOptions options, test_meshes::Random& random) {
      options.guard = random.below(5) != 0;
      const Storage storage = fits_float32(mesh) && random.below(3) == 0 ? Storage::float32 : Storage::float64;
      return breach(mesh, connectivity, run(mesh, options, storage), options.guard);
    });
  });
}
