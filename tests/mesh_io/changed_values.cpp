// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/accepted_files.h"
#include "support/memory_file.h"
#include "support/one_file_codec.h"
#include "support/scratch_folder.h"

using trismooth::AddedArrays;
using trismooth::DataArray;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ScalarType;
using trismooth::write_mesh;

namespace changed_values_test {

/// The array with other numbers in some rows; none in row 0.
DataArray changed(const DataArray& array) {
  const auto numbers = [&](auto zero) {
    const auto read = array.as<decltype(zero)>();
    std::vector<decltype(zero)> values(read.begin(), read.end());
    for (std::size_t i = array.components; i < values.size(); i += array.components + 1) {
      values[i] = static_cast<decltype(zero)>(0.1) * static_cast<decltype(zero)>(i + 1);
    }
    DataArray result = make_data_array(array.name, array.components, std::move(values));
    result.description = array.description;
    return result;
  };
  return array.type == ScalarType::float32 ? numbers(float{}) : numbers(double{});
}

bool same_arrays(const std::vector<DataArray>& a, const std::vector<DataArray>& b) {
  bool same = a.size() == b.size();
  for (std::size_t i = 0; same && i < a.size(); ++i) {
    same = a[i].name == b[i].name && a[i].type == b[i].type && a[i].components == b[i].components &&
           std::vector(a[i].bytes.begin(), a[i].bytes.end()) == std::vector(b[i].bytes.begin(), b[i].bytes.end());
  }
  return same;
}

bool is_real(const DataArray& array) {
  return array.type == ScalarType::float32 || array.type == ScalarType::float64;
}

/// What is left of a text without the beginning and the end that it shares with another.
std::string_view differing_part(std::string_view text, std::string_view other) {
  while (!text.empty() && !other.empty() && text.front() == other.front()) {
    text.remove_prefix(1);
    other.remove_prefix(1);
  }
  while (!text.empty() && !other.empty() && text.back() == other.back()) {
    text.remove_suffix(1);
    other.remove_suffix(1);
  }
  return text;
}

/// Of one number: no text of another one, but what separates them where numbers fill columns or were left out.
bool is_of_one_number(std::string_view part, const accepted_files::AcceptedFile& file) {
  if (file.bytes.find('\0') != std::string::npos) {
    return part.size() <= sizeof(double);
  }
  const bool may_fill = file.extension == ".unv" || file.extension == ".bdf" || file.name == "inp_left_out";
  return part.size() < 40 &&
         part.find_first_not_of(may_fill ? "0123456789+-.eEdD \t," : "0123456789+-.eEdD") == std::string_view::npos;
}

/// Where a coordinate moves to: by as many digits as double has, which float32 holds as well; by few where cards have
/// eight columns, and to a whole number where all are whole: the type of these would become another.
double moved_from(double from, const accepted_files::AcceptedFile& file) {
  if (file.scale != 1) {
    return from + 1;
  }
  return file.extension == ".bdf" ? from + 0.125 : double{static_cast<float>(from + 0.1)};
}

/// Whether nothing but the digits of a number changes where a coordinate moves. XML is written by a library; corners of
/// STL and nodes of MFEM's elements stand in the file more than once; parameters of Gmsh's nodes do not stay where
/// these move; a card of Nastran's that ended before a coordinate gets longer; values of HDF5's that are compressed, or
/// lie in a header with a checksum.
bool is_changed_in_place(const accepted_files::AcceptedFile& file) {
  return file.extension != ".vtu" && file.extension != ".vtp" && file.extension != ".stl" &&
         file.name.find("parametric") == std::string::npos && file.name != "mfem_nodes_of_elements" &&
         file.name != "nastran_mixed" && file.name.find("deflated") == std::string::npos &&
         file.name.find("compact") == std::string::npos;
}

TEST_CASE("a coordinate that moves is written in its place in every format, and nothing else changes") {
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    const trismooth::Codec& codec = test_support::one_file_codec(format_of(file));
    const MeshDocument document = codec.read("mesh", file.bytes);
    for (std::size_t i = 0; i < document.points.size(); ++i) {
      if (i % 3 == 2) {
        continue;  // many formats are flat
      }
      MeshDocument moved = document;
      moved.points[i] = moved_from(document.points[i], file);
      const test_support::MemoryFile target;
      moved.original->write(target.path(), moved, {}, {});
      const std::string bytes = target.bytes();
      INFO(file.name << ", coordinate " << i);
      const MeshDocument written = codec.read("mesh", bytes);
      CHECK(written.points == moved.points);
      CHECK(written.cells.connectivity == moved.cells.connectivity);
      CHECK(same_arrays(written.point_arrays, moved.point_arrays));
      if (is_changed_in_place(file)) {
        CHECK(is_of_one_number(differing_part(file.bytes, bytes), file));
        CHECK(is_of_one_number(differing_part(bytes, file.bytes), file));
      }
    }
  }
}

TEST_CASE("changed values of point arrays are written back in every format that keeps values, and nothing else is") {
  std::set<std::string> extensions;
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (!is_one_file(file)) {
      continue;
    }
    INFO(file.name);
    const ScratchFolder folder;
    const auto path = folder.write("in" + file.extension, file.bytes);
    const auto target = folder / ("out" + file.extension);
    MeshDocument document = read_mesh(path);
    bool changes = false;
    for (DataArray& array : document.point_arrays) {
      if (is_real(array) && trismooth::writes_values_of(document, document.format, array.name)) {
        array = changed(array);
        changes = true;
        extensions.insert(file.extension);
      }
    }
    for (const bool annotates : {false, true}) {
      if (annotates && !takes_added_arrays(document, document.format)) {
        continue;
      }
      AddedArrays added;
      if (annotates) {
        added.point_arrays.push_back(
            make_data_array("trismooth:fixed", 1, std::vector<std::uint8_t>(document.point_count(), 1)));
      }
      write_mesh(target, document, added);
      MeshDocument written = read_mesh(target);
      if (annotates) {
        CHECK(written.point_arrays.back().name == "trismooth:fixed");
        written.point_arrays.pop_back();
        std::erase_if(document.point_arrays,
                      [](const DataArray& array) { return array.name.starts_with("trismooth:"); });
        std::erase_if(document.cell_arrays,
                      [](const DataArray& array) { return array.name.starts_with("trismooth:"); });
      }
      CHECK(written.points == document.points);
      CHECK(same_arrays(written.point_arrays, document.point_arrays));
      CHECK(same_arrays(written.cell_arrays, document.cell_arrays));
      CHECK(same_arrays(written.field_arrays, document.field_arrays));
      if (!changes && !annotates && file.extension != ".vtu" && file.extension != ".vtp") {
        CHECK(bytes_of(target) == file.bytes);
      }
    }
  }
  for (const char* extension : {".ply", ".vtk", ".vtu", ".vtp", ".med", ".cgns", ".slf"}) {
    INFO(extension);
    CHECK((extensions.count(extension) == 1 || !is_available(*trismooth::format_of(std::string("a") + extension))));
  }
}

constexpr std::string_view legacy_file =
    "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET POLYDATA\nPOINTS 3 int\n0 0 0  1 0 0  0 1 0\nPOLYGONS 1 4\n3 0 1 "
    "2\n"
    "CELL_DATA 1\nSCALARS trismooth:shape double 1\nLOOKUP_TABLE default\n1\n"
    "POINT_DATA 3\nSCALARS heat float 1\nLOOKUP_TABLE default\n1.50 # of the first\n#\n nan\t2e0\n"
    "FIELD more 2\nwind 2 3 double\n1 2 3 4 5 6\nwind 1 3 double\n7 8 9\n";

MeshDocument legacy(const ScratchFolder& folder) {
  return read_mesh(folder.write("in.vtk", legacy_file));
}

std::string written_back(const ScratchFolder& folder, const MeshDocument& document, const AddedArrays& added = {}) {
  write_mesh(folder / "out.vtk", document, added);
  return bytes_of(folder / "out.vtk");
}

std::string with(std::string text, std::string_view old, std::string_view now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST_CASE(
    "legacy VTK: only the numbers that are others change, past comments, and of two arrays of a name the right one") {
  const ScratchFolder folder;
  MeshDocument document = legacy(folder);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  document.point_arrays[0] = make_data_array("heat", 1, std::vector<float>{1.5F, nan, 0.1F});
  document.point_arrays[2] = make_data_array("wind", 1, std::vector<double>{7, 0.1, 9});
  std::string expected = with(with(std::string(legacy_file), "2e0", "0.1"), "7 8 9", "7 0.1 9");
  CHECK(written_back(folder, document) == expected);
  // Where the coordinates get another type, all behind them stands elsewhere.
  document.points[0] = 0.25;
  expected = with(with(expected, "3 int", "3 double"), "\n0 0 0", "\n0.25 0 0");
  CHECK(written_back(folder, document) == expected);
  // Annotations stood before them.
  const AddedArrays added{{make_data_array("trismooth:fixed", 1, std::vector<std::uint8_t>{1, 1, 1})}, {}};
  const std::string annotated = written_back(folder, document, added);
  CHECK(annotated.find("trismooth:shape") == std::string::npos);
  CHECK(annotated.find("nan\t0.1\nFIELD more 2\nwind 2 3 double\n1 2 3 4 5 6\nwind 1 3 double\n7 0.1 9\n") !=
        std::string::npos);
}

TEST_CASE("an array that is not the file's own is left alone") {
  const ScratchFolder folder;
  MeshDocument document = legacy(folder);
  document.point_arrays[0] = make_data_array("cold", 1, std::vector<float>{3, 3, 3});
  document.point_arrays[1] = make_data_array("wind", 1, std::vector<double>{3, 3, 3});
  document.point_arrays.pop_back();
  CHECK(written_back(folder, document) == legacy_file);
}

TEST_CASE("PLY: properties of floating point are written back beside the coordinates, texts that are no numbers stay") {
  const ScratchFolder folder;
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float heat\nproperty double x\nproperty float y\n"
      "property uchar kind\nproperty float z\nproperty double wind\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "NaN 0 0 1 0 1.50\n2 1 0 2 0 -nan\n3 0 1 3 0 5\n3 0 1 2\n";
  MeshDocument document = read_mesh(folder.write("in.ply", text));
  CHECK(writes_values_of(document, document.format, "heat"));
  CHECK_FALSE(writes_values_of(document, document.format, "kind"));
  write_mesh(folder / "out.ply", document);
  CHECK(bytes_of(folder / "out.ply") == text);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  document.point_arrays[0] = make_data_array("heat", 1, std::vector<float>{nan, 0.1F, 3});
  document.point_arrays[2] = make_data_array("wind", 1, std::vector<double>{1.5, 0.2, 5});
  document.points[6] = 0.3;
  write_mesh(folder / "out.ply", document);
  CHECK(bytes_of(folder / "out.ply") ==
        with(with(with(text, "\n2 1", "\n0.1 1"), "-nan", "0.2"), "\n3 0 1 3", "\n3 0.3 1 3"));
}

}  // namespace changed_values_test
