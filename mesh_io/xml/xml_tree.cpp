// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xml/xml_tree.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <type_traits>

#include <expat.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

namespace {

constexpr std::size_t deepest_nesting = 64;

/// What the callbacks of expat share. They run below C code, so they keep an exception instead of throwing it.
struct ParseState {
  XML_Parser parser = nullptr;
  const std::filesystem::path* path = nullptr;
  std::string_view stop_at;
  std::vector<std::string_view> keep_text_of;
  std::size_t lines_before = 0;  ///< in front of what is parsed
  XmlHead head;
  std::vector<XmlElement*> open;
  std::exception_ptr error;

  std::size_t line() const { return lines_before + XML_GetCurrentLineNumber(parser); }
  std::size_t position() const { return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser)); }

  void stop() { XML_StopParser(parser, XML_FALSE); }

  template <class Function>
  void guarded(Function&& function) {
    if (error != nullptr || head.stopped) {
      return;
    }
    try {
      function();
    } catch (...) {
      error = std::current_exception();
      stop();
    }
  }

  void start(const char* name, const char** attributes) {
    if (open.size() == deepest_nesting) {
      throw ReadError(*path, line(), "elements are nested too deeply");
    }
    const std::size_t begin = position();
    XmlElement* element = &head.root;
    if (!open.empty()) {
      XmlElement& parent = *open.back();
      if (parent.children.empty()) {
        parent.content_end = begin;
      }
      element = &parent.children.emplace_back();
    }
    element->name = name;
    for (; *attributes != nullptr; attributes += 2) {
      element->attributes.emplace_back(attributes[0], attributes[1]);
    }
    element->line = line();
    element->content_begin = begin + static_cast<std::size_t>(XML_GetCurrentByteCount(parser));
    element->content_end = element->content_begin;
    open.push_back(element);
    if (open.size() == 2 && element->name == stop_at) {
      head.stopped = true;
      stop();
    }
  }

  void end() {
    XmlElement& element = *open.back();
    if (element.children.empty()) {
      element.content_end = std::max(element.content_begin, position());
    }
    open.pop_back();
  }

  void text(const char* characters, int count) {
    if (!open.empty() && std::ranges::find(keep_text_of, open.back()->name) != keep_text_of.end()) {
      open.back()->text.append(characters, static_cast<std::size_t>(count));
    }
  }
};

ParseState& state_of(void* data) {
  return *static_cast<ParseState*>(data);
}

void on_start(void* data, const char* name, const char** attributes) {
  state_of(data).guarded([&] { state_of(data).start(name, attributes); });
}

void on_end(void* data, const char*) {
  state_of(data).guarded([&] { state_of(data).end(); });
}

void on_text(void* data, const char* characters, int count) {
  state_of(data).guarded([&] { state_of(data).text(characters, count); });
}

void on_entity(void* data, const char*, int, const char*, int, const char*, const char*, const char*, const char*) {
  ParseState& state = state_of(data);
  state.guarded([&] { throw ReadError(*state.path, state.line(), "entities of the file's own are not accepted"); });
}

void on_skipped_entity(void* data, const char* name, int) {
  on_entity(data, name, 0, nullptr, 0, nullptr, nullptr, nullptr, nullptr);
}

void on_document_type(void* data, const char*, const char*, const char*, int) {
  ParseState& state = state_of(data);
  state.guarded([&] { throw ReadError(*state.path, state.line(), "document type declarations are not accepted"); });
}

}  // namespace

const std::string* XmlElement::attribute(std::string_view attribute_name) const {
  const auto found = std::ranges::find(attributes, attribute_name, &std::pair<std::string, std::string>::first);
  return found == attributes.end() ? nullptr : &found->second;
}

std::optional<std::string_view> XmlElement::word(std::string_view attribute_name) const {
  const std::string* const value = attribute(attribute_name);
  return value == nullptr ? std::nullopt : std::optional(trimmed(*value, " \t\r\n"));
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

namespace {

XmlHead parse(const std::filesystem::path& path, std::string_view bytes, std::string_view stop_at,
              std::vector<std::string_view> keep_text_of, XmlDocumentType type, std::size_t lines_before) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                                        &XML_ParserFree);
  if (parser == nullptr) {
    throw std::bad_alloc();
  }
  ParseState state{.parser = parser.get(),
                   .path = &path,
                   .stop_at = stop_at,
                   .keep_text_of = std::move(keep_text_of),
                   .lines_before = lines_before,
                   .head = {},
                   .open = {},
                   .error = nullptr};
  XML_SetUserData(parser.get(), &state);
  XML_SetElementHandler(parser.get(), &on_start, &on_end);
  XML_SetCharacterDataHandler(parser.get(), &on_text);
  if (type == XmlDocumentType::refused) {
    XML_SetStartDoctypeDeclHandler(parser.get(), &on_document_type);
  }
  XML_SetEntityDeclHandler(parser.get(), &on_entity);
  XML_SetSkippedEntityHandler(parser.get(), &on_skipped_entity);

  bytes = without_end_mark(bytes);  // which is none of XML's
  // expat takes int lengths, and copies what it is given.
  constexpr std::size_t least_chunk = std::size_t{1} << 16;
  constexpr std::size_t largest_chunk = std::size_t{1} << 30;
  XML_Status status = XML_STATUS_OK;
  std::size_t parsed = 0;
  std::size_t chunk = least_chunk;
  do {
    const std::size_t here = std::min(chunk, bytes.size() - parsed);
    const bool last = parsed + here == bytes.size();
    status = XML_Parse(parser.get(), bytes.data() + parsed, static_cast<int>(here), last ? XML_TRUE : XML_FALSE);
    parsed += here;
    // A tag or comment that goes on is read again from its start with the next chunk: chunks double along with it.
    const bool goes_on = parsed - std::min(parsed, state.position()) >= chunk;
    chunk = goes_on ? std::min(2 * chunk, largest_chunk) : least_chunk;
  } while (status == XML_STATUS_OK && parsed < bytes.size());

  if (state.error != nullptr) {
    std::rethrow_exception(state.error);
  }
  if (status != XML_STATUS_OK && !state.head.stopped) {
    const XML_Error code = XML_GetErrorCode(parser.get());
    if (code == XML_ERROR_NO_MEMORY) {
      throw std::bad_alloc();
    }
    const bool is_cut = code == XML_ERROR_NO_ELEMENTS || code == XML_ERROR_UNCLOSED_TOKEN ||
                        code == XML_ERROR_PARTIAL_CHAR || code == XML_ERROR_UNCLOSED_CDATA_SECTION;
    throw ReadError(path, state.line(),
                    !is_cut              ? std::string("is not well-formed XML: ") + XML_ErrorString(code)
                    : state.open.empty() ? "ends where XML is expected: it is cut off"
                                         : "ends within <" + state.open.back()->name + ">: it is cut off");
  }
  return std::move(state.head);
}

}  // namespace

XmlHead parse_xml_head(const std::filesystem::path& path, std::string_view bytes, std::string_view stop_at,
                       std::vector<std::string_view> keep_text_of, XmlDocumentType type) {
  return parse(path, bytes, stop_at, std::move(keep_text_of), type, 0);
}

void check_xml_tail(const std::filesystem::path& path, std::string_view bytes, const XmlElement& root,
                    std::size_t tail) {
  const XmlElement& stop = root.children.back();
  // The declaration says how the text is encoded.
  const std::size_t declaration = bytes.starts_with("<?xml") ? std::min(bytes.find("?>"), bytes.size() - 2) + 2 : 0;
  std::string document(bytes.substr(0, declaration));
  document.append("<").append(root.name).append("><").append(stop.name).append(">").append(bytes.substr(tail));
  const auto check = [&](std::size_t lines_before) {
    const XmlHead parsed = parse(path, document, {}, {}, XmlDocumentType::refused, lines_before);
    if (parsed.root.children.size() > 1) {
      const XmlElement& extra = parsed.root.children[1];
      throw ReadError(path, extra.line, "<" + extra.name + "> stands behind <" + stop.name + ">, the last element");
    }
  };
  try {
    check(0);
  } catch (const ReadError&) {
    // Its line is found then alone: the bytes between are many.
    check(static_cast<std::size_t>(std::ranges::count(bytes.substr(declaration, tail - declaration), '\n')));
    throw;
  }
}

}  // namespace trismooth
