// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_holders.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::uint8_t fields(std::initializer_list<unsigned> numbers) {
  unsigned bits = 0;
  for (const unsigned number : numbers) {
    bits |= 1U << number;
  }
  return static_cast<std::uint8_t>(bits);
}

constexpr auto holders = std::to_array<NastranHolder>({
    {"SPC", true, 0, fields({1, 4})},
    {"SPCD", true, 0, fields({1, 4})},
    {"SPC1", true, 2},
    {"MPC", true, 0, fields({1, 4}), true},
    {"FORCE", true, 0, fields({1})},
    {"FORCE1", true, 0, fields({1, 3, 4})},
    {"FORCE2", true, 0, fields({1, 3, 4, 5, 6})},
    {"MOMENT", true, 0, fields({1})},
    {"MOMENT1", true, 0, fields({1, 3, 4})},
    {"MOMENT2", true, 0, fields({1, 3, 4, 5, 6})},
    {"SPCR", true, 0, fields({1, 4})},
    {"SLOAD", true, 0, fields({1, 3, 5})},
    {"BNDGRID", false, 1},
    {"TEMPBC", true, 0, fields({3, 5, 7})},
    {"QHBDY", true, 4},
    {"CHBDYP", false, 0, fields({5, 6, 7})},
    {"ACCEL1", true, 8},
    {"PLOAD", true, 0, fields({2, 3, 4, 5})},
    {"TEMP", true, 0, fields({1, 3, 5})},
    {"DAREA", true, 0, fields({1, 4})},
    {"SUPORT", false, 0, fields({0, 2, 4, 6}), true},
    {"SUPORT1", true, 0, fields({1, 3, 5})},
    {"RBAR", false, 0, fields({1, 2})},
    {"RBAR1", false, 0, fields({1, 2})},
    {"RROD", false, 0, fields({1, 2})},
    {"RJOINT", false, 0, fields({1, 2})},
    {"RTRPLT", false, 0, fields({1, 2, 3})},
    {"RTRPLT1", false, 0, fields({1, 2, 3})},
    {"RBE1", false, 0, fields({1, 3, 5}), true},
    {"RSPLINE", false, 0, fields({2})},
    {"RSSCON", false, 0, fields({2, 3, 4, 5, 6, 7})},
    {"RBE2", false, 3, fields({1})},
    {"RBE3", false, 0, fields({2})},
    {"CELAS1", false, 0, fields({2, 4})},
    {"CELAS2", false, 0, fields({2, 4})},
    {"CDAMP1", false, 0, fields({2, 4})},
    {"CDAMP2", false, 0, fields({2, 4})},
    {"CMASS1", false, 0, fields({2, 4})},
    {"CMASS2", false, 0, fields({2, 4})},
    // Nodes that coordinate systems are stated by: one system or two.
    {"CORD1R", false, 0, fields({1, 2, 3, 5, 6, 7})},
    {"CORD1C", false, 0, fields({1, 2, 3, 5, 6, 7})},
    {"CORD1S", false, 0, fields({1, 2, 3, 5, 6, 7})},
});

void add_list(const NastranCard& card, std::size_t first, std::vector<NastranRange>& ranges) {
  bool is_through = false;
  for (std::size_t i = first; i < card.field_count(); ++i) {
    const std::string_view text = card.field(i);
    if (const auto number = parse_integer(text)) {
      if (is_through && !ranges.empty()) {
        ranges.back().last = *number;
      } else {
        ranges.push_back({*number, *number});
      }
      is_through = false;
    } else {
      is_through = is_through || nastran_key(text) == "THRU";
    }
  }
}

/// Behind a weight, which has a decimal point, and components: nodes, up to the next weight or word.
void add_weighted(const NastranCard& card, std::vector<NastranRange>& ranges) {
  bool has_components = false;
  for (std::size_t i = 4; i < card.field_count(); ++i) {
    const std::string_view text = card.field(i);
    if (text.empty()) {
      continue;
    }
    const auto number = parse_integer(text);
    if (!number) {
      if (text.find('.') == std::string_view::npos) {
        return;
      }
      has_components = false;
    } else if (has_components) {
      ranges.push_back({*number, *number});
    } else {
      has_components = true;
    }
  }
}

/// Behind the first two nodes: components and a node, in turn.
void add_spline(const NastranCard& card, std::vector<NastranRange>& ranges) {
  for (std::size_t i = 3; i < card.field_count(); i += 2) {
    if (const auto number = parse_integer(card.field(i))) {
      ranges.push_back({*number, *number});
    }
  }
}

}  // namespace

const NastranHolder* find_nastran_holder(std::string_view name) {
  const auto* const found = std::ranges::find(holders, name, &NastranHolder::name);
  return found == holders.end() ? nullptr : found;
}

std::vector<NastranRange> nodes_of_nastran_card(const NastranHolder& holder, const NastranCard& card) {
  std::vector<NastranRange> ranges;
  if (holder.name == "RSSCON" && nastran_key(card.field(1)) != "GRID") {
    return ranges;  // it names elements
  }
  for (std::size_t i = 0; i < card.field_count() && (holder.every_row || i < most_nastran_fields); ++i) {
    const auto number = parse_integer(card.field(i));
    if (number && ((holder.nodes_of_row >> (i % most_nastran_fields)) & 1U) != 0) {
      ranges.push_back({*number, *number});
    }
  }
  if (holder.list > 0) {
    add_list(card, holder.list, ranges);
  }
  if (holder.name == "RBE3") {
    add_weighted(card, ranges);
  } else if (holder.name == "RSPLINE") {
    add_spline(card, ranges);
  }
  return ranges;
}

}  // namespace trismooth
