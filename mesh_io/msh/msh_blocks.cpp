// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_blocks.h"

#include <algorithm>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_entities.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::uint64_t most_msh_blocks = 100'000;  // each is looked at by itself
constexpr std::size_t msh_point_bytes = 3 * sizeof(double);

}  // namespace

MshBlocks::MshBlocks(const std::filesystem::path& path) : file_(path) {
  read_head();
  read_node_blocks();
  pass_section("$EndNodes", "$Elements");
  read_element_blocks();
  pass_section("$EndElements", {});
}

void MshBlocks::give_up(const char* what) const {
  throw ReadError(file_.path(), std::string("is not read by ranges: ") + what);
}

/// Everything before the line $Nodes, and where the nodes begin.
void MshBlocks::read_head() {
  constexpr std::size_t first_bytes = std::size_t{1} << 16;
  constexpr std::size_t most_bytes = std::size_t{1} << 26;
  for (std::size_t count = first_bytes;; count *= 8) {
    const FileBytes bytes = file_.read_range(0, count);
    try {
      parse_head(bytes);
      return;
    } catch (const ReadError&) {
      if (count >= most_bytes || bytes.size() < count) {
        throw;
      }
    }
  }
}

void MshBlocks::parse_head(std::string_view bytes) {
  MshInput input(bytes, file_.path());
  TextScanner& text = input.text();
  if (trimmed(text.next_line()) != "$MeshFormat") {
    give_up("it begins with another section");
  }
  input.read_header();
  header_ = input.header();
  const bool is_known = header_.version == 41 ? header_.size_bytes == sizeof(std::int64_t)
                                              : header_.version >= 20 && header_.version <= 22;
  if (!header_.binary || !is_known) {
    give_up("it is text, or of another version");
  }
  std::string_view section = "$MeshFormat";
  for (;;) {
    if (section != "$MeshFormat" && section != "$Entities") {
      const std::size_t end = bytes.find("\n$End" + std::string(section.substr(1)), text.offset());
      if (end == bytes.npos) {
        give_up("a section has no end");
      }
      text.seek(end);
    }
    if (text.next_token("the end of a section") != "$End" + std::string(section.substr(1))) {
      give_up("a section has another end");
    }
    text.next_line();
    section = text.next_token("a section");
    const std::size_t begin = text.token_offset();
    text.next_line();
    if (section == "$Nodes") {
      head_.assign(bytes.substr(0, begin));
      at_ = text.offset();
      return;
    }
    if (section == "$Entities" && is_4()) {
      MshEntities().read(input, false);
    } else if (section != "$PhysicalNames" && section != "$Comments") {
      give_up("it has other sections");
    }
  }
}

/// The number in the line at at_, which ends there.
std::uint64_t MshBlocks::text_count() {
  constexpr std::size_t line_bytes = 64;
  const FileBytes bytes = file_.read_range(at_, at_ + line_bytes);
  TextScanner text(bytes, file_.path());
  const std::int64_t count = text.next_integer("a number", 0, largest_msh_int);
  text.next_line();
  at_ += text.offset();
  return static_cast<std::uint64_t>(count);
}

std::uint64_t MshBlocks::next_size() {
  const auto value = number_at<std::int64_t>(at_);
  at_ += sizeof(value);
  if (value < 0) {
    give_up("a count is negative");
  }
  return static_cast<std::uint64_t>(value);
}

std::int32_t MshBlocks::next_int() {
  const auto value = number_at<std::int32_t>(at_);
  at_ += sizeof(value);
  return value;
}

/// Passes so many rows.
void MshBlocks::pass(std::uint64_t count, std::size_t row_bytes) {
  if (at_ > file_.size() || count > (file_.size() - at_) / row_bytes) {
    give_up("it is cut off");
  }
  at_ += count * row_bytes;
}

void MshBlocks::read_node_blocks() {
  if (!is_4()) {
    points_ = text_count();
    MshNodeBlock block{.numbers = {0, points_}, .tags = at_, .rows = at_, .row_bytes = tag_size() + msh_point_bytes};
    pass(points_, block.row_bytes);
    if (points_ > 0) {
      nodes_.push_back(block);
    }
    return;
  }
  const std::uint64_t blocks = next_size();
  points_ = next_size();
  next_size();
  next_size();
  if (blocks > most_msh_blocks || points_ > static_cast<std::uint64_t>(largest_msh_int)) {
    give_up("it has many blocks");
  }
  std::uint64_t done = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    MshNodeBlock block;
    block.dimension = next_int();
    block.entity = next_int();
    block.parametric = next_int();
    const std::uint64_t count = next_size();
    if (block.dimension < 0 || block.dimension > 3 || block.parametric < 0 || block.parametric > 1 ||
        count > points_ - done) {
      give_up("the head of a block is wrong");
    }
    const auto parameters = static_cast<std::size_t>(block.parametric == 1 ? block.dimension : 0);
    block.row_bytes = msh_point_bytes + parameters * sizeof(double);
    block.numbers = {done, done + count};
    done += count;
    block.tags = at_;
    pass(count, tag_size());
    block.rows = at_;
    pass(count, block.row_bytes);
    has_surfaces_ = has_surfaces_ || (block.dimension > 1 && count > 0);
    if (count > 0) {
      nodes_.push_back(block);
    }
  }
  if (done != points_) {
    give_up("nodes are missing");
  }
}

void MshBlocks::read_element_blocks() {
  std::uint64_t blocks = 0;
  if (is_4()) {
    blocks = next_size();
    cells_ = next_size();
    next_size();
    next_size();
  } else {
    cells_ = text_count();
  }
  if (blocks > most_msh_blocks || cells_ > static_cast<std::uint64_t>(largest_msh_int)) {
    give_up("it has many blocks");
  }
  std::uint64_t done = 0;
  for (std::uint64_t b = 0; is_4() ? b < blocks : done < cells_; ++b) {
    MshElementBlock block;
    if (is_4()) {
      block.dimension = next_int();
      block.entity = next_int();
    }
    block.type = next_int();
    const std::uint64_t count = is_4() ? next_size() : static_cast<std::uint64_t>(std::max(next_int(), 0));
    block.labels = is_4() ? 0 : next_int();
    const std::size_t vertices = msh_element_type(block.type).vertices;
    if (vertices == 0 || count > cells_ - done || block.labels < 0 || b > most_msh_blocks) {
      give_up("the head of a block is wrong, or there are many");
    }
    block.row_bytes = tag_size() * (1 + vertices) + static_cast<std::size_t>(block.labels) * sizeof(std::int32_t);
    block.numbers = {done, done + count};
    done += count;
    block.rows = at_;
    pass(count, block.row_bytes);
    if (count > 0) {
      elements_.push_back(block);
    }
  }
  if (done != cells_) {
    give_up("elements are missing");
  }
}

/// At at_ a section ends, and that one begins; with none the file ends.
void MshBlocks::pass_section(std::string_view end, std::string_view begin) {
  constexpr std::size_t line_bytes = 64;
  const FileBytes bytes = file_.read_range(at_, at_ + line_bytes);
  TextScanner text(bytes, file_.path());
  if (text.next_token(end) != end) {
    give_up("a section is longer than it says");
  }
  text.next_line();
  if (begin.empty()) {
    if (!text.at_end() || at_ + bytes.size() < file_.size()) {
      give_up("it has other sections");
    }
    return;
  }
  if (text.next_token(begin) != begin) {
    give_up("it has other sections");
  }
  text.next_line();
  at_ += text.offset();
}

}  // namespace trismooth
