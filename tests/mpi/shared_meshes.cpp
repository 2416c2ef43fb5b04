// SPDX-License-Identifier: BSD-3-Clause
// Meshes of other people, where they lie beside the checkout, cut by METIS.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mpi/metis_cut.h"
#include "mpi/random_pieces.h"
#include "properties/smoothing_cases.h"

using mpi_tests::Cut;
using mpi_tests::RandomMesh;
using trismooth::mpi::Gather;

namespace {

/// Its triangles at x and y; vertices of other cells are held.
RandomMesh mesh_of(const std::filesystem::path& path) {
  const trismooth::MeshDocument document = trismooth::read_mesh(path);
  RandomMesh mesh;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    mesh.mesh.points.push_back({document.points[3 * v], document.points[3 * v + 1]});
  }
  mesh.other_cells.assign(document.point_count(), 0);
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto corners = document.cells[c];
    const std::uint8_t type = document.cells.types[c];
    if (type == trismooth::cell_type::triangle || (type == trismooth::cell_type::polygon && corners.size() == 3)) {
      mesh.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
      for (const std::int32_t v : corners) {
        mesh.other_cells[static_cast<std::size_t>(v)] = 1;
      }
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("shared meshes that METIS has cut come out with the bits of the whole") {
  const std::filesystem::path folder = TRISMOOTH_SHARED_MESHES;
  const auto cut = mpi_tests::has_metis ? Cut::by_metis : Cut::in_strips;
  if (!std::filesystem::is_directory(folder)) {
    SUCCEED("there are none");
    return;
  }
  // Else every method, form and precision, but not each with each.
  const std::uint64_t step = std::getenv("TRISMOOTH_THOROUGH") != nullptr ? 1 : 5;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") {
      continue;
    }
    INFO(entry.path());
    RandomMesh mesh = mesh_of(entry.path());
    for (std::uint64_t index = 0; index < properties::combinations; index += step) {
      properties::SmoothingOptions options = properties::combination(index);
      options.max_sweeps = 3;
      mesh.seed = index;
      for (const bool slides : {false, true}) {
        mesh.slide.along = slides ? trismooth::Slide::curves : trismooth::Slide::off;
        INFO(properties::text_of(options) << (slides ? ", slides" : ""));
        CHECK(mpi_tests::in_pieces(mesh, options, properties::run(mesh, options), cut, Gather::where_needed) == "");
      }
    }
  }
}
