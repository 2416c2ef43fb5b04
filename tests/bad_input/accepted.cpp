// SPDX-License-Identifier: BSD-3-Clause
#include <set>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;
using accepted_files::Mesh;
using trismooth::FileFormat;
using trismooth::MeshDocument;

namespace {

using Point = std::array<double, 3>;

/// The cells with more than two vertices, as their corners: STL numbers its vertices as it likes.
std::vector<std::vector<Point>> faces_of(const MeshDocument& document) {
  std::vector<std::vector<Point>> faces;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (document.cells[cell].size() > 2 && document.cells.types[cell] >= trismooth::cell_type::triangle) {
      auto& face = faces.emplace_back();
      for (const auto vertex : document.cells[cell]) {
        const std::size_t at = 3 * static_cast<std::size_t>(vertex);
        face.push_back({document.points[at], document.points[at + 1], document.points[at + 2]});
      }
    }
  }
  return faces;
}

std::vector<std::vector<Point>> faces_of(const Mesh& mesh, double scale) {
  std::vector<std::vector<Point>> faces;
  for (const auto& vertices : mesh.faces) {
    auto& face = faces.emplace_back();
    for (const int vertex : vertices) {
      Point point = mesh.points[static_cast<std::size_t>(vertex)];
      std::ranges::transform(point, point.begin(), [scale](double x) { return scale * x; });
      face.push_back(point);
    }
  }
  return faces;
}

}  // namespace

TEST_CASE("Every file of the collection holds the mesh, and no two have one name") {
  std::set<std::string> names;
  for (const AcceptedFile& file : accepted_files::all()) {
    INFO(file.name);
    CHECK(names.insert(file.name).second);
    CHECK(file.bytes.size() < (is_kept_by_hdf5(file) ? 20000 : 4000));
    const Outcome outcome = read(file);
    INFO(outcome.message);
    REQUIRE(outcome.document);
    const MeshDocument& document = *outcome.document;
    CHECK(broken_promise(document) == "");
    const bool others = document.point_count() != accepted_files::mesh(false).points.size();
    CHECK(document.point_count() == accepted_files::mesh(others).points.size());
    CHECK(faces_of(document) == faces_of(accepted_files::mesh(others), file.scale));
  }
}

TEST_CASE("Every file of the collection is written back with the same bytes, or what it holds") {
  for (const AcceptedFile& file : accepted_files::all()) {
    INFO(file.name);
    const MeshDocument document = read(file).document.value();
    const std::string written = written_back(document);
    if (is_vtk_xml(file)) {
      const Outcome again = read({file.name, file.extension, written});
      INFO(again.message);
      REQUIRE(again.document);
      CHECK(difference(document, *again.document) == "");
    } else {
      CHECK(written == file.bytes);
    }
  }
}
