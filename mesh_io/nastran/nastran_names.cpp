// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_names.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// What stands behind `begin` in the text, where it begins so.
std::optional<std::string_view> behind(std::string_view text, std::string_view begin) {
  return text.starts_with(begin) ? std::optional(text.substr(begin.size())) : std::nullopt;
}

}  // namespace

void NastranNames::read_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  if (const auto named = behind(text, "$HMNAME ")) {
    const bool is_property = named->starts_with("PROP ");
    const std::size_t open = named->find('"');
    const std::size_t close = open == std::string_view::npos ? open : named->find('"', open + 1);
    if (close == std::string_view::npos || !(is_property || named->starts_with("COMP "))) {
      return;
    }
    const std::string_view head = named->substr(0, open);
    if (const auto number = parse_integer(trimmed(head.substr(head.find(' '))))) {
      (is_property ? properties_ : components_).emplace(*number, named->substr(open + 1, close - open - 1));
    }
    return;
  }
  if (text.starts_with("$ Femap ") || text.starts_with("$ FEMAP ")) {
    constexpr std::string_view word = " Property ";
    const std::size_t at = text.find(word);
    const std::size_t colon = at == std::string_view::npos ? at : text.find(" : ", at);
    if (colon != std::string_view::npos) {
      const auto number = parse_integer(trimmed(text.substr(at + word.size(), colon - at - word.size())));
      const std::string_view name = trimmed(text.substr(colon + 3));
      if (number && !name.empty()) {
        properties_.emplace(*number, name);
      }
    }
    return;
  }
  if (const auto region = behind(text, "$ Elements and Element Properties for region :")) {
    next_ = trimmed(*region);
  }
}

void NastranNames::read_card(const NastranCard& card) {
  if (next_.empty() || !card.name.starts_with('P') || card.name == "PARAM" || card.name.starts_with("PLOAD")) {
    return;
  }
  if (const auto number = parse_integer(card.field(0))) {
    properties_.emplace(*number, std::move(next_));
    next_.clear();
  }
}

std::map<std::int64_t, std::string> NastranNames::take() {
  return std::move(properties_.empty() ? components_ : properties_);
}

std::string nastran_name_comment(std::int64_t property, std::string_view name) {
  constexpr std::size_t columns = 24;
  const std::string number = std::to_string(property);
  const std::string blank(columns > number.size() ? columns - number.size() : 1, ' ');
  return "$HMNAME PROP" + blank + number + "\"" + std::string(name) + "\"";
}

bool is_nastran_name(std::string_view name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '"'; });
}

}  // namespace trismooth
