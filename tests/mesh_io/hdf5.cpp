// SPDX-License-Identifier: BSD-3-Clause
#ifdef TRISMOOTH_HAS_HDF5

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>

#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/hdf5/hdf5_writer.h"

#include "catch.h"
#include "support/memory_file.h"
#include "support/scratch_folder.h"

using trismooth::Hdf5Kind;
using trismooth::Hdf5Lock;
using trismooth::Hdf5Reader;
using trismooth::Hdf5Writer;
using trismooth::ReadError;
using trismooth::ScalarType;
using trismooth::WriteError;

namespace trismooth::hdf5_test {
namespace {

constexpr std::array<double, 6> points{0, 0, 1, 0.5, 1e300, -0.0};
constexpr std::array<std::uint64_t, 2> three_by_two{3, 2};

std::string small_file(const ScratchFolder& folder, const std::string& name = "small.h5") {
  Hdf5Writer writer = Hdf5Writer::make(folder / name);
  writer.write<double>("/Mesh/points", three_by_two, points);
  writer.write<std::int32_t>("/Mesh/cells", std::array<std::uint64_t, 1>{3}, std::array<std::int32_t, 3>{0, 1, 2});
  writer.make_group("/Mesh/empty/er");
  writer.set_attribute("/Mesh", "name", "plate");
  writer.set_attribute("/Mesh", "padded", "plate", 8);
  writer.set_attribute("/Mesh", "dimension", 2);
  writer.set_attribute<double>("/Mesh/points", "origin", std::array<double, 2>{1, 2});
  writer.close();
  return bytes_of(folder / name);
}

/// A file by HDF5's own calls; `fill` gets its root.
template <class Fill>
std::string foreign_file(const ScratchFolder& folder, const Fill& fill) {
  const std::filesystem::path path = folder / "foreign.h5";
  const Hdf5Lock lock;
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose);
  fill(file.get());
  H5Fflush(file.get(), H5F_SCOPE_GLOBAL);
  return bytes_of(path);
}

/// A dataset of doubles with those chunks, deflated; without values where there are none.
void make_deflated(hid_t file, std::vector<hsize_t> extents, std::vector<hsize_t> chunk,
                   const std::vector<double>& values) {
  const std::vector<hsize_t> most(extents.size(), H5S_UNLIMITED);
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), most.data()), &H5Sclose);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_deflate(properties.get(), 9);
  const Hdf5Handle made(H5Dcreate2(file, "x", H5T_IEEE_F64BE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                        &H5Dclose);
  if (!values.empty()) {
    H5Dwrite(made.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
}

void write_changed(const std::filesystem::path& path, const std::string& bytes, const Hdf5Values& values) {
  write_changed_hdf5(path, bytes, values);
}

/// A whole number, below 2^53, held to the range of a type.
template <class T>
double clamped(double value, T /*type*/) {
  return std::clamp(value, static_cast<double>(std::numeric_limits<T>::lowest()),
                    static_cast<double>(std::numeric_limits<T>::max()));
}

std::string refusal_of(const std::string& bytes, const std::string& dataset) {
  return message_of<ReadError>([&] {
    const Hdf5Reader reader("a.h5", bytes);
    reader.read<double>(dataset);
  });
}

}  // namespace

TEST_CASE("what was written to HDF5 is read again, with its types and shapes") {
  const ScratchFolder folder;
  const std::string bytes = small_file(folder);
  const Hdf5Reader reader("small.h5", bytes);
  const auto members = reader.members("/Mesh");
  REQUIRE(members.size() == 3);
  CHECK(members[0].name == "cells");
  CHECK(members[0].kind == Hdf5Kind::dataset);
  CHECK(members[1].name == "empty");
  CHECK(members[1].kind == Hdf5Kind::group);
  CHECK(reader.kind_of("/Mesh/empty/er") == Hdf5Kind::group);
  CHECK(!reader.kind_of("/Mesh/none"));
  CHECK(!reader.kind_of("/Mesh/points/none"));
  CHECK(reader.shape_of("Mesh/points").extents == std::vector<std::uint64_t>{3, 2});
  CHECK(reader.shape_of("Mesh/points").type == ScalarType::float64);
  CHECK(reader.shape_of("Mesh/cells").type == ScalarType::int32);
  CHECK(reader.read<double>("/Mesh/points") == std::vector<double>(points.begin(), points.end()));
  CHECK(std::signbit(reader.read<double>("/Mesh/points")[5]));
  CHECK(reader.read<std::int64_t>("/Mesh/cells") == std::vector<std::int64_t>{0, 1, 2});
  CHECK(reader.read<double>("/Mesh/cells") == std::vector<double>{0, 1, 2});
  const DataArray array = reader.read_array("/Mesh/cells", "c", 3);
  CHECK(array.type == ScalarType::int32);
  CHECK(array.rows() == 1);
  CHECK(reader.attribute_names("/Mesh") == std::vector<std::string>{"dimension", "name", "padded"});
  CHECK(reader.read_attribute_texts("/Mesh", "name") == std::vector<std::string>{"plate"});
  CHECK(reader.read_attribute_texts("/Mesh", "padded") == std::vector<std::string>{"plate"});
  CHECK(reader.read_attribute<std::int64_t>("/Mesh", "dimension") == std::vector<std::int64_t>{2});
  CHECK(reader.read_attribute<double>("/Mesh/points", "origin") == std::vector<double>{1, 2});
  CHECK(!reader.has_attribute("/Mesh", "origin"));
}

TEST_CASE("the same calls make the same bytes of HDF5") {
  const ScratchFolder folder;
  CHECK(small_file(folder, "a.h5") == small_file(folder, "b.h5"));
}

TEST_CASE("values are written over, and type, chunks, filters and byte order stay") {
  const ScratchFolder folder;
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.0);
  foreign_file(folder, [&](hid_t file) { make_deflated(file, {500, 2}, {128, 2}, values); });
  values[7] = 0.125;
  const std::string before = bytes_of(folder / "foreign.h5");
  const std::filesystem::path path = folder / "foreign.h5";
  const std::vector<double> few(points.begin(), points.end());
  CHECK_THROWS_AS(write_changed(path, before, {{"x", few}}), WriteError);
  CHECK_THROWS_AS(write_changed(path, before, {{"y", few}}), WriteError);
  CHECK((bytes_of(path) == before));
  write_changed(path, before, {{"x", values}});
  const std::string bytes = bytes_of(folder / "foreign.h5");
  CHECK(Hdf5Reader("a.h5", bytes).read<double>("x") == values);
  const Hdf5Lock lock;
  const Hdf5Handle file(H5Fopen((folder / "foreign.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  const Hdf5Handle dataset(H5Dopen2(file.get(), "x", H5P_DEFAULT), &H5Dclose);
  const Hdf5Handle properties(H5Dget_create_plist(dataset.get()), &H5Pclose);
  const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
  CHECK(H5Pget_nfilters(properties.get()) == 1);
  CHECK(H5Tequal(type.get(), H5T_IEEE_F64BE) > 0);
}

TEST_CASE(
    "a file in memory gets other values and is written to any path, also where it grows and bytes stand behind it") {
  const ScratchFolder folder;
  std::vector<double> values(100000);
  std::string bytes = foreign_file(folder, [&](hid_t file) { make_deflated(file, {50000, 2}, {10000, 2}, values); });
  bytes += "behind";
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::sqrt(static_cast<double>(i));
  }
  const test_support::MemoryFile target;
  write_changed(target.path(), bytes, {{"x", values}});
  const std::string written = target.bytes();
  CHECK(written.size() > 2 * bytes.size());
  CHECK(Hdf5Reader("a.h5", written).read<double>("x") == values);
}

TEST_CASE("values that are packed with a loss are read, and not written over") {
  const ScratchFolder folder;
  const std::vector<double> values{0, 0.25, 0.5, 1};
  const std::string bytes = foreign_file(folder, [&](hid_t file) {
    const hsize_t count = values.size();
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    H5Pset_chunk(properties.get(), 1, &count);
    H5Pset_scaleoffset(properties.get(), H5Z_SO_FLOAT_DSCALE, 2);
    const Hdf5Handle made(
        H5Dcreate2(file, "x", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), &H5Dclose);
    H5Dwrite(made.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
  CHECK(Hdf5Reader("a.h5", bytes).read<double>("x") == values);
  const test_support::MemoryFile target;
  CHECK(message_of<WriteError>([&] {
          write_changed(target.path(), bytes, {{"x", {0, 0.25, 0.5, 1.001}}});
        }).find("'x' is packed with a loss (scale-offset, n-bit)") != std::string::npos);
}

TEST_CASE("numbers that stand in the file as they are are written over there without HDF5, and no other byte changes") {
  const ScratchFolder folder;
  // Behind a block of a program's own all places move.
  std::string bytes = std::string(512, 'u') + small_file(folder);
  if (GENERATE(true, false)) {
    bytes.erase(0, 512);
  }
  const Hdf5Reader reader("a.h5", bytes);
  const auto place = reader.place_of("/Mesh/points");
  REQUIRE(place);
  CHECK(!place->is_big_endian);
  std::string expected = bytes;
  std::vector<double> values(points.begin(), points.end());
  CHECK((bytes.substr(place->begin, 48) == std::string_view(reinterpret_cast<const char*>(points.data()), 48)));
  values[3] = -7;
  std::memcpy(expected.data() + place->begin, values.data(), 48);
  const Hdf5Column column =
      trismooth::hdf5_column(reader, "/Mesh/points", 0, 2, {{.component = 0}, {.component = 1}, {.component = 2}});
  REQUIRE(!column.is_packed);
  // HDF5 is not asked once more: it would refuse what has its signature no longer.
  const std::size_t signature = bytes.find("HDF\r\n");
  bytes[signature] = expected[signature] = '-';
  MeshDocument document;
  document.points = values;
  const test_support::MemoryFile target;
  make_hdf5_original(bytes, 2, {column})->write(target.path(), document, {}, {});
  CHECK((target.bytes() == expected));
}

TEST_CASE("numbers of every type and order of bytes are read from where they stand, held to the range asked for") {
  const ScratchFolder folder;
  const std::vector<double> whole{0, 1, 100, -100, 300, -70000, 5e9, -5e9};
  const std::array types{H5T_STD_I8LE,  H5T_STD_U8BE,  H5T_STD_I16LE, H5T_STD_U16BE,  H5T_STD_I32BE,
                         H5T_STD_U32LE, H5T_STD_I64BE, H5T_STD_U64LE, H5T_IEEE_F32BE, H5T_IEEE_F64BE};
  const std::string bytes = foreign_file(folder, [&](hid_t file) {
    for (std::size_t i = 0; i < types.size(); ++i) {
      const hsize_t count = whole.size();
      const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
      const Hdf5Handle made(
          H5Dcreate2(file, std::to_string(i).c_str(), types[i], space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          &H5Dclose);
      H5Dwrite(made.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, whole.data());
    }
  });
  const Hdf5Reader reader("a.h5", bytes);
  for (std::size_t i = 0; i < types.size(); ++i) {
    CAPTURE(i);
    CHECK(reader.place_of(std::to_string(i)));
    // What the file holds of them, and then what the reader makes of that.
    const auto held = [&](double value) {
      return i == 8 ? static_cast<double>(static_cast<float>(value))
             : i == 9
                 ? value
                 : visit_scalar_type(static_cast<ScalarType>(i), [value](auto type) { return clamped(value, type); });
    };
    const auto is_right = [&]<class T>(T type) {
      std::vector<T> expected;
      for (const double value : whole) {
        expected.push_back(static_cast<T>(clamped(held(value), type)));
      }
      return reader.read<T>(std::to_string(i)) == expected;
    };
    CHECK(is_right(double{}));
    CHECK(is_right(float{}));
    if (i < 8) {
      CHECK(is_right(std::int8_t{}));
      CHECK(is_right(std::uint8_t{}));
      CHECK(is_right(std::int16_t{}));
      CHECK(is_right(std::uint16_t{}));
      CHECK(is_right(std::int32_t{}));
      CHECK(is_right(std::uint32_t{}));
      CHECK(is_right(std::int64_t{}));
      CHECK(is_right(std::uint64_t{}));
    } else {
      CHECK_THROWS_AS(reader.read<std::int64_t>(std::to_string(i)), ReadError);
    }
  }
}

TEST_CASE("rows of characters are written and read as bytes, texts of any length are not") {
  const ScratchFolder folder;
  Hdf5Writer writer = Hdf5Writer::make(folder / "rows.h5");
  writer.write_rows("/names", 4, "ab  cdef");
  writer.close();
  const std::string bytes = bytes_of(folder / "rows.h5");
  const Hdf5Reader reader("a.h5", bytes);
  CHECK(reader.read_bytes("/names") == "ab  cdef");
  CHECK(reader.shape_of("/names").count() == 2);
  CHECK_THROWS_AS(reader.read_bytes("/none"), ReadError);
  CHECK(is_hdf5_with(bytes, "names"));
  CHECK(is_hdf5_with(std::string(1024, ' ') + bytes, "names"));
  CHECK_FALSE(is_hdf5_with(bytes, "none"));
  CHECK_FALSE(is_hdf5_with(bytes.substr(0, 100), "names"));
  CHECK_FALSE(is_hdf5_with("OFF\nnames\n", "names"));
  const std::string of_any_length = foreign_file(folder, [](hid_t file) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file, "x", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          &H5Dclose);
  });
  CHECK_THROWS_AS(Hdf5Reader("a.h5", of_any_length).read_bytes("x"), ReadError);
}

TEST_CASE("texts of any length are read") {
  const ScratchFolder folder;
  const std::string bytes = foreign_file(folder, [](hid_t file) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    const hsize_t count = 2;
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file, "x", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          &H5Dclose);
    const std::array<const char*, 2> texts{"inlet", "a longer name"};
    H5Dwrite(made.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
  });
  const Hdf5Reader reader("a.h5", bytes);
  CHECK(reader.shape_of("x").is_text);
  CHECK(reader.read_texts("x") == std::vector<std::string>{"inlet", "a longer name"});
  CHECK_THROWS_AS(reader.read<double>("x"), ReadError);
}

TEST_CASE("an HDF5 file that is cut off, or is none, is refused, and nothing is printed") {
  const ScratchFolder folder;
  const std::string bytes = small_file(folder);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{8}, std::size_t{96}, bytes.size() / 2, bytes.size() - 1}) {
    CAPTURE(size);
    const std::string cut = bytes.substr(0, size);
    CHECK(message_of<ReadError>([&] { Hdf5Reader("a.h5", cut); }).starts_with("a.h5: is no whole HDF5 file"));
  }
}

TEST_CASE("names that are missing or of the wrong kind are refused with the file and the object") {
  const ScratchFolder folder;
  const std::string bytes = small_file(folder);
  CHECK(refusal_of(bytes, "/Mesh/none") == "a.h5: '/Mesh/none' is no dataset of the file");
  CHECK(refusal_of(bytes, "/Mesh") == "a.h5: '/Mesh' is no dataset of the file");
  const Hdf5Reader reader("a.h5", bytes);
  CHECK_THROWS_AS(reader.members("/Mesh/points"), ReadError);
  CHECK_THROWS_AS(reader.read_texts("/Mesh/points"), ReadError);
  CHECK_THROWS_AS(reader.read_attribute<double>("/Mesh", "none"), ReadError);
  CHECK(message_of<ReadError>([&] { reader.read<std::int64_t>("/Mesh/points"); }) ==
        "a.h5: '/Mesh/points' holds float64, where whole numbers are expected");
}

TEST_CASE("sizes that no bytes stand behind are refused before memory is asked for") {
  const ScratchFolder folder;
  const hsize_t many = hsize_t{1} << 40;
  CHECK(refusal_of(foreign_file(folder,
                                [&](hid_t file) {
                                  make_deflated(file, {many, 2}, {128, 2}, {});
                                }),
                   "x")
            .find("declares 2199023255552 values, more than the 0 bytes") != std::string::npos);
  // A chunk is taken to memory as a whole, and this one has 3 GiB of zeros.
  CHECK(refusal_of(foreign_file(folder,
                                [&](hid_t file) {
                                  make_deflated(file, {2, 2}, {hsize_t{1} << 27, 3}, {});
                                }),
                   "x")
            .find("declares 4 values") != std::string::npos);
}

TEST_CASE("numbers of a form of their own, as damaged files describe them, are no numbers that are read") {
  const ScratchFolder folder;
  const std::string bytes = foreign_file(folder, [](hid_t file) {
    const Hdf5Handle type(H5Tcopy(H5T_IEEE_F64LE), &H5Tclose);
    H5Tset_ebias(type.get(), 1000);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file, "x", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          &H5Dclose);
    const double value = 1;
    H5Dwrite(made.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
  });
  CHECK(refusal_of(bytes, "x") == "a.h5: 'x' holds no numbers of a type that is read");
}

TEST_CASE("links are listed and not followed; groups in a circle are groups") {
  const ScratchFolder folder;
  const std::string bytes = foreign_file(folder, [](hid_t file) {
    const Hdf5Handle group(H5Gcreate2(file, "a", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), &H5Gclose);
    H5Lcreate_hard(file, "a", group.get(), "circle", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/a", file, "soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("/etc/passwd", "/x", file, "outside", H5P_DEFAULT, H5P_DEFAULT);
  });
  const Hdf5Reader reader("a.h5", bytes);
  CHECK(reader.kind_of("/a/circle/circle/circle") == Hdf5Kind::group);
  const auto members = reader.members("/");
  REQUIRE(members.size() == 3);
  CHECK(members[1].kind == Hdf5Kind::link);
  CHECK(members[2].kind == Hdf5Kind::link);
  CHECK(refusal_of(bytes, "/outside/x").find("leads through 'outside', a link, which is not followed") !=
        std::string::npos);
}

}  // namespace trismooth::hdf5_test

#endif
