// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_input.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_information.h"

namespace trismooth {

VtkLegacyInput::VtkLegacyInput(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
    : scanner_(bytes, path), workers_(workers.workers), plain_rows_(bytes, workers) {
  read_header();
}

void VtkLegacyInput::read_header() {
  constexpr std::string_view magic = "# vtk datafile version";
  constexpr int newest_major_version = 5;
  if (scanner_.text().starts_with(byte_order_mark)) {
    scanner_.seek(byte_order_mark.size());
  }
  const std::string_view first_line = scanner_.next_line();
  if (lower_case(first_line.substr(0, magic.size())) != magic) {
    fail("expected '# vtk DataFile Version', got " + quoted(first_line));
  }
  TextScanner rest(first_line, scanner_.path(), TextScanner::Comments::none, magic.size());
  const std::string_view version = rest.peek_token();
  const auto major = parse_integer_as<std::int32_t>(version.substr(0, version.find('.')));
  if (!major || *major < 1 || *major > newest_major_version) {
    fail("file version " + quoted(version) + " is not supported; versions 1.0 to 5.1 are");
  }
  scanner_.next_line();  // the title
  const std::string_view encoding = scanner_.next_token("ASCII or BINARY");
  const std::string keyword = lower_case(encoding);
  if (keyword != "ascii" && keyword != "binary") {
    fail("expected ASCII or BINARY, got " + quoted(encoding));
  }
  binary_ = keyword == "binary";
}

void VtkLegacyInput::pass_comments() {
  std::size_t behind = scanner_.offset();
  while (!scanner_.at_end() && scanner_.text()[scanner_.offset()] == '#') {
    scanner_.next_line();
    behind = scanner_.offset();
  }
  scanner_.seek(behind);
}

void VtkLegacyInput::pass_comment() {
  const std::size_t offset = scanner_.offset();
  if (!scanner_.at_end_of_line() && scanner_.text()[scanner_.offset()] == '#') {
    scanner_.next_line();
  } else {
    scanner_.seek(offset);
  }
}

bool VtkLegacyInput::at_end() {
  pass_comments();
  return scanner_.at_end();
}

bool VtkLegacyInput::at_end_of_line() {
  return scanner_.at_end_of_line() || scanner_.text()[scanner_.offset()] == '#';
}

std::string VtkLegacyInput::peek_word() {
  // What looks like a token may be megabytes of binary data.
  constexpr std::size_t longer_than_any_keyword = 32;
  return lower_case(scanner_.peek_token().substr(0, longer_than_any_keyword));
}

std::string VtkLegacyInput::peek_keyword() {
  const std::size_t offset = scanner_.offset();
  pass_comments();
  std::string keyword = peek_word();
  scanner_.seek(offset);
  return keyword;
}

bool VtkLegacyInput::is_next(std::string_view keyword) {
  const std::size_t offset = scanner_.offset();
  if (binary_ && at_end_of_line()) {
    scanner_.next_line();
  }
  const bool is = (binary_ ? peek_word() : peek_keyword()) == keyword;
  scanner_.seek(offset);
  return is;
}

bool VtkLegacyInput::is_after_next(std::string_view keyword) {
  const std::size_t offset = scanner_.offset();
  const std::size_t length = scanner_.peek_token().size();
  scanner_.seek(scanner_.offset() + length);
  const bool is = peek_word() == keyword;
  scanner_.seek(offset);
  return is;
}

std::string_view VtkLegacyInput::next_keyword(std::string_view what) {
  pass_comments();
  return next_token(what);
}

std::string_view VtkLegacyInput::next_token(std::string_view what) {
  if (binary_ && scanner_.at_end()) {
    place_ = scanner_.offset();
    fail("expected " + std::string(what) + ", got the end of the file");
  }
  const std::string_view token = scanner_.next_token(what);
  place_ = scanner_.token_offset();
  return token;
}

VtkLegacyType VtkLegacyInput::next_type() {
  const std::string_view token = next_token("a data type");
  const std::optional<VtkLegacyType> type = vtk_legacy_type(token);
  if (!type) {
    fail("expected a data type (float, double, int, ...), got " + quoted(token));
  }
  return *type;
}

std::uint64_t VtkLegacyInput::next_count(std::string_view what) {
  const std::string_view token = next_token(what);
  const std::optional<std::int64_t> count = parse_integer_as<std::int64_t>(token);
  if (!count || *count < 0) {
    fail("expected " + std::string(what) + " (a whole number from 0), got " + quoted(token));
  }
  return static_cast<std::uint64_t>(*count);
}

void VtkLegacyInput::expect_keyword(std::string_view keyword) {
  const std::string upper = upper_case(keyword);
  const std::string_view token = next_keyword(upper);
  if (lower_case(token) != keyword) {
    fail("expected " + upper + ", got " + quoted(token));
  }
}

std::uint64_t VtkLegacyInput::value_count(std::uint64_t a, std::uint64_t b, std::string_view what) const {
  if (b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b) {
    fail("declares " + std::to_string(a) + " x " + std::to_string(b) + " " + std::string(what) +
         ", more than any file holds");
  }
  return a * b;
}

void VtkLegacyInput::require_values(std::uint64_t count, std::uint64_t room, std::string_view what) const {
  if (count > room) {
    fail("declares " + std::to_string(count) + " " + std::string(what) + ", but the rest of the file has room for " +
         std::to_string(room) + " at most: it is cut off, or that number is wrong");
  }
}

void VtkLegacyInput::pass_header_line() {
  const std::string_view text = scanner_.text();
  std::size_t end = std::min(text.find_first_not_of(blanks, scanner_.offset()), text.size());
  if (end < text.size() && text[end] == '#') {
    end = std::min(text.find_first_of("\r\n", end), text.size());
  }
  if (text.substr(end, 2) == "\r\n") {
    ++end;
  }
  if (end == text.size() || text[end] != '\n') {
    place_ = end;
    fail("expected the end of the line before the binary data");
  }
  scanner_.seek(end + 1);
}

void VtkLegacyInput::begin_values(std::uint64_t count, std::size_t bytes_each, std::string_view what) {
  if (!binary_) {
    // Every value takes a digit and, all but the last, a space.
    require_values(count, (bytes_left() + 1) / 2, what);
  } else if (count > 0) {
    require_values(count, bytes_left() / bytes_each, what);
    pass_header_line();
    require_values(count, bytes_left() / bytes_each, what);
  }
}

template <class T>
T VtkLegacyInput::next_text_value(std::string_view what) {
  std::string_view token = scanner_.next_token(what);
  while (token.front() == '#') {
    scanner_.next_line();
    token = scanner_.next_token(what);
  }
  if constexpr (std::is_floating_point_v<T>) {
    if (const std::optional<T> value = parse_number<T>(token)) {
      return *value;
    }
    fail("expected " + std::string(what) + " (a number), got " + quoted(token));
  } else {
    if (const std::optional<T> value = parse_integer_as<T>(token)) {
      return *value;
    }
    fail("expected " + std::string(what) + " (a whole number from " + std::to_string(std::numeric_limits<T>::lowest()) +
         " to " + std::to_string(std::numeric_limits<T>::max()) + "), got " + quoted(token));
  }
}

template <class T>
T VtkLegacyInput::next_binary_value(std::string_view what) {
  place_ = scanner_.offset();
  require_values(1, bytes_left() / sizeof(T), what);
  scanner_.seek(place_ + sizeof(T));
  return load<std::endian::big, T>(scanner_.text().data() + place_);
}

template <class T>
bool VtkLegacyInput::next(T& value, std::string_view what) {
  if (!binary_) {
    value = next_text_value<T>(what);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    value = visit_scalar_type(
        stored_, [&](auto zero) { return static_cast<std::int64_t>(next_binary_value<decltype(zero)>(what)); });
  } else {
    value = next_binary_value<T>(what);
  }
  return true;
}

template <class T>
std::vector<T> VtkLegacyInput::read_values(std::uint64_t count, std::string_view what, std::string_view each) {
  begin_values(count, sizeof(T), what);
  std::vector<T> values;
  shared_resize(values, count, workers_);
  read_rows(count, 1, [&](auto& numbers, std::size_t first, std::size_t last) {
    return std::all_of(values.begin() + static_cast<std::ptrdiff_t>(first),
                       values.begin() + static_cast<std::ptrdiff_t>(last),
                       [&](T& value) { return numbers.next(value, each.empty() ? what : each); });
  });
  return values;
}

std::vector<std::uint8_t> VtkLegacyInput::read_bits(std::uint64_t count, std::string_view what) {
  if (!binary_) {
    std::vector<std::uint8_t> bits = read_values<std::uint8_t>(count, what);
    std::ranges::transform(bits, bits.begin(), [](std::uint8_t bit) { return std::uint8_t{bit != 0}; });
    return bits;
  }
  const std::uint64_t byte_count = count / 8 + (count % 8 == 0 ? 0 : 1);
  const std::vector<std::uint8_t> packed = read_values<std::uint8_t>(byte_count, what);
  std::vector<std::uint8_t> bits(count);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bits[i] = static_cast<std::uint8_t>(packed[i / 8] >> (7 - i % 8) & 1U);
  }
  return bits;
}

std::uint64_t VtkLegacyInput::next_string_length(std::string_view what) {
  // The two highest bits say in how many bytes the length stands, themselves included.
  constexpr std::uint64_t flag_bits = 2;
  place_ = scanner_.offset();
  require_values(1, bytes_left(), what);
  const auto first = static_cast<unsigned char>(scanner_.text()[place_]);
  switch (first >> 6) {
    case 3:
      return next_binary_value<std::uint8_t>(what) & (0xffU >> flag_bits);
    case 2:
      return next_binary_value<std::uint16_t>(what) & (0xffffU >> flag_bits);
    case 1:
      return next_binary_value<std::uint32_t>(what) & (0xffffffffU >> flag_bits);
    default:
      return next_binary_value<std::uint64_t>(what);
  }
}

std::vector<std::string_view> VtkLegacyInput::read_strings(std::uint64_t count, std::string_view what) {
  std::vector<std::string_view> strings;
  if (!binary_) {
    require_values(count, bytes_left(), what);
    strings.reserve(count);
    scanner_.next_line();  // the rest of the header line
    for (std::uint64_t i = 0; i < count; ++i) {
      if (bytes_left() == 0) {
        next_token(what);  // fails
      }
      strings.push_back(scanner_.next_line());
    }
    return strings;
  }
  begin_values(count, 1, what);
  strings.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t length = next_string_length(what);
    require_values(length, bytes_left(), "bytes of a string");
    strings.push_back(scanner_.text().substr(scanner_.offset(), length));
    scanner_.seek(scanner_.offset() + length);
  }
  return strings;
}

void VtkLegacyInput::skip_variants(std::uint64_t count, std::string_view what) {
  require_values(count, (bytes_left() + 1) / 2, what);
  for (std::uint64_t i = 0; i < count; ++i) {
    next_token(what);
    next_token(what);
  }
}

std::shared_ptr<const ArrayDescription> VtkLegacyInput::read_metadata(std::uint64_t components) {
  if (peek_keyword() != "metadata") {
    return nullptr;
  }
  next_keyword("METADATA");
  scanner_.next_line();
  ArrayDescription description;
  while (bytes_left() > 0) {
    const std::string_view line = scanner_.next_line();
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) {
      break;
    }
    const std::string keyword = lower_case(words.front());
    if (keyword == "component_names") {
      // A component without a name is an empty line that ends nothing. Where lines are missing, arrays that are added
      // behind the file's last byte would be taken for names. Of two lists the last one holds, as in VTK.
      description.component_names.clear();
      for (std::uint64_t i = 0; i < components; ++i) {
        if (bytes_left() == 0) {
          fail("COMPONENT_NAMES: expected " + std::to_string(components) + " lines, got " + std::to_string(i) +
               ": the file is cut off");
        }
        description.component_names.push_back(decode_vtk_name(trimmed(scanner_.next_line())));
      }
    } else if (keyword == "name") {
      read_information(words, description.information);
    }
  }
  if (std::ranges::all_of(description.component_names, &std::string::empty)) {
    description.component_names.clear();
  }
  return description.empty() ? nullptr : std::make_shared<const ArrayDescription>(std::move(description));
}

void VtkLegacyInput::read_information(const std::vector<std::string_view>& header,
                                      std::vector<ArrayInformation>& information) {
  if (header.size() < 4 || lower_case(header[2]) != "location") {
    return;
  }
  ArrayInformation entry{std::string(header[1]), std::string(header[3]), {}};
  const std::size_t behind_header = scanner_.offset();
  const std::vector<std::string_view> data = words_of(scanner_.next_line());
  if (data.empty() || lower_case(data[0]) != "data") {
    scanner_.seek(behind_header);
    return;
  }
  const auto kind = vtk_legacy_information_kind(entry.name, entry.location);
  const bool is_list = kind == InformationKind::numbers || kind == InformationKind::texts;
  for (std::size_t i = is_list ? 2 : 1; i < data.size(); ++i) {
    entry.values.push_back(decode_vtk_name(data[i]));
  }
  if (kind == InformationKind::texts && data.size() > 1) {
    // One a line, which may be empty.
    const std::uint64_t count = parse_integer_as<std::uint64_t>(data[1]).value_or(0);
    for (std::uint64_t i = 0; i < count && bytes_left() > 0; ++i) {
      entry.values.push_back(decode_vtk_name(trimmed(scanner_.next_line())));
    }
  }
  if (!is_range_information(entry.name, entry.location)) {
    information.push_back(std::move(entry));
  }
}

#define TRISMOOTH_INSTANTIATE(T)                                                                     \
  template bool VtkLegacyInput::next<T>(T & value, std::string_view what);                           \
  template std::vector<T> VtkLegacyInput::read_values<T>(std::uint64_t count, std::string_view what, \
                                                         std::string_view each);
TRISMOOTH_INSTANTIATE(std::int8_t)
TRISMOOTH_INSTANTIATE(std::uint8_t)
TRISMOOTH_INSTANTIATE(std::int16_t)
TRISMOOTH_INSTANTIATE(std::uint16_t)
TRISMOOTH_INSTANTIATE(std::int32_t)
TRISMOOTH_INSTANTIATE(std::uint32_t)
TRISMOOTH_INSTANTIATE(std::int64_t)
TRISMOOTH_INSTANTIATE(std::uint64_t)
TRISMOOTH_INSTANTIATE(float)
TRISMOOTH_INSTANTIATE(double)
#undef TRISMOOTH_INSTANTIATE

void VtkLegacyInput::fail(const std::string& message) const {
  if (binary_) {
    throw ReadError(scanner_.path(), "at byte " + std::to_string(place_) + ": " + message);
  }
  scanner_.fail(message);
}

}  // namespace trismooth
