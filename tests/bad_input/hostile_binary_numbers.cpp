// SPDX-License-Identifier: BSD-3-Clause
// The same for binary data: hostile numbers of every width at every byte, of encoded and compressed arrays at every
// number. Which bytes are a coordinate or an index is found out by what a harmless number there changes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/accepted_vtk_files.h"
#include "support/xml_arrays.h"

using accepted_files::AcceptedFile;
using accepted_files::vtk::number_bytes;
using accepted_files::vtk::XmlArrays;
using trismooth::MeshDocument;

namespace {

/// Files whose numbers stand in the file as they are in memory.
bool is_binary(const AcceptedFile& file) {
  const bool vtk_binary = file.extension == ".vtk" && file.bytes.find("\nBINARY") != std::string::npos;
  const bool raw =
      file.name.find("appended_raw") != std::string::npos && file.bytes.find("compressor") == std::string::npos;
  return vtk_binary || raw || file.name.find("endian") != std::string::npos || file.name.starts_with("stl_binary");
}

bool is_big_endian(const AcceptedFile& file) {
  return file.extension == ".vtk" || file.name.find("big") != std::string::npos;
}

/// Bytes of numbers, and the file that has them: as they are, or encoded.
class BinaryNumbers {
 public:
  using Encode = std::function<std::string(const std::string& bytes)>;

  /// All of the file.
  explicit BinaryNumbers(const AcceptedFile& file)
      : BinaryNumbers(
            file, file.bytes, [](const std::string& bytes) { return bytes; }, stride_of(file)) {}
  /// `step`: from one place that is tried to the next.
  BinaryNumbers(const AcceptedFile& file, std::string bytes, Encode encode, std::size_t step)
      : file_(file),
        bytes_(std::move(bytes)),
        encode_(std::move(encode)),
        step_(step),
        whole_(read(file).document.value()) {}

  const std::string& file_name() const { return file_.name; }
  std::size_t size() const { return bytes_.size(); }
  std::size_t step() const { return step_; }

  template <class T>
  Outcome with(std::size_t at, T number) const {
    std::string bytes = bytes_;
    const std::string stored = number_bytes(number, is_big_endian(file_));
    return read(file_, encode_(bytes.replace(at, stored.size(), stored)));
  }

  /// True where a number of type T at that byte is a coordinate.
  template <class T>
  bool is_coordinate(std::size_t at) const {
    const T harmless{7.0625};
    const Outcome outcome = with(at, harmless);
    return outcome.document &&
           std::ranges::find(outcome.document->points, double{harmless}) != outcome.document->points.end() &&
           outcome.document->cells.size() == whole_.cells.size();
  }

  /// True where a number of type T at that byte is a vertex index: the cells say what it says.
  template <class T>
  bool is_index(std::size_t at) const {
    std::vector<std::size_t> places;
    for (const T harmless : {T{1}, T{2}}) {
      const Outcome outcome = with(at, harmless);
      if (!outcome.document || outcome.document->cells.offsets != whole_.cells.offsets) {
        return false;
      }
      const auto& now = outcome.document->cells.connectivity;
      for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i] != whole_.cells.connectivity[i]) {
          places.push_back(i);
          if (now[i] + first_index_ != static_cast<std::int32_t>(harmless)) {
            return false;
          }
        }
      }
    }
    // One place, where at least one of the two harmless numbers was not there already.
    return !places.empty() && std::ranges::count(places, places.front()) == static_cast<std::ptrdiff_t>(places.size());
  }

  /// The same, and the number is not a narrower index beside something else.
  bool is_wide_index(std::size_t at) const {
    const std::size_t high_half = at + (is_big_endian(file_) ? 0 : sizeof(std::int32_t));
    return is_index<std::int64_t>(at) && !with(high_half, std::int32_t{1}).document;
  }

  std::size_t point_count() const { return whole_.point_count(); }
  std::int32_t first_index() const { return first_index_; }

 private:
  const AcceptedFile& file_;
  std::string bytes_;
  Encode encode_;
  std::size_t step_;
  MeshDocument whole_;
  std::int32_t first_index_ =
      file_.extension == ".meshb" || file_.extension == ".slf" ? 1 : 0;  ///< in the file, of the first vertex
};

/// Where a number is neither a coordinate nor an index, some bytes will do. No divisor of a number's size.
constexpr std::size_t stride_elsewhere = 5;

struct Sites {
  std::size_t coordinates = 0;
  std::size_t indices = 0;
};

template <class T>
void check_coordinates(const BinaryNumbers& numbers, Faults& faults, Sites& sites) {
  using Limits = std::numeric_limits<T>;
  for (std::size_t at = 0; at + sizeof(T) <= numbers.size(); at += numbers.step()) {
    const bool is_site = numbers.is_coordinate<T>(at);
    if (!is_site && at % stride_elsewhere != 0) {
      continue;
    }
    sites.coordinates += is_site ? 1 : 0;
    for (const T hostile : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN(), Limits::infinity(),
                            -Limits::infinity(), Limits::denorm_min(), -Limits::max()}) {
      const Outcome outcome = numbers.with(at, hostile);
      const std::string place = fmt::format("float{} {} at byte {}", 8 * sizeof(T), hostile, at);
      faults.add_any(numbers.file_name(), place, outcome.fault);
      if (is_site && outcome.document && !std::isfinite(hostile)) {
        faults.add(numbers.file_name(), place, "is accepted");
      }
    }
  }
}

template <class T>
void check_indices(const BinaryNumbers& numbers, Faults& faults, Sites& sites) {
  const auto beyond = static_cast<T>(numbers.point_count()) + static_cast<T>(numbers.first_index());
  std::vector<T> hostile_numbers{T{-1}, beyond, std::numeric_limits<T>::min(), std::numeric_limits<T>::max(),
                                 T{1'000'000'000}};
  if constexpr (sizeof(T) == 8) {
    hostile_numbers.insert(hostile_numbers.end(), {T{1} << 31, T{1} << 32, (T{1} << 32) + 1, (T{1} << 56) + 2});
  }
  for (std::size_t at = 0; at + sizeof(T) <= numbers.size(); at += numbers.step()) {
    const bool is_site = sizeof(T) == 8 ? numbers.is_wide_index(at) : numbers.is_index<T>(at);
    if (!is_site && at % stride_elsewhere != 0) {
      continue;
    }
    sites.indices += is_site ? 1 : 0;
    for (const T hostile : hostile_numbers) {
      const Outcome outcome = numbers.with(at, hostile);
      const std::string place = fmt::format("int{} {} at byte {}", 8 * sizeof(T), hostile, at);
      faults.add_any(numbers.file_name(), place, outcome.fault);
      if (is_site && outcome.document) {
        faults.add(numbers.file_name(), place, "is accepted");
      }
    }
  }
}

Sites check(const BinaryNumbers& numbers, Faults& faults) {
  Sites sites;
  check_coordinates<float>(numbers, faults, sites);
  check_coordinates<double>(numbers, faults, sites);
  check_indices<std::int32_t>(numbers, faults, sites);
  check_indices<std::int64_t>(numbers, faults, sites);
  return sites;
}

}  // namespace

TEST_CASE("A hostile number in binary data is refused as a coordinate and as an index, and does no harm elsewhere") {
  Faults faults;
  std::size_t files = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (!is_binary(file)) {
      continue;
    }
    ++files;
    const BinaryNumbers numbers(file);
    const Sites sites = check(numbers, faults);
    INFO(file.name);
    const bool has_whole_coordinates = file.scale != 1;
    CHECK((sites.coordinates >= 2 * numbers.point_count() / (2 * stride_of(file)) || has_whole_coordinates));
    // STL has no indices, and those of MSH are tags, which begin at 1.
    const bool has_indices = file.extension != ".stl" && file.extension != ".msh";
    CHECK((sites.indices >= 12 / (2 * stride_of(file)) || !has_indices));
  }
  CHECK(files > 15);
  REQUIRE_NONE(faults);
}

TEST_CASE("A hostile number in an encoded or compressed array is refused as a coordinate and as an index") {
  Faults faults;
  std::size_t files = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    const XmlArrays arrays(file.bytes);
    if (!is_vtk_xml(file) || is_binary(file) || arrays.arrays().empty()) {
      continue;
    }
    ++files;
    // Numbers in arrays are aligned; where encoding takes long, some will do.
    const std::size_t numbers_a_step = (arrays.is_slow() ? 3 : 1) * stride_of(file);
    Sites sites;
    for (const XmlArrays::Array& array : arrays.arrays()) {
      const BinaryNumbers numbers(
          file, arrays.payload(array).value(),
          [&](const std::string& bytes) { return arrays.with(array, arrays.with_payload(array, bytes)); },
          sizeof(std::int32_t) * numbers_a_step);
      const Sites found = check(numbers, faults);
      sites.coordinates += found.coordinates;
      sites.indices += found.indices;
    }
    INFO(file.name);
    const std::size_t points = read(file).document.value().point_count();
    CHECK(sites.coordinates >= 3 * points / (2 * numbers_a_step));
    CHECK(sites.indices >= 12 / (2 * numbers_a_step));
  }
  CHECK(files > 15);
  REQUIRE_NONE(faults);
}
