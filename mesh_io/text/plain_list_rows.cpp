// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/plain_list_rows.h"

#include "trismooth/mesh_io/text/token_count.h"

namespace trismooth {

namespace {

struct Counted {
  std::size_t rows = 0;
  std::size_t tokens = 0;
};

/// Of text[begin, end), up to its row number `most`.
Counted count_rows(std::string_view text, std::size_t begin, std::size_t end, std::size_t most) {
  Counted counted;
  text = text.substr(0, end);
  for (std::size_t at = begin; at < end && counted.rows < most; ++at) {
    const std::size_t line = at;
    at = find_line_end(text, line);
    if (const auto tokens = static_cast<std::size_t>(count_tokens(text, line, at)); tokens > 0) {
      ++counted.rows;
      counted.tokens += tokens;
    }
  }
  return counted;
}

}  // namespace

PlainListRows::PlainListRows(std::string_view text, std::size_t offset, std::size_t rows, std::size_t beside,
                             const FileWorkers& workers)
    : text_(text), lines_(text, offset, workers), rows_(rows), parts_(lines_.size()) {
  std::vector<Counted> counts(lines_.size());
  lines_.all_of([&](std::size_t part) {
    counts[part] = count_rows(text_, lines_.begin(part), lines_.end(part), rows);
    return true;
  });
  std::size_t row = 0;
  std::size_t item = 0;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    Counted& counted = counts[part];
    if (counted.rows > rows - row) {
      counted = count_rows(text_, lines_.begin(part), lines_.end(part), rows - row);
    }
    const std::size_t others = counted.rows * (beside + 1);
    if (counted.tokens < others) {
      return;
    }
    parts_[part] = {row, row + counted.rows, item, item + counted.tokens - others};
    row = parts_[part].last;
    item = parts_[part].last_item;
  }
  if (row == rows) {
    items_ = item;
  }
}

}  // namespace trismooth
