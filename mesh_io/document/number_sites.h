// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// How a file writes its numbers.
enum class NumberEncoding : std::uint8_t { text, little_endian, big_endian };

constexpr NumberEncoding binary_encoding(bool is_big_endian) {
  return is_big_endian ? NumberEncoding::big_endian : NumberEncoding::little_endian;
}

/// Whether numbers of a binary encoding are not in this machine's byte order.
constexpr bool is_swapped(NumberEncoding encoding) {
  return (encoding == NumberEncoding::big_endian) == (std::endian::native == std::endian::little);
}

/// Whether a number in a file is to be written over: what is no number stays as it is written, and the sign of a zero
/// counts, for what is written is read back bit for bit.
template <class T>
bool differs(T stored, T value) {
  if constexpr (std::is_floating_point_v<T>) {
    return !(std::isnan(stored) && std::isnan(value)) &&
           (stored != value || std::signbit(stored) != std::signbit(value));
  } else {
    return stored != value;
  }
}

/// What a number at a site is.
struct SiteColumn {
  std::string array = {};      ///< the point array that it is of; empty for coordinates
  std::uint8_t component = 0;  ///< of that array; x, y or z

  bool operator==(const SiteColumn&) const = default;
};

/// Sites of a binary file in equal steps, whose numbers stand side by side.
struct EvenSites {
  std::uint64_t begin = 0;  ///< byte offset of the first one
  std::uint64_t step = 0;   ///< bytes from each to the next
  std::size_t count = 0;
  std::size_t number_bytes = sizeof(double);
};

/// Where in a file's bytes the numbers of each vertex stand that may change: its coordinates, values of its fields.
struct NumberSites {
  NumberEncoding encoding = NumberEncoding::text;
  ScalarType type = ScalarType::float64;  ///< for text of floating point, what a reader rounds to
  /// What each number of a site is. Coordinates that a file does not state (z of a flat one) are left out.
  std::vector<SiteColumn> columns{{.component = 0}, {.component = 1}, {.component = 2}};
  std::vector<ScalarType> column_types;  ///< of each column where they differ; empty where all are of `type`
  std::vector<std::uint64_t> offsets;    ///< byte offsets, one a column and site; sites in the file's order
  std::optional<EvenSites> even;         ///< instead of offsets, which are none then
  std::vector<std::int32_t> vertices;    ///< the vertex at each site; empty where they are in the order of the vertices
  std::size_t first_vertex = 0;          ///< the one at the first site then
  std::uint8_t most_characters = 0;      ///< that a new number may take as text; 0: any number of them
  /// Text: each number stands right in columns, which begin at its offset, and a new one does so too, as Fortran writes
  /// it (see fortran_text), with the letter of the old one's exponent, or E.
  bool is_in_columns = false;

  /// Sites.
  std::size_t size() const { return even ? even->count : offsets.size() / columns.size(); }
  /// Byte offset of the number of that column at a site.
  std::uint64_t offset_of(std::size_t site, std::size_t column) const {
    return even ? even->begin + site * even->step + column * even->number_bytes
                : offsets[columns.size() * site + column];
  }
  /// Whether some are values of the point array.
  bool has_values_of(std::string_view point_array) const {
    return !point_array.empty() && std::ranges::find(columns, point_array, &SiteColumn::array) != columns.end();
  }
  std::size_t vertex_at(std::size_t site) const {
    return vertices.empty() ? first_vertex + site : static_cast<std::size_t>(vertices[site]);
  }
};

/// `count` sites of numbers of float32 or float64 in a binary encoding, one behind the other from the byte `begin` on;
/// so do the columns' numbers stand.
NumberSites binary_sites(NumberEncoding encoding, ScalarType type, std::uint64_t begin, std::size_t count,
                         std::vector<SiteColumn> columns);

/// Where the values of a column are: those of vertex v at first[v * stride]. Null: the column stays as it is.
struct ColumnValues {
  const double* first = nullptr;
  std::size_t stride = 0;
};

/// Writes `bytes` to the plain path `path`, each number that differs from its site's value replaced by that of
/// `values` (one a column of `sites`, representable in their types), every other byte as it is, and then `suffix`.
/// Text gets the shortest text that reads back to the same value, or, where that is longer than most_characters, the
/// nearest number that is not. Text that stands there may have an exponent as Fortran writes it. Throws WriteError.
void write_patched(const std::filesystem::path& path, std::string_view bytes, const NumberSites& sites,
                   std::span<const ColumnValues> values, std::string_view suffix, const FileWorkers& workers);

/// Sites of numbers with what they are to be.
struct PatchedSites {
  const NumberSites& sites;
  std::vector<ColumnValues> values;
};

/// Puts lists, whose columns follow each other, in the order of their places, without those that are empty. False where
/// they are not apart, each wholly behind the one before: in files in which several grids share numbers, and in those
/// that are damaged, or made to mislead.
bool sort_apart(std::vector<NumberSites>& lists);

/// write_patched() of several lists of sites, each wholly behind the one before.
void write_patched(const std::filesystem::path& path, std::string_view bytes, std::span<const PatchedSites> lists,
                   std::string_view suffix, const FileWorkers& workers);

/// write_patched() of sites of x, y and z: `points` has them of every vertex.
void write_patched(const std::filesystem::path& path, std::string_view bytes, const NumberSites& sites,
                   std::span<const double> points, std::string_view suffix, const FileWorkers& workers);

}  // namespace trismooth
