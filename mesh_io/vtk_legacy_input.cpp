#include "trismooth/mesh_io/vtk_legacy_input.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/number_text.h"

namespace trismooth {

namespace {

constexpr std::string_view blanks = " \t\v\f";

/// The whole number that all of `token` states, if T holds it.
template <class T>
std::optional<T> parse_integer(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-';
  T value{};
  const auto [stop, error] = std::from_chars(token.data() + (plus ? 1 : 0), token.data() + token.size(), value);
  if (stop != token.data() + token.size() || error != std::errc{}) {
    return std::nullopt;
  }
  return value;
}

template <class T>
T load_big_endian(const char* bytes) {
  std::array<char, sizeof(T)> stored{};
  std::memcpy(stored.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::little) {
    std::ranges::reverse(stored);
  }
  return std::bit_cast<T>(stored);
}

}  // namespace

VtkLegacyInput::VtkLegacyInput(std::string_view bytes, const std::filesystem::path& path) : scanner_(bytes, path) {
  read_header();
}

void VtkLegacyInput::read_header() {
  constexpr std::string_view magic = "# vtk datafile version";
  constexpr int newest_major_version = 5;
  const std::string_view first_line = scanner_.next_line();
  if (lower_case(first_line.substr(0, magic.size())) != magic) {
    fail("expected '# vtk DataFile Version', got " + quoted(first_line));
  }
  TextScanner rest(first_line, scanner_.path(), TextScanner::Comments::none, magic.size());
  const std::string_view version = rest.peek_token();
  const auto major = parse_integer<int>(version.substr(0, version.find('.')));
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

std::string VtkLegacyInput::peek_keyword() {
  // What looks like a token may be megabytes of binary data.
  constexpr std::size_t longer_than_any_keyword = 32;
  const std::size_t offset = scanner_.offset();
  std::string keyword = lower_case(scanner_.peek_token().substr(0, longer_than_any_keyword));
  scanner_.seek(offset);
  return keyword;
}

std::string_view VtkLegacyInput::next_token(std::string_view what) {
  if (binary_ && at_end()) {
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
  const std::optional<std::int64_t> count = parse_integer<std::int64_t>(token);
  if (!count || *count < 0) {
    fail("expected " + std::string(what) + " (a whole number from 0), got " + quoted(token));
  }
  return static_cast<std::uint64_t>(*count);
}

void VtkLegacyInput::expect_keyword(std::string_view keyword) {
  const std::string upper = upper_case(keyword);
  const std::string_view token = next_token(upper);
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
  const std::string_view token = scanner_.next_token(what);
  if constexpr (std::is_floating_point_v<T>) {
    if (const std::optional<T> value = parse_number<T>(token)) {
      return *value;
    }
    fail("expected " + std::string(what) + " (a number), got " + quoted(token));
  } else {
    if (const std::optional<T> value = parse_integer<T>(token)) {
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
  return load_big_endian<T>(scanner_.text().data() + place_);
}

template <class T>
T VtkLegacyInput::next_value(std::string_view what) {
  return binary_ ? next_binary_value<T>(what) : next_text_value<T>(what);
}

std::int64_t VtkLegacyInput::next_integer(ScalarType type, std::string_view what) {
  if (!binary_) {
    return next_text_value<std::int64_t>(what);
  }
  return visit_scalar_type(type,
                           [&](auto zero) { return static_cast<std::int64_t>(next_value<decltype(zero)>(what)); });
}

template <class T>
std::vector<T> VtkLegacyInput::read_values(std::uint64_t count, std::string_view what) {
  begin_values(count, sizeof(T), what);
  std::vector<T> values(count);
  for (T& value : values) {
    value = next_value<T>(what);
  }
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

void VtkLegacyInput::skip_metadata(std::uint64_t components) {
  if (peek_keyword() != "metadata") {
    return;
  }
  next_token("METADATA");
  scanner_.next_line();
  while (bytes_left() > 0) {
    const std::string_view line = scanner_.next_line();
    if (line.find_first_not_of(blanks) == std::string_view::npos) {
      return;
    }
    if (lower_case(line.substr(0, line.find_first_of(blanks))) == "component_names") {
      // A component without a name is an empty line that ends nothing. Where lines are missing, arrays that are added
      // behind the file's last byte would be taken for names.
      for (std::uint64_t i = 0; i < components; ++i) {
        if (bytes_left() == 0) {
          fail("COMPONENT_NAMES: expected " + std::to_string(components) + " lines, got " + std::to_string(i) +
               ": the file is cut off");
        }
        scanner_.next_line();
      }
    }
  }
}

#define TRISMOOTH_INSTANTIATE(T)                                   \
  template T VtkLegacyInput::next_value<T>(std::string_view what); \
  template std::vector<T> VtkLegacyInput::read_values<T>(std::uint64_t count, std::string_view what);
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
