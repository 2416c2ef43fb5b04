// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_binary_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"

namespace trismooth::off_binary_reader_test {

using namespace byte_files;

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using OpenMesh::IO::Options;

OpenMeshMesh open_mesh_square() {
  OpenMeshMesh mesh;
  mesh.request_vertex_colors();
  mesh.request_vertex_normals();
  mesh.request_vertex_texcoords2D();
  mesh.request_face_colors();
  std::vector<OpenMeshMesh::VertexHandle> v;
  for (const auto& point : {OpenMeshMesh::Point(0, 0, 0), OpenMeshMesh::Point(2, 0, 0), OpenMeshMesh::Point(2, 2, 0),
                            OpenMeshMesh::Point(0, 2, 0), OpenMeshMesh::Point(0.75F, 1.3F, 0)}) {
    v.push_back(mesh.add_vertex(point));
    mesh.set_color(v.back(), {10, 20, 200});
    mesh.set_normal(v.back(), {0, 0, 1});
    mesh.set_texcoord2D(v.back(), {0.5F, 0.25F});
  }
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.set_color(mesh.add_face(v[i], v[(i + 1) % 4], v[4]), {1, 2, 3});
  }
  return mesh;
}

void check_points(const MeshDocument& document, const OpenMeshMesh& mesh) {
  REQUIRE(document.point_count() == mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(document.points[3 * static_cast<std::size_t>(vertex.idx()) + axis] ==
            static_cast<double>(mesh.point(vertex)[axis]));
    }
  }
}

/// What Geomview's manual says of a binary OFF file, word by word.
class Words {
 public:
  explicit Words(const std::string& keyword, std::endian order = std::endian::big)
      : bytes_(keyword + " BINARY\n"), order_(order) {}

  template <class T>
  Words& add(std::initializer_list<T> numbers) {
    static_assert(sizeof(T) == 4);
    for (const T number : numbers) {
      bytes_ += number_bytes(number, order_);
    }
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::endian order_;
};

TEST_CASE("binary OFF: files of OpenMesh are read, written back byte by byte, and read by it when moved") {
  const OpenMeshMesh mesh = open_mesh_square();
  for (const std::size_t fields :
       {std::size_t{0}, std::size_t{Options::VertexColor}, std::size_t{Options::VertexNormal},
        std::size_t{Options::VertexTexCoord}, std::size_t{Options::FaceColor},
        std::size_t{Options::VertexNormal | Options::VertexColor | Options::FaceColor},
        std::size_t{Options::VertexNormal | Options::VertexColor | Options::VertexTexCoord | Options::FaceColor}}) {
    for (const std::size_t colours :
         {std::size_t{0}, std::size_t{Options::ColorAlpha}, std::size_t{Options::ColorFloat},
          std::size_t{Options::ColorFloat | Options::ColorAlpha}}) {
      CAPTURE(fields, colours);
      const TemporaryPath file(".off");
      REQUIRE(OpenMesh::IO::write_mesh(mesh, file.path().string(),
                                       Options(static_cast<Options::value_type>(Options::Binary | fields | colours))));
      MeshDocument document = trismooth::read_mesh(file.path());
      CHECK(document.point_type == ScalarType::float32);
      check_points(document, mesh);
      CHECK(document.cells.types == std::vector<std::uint8_t>(4, cell_type::triangle));
      CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
      CHECK((find_array(document.point_arrays, "normals") != nullptr) == ((fields & Options::VertexNormal) != 0));
      const DataArray* const of_faces = find_array(document.cell_arrays, "colours");
      CHECK((of_faces != nullptr) == ((fields & Options::FaceColor) != 0));
      const DataArray* const of_points = find_array(document.point_arrays, "colours");
      CHECK((of_points != nullptr) == ((fields & Options::VertexColor) != 0));
      if (of_points != nullptr) {
        const bool is_float = (colours & Options::ColorFloat) != 0;
        CHECK(of_points->components == ((colours & Options::ColorAlpha) != 0 ? 4U : 3U));
        CHECK(of_points->value(4, 2) == Approx(is_float ? 200.0 / 255 : 200.0).epsilon(1e-6));
      }
      CHECK(written_back(document) == file.bytes());

      document.points[12] = 1.0625;
      std::string moved = file.bytes();
      const std::string before = number_bytes(0.75F) + number_bytes(1.3F);
      moved.replace(moved.find(before), 4, number_bytes(1.0625F));
      CHECK(written_back(document) == moved);
    }
  }
}

TEST_CASE("binary OFF: files as Geomview's manual has them are read, with the colours that faces count") {
  Words words("COFF");
  words.add({4, 2, 5});
  for (const auto& [x, y] : {std::pair(0.F, 0.F), {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
    words.add({x, y, 0.F, 0.5F, 0.25F, 1.F, 1.F});
  }
  words.add({3, 0, 1, 2, 4}).add({0.F, 0.5F, 1.F, 1.F}).add({3, 0, 2, 3, 0});
  const MeshDocument document = off_codec.read("g.off", words.bytes());
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3});
  const DataArray* const colours = find_array(document.point_arrays, "colours");
  REQUIRE((colours != nullptr && colours->type == ScalarType::float32 && colours->components == 4));
  CHECK(colours->as<float>()[4] == 0.5F);
  CHECK(document.cell_arrays.empty());
  REQUIRE(document.notes.size() == 1);
  CHECK(contains(document.notes[0], "face colours have different numbers"));
  CHECK(written_back(document) == words.bytes());
}

TEST_CASE("binary OFF: what breaks the rules is refused with its byte") {
  const auto square = [](std::initializer_list<std::int32_t> counts, std::initializer_list<std::int32_t> face,
                         float coordinate = 1) {
    return Words("OFF").add(counts).add({0.F, 0.F, 0.F, coordinate, 0.F, 0.F, 0.F, 1.F, 0.F}).add(face).bytes();
  };
  REQUIRE(refusal(off_codec, square({3, 1, 0}, {3, 0, 1, 2, 0})).empty());
  const auto refused = [&](const std::string& bytes) { return refusal(off_codec, bytes); };
  // The keyword's line has 11 bytes, the counts have 12, the vertices 36.
  CHECK(contains(refused(square({3, 1, 0}, {3, 0, 1, 3, 0})), "byte 71: face 0 vertex index 3 is out of range"));
  CHECK(contains(refused(square({3, 1, 0}, {3, 0, -1, 2, 0})), "byte 67: face 0 vertex index -1 is out of range"));
  CHECK(contains(refused(square({3, 1, 0}, {2, 0, 1, 0, 0})), "byte 59: face 0 has 2 vertices"));
  CHECK(contains(refused(square({3, 1, 0}, {1 << 30, 0, 1, 2, 0})), "byte 59: face 0 has 1073741824 vertices"));
  CHECK(contains(refused(square({3, 1, 0}, {3, 0, 1, 2, 5})), "byte 75: face 0 has a colour of 5 components"));
  CHECK(contains(refused(square({3, 1, 0}, {3, 0, 1, 2, 0, 0})), "byte 79: expected the end of the file"));
  CHECK(contains(refused(square({3, 1, 0}, {3, 0, 1, 2, 0}, std::numeric_limits<float>::quiet_NaN())),
                 "byte 35: vertex 1 has a coordinate that is not a finite number"));
  CHECK(contains(refused(square({2000000000, 1, 0}, {3, 0, 1, 2, 0})), "declares 2000000000 vertices, but the file"));
  CHECK(contains(refused(square({3, 2000000000, 0}, {3, 0, 1, 2, 0})), "declares 2000000000 faces, but the file"));
  CHECK(contains(refused("OFF BINARY\n"), "byte 11: expected the number of vertices, got the end of the file"));
  CHECK(contains(refused("OFF BINARY"), "got the end of the file"));
  CHECK(contains(refused("4OFF BINARY\n"), "unsupported OFF variant"));
}

}  // namespace trismooth::off_binary_reader_test
