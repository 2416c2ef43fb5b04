// SPDX-License-Identifier: BSD-3-Clause
// Medit as libMeshb writes it in binary: every version, either byte order.
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/accepted_files.h"
#include "support/scratch_folder.h"

using byte_files::contains;
using byte_files::values;
using trismooth::find_array;
using trismooth::medit_codec;
using trismooth::MeshDocument;
using trismooth::NamedSet;
using trismooth::ScalarType;

namespace {

std::string medit_file_named(const std::string& name) {
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (file.name == name) {
      return file.bytes;
    }
  }
  FAIL(name);
  return {};
}

std::string stored_word(std::int32_t number) {
  return byte_files::number_bytes(number);
}

std::string refusal_of_binary(const std::string& bytes) {
  return byte_files::refusal(medit_codec, bytes);
}

/// The file with four bytes in another place replaced.
std::string with_stored_word(std::string bytes, std::size_t at, std::int32_t number) {
  return bytes.replace(at, 4, stored_word(number));
}

}  // namespace

TEST_CASE("binary Medit of every version and byte order is read, and written back with the same bytes") {
  for (const std::string name : {"1_little", "2_big", "3_little", "4_big", "2_little"}) {
    CAPTURE(name);
    const std::string bytes = medit_file_named("medit_" + name + "_endian");
    MeshDocument document = medit_codec.read("mesh.meshb", bytes);
    CHECK(document.points == std::vector<double>{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0});
    CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
    CHECK(values<std::int32_t>(find_array(document.point_arrays, "medit:ref")) ==
          std::vector<std::int32_t>{0, 1, 2, 3, 4});
    CHECK(values<std::int32_t>(find_array(document.cell_arrays, "medit:ref")) ==
          std::vector<std::int32_t>{9, 7, 7, 7, 7});
    CHECK(document.point_sets == std::vector<NamedSet>{{"Corners", {0, 2}}, {"RequiredEdges", {0, 1}}});
    CHECK(document.point_type == (name[0] == '1' ? ScalarType::float32 : ScalarType::float64));
    REQUIRE(document.notes.size() == 1);
    CHECK(contains(document.notes[0], "TangentAtVertices, keyword 250"));
    CHECK(byte_files::written_back(document) == bytes);

    document.points[12] = 0.7578125;
    const std::string moved = byte_files::written_back(document);
    const auto order = contains(name, "big") ? std::endian::big : std::endian::little;
    const std::string from =
        name[0] == '1' ? byte_files::number_bytes(0.75F, order) : byte_files::number_bytes(0.75, order);
    const std::string to =
        name[0] == '1' ? byte_files::number_bytes(0.7578125F, order) : byte_files::number_bytes(0.7578125, order);
    CHECK(moved == replace_all(bytes, from, to));
  }
}

TEST_CASE("binary Medit may say that its coordinates are of float32, whatever its version") {
  // Dimension 2; the precision; one vertex (0.5, 2) of reference 3; End.
  const std::string head = stored_word(1) + stored_word(2) + stored_word(3) + stored_word(20) + stored_word(2) +
                           stored_word(155) + stored_word(32) + stored_word(32);
  const std::string vertex = byte_files::number_bytes(0.5F) + byte_files::number_bytes(2.0F) + stored_word(3);
  const std::string bytes =
      head + stored_word(4) + stored_word(56) + stored_word(1) + vertex + stored_word(54) + stored_word(0);
  const MeshDocument document = medit_codec.read("mesh.meshb", bytes);
  CHECK(document.points == std::vector<double>{0.5, 2, 0});
  CHECK(document.point_type == ScalarType::float32);
  CHECK(document.notes.empty());
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 28, 16)), "byte 28: expected a precision of 32 or 64 bits"));
}

TEST_CASE("what breaks the rules of binary Medit is refused with the byte and the reason") {
  const std::string bytes = medit_file_named("medit_2_little_endian");
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 16, 4)), "byte 16: expected a dimension of 2 or 3, got 4"));
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 24, 5)),
                 "byte 24: expected the position of the next keyword, from 28"));
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 24, 1 << 30)), "the file is cut off, or that is wrong"));
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 28, 4)),
                 "byte 28: declares 4 Vertices, but there is room for 5"));
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 28, -1)), "byte 28: declares -1 Vertices"));
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, 20, 999)), "byte "));
  const std::string nan = byte_files::number_bytes(std::bit_cast<double>(0x7ff8000000000000U));
  CHECK(contains(refusal_of_binary(std::string(bytes).replace(60, 8, nan)),
                 "byte 60: vertex 2 has a coordinate that is not a finite number"));
  // The last block but End are the triangles.
  const std::size_t triangles = bytes.size() - 8 - 4 * 16;
  CHECK(contains(refusal_of_binary(with_stored_word(bytes, triangles + 4, 6)),
                 "row 1 of Triangles has a vertex number out of range; the file has 5 vertices, counted from 1"));
  const std::string end = stored_word(54) + stored_word(0);
  const std::string head = stored_word(1) + stored_word(2) + stored_word(3);
  CHECK(contains(refusal_of_binary(head + stored_word(24) + stored_word(2) + stored_word(0) + end),
                 "byte 16: expected the dimension and nothing else, got 8 bytes"));
  CHECK(contains(refusal_of_binary(head + stored_word(20) + stored_word(2) + stored_word(4) + stored_word(28) + end),
                 "byte 28: expected the number of Vertices, got 0 bytes"));
  CHECK(contains(refusal_of_binary(bytes.substr(0, bytes.size() - 1)), "it is cut off"));
  CHECK(contains(refusal_of_binary(bytes.substr(0, 12)), "it is cut off"));
  // Not binary, then: the careful reader of text says what it is not.
  CHECK(contains(refusal_of_binary(bytes.substr(0, 11)), "is no Medit file"));
  // Nothing but a dimension comes first.
  CHECK_FALSE(medit_codec.recognises(std::string("\1\0\0\0\2\0\0\0\4\0\0\0", 12)));
}

TEST_CASE("a .meshb from elsewhere is binary, and 64 bits wide where references need it") {
  const ScratchFolder folder;
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0.25};
  document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(trismooth::cell_type::line, std::vector<std::int32_t>{2, 0});
  const std::int64_t reference = GENERATE(std::int64_t{7}, std::int64_t{1} << 40);
  document.cell_arrays.push_back(trismooth::make_data_array("material", 1, std::vector<std::int64_t>{reference, 2}));
  document.point_sets = {{"RequiredVertices", {2}}};
  write_mesh(folder / "out.meshb", document);
  CHECK(bytes_of(folder / "out.meshb").substr(0, 8) == stored_word(1) + stored_word(reference == 7 ? 2 : 4));
  const MeshDocument again = trismooth::read_mesh(folder / "out.meshb");
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == std::vector<std::int32_t>{2, 0, 0, 1, 2});
  CHECK(find_array(again.cell_arrays, "medit:ref")->value(1) == static_cast<double>(reference));
  CHECK(again.point_sets == document.point_sets);
  CHECK(again.notes.empty());
}
