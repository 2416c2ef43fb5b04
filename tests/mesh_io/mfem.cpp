#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::read_mesh;

namespace {

namespace type = trismooth::cell_type;

const std::string disc =
    "MFEM mesh v1.3\n\ndimension\n2\n\nelements\n3\n7 2 0 1 2\n7 2 0 2 3\n9 3 1 4 5 2\n\n"
    "attribute_sets\n3\n\"air\" 1 7\n\"steel core\" 1 9\n\"everything\" 2 7 9\n\n"
    "boundary\n2\n3 1 0 1\n4 1 3 0\n\nbdr_attribute_sets\n1\n\"inlet\" 1 4\n\n"
    "vertices\n6\n2\n0 0\n1.50 0\n1 1\n0 1\n2 0\n2 1\n\nmfem_mesh_end\n";

std::string refusal_of(const std::string& bytes) {
  const ScratchFolder folder;
  return message_of<trismooth::ReadError>([path = folder.write("a.mesh", bytes)] { read_mesh(path); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::vector<std::int32_t> attributes_of(const MeshDocument& document) {
  const auto values = document.cell_arrays.at(0).as<std::int32_t>();
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("an MFEM mesh is elements and then its boundary, with attributes and their names") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(folder.write("disc.mesh", disc));
  CHECK(document.format == FileFormat::mfem);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1.5, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0});
  CHECK(document.cells.types ==
        std::vector<std::uint8_t>{type::triangle, type::triangle, type::quad, type::line, type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 1, 4, 5, 2, 0, 1, 3, 0});
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "mfem:attribute");
  CHECK(attributes_of(document) == std::vector<std::int32_t>{7, 7, 9, 3, 4});
  const auto& names = document.cell_arrays[0].description->value_names;
  CHECK(names == std::vector<trismooth::ValueName>{{7, 2, "air"}, {9, 2, "steel core"}, {4, 1, "inlet"}});
  CHECK(document.cell_sets == std::vector<trismooth::NamedSet>{{"everything", {0, 1, 2}}});
}

TEST_CASE("what is written back differs in the numbers of moved vertices alone") {
  const ScratchFolder folder;
  MeshDocument document = read_mesh(folder.write("disc.mesh", disc));
  write_mesh(folder / "same.mesh", document);
  CHECK(bytes_of(folder / "same.mesh") == disc);
  document.points[3] = 1.25;
  document.points[7] = -1e-7;
  write_mesh(folder / "moved.mesh", document);
  CHECK(bytes_of(folder / "moved.mesh") ==
        replaced(replaced(disc, "1.50 0", "1.25 0"), "\n1 1\n0 1", "\n1 -1e-07\n0 1"));
}

TEST_CASE("a document of another format becomes an MFEM mesh with its groups") {
  const ScratchFolder folder;
  MeshDocument document = read_mesh(folder.write("disc.mesh", disc));
  document.original = nullptr;
  CHECK(what_is_lost(document, FileFormat::mfem) ==
        std::vector<std::string>{"MFEM holds no sets of cells: everything is not written"});
  write_mesh(folder / "again.mesh", document);
  const MeshDocument again = read_mesh(folder / "again.mesh");
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(attributes_of(again) == attributes_of(document));
  CHECK(again.cell_arrays[0].description->value_names == document.cell_arrays[0].description->value_names);
}

TEST_CASE("attributes of MFEM are positive; points in space keep their z; lines are the boundary") {
  const ScratchFolder folder;
  MeshDocument document;
  document.format = FileFormat::mfem;  // of the formats that the extension names
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0.5};
  document.cells.append(type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(type::vertex, std::vector<std::int32_t>{2});
  document.cell_arrays.push_back(trismooth::make_data_array("region", 1, std::vector<std::int32_t>{-5, 12, 0}));
  const auto lost = what_is_lost(document, FileFormat::mfem);
  CHECK(lost == std::vector<std::string>{
                    "MFEM holds lines, triangles and quadrilaterals only: 1 cell of type vertex is not written",
                    "MFEM lists lines apart from faces: the cells are written in another order"});
  write_mesh(folder / "a.mesh", document);
  CHECK(bytes_of(folder / "a.mesh") ==
        "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n1\n12 2 0 1 2\n\nboundary\n1\n1 1 0 1\n\nvertices\n3\n3\n0 0 0\n"
        "1 0 0\n1 1 0.5\n");
}

TEST_CASE("what MFEM meshes are not read is said with its reason") {
  CHECK(refusal_of(replaced(disc, "6\n2\n0 0", "6\n\nnodes\nFiniteElementSpace")).find("is a curved mesh of MFEM") !=
        std::string::npos);
  for (const auto& [version, reason] : std::vector<std::pair<std::string, std::string>>{
           {"MFEM NURBS mesh v1.0", "is a NURBS mesh"},
           {"MFEM NC mesh v1.0", "is a non-conforming mesh"},
           {"MFEM INLINE mesh v1.0", "is an INLINE mesh"},
           {"MFEM mesh v1.4", "expected 'MFEM mesh v1.0' to 'v1.3' in the first line, got 'MFEM mesh v1.4'"}}) {
    CHECK(refusal_of(replaced(disc, "MFEM mesh v1.3", version)).find(reason) != std::string::npos);
  }
  CHECK(refusal_of(replaced(disc, "mfem_mesh_end", "vertex_parents")).find("is a non-conforming mesh") !=
        std::string::npos);
}

TEST_CASE("what is wrong in an MFEM mesh is named with its line") {
  CHECK(refusal_of(replaced(disc, "7 2 0 2 3", "7 2 0 2 6")).find(":9: vertex 6 is out of range: the file has 6") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "9 3 1", "9 8 1")).find(":10: expected a geometry from 0 to 7") != std::string::npos);
  CHECK(refusal_of(replaced(disc, "7 2 0 1 2\n7 2 0 2 3\n9 3", "7 2 0 1 2\n7 2 0 2 3\n9 2 1 2 9\n9 3"))
            .find(":11: expected a section of MFEM, got '9'") != std::string::npos);
  CHECK(refusal_of(replaced(disc, "vertices\n6", "vertices\n2000000000")).find("declares 2000000000 vertices") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "1.50 0", "nan 0")).find("expected a coordinate (a finite number), got 'nan'") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "\nmfem_mesh_end\n", "")).find("expected the end of the mesh, 'mfem_mesh_end'") !=
        std::string::npos);
  CHECK(refusal_of("MFEM mesh v1.0\n").find("expected the section 'vertices'") != std::string::npos);
}
