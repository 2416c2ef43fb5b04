// SPDX-License-Identifier: BSD-3-Clause
// Which files are read in parts: what files are made of nearly always. That they are read as by the careful way is
// shown by reading_in_parts.cpp.
#include <string>

#include "trismooth/mesh_io/obj/obj_plain_reader.h"
#include "trismooth/mesh_io/off/off_plain_rows.h"
#include "trismooth/mesh_io/ply/ply_plain_rows.h"
#include "trismooth/mesh_io/ply/ply_source.h"
#include "trismooth/mesh_io/stl/stl_plain_facets.h"

#include "catch.h"

namespace trismooth::plain_readers_test {

/// Of what files are made of, and of what is left to the careful way.
struct Texts {
  std::vector<std::string> plain;
  std::vector<std::string> others;
};

/// True where reads(text, workers) says so for parts of any size.
template <class Reads>
void check_texts(const Texts& texts, const Reads& reads) {
  Workers two(2);
  for (const std::size_t part_bytes : {std::size_t{1}, std::size_t{17}, std::size_t{100}, FileWorkers::whole}) {
    for (const std::string& text : texts.plain) {
      INFO(text);
      CHECK(reads(text, FileWorkers(two, part_bytes)));
    }
    for (const std::string& text : texts.others) {
      INFO(text);
      CHECK_FALSE(reads(text, FileWorkers(two, part_bytes)));
    }
  }
  for (const std::string& text : texts.plain) {
    CHECK_FALSE(reads(text, FileWorkers(two, FileWorkers::serial)));
  }
}

/// Reads the header, the vertices and the faces of a PLY file; true where all of both is plain.
template <class Source>
bool reads_ply(const trismooth::PlyHeader& header, Source source, std::string_view bytes, const FileWorkers& workers) {
  const trismooth::PlyElement& vertex = *header.find("vertex");
  const trismooth::PlyElement& face = *header.find("face");
  const auto columns_of = [](const trismooth::PlyElement& element, std::size_t behind) {
    trismooth::ScalarColumns columns(element.properties.size());
    for (std::size_t p = behind; p < columns.size(); ++p) {
      if (!element.properties[p].is_list()) {
        columns[p].emplace(element.properties[p].name, element.properties[p].type, element.count);
      }
    }
    return columns;
  };
  std::vector<int> axes(vertex.properties.size(), -1);
  axes[0] = 0;
  axes[1] = 1;
  axes[2] = 2;
  std::vector<double> points(3 * vertex.count);
  std::vector<std::uint64_t> sites(3 * vertex.count);
  trismooth::ScalarColumns of_vertices = columns_of(vertex, 3);
  trismooth::ScalarColumns of_faces = columns_of(face, 0);
  CellList cells;
  return read_plain_vertices(source, vertex, axes, 3, points, sites, of_vertices) &&
         trismooth::PlainFaceReader(source, face, *face.find("vertex_indices"), vertex.count, cells, of_faces,
                                    workers.workers)
             .read() &&
         cells.size() == face.count && source.offset() == bytes.size();
}

bool reads_ply(const std::string& bytes, const FileWorkers& workers) {
  const trismooth::PlyHeader header = trismooth::parse_ply_header("mesh.ply", bytes);
  if (header.encoding == trismooth::NumberEncoding::text) {
    return reads_ply(header, trismooth::PlyTextSource("mesh.ply", bytes, header.size, workers), bytes, workers);
  }
  return reads_ply(header, trismooth::PlyBinarySource("mesh.ply", bytes, header.size, header.encoding, workers), bytes,
                   workers);
}

std::string ply(const std::string& format, const std::string& vertex_property, const std::string& face_property,
                const std::string& data) {
  return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n" +
         vertex_property + "element face 3\nproperty list uchar int vertex_indices\n" + face_property + "end_header\n" +
         data;
}

/// The same in either byte order: 4 vertices, and faces of these degrees; a byte behind each.
std::string ply_data(bool swapped, const std::vector<int>& degrees, bool with_bytes, float first = 0.5F) {
  std::string data;
  const auto add = [&](auto number) {
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof(number));
    data += swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  };
  for (int vertex = 0; vertex < 4; ++vertex) {
    add(first);
    add(0.25 * vertex);
    add(1.0F);
    data += with_bytes ? "v" : "";
  }
  for (const int degree : degrees) {
    add(static_cast<std::uint8_t>(degree));
    for (int corner = 0; corner < degree; ++corner) {
      add(std::int32_t{corner % 4});
    }
    data += with_bytes ? "f" : "";
  }
  return data;
}

std::string facet(const std::string& corner) {
  return "  facet normal 0 0 nan\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex " + corner +
         "\n    endloop\n  endfacet\n";
}

TEST_CASE("OBJ with groups, references of every form and other statements is read in parts") {
  const std::string vertices = "v 0 0 0\nv 1 0 0 1\r\n  v 0 1 0 1 0.5 0\n";
  check_texts(
      {{vertices + "f 1 2 3\n", vertices + "f 1/2 2/3 3/4\nf 1//2 2//3 3//4\nf 1/1/1 -2/-1/-1 3/1/\n",
        "# a\nmtllib b c\no d\n" + vertices + "\n#\nvn 0 0 1\ng e f\nusemtl #g\ns off\nl 1 2 3\np 1 2\nfo 1 2 3",
        "f 1 2 3\n" + vertices, vertices},
       {vertices + "f 1 2 4\n", vertices + "f 1 2 3 # a\n", vertices + "f 1 2 \\\n 3\n", vertices + "v 1 2\n",
        vertices + "vn 1 \\\n 2 3\n", vertices + "f +1 2 3\n", vertices + "7\n", "f 1 2 3\n", "", "#\n"}},
      [](const std::string& text, const FileWorkers& workers) {
        return trismooth::read_plain_obj(text, workers).has_value();
      });
}

TEST_CASE("OFF with fields, colours and faces of any degrees is read in parts") {
  // Three vertices and two faces.
  const auto reads = [](const std::string& text, const FileWorkers& workers) {
    const std::size_t line = text.find('\n');
    const trismooth::OffKeyword keyword = trismooth::parse_off_keyword(text.substr(0, line)).value();
    MeshDocument document;
    document.points.resize(9);
    trismooth::NumberSites sites;
    sites.offsets.resize(9);
    trismooth::OffPlainRows rows(text, workers);
    const auto vertices = rows.read_vertices(line, 3, keyword, document, sites);
    return vertices && rows.read_faces(vertices->offset, 2, document.point_count(), document);
  };
  const std::string faces = "3 0 1 2\n3 2 1 0\n";
  check_texts(
      {{"OFF\n0 0 0\n1 0 0\n0 1 0\n" + faces, "OFF\n0 0 0 9 9 9\n1 0 0 8 8 8\n0 1 0 7 7 7\n" + faces,
        "STCNOFF\n0 0 0 0 0 1 1 2 3 4 0.5 0.5\n1 0 0 0 0 1 1 2 3 4 0.5 0.5\n0 1 0 0 0 1 1 2 3 4 0.5 0.5\n" + faces,
        "NOFF\n0 0 0 0 0 1\n1\n0\n0 0 0 1\n0 1 0 0 0 1\n" + faces,
        "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2 3\n3 2 1 0 3 4 5\n", "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n4 2 1 0 1 8",
        "OFF\n0 0 0\n1 0 0\n0 1 0\n5 0 1 2 0 1\n\n3 2 1 0\n and more"},
       {"OFF\n0 0 0 1 2 3\n1 0 0\n0 1 0 1 2 3\n" + faces, "OFF\n0 0 0 1\n1 0 0 1\n0 1 0 1\n" + faces,
        "OFF\n0 0 0\n1 0 0 # a\n0 1 0\n" + faces, "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n",
        "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2\n3 0 1 2 1 2\n", "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n",
        "OFF\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2 3\n3 0 1 2\n", "OFF\n0 0 0\n1 0 inf\n0 1 0\n" + faces}},
      reads);
}

TEST_CASE("PLY with scalar properties and faces of any degrees is read in parts") {
  const std::string vertices = "0 0 0 1\n1 0 0 2\n0 1 0 3\n1\n1 0 4\n";
  const std::string scalar = "property uchar a\n";
  const std::string list = "property list uchar int a\n";
  const auto text = [&](const std::string& faces) { return ply("ascii", scalar, scalar, vertices + faces); };
  const std::string nan = ply_data(false, {3, 3, 3}, false, std::numeric_limits<float>::quiet_NaN());
  check_texts(
      {{text("3 0 1 2 7\n3 1 2 3 8\n3 1 2 3 9"), text("3 0 1 2 7\n4 0 1 2 3 8\n3 1 2 3 9"),
        ply("binary_little_endian", scalar, scalar, ply_data(false, {3, 3, 3}, true)),
        ply("binary_big_endian", scalar, scalar, ply_data(true, {3, 3, 3}, true)),
        ply("binary_little_endian", "", "", ply_data(false, {3, 5, 4}, false)),
        ply("binary_big_endian", scalar, scalar, ply_data(true, {4, 3, 3}, true))},
       {text("3 0 1 2 7\n3 1 2 4 8\n3 1 2 3 9"), text("3 0 1 2 7\n3 1 2 3 256\n3 1 2 3 9"),
        text("3 0 1 2 7\n3 1 2 3 8\n2 1 2 9"), text("3 0 1 2 7\n3 1 2 3 8\n3 1 2 3 9 9"),
        ply("binary_little_endian", "", "", ply_data(false, {3, 2, 3}, false)),
        ply("binary_little_endian", "", "", ply_data(false, {3, 3}, false)), ply("binary_little_endian", "", "", nan),
        ply("ascii", "", list, "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 0\n3 1 2 3 0\n3 1 2 3 0")}},
      [](const std::string& bytes, const FileWorkers& workers) { return reads_ply(bytes, workers); });
}

TEST_CASE("STL of one solid is read in parts") {
  const std::string two = facet("0 1 0") + facet("0 1e0 1");
  check_texts({{two, two + "endsolid a b\n", two + "  endsolid\n\n", facet("0 1 0") + "\n\n" + two + "endsolid"},
               {"", "endsolid\n", facet("0 1") + two, facet("0 1 nan") + two, two + "endsolid\nsolid b\n" + two,
                "color 1\n" + two, facet("0 1 0") + "color 1\n" + two, two + "facet", two + "endsolid\nmore\n"}},
              [](const std::string& text, const FileWorkers& workers) {
                return trismooth::read_plain_text_facets(text, 0, workers).has_value();
              });
}

}  // namespace trismooth::plain_readers_test
