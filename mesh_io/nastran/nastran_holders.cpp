#include "trismooth/mesh_io/nastran/nastran_holders.h"

#include <algorithm>
#include <array>
#include <optional>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::uint8_t fields(std::uint8_t a, std::uint8_t b = 0, std::uint8_t c = 0, std::uint8_t d = 0,
                              std::uint8_t e = 0) {
  return static_cast<std::uint8_t>((1U << a) | (1U << (b == 0 ? a : b)) | (1U << (c == 0 ? a : c)) |
                                   (1U << (d == 0 ? a : d)) | (1U << (e == 0 ? a : e)));
}

constexpr auto holders = std::to_array<NastranHolder>({
    {"SPC", true, 0, fields(1, 4)},
    {"SPCD", true, 0, fields(1, 4)},
    {"SPC1", true, 2},
    {"MPC", true, 0, fields(1, 4), true},
    {"FORCE", true, 0, fields(1)},
    {"FORCE1", true, 0, fields(1, 3, 4)},
    {"FORCE2", true, 0, fields(1, 3, 4, 5, 6)},
    {"MOMENT", true, 0, fields(1)},
    {"MOMENT1", true, 0, fields(1, 3, 4)},
    {"MOMENT2", true, 0, fields(1, 3, 4, 5, 6)},
    {"SUPORT", false, 0, fields(0, 2, 4, 6), true},
    {"SUPORT1", true, 0, fields(1, 3, 5)},
    {"RBAR", false, 0, fields(1, 2)},
    {"RROD", false, 0, fields(1, 2)},
    {"RBE2", false, 3, fields(1)},
    {"RBE3", false, 0, fields(2)},
    {"CELAS1", false, 0, fields(2, 4)},
    {"CELAS2", false, 0, fields(2, 4)},
    {"CDAMP1", false, 0, fields(2, 4)},
    {"CDAMP2", false, 0, fields(2, 4)},
    {"CMASS1", false, 0, fields(2, 4)},
    {"CMASS2", false, 0, fields(2, 4)},
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

}  // namespace

const NastranHolder* find_nastran_holder(std::string_view name) {
  const auto* const found = std::ranges::find(holders, name, &NastranHolder::name);
  return found == holders.end() ? nullptr : found;
}

std::vector<NastranRange> nodes_of_nastran_card(const NastranHolder& holder, const NastranCard& card) {
  std::vector<NastranRange> ranges;
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
  }
  return ranges;
}

}  // namespace trismooth
