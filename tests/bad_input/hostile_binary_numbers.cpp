// The same for binary data: hostile numbers of every width at every byte. Which bytes are a coordinate or an index is
// found out by what a harmless number there changes.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/accepted_vtk_files.h"

using accepted_files::AcceptedFile;
using accepted_files::vtk::number_bytes;
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

class BinaryFile {
 public:
  explicit BinaryFile(const AcceptedFile& file) : file_(file), whole_(read(file).document.value()) {}

  template <class T>
  Outcome with(std::size_t at, T number) const {
    std::string bytes = file_.bytes;
    const std::string stored = number_bytes(number, is_big_endian(file_));
    return read(file_, bytes.replace(at, stored.size(), stored));
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
          if (now[i] != static_cast<std::int32_t>(harmless)) {
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

 private:
  const AcceptedFile& file_;
  MeshDocument whole_;
};

/// Where a number is neither a coordinate nor an index, some bytes will do. No divisor of a number's size.
constexpr std::size_t stride_elsewhere = 5;

struct Sites {
  std::size_t coordinates = 0;
  std::size_t indices = 0;
};

template <class T>
void check_coordinates(const AcceptedFile& file, const BinaryFile& binary, Faults& faults, Sites& sites) {
  using Limits = std::numeric_limits<T>;
  for (std::size_t at = 0; at + sizeof(T) <= file.bytes.size(); at += stride_of(file)) {
    const bool is_site = binary.is_coordinate<T>(at);
    if (!is_site && at % stride_elsewhere != 0) {
      continue;
    }
    sites.coordinates += is_site ? 1 : 0;
    for (const T hostile : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN(), Limits::infinity(),
                            -Limits::infinity(), Limits::denorm_min(), -Limits::max()}) {
      const Outcome outcome = binary.with(at, hostile);
      const std::string place = fmt::format("float{} {} at byte {}", 8 * sizeof(T), hostile, at);
      faults.add_any(file.name, place, outcome.fault);
      if (is_site && outcome.document && !(hostile - hostile == 0)) {
        faults.add(file.name, place, "is accepted");
      }
    }
  }
}

template <class T>
void check_indices(const AcceptedFile& file, const BinaryFile& binary, Faults& faults, Sites& sites) {
  const auto count = static_cast<T>(binary.point_count());
  std::vector<T> hostile_numbers{T{-1}, count, std::numeric_limits<T>::min(), std::numeric_limits<T>::max(),
                                 T{1'000'000'000}};
  if constexpr (sizeof(T) == 8) {
    hostile_numbers.insert(hostile_numbers.end(), {T{1} << 31, T{1} << 32, (T{1} << 32) + 1, (T{1} << 56) + 2});
  }
  for (std::size_t at = 0; at + sizeof(T) <= file.bytes.size(); at += stride_of(file)) {
    const bool is_site = sizeof(T) == 8 ? binary.is_wide_index(at) : binary.is_index<T>(at);
    if (!is_site && at % stride_elsewhere != 0) {
      continue;
    }
    sites.indices += is_site ? 1 : 0;
    for (const T hostile : hostile_numbers) {
      const Outcome outcome = binary.with(at, hostile);
      const std::string place = fmt::format("int{} {} at byte {}", 8 * sizeof(T), hostile, at);
      faults.add_any(file.name, place, outcome.fault);
      if (is_site && outcome.document) {
        faults.add(file.name, place, "is accepted");
      }
    }
  }
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
    const BinaryFile binary(file);
    Sites sites;
    check_coordinates<float>(file, binary, faults, sites);
    check_coordinates<double>(file, binary, faults, sites);
    check_indices<std::int32_t>(file, binary, faults, sites);
    check_indices<std::int64_t>(file, binary, faults, sites);
    INFO(file.name);
    CHECK(sites.coordinates >= 3 * binary.point_count() / (2 * stride_of(file)));
    CHECK((sites.indices >= 12 / (2 * stride_of(file)) || file.extension == ".stl"));
  }
  CHECK(files > 15);
  REQUIRE_NONE(faults);
}
