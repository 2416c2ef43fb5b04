// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_paths.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// What stands in brackets: a place, an attribute's value, or the names that an element may have.
struct Predicate {
  std::size_t place = 0;
  std::string attribute;
  std::string value;
  std::vector<std::string> names;
};

struct Step {
  bool is_deep = false;  ///< behind "//"
  std::string name;      ///< empty: any
  std::vector<Predicate> predicates;
};

/// Reads a path; every function answers false, or nothing, where it reads something else.
class PathParser {
 public:
  explicit PathParser(std::string_view text) : rest_(text) {}

  std::optional<std::vector<Step>> steps() {
    std::vector<Step> found;
    while (!rest_.empty()) {
      Step& step = found.emplace_back();
      if (!take("/")) {
        return std::nullopt;
      }
      step.is_deep = take("/");
      if (!take("*")) {
        step.name = name();
        if (step.name.empty()) {
          return std::nullopt;
        }
      }
      while (take("[")) {
        if (!read_predicate(step.predicates.emplace_back())) {
          return std::nullopt;
        }
      }
    }
    return found.empty() ? std::nullopt : std::optional(std::move(found));
  }

 private:
  bool take(std::string_view token) {
    rest_ = trimmed(rest_, " \t\r\n");
    const bool is_there = rest_.starts_with(token);
    rest_.remove_prefix(is_there ? token.size() : 0);
    return is_there;
  }

  std::string name() {
    rest_ = trimmed(rest_, " \t\r\n");
    const std::size_t end = std::min(rest_.find_first_of("/[]@=*'\" \t\r\n"), rest_.size());
    std::string read(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return read;
  }

  bool read_predicate(Predicate& predicate) {
    if (take("@")) {
      predicate.attribute = name();
      if (predicate.attribute.empty() || !take("=") || rest_.empty()) {
        return false;
      }
      rest_ = trimmed(rest_, " \t\r\n");
      const char quote = rest_.empty() ? '\0' : rest_.front();
      const std::size_t end = rest_.find(quote, 1);
      if ((quote != '"' && quote != '\'') || end == rest_.npos) {
        return false;
      }
      predicate.value = rest_.substr(1, end - 1);
      rest_.remove_prefix(end + 1);
      return take("]");
    }
    if (take("self::")) {
      do {
        predicate.names.push_back(name());
      } while (take("or") && take("self::"));
      return take("]");
    }
    const auto place = parse_unsigned(name());
    predicate.place = static_cast<std::size_t>(place.value_or(0));
    return predicate.place > 0 && take("]");
  }

  std::string_view rest_;
};

bool matches(const XmlElement& element, const Predicate& predicate) {
  if (!predicate.names.empty()) {
    return std::ranges::find(predicate.names, element.name) != predicate.names.end();
  }
  const std::string* const value = element.attribute(predicate.attribute);
  return value != nullptr && *value == predicate.value;
}

/// Those of an element's children that a step leads to.
void take_step(std::span<const XmlElement> children, const Step& step, XmlElements& found) {
  XmlElements taken;
  for (const XmlElement& child : children) {
    if (step.name.empty() || child.name == step.name) {
      taken.push_back(&child);
    }
  }
  for (const Predicate& predicate : step.predicates) {
    if (predicate.place > 0) {
      taken = predicate.place <= taken.size() ? XmlElements{taken[predicate.place - 1]} : XmlElements{};
    } else {
      std::erase_if(taken, [&predicate](const XmlElement* element) { return !matches(*element, predicate); });
    }
  }
  found.insert(found.end(), taken.begin(), taken.end());
}

/// All elements below one, and itself.
void add_tree(const XmlElement& element, XmlElements& tree) {
  tree.push_back(&element);
  for (const XmlElement& child : element.children) {
    add_tree(child, tree);
  }
}

std::size_t size_of_tree(const XmlElement& element) {
  XmlElements tree;
  add_tree(element, tree);
  return tree.size();
}

constexpr auto entities = std::to_array<std::pair<std::string_view, char>>(
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}});

}  // namespace

XdmfPaths::XdmfPaths(std::filesystem::path file, const XmlElement& root)
    : file_(std::move(file)), root_(root), visits_left_(1'000'000 + 64 * size_of_tree(root)) {}

void XdmfPaths::visit(std::size_t elements, std::size_t line) {
  if (elements > visits_left_) {
    throw ReadError(file_, line, "references lead to more elements than are looked at");
  }
  visits_left_ -= elements;
}

XmlElements XdmfPaths::search(std::string_view path, std::size_t line) {
  const auto steps = PathParser(path).steps();
  if (!steps) {
    throw ReadError(file_, line,
                    "the reference " + quoted(path) + " is none that is read: paths of names with [1], " +
                        "[@Name='mesh'] and [self::Geometry] are");
  }
  // Above the root: its only child is the root.
  XmlElements at{nullptr};
  for (const Step& step : *steps) {
    XmlElements parents;
    for (const XmlElement* const element : at) {
      parents.push_back(element);
      if (step.is_deep) {
        parents.pop_back();
        if (element == nullptr) {
          parents.push_back(nullptr);
        }
        add_tree(element == nullptr ? root_ : *element, parents);
        visit(parents.size(), line);
      }
    }
    XmlElements found;
    for (const XmlElement* const parent : parents) {
      const std::span children = parent == nullptr ? std::span(&root_, 1) : std::span(parent->children);
      visit(1 + children.size(), line);
      take_step(children, step, found);
    }
    at = std::move(found);
  }
  return at;
}

const XmlElements& XdmfPaths::find(const std::string& path, std::size_t line) {
  auto found = found_.find(path);
  if (found == found_.end()) {
    found = found_.emplace(path, search(path, line)).first;
  }
  if (found->second.empty()) {
    throw ReadError(file_, line, "the reference " + quoted(std::string_view(path)) + " leads to nothing");
  }
  return found->second;
}

XmlElements XdmfPaths::children_of(const XmlElement& element) {
  XmlElements children;
  for (const XmlElement& child : element.children) {
    if (child.name != "include" && !child.name.ends_with(":include")) {
      children.push_back(&child);
      continue;
    }
    if (!xdmf_attribute(child, "href").empty()) {
      throw ReadError(file_, child.line, "includes another file, which is not read: copy its elements to this file");
    }
    std::string path = xdmf_attribute(child, "xpointer");
    constexpr std::string_view begin = "xpointer(";
    if (!path.starts_with(begin) || !path.ends_with(')')) {
      throw ReadError(file_, child.line, "includes " + quoted(std::string_view(path)) + ", which is no xpointer(...)");
    }
    path = path.substr(begin.size(), path.size() - begin.size() - 1);
    const XmlElements& included = find(path, child.line);
    visit(included.size(), child.line);
    children.insert(children.end(), included.begin(), included.end());
  }
  visit(children.size(), element.line);
  return children;
}

std::string xdmf_word(std::string_view word) {
  return upper_case(trimmed(word, " \t\r\n"));
}

std::string xdmf_attribute(const XmlElement& element, std::string_view name, std::string_view other_name) {
  for (const std::string_view one : {name, other_name}) {
    if (const auto word = element.word(one)) {
      return std::string(*word);
    }
  }
  return {};
}

std::string xml_unescaped(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto* const entity =
        std::ranges::find_if(entities, [text](const auto& e) { return text.starts_with(e.first); });
    plain += entity == entities.end() ? text.front() : entity->second;
    text.remove_prefix(entity == entities.end() ? 1 : entity->first.size());
  }
  return plain;
}

}  // namespace trismooth
