// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

using XmlElements = std::vector<const XmlElement*>;

/// What references of an XDMF file lead to: XPath as its writers use it, "/Xdmf/Domain/Grid[@Name='mesh'][1]/Geometry",
/// "//Grid[2]/*[self::Topology or self::Geometry]".
class XdmfPaths {
 public:
  /// Of the file `file`; `root`, its <Xdmf>, outlives the object.
  XdmfPaths(std::filesystem::path file, const XmlElement& root);

  /// The elements that the path leads to, in the document's order. Throws ReadError with that line where the path is
  /// none that is read, leads to nothing, or to more than is worth looking at.
  const XmlElements& find(const std::string& path, std::size_t line);

  /// The children of an element, in place of <xi:include> what it includes. Throws ReadError.
  XmlElements children_of(const XmlElement& element);

 private:
  XmlElements search(std::string_view path, std::size_t line);
  /// Throws ReadError where references look at elements too often.
  void visit(std::size_t elements, std::size_t line);

  std::filesystem::path file_;
  const XmlElement& root_;
  std::map<std::string, XmlElements, std::less<>> found_;
  std::size_t visits_left_;
};

/// A word of the format without its case: "TRIANGLE_6".
std::string xdmf_word(std::string_view word);

/// The first of these attributes that the element has, or "" in place of none: XDMF 2 and 3 call some differently.
std::string xdmf_attribute(const XmlElement& element, std::string_view name, std::string_view other_name = {});

/// Text of XML with what its five entities stand for in their place.
std::string xml_unescaped(std::string_view text);

}  // namespace trismooth
