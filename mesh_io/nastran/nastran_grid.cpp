// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_grid.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "trismooth/mesh_io/nastran/nastran_card.h"
#include "trismooth/mesh_io/nastran/nastran_original.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// Of a GRID, the fields behind its name that are coordinates.
constexpr std::size_t first_coordinate = 2;
constexpr std::size_t coordinates = 3;

std::size_t offset_in(std::string_view text, std::string_view part) {
  return static_cast<std::size_t>(part.data() - text.data());
}

class GridText {
 public:
  GridText(std::string_view text, std::size_t begin, std::string& out) : text_(text), done_(begin), out_(out) {
    end_ = read_nastran_card(text, begin, card_);
  }

  /// A new number for that axis; fewer characters than its room.
  void set(std::size_t axis, double value) {
    std::array<char, 32> number{};
    numbers_[axis].assign(number.data(),
                          write_within(value, most_nastran_characters, NumberForm::nastran, number.data()));
  }

  std::size_t append() {
    if (card_.lines.front().is_free) {
      append_free();
    } else if (fits()) {
      append_in_columns();
    } else {
      append_large();
    }
    copy_until(end_);
    return end_;
  }

 private:
  /// Where a field of the card stands.
  struct Spot {
    std::size_t line;
    std::size_t field;
  };

  Spot spot_of(std::size_t field) const {
    const std::size_t count = card_.lines.front().count;
    return {field / count, field % count};
  }

  bool is_there(const Spot& spot) const {
    return spot.line < card_.lines.size() && spot.field < card_.lines[spot.line].present;
  }

  bool fits() const {
    for (std::size_t axis = 0; axis < coordinates; ++axis) {
      const Spot spot = spot_of(first_coordinate + axis);
      if (!numbers_[axis].empty() && !(is_there(spot) && numbers_[axis].size() <= card_.lines[spot.line].width())) {
        return false;
      }
    }
    return true;
  }

  void copy_until(std::size_t end) {
    out_.append(text_.substr(done_, end - done_));
    done_ = end;
  }

  void replace(std::string_view old, std::string_view now) {
    copy_until(offset_in(text_, old));
    out_.append(now);
    done_ += old.size();
  }

  /// Between commas only the number changes. Fields that are not there are added.
  void append_free() {
    std::vector<std::size_t> present;
    for (const NastranLine& line : card_.lines) {
      present.push_back(line.present);
    }
    for (std::size_t axis = 0; axis < coordinates; ++axis) {
      if (numbers_[axis].empty()) {
        continue;
      }
      const Spot spot = spot_of(first_coordinate + axis);
      if (is_there(spot)) {
        const std::string_view field = card_.lines[spot.line].fields[spot.field];
        replace(trimmed(field).empty() ? field : trimmed(field), numbers_[axis]);
      } else if (spot.line < card_.lines.size()) {
        copy_until(offset_in(text_, card_.lines[spot.line].tail));
        out_.append(spot.field + 1 - present[spot.line], ',').append(numbers_[axis]);
        present[spot.line] = spot.field + 1;
      } else {
        const std::string_view line = card_.lines.front().text;
        copy_until(offset_in(text_, line) + line.size());
        out_.append(line_end()).append("*,").append(numbers_[axis]);
      }
    }
  }

  void append_in_columns() {
    for (std::size_t axis = 0; axis < coordinates; ++axis) {
      if (!numbers_[axis].empty()) {
        const Spot spot = spot_of(first_coordinate + axis);
        const NastranLine& line = card_.lines[spot.line];
        const bool ends_with_line = line.last_is_short && spot.field + 1 == line.present;
        replace(line.fields[spot.field], in_columns(line, spot.field, numbers_[axis], ends_with_line));
      }
    }
  }

  /// The number with the blanks of its field: at the right where the old one was, else where that began.
  static std::string in_columns(const NastranLine& line, std::size_t field, const std::string& number,
                                bool ends_with_line) {
    const std::string_view old = line.fields[field];
    const std::size_t width = line.width();
    const bool has_tab = old.find('\t') != std::string_view::npos;
    const std::size_t columns = has_tab || !ends_with_line ? width : std::max(old.size(), number.size());
    const std::size_t before = has_tab ? 0 : std::min(old.find_first_not_of(blanks), old.size());
    const bool is_right =
        !has_tab && before > 0 && before < old.size() && blanks.find(old.back()) == blanks.npos && old.size() == width;
    const std::size_t room = columns - number.size();
    std::string text(is_right ? room : before == old.size() ? 0 : std::min(before, room), ' ');
    text += number;
    if (!(has_tab && ends_with_line)) {
      text.resize(std::max(columns, text.size()), ' ');
    }
    return text;
  }

  /// The fields of a line in large field, and what stands behind them.
  void append_large_line(std::string_view head, std::size_t first, std::string_view tail) {
    std::string line(trimmed(head));
    line.resize(std::max(line.size(), nastran_head_columns), ' ');
    for (std::size_t i = 0; i < most_nastran_fields / 2; ++i) {
      const std::size_t field = first + i;
      const bool is_coordinate = field >= first_coordinate && field < first_coordinate + coordinates;
      const bool is_new = is_coordinate && !numbers_[field - first_coordinate].empty();
      line += is_new ? std::string_view(numbers_[field - first_coordinate]) : card_.field(field);
      line.resize(std::max(line.size(), nastran_head_columns + (i + 1) * most_nastran_characters), ' ');
    }
    const std::string_view rest = trimmed(tail);
    if (rest.empty() || rest.starts_with('$')) {
      line.erase(line.find_last_not_of(' ') + 1);
      line += rest.empty() ? "" : " ";
    }
    out_.append(line).append(rest);
  }

  void append_large() {
    const NastranLine& first = card_.lines.front();
    const bool has_second = first.is_large() && card_.lines.size() > 1;
    const std::string_view mark = first.is_large() ? first.mark() : std::string_view();
    const std::string name(trimmed(first.head));
    append_large_line(first.is_large() ? name : name + "*", 0, first.is_large() ? first.tail : std::string_view());
    done_ = offset_in(text_, first.text) + first.text.size();
    if (has_second) {
      const NastranLine& second = card_.lines[1];
      copy_until(offset_in(text_, second.text));
      append_large_line(second.head, most_nastran_fields / 2, second.tail);
      done_ += second.text.size();
      return;
    }
    out_.append(line_end());
    append_large_line(mark.starts_with('*') ? mark : "*", most_nastran_fields / 2,
                      first.is_large() ? std::string_view() : first.tail);
  }

  /// As the first line ends.
  std::string_view line_end() const {
    const std::string_view line = card_.lines.front().text;
    const std::string_view behind = text_.substr(offset_in(text_, line) + line.size());
    return behind.starts_with("\r\n") ? "\r\n" : behind.starts_with('\r') ? "\r" : "\n";
  }

  std::string_view text_;
  std::size_t done_;
  std::size_t end_ = 0;
  std::string& out_;
  NastranCard card_;
  std::array<std::string, coordinates> numbers_;  ///< new ones; empty: it stays
};

}  // namespace

std::size_t append_moved_grid(std::string_view text, std::size_t begin, const std::array<double, 3>& before,
                              const std::array<double, 3>& now, std::string& out) {
  GridText grid(text, begin, out);
  for (std::size_t axis = 0; axis < coordinates; ++axis) {
    if (std::bit_cast<std::uint64_t>(before[axis]) != std::bit_cast<std::uint64_t>(now[axis])) {
      grid.set(axis, now[axis]);
    }
  }
  return grid.append();
}

}  // namespace trismooth
