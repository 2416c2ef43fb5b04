// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <expat.h>

/// Pages and pictures as an XML parser sees them.
namespace pages {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< that of children, too

  std::string attribute(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
  double number(const std::string& key) const { return std::stod(attribute(key)); }
};

/// What an XML parser finds in a text.
struct Parsed {
  std::string error;  ///< empty where the text is well-formed
  std::vector<Element> elements;
  std::vector<std::size_t> open;   ///< of the elements, those that the parser is in
  std::vector<std::string> links;  ///< values of attributes that fetch something
  std::string text;

  std::vector<Element> all(const std::string& name) const {
    std::vector<Element> found;
    std::ranges::copy_if(elements, std::back_inserter(found), [&](const Element& e) { return e.name == name; });
    return found;
  }
  auto count(const std::string& name) const { return std::ssize(all(name)); }
  bool says(const std::string& words) const { return text.find(words) != std::string::npos; }
};

inline Parsed parse(const std::string& xml) {
  Parsed parsed;
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(XML_ParserCreate("UTF-8"),
                                                                                             &XML_ParserFree);
  XML_SetUserData(parser.get(), &parsed);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const XML_Char* name, const XML_Char** attributes) {
        auto& found = *static_cast<Parsed*>(data);
        found.open.push_back(found.elements.size());
        found.elements.push_back({name, {}, ""});
        for (; *attributes != nullptr; attributes += 2) {
          const std::string attribute = attributes[0];
          found.elements.back().attributes[attribute] = attributes[1];
          if (attribute == "src" || attribute == "href") {
            found.links.emplace_back(attributes[1]);
          }
        }
      },
      [](void* data, const XML_Char*) { static_cast<Parsed*>(data)->open.pop_back(); });
  XML_SetCharacterDataHandler(parser.get(), [](void* data, const XML_Char* text, int length) {
    auto& found = *static_cast<Parsed*>(data);
    found.text.append(text, static_cast<std::size_t>(length));
    for (const std::size_t element : found.open) {
      found.elements[element].text.append(text, static_cast<std::size_t>(length));
    }
  });
  if (XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), XML_TRUE) == XML_STATUS_ERROR) {
    parsed.error = std::string(XML_ErrorString(XML_GetErrorCode(parser.get()))) + " in line " +
                   std::to_string(XML_GetCurrentLineNumber(parser.get()));
  }
  return parsed;
}

/// How often the words stand in a text.
inline std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace pages
