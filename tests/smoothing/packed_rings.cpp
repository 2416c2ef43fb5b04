// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/packed_rings.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using trismooth::Form;
using trismooth::OneRings;
using trismooth::pack_rings;
using trismooth::PackedRings;
using trismooth::Workers;

namespace {

OneRings smoothing_rings_of(const Mesh& mesh) {
  Workers workers(1);
  const auto topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  const std::vector<std::uint8_t> reversed(mesh.triangles.size(), 0);
  return trismooth::one_rings(topology, mesh.triangles, reversed, topology.hold, workers);
}

/// The packed rings are the mesh's own under another numbering, free vertices first.
void check_packed(const PackedRings& packed, const OneRings& rings) {
  std::vector<std::int32_t> numbers(packed.input_index.begin(), packed.input_index.end());
  std::ranges::sort(numbers);
  std::vector<std::int32_t> all(static_cast<std::size_t>(rings.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  REQUIRE(numbers == all);
  REQUIRE(packed.view().size() == packed.free_count());
  std::int32_t in_run = 0;
  for (std::size_t r = 0; r < packed.runs.size(); ++r) {
    const trismooth::RingRun& run = packed.runs[r];
    REQUIRE(run.end > in_run);
    REQUIRE((r == 0 || run.ring_size != packed.runs[r - 1].ring_size || run.kind != packed.runs[r - 1].kind));
    for (; in_run < run.end; ++in_run) {
      REQUIRE(std::cmp_equal(packed.view()[in_run].size(), run.ring_size));
      REQUIRE(packed.view().kind(in_run) == run.kind);
    }
  }
  REQUIRE(in_run == packed.free_count());
  for (std::int32_t v = 0; v < packed.vertex_count(); ++v) {
    const std::int32_t input = packed.input_index[v];
    REQUIRE(packed.view().is_free(v) == rings.is_free(input));
    if (packed.view().is_free(v)) {
      std::vector<std::int32_t> ring;
      for (const std::int32_t neighbour : packed.view()[v]) {
        ring.push_back(packed.input_index[neighbour]);
      }
      REQUIRE(std::ranges::equal(ring, rings[input]));
    }
  }
}

}  // namespace

TEST_CASE("packing renumbers the rings and changes nothing else") {
  Workers workers(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const OneRings rings = smoothing_rings_of(mesh);
    for (const Form form : {Form::swap, Form::in_place}) {
      check_packed(pack_rings(rings, mesh.points, form, workers), rings);
    }
  }
}

TEST_CASE("Form A has one batch of all free vertices, Form B one for each colour") {
  Workers workers(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const OneRings rings = smoothing_rings_of(mesh);
    const PackedRings swap = pack_rings(rings, mesh.points, Form::swap, workers);
    CHECK(swap.colours == 0);
    CHECK(swap.batches == std::vector<std::int32_t>{0, swap.free_count()});

    const PackedRings in_place = pack_rings(rings, mesh.points, Form::in_place, workers);
    const auto classes = naive::colour_classes(naive::one_rings(mesh.vertex_count(), mesh.triangles));
    REQUIRE(in_place.colours == static_cast<std::int32_t>(classes.size()));
    REQUIRE(in_place.batches.size() == classes.size() + 1);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const std::set<std::int32_t> found(in_place.input_index.begin() + in_place.batches[c],
                                         in_place.input_index.begin() + in_place.batches[c + 1]);
      CHECK(found == std::set<std::int32_t>(classes[c].begin(), classes[c].end()));
    }
  }
}

TEST_CASE("the packing does not depend on the number of threads") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(180, 180, 0.3, 1), 2);
  const OneRings rings = smoothing_rings_of(mesh);
  for (const Form form : {Form::swap, Form::in_place}) {
    Workers one(1);
    const PackedRings expected = pack_rings(rings, mesh.points, form, one);
    check_packed(expected, rings);
    for (const int threads : {2, 3, 8}) {
      Workers many(threads);
      const PackedRings found = pack_rings(rings, mesh.points, form, many);
      CHECK(found.input_index == expected.input_index);
      CHECK(found.offsets == expected.offsets);
      CHECK(found.neighbours == expected.neighbours);
      CHECK(found.runs == expected.runs);
      CHECK(found.batches == expected.batches);
      CHECK(found.colours == expected.colours);
    }
  }
}

TEST_CASE("a mesh of nothing is packed") {
  Workers workers(1);
  const PackedRings packed = pack_rings(OneRings{}, {}, Form::in_place, workers);
  CHECK(packed.vertex_count() == 0);
  CHECK(packed.free_count() == 0);
}
