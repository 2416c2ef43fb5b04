// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trismooth {

/// Names and values, in the document's order.
using XmlAttributes = std::vector<std::pair<std::string, std::string>>;

/// An element of an XML document, with the place of its content in the document's bytes.
struct XmlElement {
  std::string name;
  XmlAttributes attributes;
  std::vector<XmlElement> children;
  std::string text;               ///< character data; only of elements of the names given to parse_xml_head()
  std::size_t line = 0;           ///< line of the start tag, from 1
  std::size_t content_begin = 0;  ///< byte behind the start tag
  std::size_t content_end = 0;    ///< byte of the first child's start tag, else of the end tag

  /// The attribute's value, or nullptr.
  const std::string* attribute(std::string_view attribute_name) const;
  /// Its value without white space around it: a word of the format, which writers in Fortran pad. Valid as long as
  /// that.
  std::optional<std::string_view> word(std::string_view attribute_name) const;
  /// The first child of that name, or nullptr.
  const XmlElement* child(std::string_view child_name) const;
};

/// The part of a document that is XML: all of it, or all before the content of the element that ends it.
struct XmlHead {
  XmlElement root;
  bool stopped = false;  ///< the stop element was found; it is the last child of the root then, its content unread
};

/// What a document may declare of its type. Entities of its own are refused either way: they make much text of little.
enum class XmlDocumentType : bool { refused, without_entities };

/// Parses the document up to and with the start tag of the first child of the root named `stop_at` (what follows that
/// tag need not be XML), or as a whole where there is none. Nesting deeper than 64 is refused, and so are document type
/// declarations, unless `type` lets them be. Throws ReadError with the line.
XmlHead parse_xml_head(const std::filesystem::path& path, std::string_view bytes, std::string_view stop_at,
                       std::vector<std::string_view> keep_text_of, XmlDocumentType type = XmlDocumentType::refused);

/// Checks what follows `stop`, the stop element of that head, from the byte `tail` on, where its end tag begins: end
/// tags, comments and nothing else. Throws ReadError with the line.
void check_xml_tail(const std::filesystem::path& path, std::string_view bytes, const XmlElement& root,
                    std::size_t tail);

}  // namespace trismooth
