// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/sanitized.h"
#include "support/scratch_folder.h"

using trismooth::Codec;
using trismooth::DataArray;
using trismooth::FileWorkers;
using trismooth::MeshDocument;
using trismooth::ScalarType;
using trismooth::Workers;
using trismooth::WriteError;
namespace cell_type = trismooth::cell_type;

namespace {

struct NamedCodec {
  std::string_view name;
  const Codec* codec;
  bool is_flat = false;  ///< it holds x and y alone
};

constexpr std::array<NamedCodec, 8> all_codecs{{{"off", &trismooth::off_codec},
                                                {"obj", &trismooth::obj_codec},
                                                {"ply", &trismooth::ply_codec},
                                                {"stl", &trismooth::stl_codec},
                                                {"vtk", &trismooth::vtk_legacy_codec},
                                                {"vtu", &trismooth::vtu_codec},
                                                {"vtp", &trismooth::vtp_codec},
                                                {"su2", &trismooth::su2_codec, true}}};

/// Documents of any content that formats have to cope with: all kinds of cells in any order, arrays of every type, and
/// coordinates of few and of many digits.
class RandomDocuments {
 public:
  explicit RandomDocuments(unsigned seed) : random_(seed) {}

  MeshDocument make(std::size_t points, std::size_t cells) {
    MeshDocument document;
    document.point_type = random_() % 2 == 0 ? ScalarType::float32 : ScalarType::float64;
    for (std::size_t i = 0; i < 3 * points; ++i) {
      const double x = random_() % 3 == 0 ? static_cast<double>(random_() % 10) : anywhere_(random_);
      document.points.push_back(document.point_type == ScalarType::float32 ? static_cast<double>(static_cast<float>(x))
                                                                           : x);
    }
    for (std::size_t c = 0; points > 0 && c < cells; ++c) {
      append_cell(document, points);
    }
    const bool finite = random_() % 2 == 0;
    document.point_arrays = arrays(points, finite);
    document.cell_arrays = arrays(document.cells.size(), finite);
    document.field_arrays = {array<double>("time", 1, 1), array<std::int32_t>("table", 3, 5)};
    return document;
  }

 private:
  void append_cell(MeshDocument& document, std::size_t points) {
    constexpr std::array<std::pair<std::uint8_t, std::size_t>, 10> kinds{{{cell_type::triangle, 3},
                                                                          {cell_type::triangle, 3},
                                                                          {cell_type::triangle, 3},
                                                                          {cell_type::quad, 4},
                                                                          {cell_type::polygon, 5},
                                                                          {cell_type::polygon, 300},
                                                                          {cell_type::line, 2},
                                                                          {cell_type::poly_line, 4},
                                                                          {cell_type::vertex, 1},
                                                                          {cell_type::triangle_strip, 6}}};
    const auto [type, size] = kinds[random_() % (random_() % 8 == 0 ? kinds.size() : 3)];
    std::vector<std::int32_t> vertices(size);
    for (std::int32_t& vertex : vertices) {
      vertex = static_cast<std::int32_t>(random_() % points);
    }
    document.cells.append(type, vertices);
  }

  template <class T>
  DataArray array(const std::string& name, std::size_t components, std::size_t rows) {
    std::vector<T> numbers(rows * components);
    for (T& number : numbers) {
      number = static_cast<T>(static_cast<std::int64_t>(random_()) >> (random_() % 60));
    }
    return trismooth::make_data_array(name, components, std::move(numbers));
  }

  std::vector<DataArray> arrays(std::size_t rows, bool finite) {
    std::vector<double> reals(rows);
    for (double& real : reals) {
      real = finite || random_() % 4 != 0 ? anywhere_(random_) : std::numeric_limits<double>::quiet_NaN();
    }
    return {array<std::int8_t>("a", 1, rows),  array<std::uint8_t>("b", 3, rows),
            array<std::int16_t>("c", 1, rows), array<std::uint16_t>("d", 2, rows),
            array<std::int32_t>("e", 1, rows), array<std::uint32_t>("f", 1, rows),
            array<std::int64_t>("g", 1, rows), array<std::uint64_t>("h", 1, rows),
            array<float>("i", 9, rows),        trismooth::make_data_array("j", 1, std::move(reals))};
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> anywhere_{-1e3, 1e3};
};

std::string bytes_written(const Codec& codec, const MeshDocument& document, const FileWorkers& workers) {
  const ScratchFolder folder;
  codec.write_shared(folder / "mesh", document, workers);
  return bytes_of(folder / "mesh");
}

/// The document as the format can hold it.
MeshDocument document_for(const NamedCodec& format, MeshDocument document) {
  for (std::size_t i = 2; format.is_flat && i < document.points.size(); i += 3) {
    document.points[i] = 0;
  }
  return document;
}

/// What is wrong where `document` is written to `path`; empty where nothing is.
std::string write_failure(const Codec& codec, const std::filesystem::path& path, const MeshDocument& document,
                          const FileWorkers& workers) {
  return message_of<WriteError>([&] { codec.write_shared(path, document, workers); });
}

}  // namespace

TEST_CASE("a mesh is written in the same bytes by every number of threads, in parts of any size") {
  const NamedCodec each = GENERATE(from_range(all_codecs.begin(), all_codecs.end()));
  CAPTURE(each.name);
  const int threads = GENERATE(1, 2, 3, 8);
  CAPTURE(threads);
  Workers alone(1);
  Workers workers(threads);
  RandomDocuments documents(7);
  // Rows that fill a block to its end, and one less and more, for blocks of few rows.
  for (const std::size_t points : {0, 1, 2, 3, 4, 7, 8, 9, 31, 32, 33, 100}) {
    const MeshDocument document = document_for(each, documents.make(points, 2 * points));
    const std::string whole = bytes_written(*each.codec, document, FileWorkers(alone, FileWorkers::whole));
    CHECK((bytes_written(*each.codec, document, FileWorkers(workers)) == whole));
    for (const std::size_t part_bytes : {std::size_t{0}, std::size_t{1}, std::size_t{64}, 1 + points * 8,
                                         std::size_t{300}, FileWorkers::default_part_bytes}) {
      CAPTURE(points, part_bytes);
      CHECK((bytes_written(*each.codec, document, FileWorkers(workers, part_bytes)) == whole));
    }
  }
}

TEST_CASE("a mesh of several blocks for each thread is converted to the same bytes by any number of threads") {
  const NamedCodec each = GENERATE(from_range(all_codecs.begin(), all_codecs.end()));
  CAPTURE(each.name);
  const MeshDocument document = document_for(each, RandomDocuments(3).make(20000, 20000));
  const ScratchFolder folder;
  const std::string extension(each.name);
  write_mesh(folder / ("one." + extension), document, {}, 1);
  const std::string expected = bytes_of(folder / ("one." + extension));
  CHECK(expected.size() > 3 * FileWorkers::default_part_bytes);
  for (const int threads : is_sanitized ? std::vector{3} : std::vector{2, 3, 8}) {
    write_mesh(folder / ("more." + extension), document, {}, threads);
    CHECK((bytes_of(folder / ("more." + extension)) == expected));
  }
}

TEST_CASE("arrays are added to a file in the same bytes by any number of threads") {
  const bool finite = GENERATE(true, false);  // ASCII or BINARY
  RandomDocuments documents(11);
  MeshDocument source = documents.make(5000, 5000);
  source.cell_arrays.clear();
  source.point_arrays.clear();
  if (!finite) {
    source.field_arrays.push_back(
        trismooth::make_data_array("nan", 1, std::vector<double>{std::numeric_limits<double>::quiet_NaN()}));
  }
  const ScratchFolder folder;
  for (const std::string_view extension : {".vtk", ".vtu"}) {
    CAPTURE(finite, extension);
    const auto path = [&](const char* name) { return folder / (std::string(name) + std::string(extension)); };
    write_mesh(path("in"), source);
    const MeshDocument document = trismooth::read_mesh(path("in"));
    const MeshDocument others = documents.make(5000, 5000);
    const trismooth::AddedArrays added{others.point_arrays, others.cell_arrays};
    write_mesh(path("one"), document, added, 1);
    for (const int threads : is_sanitized ? std::vector{3} : std::vector{2, 3, 8}) {
      write_mesh(path("more"), document, added, threads);
      CHECK((bytes_of(path("more")) == bytes_of(path("one"))));
    }
  }
}

TEST_CASE("what cannot be written is the same error for every number of threads") {
  const NamedCodec each = GENERATE(from_range(all_codecs.begin(), all_codecs.end()));
  CAPTURE(each.name);
  const MeshDocument document = document_for(each, RandomDocuments(5).make(20000, 20000));
  const ScratchFolder folder;
  Workers alone(1);
  const std::string nowhere = write_failure(*each.codec, folder / "none/mesh", document, FileWorkers(alone));
  CHECK(nowhere == (folder / "none/mesh").string() + ": cannot be written: No such file or directory");
  const bool has_full_disk = std::filesystem::exists("/dev/full");
  const std::string full = has_full_disk ? write_failure(*each.codec, "/dev/full", document, FileWorkers(alone)) : "";
  CHECK((!has_full_disk || full == "/dev/full: cannot be written: No space left on device"));
  for (const int threads : {2, 3, 8}) {
    Workers workers(threads);
    CHECK(write_failure(*each.codec, folder / "none/mesh", document, FileWorkers(workers)) == nowhere);
    for (int round = 0; has_full_disk && round < 5; ++round) {
      CHECK(write_failure(*each.codec, "/dev/full", document, FileWorkers(workers)) == full);
    }
  }
}
