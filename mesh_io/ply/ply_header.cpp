// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

struct TypeName {
  ScalarType type;
  std::string_view name;  ///< of the original format
  std::string_view sized_name;
};

constexpr std::array<TypeName, 10> ply_type_names{{
    {ScalarType::int8, "char", "int8"},
    {ScalarType::uint8, "uchar", "uint8"},
    {ScalarType::int16, "short", "int16"},
    {ScalarType::uint16, "ushort", "uint16"},
    {ScalarType::int32, "int", "int32"},
    {ScalarType::uint32, "uint", "uint32"},
    {ScalarType::float32, "float", "float32"},
    {ScalarType::float64, "double", "float64"},
    // Not of the format, but written and read by some.
    {ScalarType::int64, "int64", "int64"},
    {ScalarType::uint64, "uint64", "uint64"},
}};

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view bytes)
      : bytes_(bytes), begin_(begin_of_text(bytes)), scanner_(bytes, path, TextScanner::Comments::none, begin_) {}

  PlyHeader parse() {
    parse_magic();
    bool has_format = false;
    while (true) {
      const std::string_view keyword = scanner_.next_token("a header line or 'end_header'");
      if (keyword == "comment" || keyword == "obj_info") {
        scanner_.next_line();
        continue;
      }
      if (keyword == "end_header") {
        break;
      }
      if (keyword == "format") {
        if (std::exchange(has_format, true)) {
          scanner_.fail("the format is declared twice");
        }
        parse_format();
      } else if (keyword == "element") {
        parse_element();
      } else if (keyword == "property") {
        parse_property();
      } else {
        scanner_.fail("expected 'format', 'element', 'property', 'comment', 'obj_info' or 'end_header', got " +
                      trismooth::quoted(keyword));
      }
      finish_line();
    }
    if (!has_format) {
      scanner_.fail("the header declares no format");
    }
    finish_line();
    // A header of CR lines leaves open whether an LF that follows belongs to it; it is data.
    header_.size = scanner_.offset() - (lines_end_with_cr_ && bytes_[scanner_.offset() - 1] == '\n' ? 1 : 0);
    return std::move(header_);
  }

 private:
  void parse_magic() {
    constexpr std::string_view magic = "ply";
    if (!bytes_.substr(begin_).starts_with(magic) || scanner_.next_token(magic) != magic ||
        !scanner_.at_end_of_line()) {
      throw ReadError(scanner_.path(), 1, "is not a PLY file: the first line is not 'ply'");
    }
    const std::string_view line_end = bytes_.substr(scanner_.offset(), 2);
    lines_end_with_cr_ = line_end.starts_with('\r') && line_end != "\r\n";
    scanner_.next_line();
  }

  void parse_format() {
    const std::string_view name = word("a format");
    if (name == "ascii") {
      header_.encoding = NumberEncoding::text;
    } else if (name == "binary_little_endian") {
      header_.encoding = NumberEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = NumberEncoding::big_endian;
    } else {
      scanner_.fail("expected 'ascii', 'binary_little_endian' or 'binary_big_endian', got " + trismooth::quoted(name));
    }
    if (const std::string_view version = word("a version"); version != "1.0") {
      scanner_.fail("expected version 1.0, got " + trismooth::quoted(version));
    }
  }

  void parse_element() {
    PlyElement element;
    element.name = word("an element's name");
    if (!element_names_.insert(element.name).second) {
      scanner_.fail("element " + trismooth::quoted(element.name) + " is declared twice");
    }
    require_word("a number of rows");
    element.count = static_cast<std::uint64_t>(
        scanner_.next_integer("a number of rows", 0, std::numeric_limits<std::int64_t>::max()));
    header_.elements.push_back(std::move(element));
    property_names_.clear();
  }

  void parse_property() {
    if (header_.elements.empty()) {
      scanner_.fail("a property is declared before any element");
    }
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    std::string_view type = word("a type");
    if (type == "list") {
      property.count_type = type_of(word("the type of a list's count"));
      if (*property.count_type == ScalarType::float32 || *property.count_type == ScalarType::float64) {
        scanner_.fail("the count of a list must be of an integer type");
      }
      type = word("the type of a list's items");
    }
    property.type = type_of(type);
    property.name = word("a property's name");
    property.label = "property " + trismooth::quoted(property.name) + " of element " + trismooth::quoted(element.name);
    if (!property_names_.insert(property.name).second) {
      scanner_.fail(property.label + " is declared twice");
    }
    element.properties.push_back(std::move(property));
  }

  ScalarType type_of(std::string_view name) const {
    for (const TypeName& known : ply_type_names) {
      if (name == known.name || name == known.sized_name) {
        return known.type;
      }
    }
    scanner_.fail(
        "expected a type (char, uchar, short, ushort, int, uint, float, double, int8, uint8, int16, uint16, int32, "
        "uint32, float32, float64, int64 or uint64), got " +
        trismooth::quoted(name));
  }

  void require_word(std::string_view what) {
    if (scanner_.at_end_of_line()) {
      scanner_.fail("expected " + std::string(what) + ", got the end of the line");
    }
  }

  std::string_view word(std::string_view what) {
    require_word(what);
    return scanner_.next_token(what);
  }

  void finish_line() {
    if (!scanner_.at_end_of_line()) {
      scanner_.fail("expected the end of the line, got " + trismooth::quoted(scanner_.peek_token()));
    }
    scanner_.next_line();
  }

  std::string_view bytes_;
  std::size_t begin_;  ///< behind a byte-order mark
  TextScanner scanner_;
  PlyHeader header_;
  std::set<std::string> element_names_;
  std::set<std::string> property_names_;  ///< of the last element
  bool lines_end_with_cr_ = false;
};

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  return found == properties.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - properties.begin()));
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view bytes) {
  return HeaderParser(path, bytes).parse();
}

bool is_ply_type(ScalarType type) {
  return type != ScalarType::int64 && type != ScalarType::uint64;
}

std::string_view ply_type_name(ScalarType type) {
  return std::ranges::find(ply_type_names, type, &TypeName::type)->name;
}

}  // namespace trismooth
