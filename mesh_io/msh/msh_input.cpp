// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::array<double, 5> read_versions{2.0, 2.1, 2.2, 4.0, 4.1};

}  // namespace

MshInput::MshInput(std::string_view bytes, const std::filesystem::path& path)
    : scanner_(bytes, path, TextScanner::Comments::none, begin_of_text(bytes)) {}

void MshInput::read_header() {
  const std::string_view version = scanner_.next_token("the version of the format");
  const std::optional<double> number = parse_number<double>(version);
  if (!number || std::ranges::find(read_versions, *number) == read_versions.end()) {
    scanner_.fail("expected a version of the format (2, 2.1, 2.2, 4, 4.1), got " + quoted(version) +
                  "; Gmsh writes these (Mesh.MshFileVersion)");
  }
  header_.version = static_cast<int>(std::lround(10 * *number));
  header_.binary = scanner_.next_integer("0 (text) or 1 (binary)", 0, 1) == 1;
  const std::int64_t size = scanner_.next_integer("the size of the data, 4 or 8", 4, 8);
  if (size != 4 && size != 8) {
    scanner_.fail("expected the size of the data, 4 or 8, got " + std::to_string(size));
  }
  // Before 4.1 it is the size of a double, which is 8.
  header_.size_bytes = static_cast<std::size_t>(header_.version >= 41 ? size : 8);
  if (header_.version < 41 && size != 8) {
    scanner_.fail("expected 8, the size of a coordinate, got " + std::to_string(size));
  }
  if (header_.binary) {
    scanner_.next_line();
    const auto one = binary<std::int32_t>("the number 1 in the byte order of the file");
    if (one != 1 && one != std::int32_t{1} << 24) {
      fail("expected the number 1 in the byte order of the file, got " + std::to_string(one));
    }
    header_.swapped = one != 1;
  }
}

std::int64_t MshInput::integer(std::string_view what, std::int64_t lowest, std::int64_t highest) {
  return header_.binary ? within(what, binary<std::int32_t>(what), lowest, highest)
                        : scanner_.next_integer(what, lowest, highest);
}

std::int64_t MshInput::size(std::string_view what, std::int64_t highest) {
  if (!header_.binary) {
    return scanner_.next_integer(what, 0, highest);
  }
  if (header_.size_bytes == sizeof(std::uint32_t)) {
    return within(what, binary<std::uint32_t>(what), 0, highest);
  }
  return within(what, binary<std::int64_t>(what), 0, highest);
}

double MshInput::real(std::string_view what) {
  if (!header_.binary) {
    return scanner_.next_double(what);
  }
  const auto value = binary<double>(what);
  if (!std::isfinite(value)) {
    fail("expected " + std::string(what) + " (a finite number), got " + std::to_string(value));
  }
  return value;
}

void MshInput::require_room(std::string_view what, std::uint64_t count, std::size_t numbers_each,
                            std::size_t bytes_each) {
  // Every number takes a digit and a separator, but for the separator at the end of the file.
  trismooth::require_room(path(), what, count, header_.binary ? bytes_each : 2 * numbers_each,
                          header_.binary ? bytes_left() : bytes_left() + 1);
}

void MshInput::fail_at(std::size_t offset, const std::string& message) const {
  if (header_.binary) {
    throw ReadError(path(), "byte " + std::to_string(offset) + ": " + message);
  }
  scanner_.fail_at(offset, message);
}

template <class T>
T MshInput::binary(std::string_view what) {
  BinaryNumbers numbers(bytes(), offset(), header_.swapped);
  T value{};
  const bool read = numbers.next(value);
  scanner_.resume(numbers.token_offset(), numbers.offset());
  if (!read) {
    fail("expected " + std::string(what) + ", got the end of the file");
  }
  return value;
}

std::int64_t MshInput::within(std::string_view what, std::int64_t value, std::int64_t lowest,
                              std::int64_t highest) const {
  if (value < lowest || value > highest) {
    fail("expected " + std::string(what) + " from " + std::to_string(lowest) + " to " + std::to_string(highest) +
         ", got " + std::to_string(value));
  }
  return value;
}

}  // namespace trismooth
