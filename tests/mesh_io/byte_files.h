// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"

namespace byte_files {

/// A path in the temporary folder that no other test uses, removed at the end.
class TemporaryPath {
 public:
  explicit TemporaryPath(std::string_view extension) {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("trismooth_" + std::to_string(getpid()) + "_" + std::to_string(count++) + std::string(extension));
  }
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  ~TemporaryPath() {
    std::error_code error;
    std::filesystem::remove(path_, error);
  }

  const std::filesystem::path& path() const { return path_; }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

/// The bytes of a number in the byte order `order`.
template <class T>
std::string number_bytes(T number, std::endian order = std::endian::little) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(number);
  if (order != std::endian::native) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return {bytes.data(), bytes.size()};
}

/// What the codec says of bytes that it must refuse; empty where it reads them.
inline std::string refusal(const trismooth::Codec& codec, const std::string& bytes) {
  try {
    codec.read("mesh", bytes);
  } catch (const trismooth::ReadError& error) {
    return error.what();
  }
  return {};
}

/// The bytes that a document gives when it is written back to its own format.
inline std::string written_back(const trismooth::MeshDocument& document) {
  const TemporaryPath file(".bytes");
  document.original->write(file.path(), document, {}, {});
  return file.bytes();
}

/// What readers guarantee of every document.
inline bool is_valid(const trismooth::MeshDocument& document) {
  const auto points = static_cast<std::int64_t>(document.point_count());
  const auto& cells = document.cells;
  const auto has_rows = [](std::size_t rows) {
    return [rows](const trismooth::DataArray& array) { return array.rows() == rows; };
  };
  return document.points.size() % 3 == 0 && std::ranges::all_of(document.points, [](double x) { return x - x == 0; }) &&
         cells.offsets.size() == cells.size() + 1 && std::ranges::is_sorted(cells.offsets) &&
         cells.offsets.back() == static_cast<std::int64_t>(cells.connectivity.size()) &&
         std::ranges::all_of(cells.connectivity, [&](std::int32_t v) { return v >= 0 && v < points; }) &&
         std::ranges::all_of(document.point_arrays, has_rows(document.point_count())) &&
         std::ranges::all_of(document.cell_arrays, has_rows(cells.size()));
}

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != text.npos;
}

/// The numbers of an array that must be there, of type T.
template <class T>
std::vector<T> values(const trismooth::DataArray* array) {
  REQUIRE(array != nullptr);
  const auto view = array->as<T>();
  return {view.begin(), view.end()};
}

}  // namespace byte_files
