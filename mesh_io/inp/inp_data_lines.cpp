// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "trismooth/mesh_io/inp/inp_lines_reader.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr auto most_items = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

/// Abaqus and CalculiX read that many characters of a number.
constexpr std::uint8_t most_number_characters = 20;

/// Elements of more nodes go on in the next line, also where no comma says so.
constexpr std::size_t most_nodes_in_line = 8;

}  // namespace

void InpLinesReader::read_data(std::string_view line) {
  switch (block_) {
    case Block::node:
      read_node(line);
      break;
    case Block::element:
      read_element(line);
      break;
    case Block::node_set:
    case Block::element_set:
      read_set(line);
      break;
    case Block::system:
      has_system_ = true;
      break;
    case Block::loads:
    case Block::equation:
    case Block::constraint:
      read_held(line);
      break;
    case Block::other:
      if (!has_keyword_) {
        fail_at(line, "expected a keyword line of Abaqus (*NODE, *ELEMENT, ...), got " + trismooth::quoted(line));
      }
  }
}

/// label, x, y, z, and a normal, of which any but the label may be left out.
void InpLinesReader::read_node(std::string_view line) {
  if (model_.node_offsets.size() >= most_items) {
    fail_at(line, "has more nodes than 32-bit indices can tell apart");
  }
  InpFields fields(line);
  fields.next();
  const std::int64_t label = label_of(fields.text(), "a node number");
  const auto vertex = static_cast<std::int32_t>(model_.node_offsets.size());
  std::array<std::string_view, 3> texts{};
  for (std::string_view& text : texts) {
    if (!fields.next()) {
      break;
    }
    text = fields.text();
    double value = 0;
    if (!text.empty()) {
      const std::optional<double> number = parse_fortran_number<double>(text);
      if (!number || !std::isfinite(*number)) {
        model_.points.resize(3 * static_cast<std::size_t>(vertex));
        fail_at(text, "node " + std::to_string(label) + ": expected a coordinate (a finite number), got " +
                          trismooth::quoted(text));
      }
      value = *number;
    }
    model_.points.push_back(value);
  }
  model_.points.resize(3 * (static_cast<std::size_t>(vertex) + 1));
  model_.node_offsets.push_back(offset_of(line));
  model_.node_origins.add(static_cast<std::size_t>(vertex), open_.back());
  scope().nodes.labels.push_back(label);
  scope().nodes.indices.push_back(vertex);
  add_sites(vertex, line, texts);
  if (set_lines_ != nullptr) {
    set_lines_->back().behind = vertex + 1;
  }
}

void InpLinesReader::add_sites(std::int32_t vertex, std::string_view line,
                               const std::array<std::string_view, 3>& texts) {
  InpSource& source = model_.sources[open_.back()];
  // Coordinates that stand side by side are one site: nothing comes between them when gaps are filled.
  for (std::uint8_t first = 0; first < 3;) {
    if (texts[first].empty()) {
      const bool has_field = texts[first].data() != nullptr;
      const std::string_view place = has_field ? texts[first] : line.substr(line.size());
      source.gaps.push_back({offset_of(place), vertex, first, !has_field});
      ++first;
      continue;
    }
    std::uint8_t behind = first;
    while (behind < 3 && !texts[behind].empty()) {
      ++behind;
    }
    add_site(source, vertex, first, std::span(texts).subspan(first, static_cast<std::size_t>(behind - first)));
    first = behind;
  }
}

/// A site of coordinates side by side, from that component on.
void InpLinesReader::add_site(InpSource& source, std::int32_t vertex, std::uint8_t first,
                              std::span<const std::string_view> texts) {
  if (source.sites.empty() || source.sites.back().columns.size() != texts.size() ||
      source.sites.back().columns.front().component != first) {
    NumberSites& added = source.sites.emplace_back();
    added.columns.clear();
    for (std::size_t i = 0; i < texts.size(); ++i) {
      added.columns.push_back({.component = static_cast<std::uint8_t>(first + i)});
    }
    added.most_characters = most_number_characters;
  }
  NumberSites& sites = source.sites.back();
  sites.vertices.push_back(vertex);
  for (const std::string_view text : texts) {
    sites.offsets.push_back(offset_of(text));
  }
}

/// label, nodes; on as many lines as they need.
void InpLinesReader::read_element(std::string_view line) {
  InpFields fields(line);
  const InpElementType& type = model_.blocks.back().known;
  if (!is_in_element_) {
    if (model_.element_count() >= most_items) {
      fail_at(line, "has more elements than 32-bit indices can tell apart");
    }
    fields.next();
    const std::int64_t label = label_of(fields.text(), "an element number");
    model_.element_offsets.push_back(offset_of(line));
    model_.element_origins.add(model_.element_count() - 1, open_.back());
    scope().elements.labels.push_back(label);
    scope().elements.indices.push_back(static_cast<std::int32_t>(model_.element_count() - 1));
    is_in_element_ = true;
    missing_ = type.nodes;
  }
  while (fields.next()) {
    if (fields.text().empty()) {
      continue;
    }
    if (type.is_known() && missing_ == 0) {
      fail_at(fields.text(), "an element of type " + trismooth::quoted(model_.blocks.back().type) + " has " +
                                 std::to_string(type.nodes) + " nodes, this one has more");
    }
    add_reference(fields.text());
    missing_ -= type.is_known() ? 1 : 0;
  }
  const bool goes_on = inp_goes_on(line) || (type.is_known() && type.nodes > most_nodes_in_line);
  if (type.is_known() ? missing_ > 0 : inp_goes_on(line)) {
    if (!goes_on) {
      fail_at(line, "an element of type " + trismooth::quoted(model_.blocks.back().type) + " has " +
                        std::to_string(type.nodes) + " nodes, this one has " + std::to_string(type.nodes - missing_));
    }
    return;
  }
  is_in_element_ = false;
  if (model_.references.size() == model_.element_begins.back()) {
    fail_at(line, "expected the nodes of an element, got its number alone");
  }
  model_.element_begins.push_back(model_.references.size());
  if (set_lines_ != nullptr) {
    set_lines_->back().behind = static_cast<std::int32_t>(model_.element_count());
  }
}

/// A label of a node, or that of one of an instance: "Plate-1.17".
void InpLinesReader::add_reference(std::string_view field) {
  if (const std::optional<std::int64_t> label = parse_integer(field)) {
    model_.references.push_back(*label);
    return;
  }
  const std::size_t point = field.rfind('.');
  if (point != std::string_view::npos && point > 0) {
    const auto instance = model_.instances.find(inp_key(field.substr(0, point)));
    const std::optional<std::int64_t> label = parse_integer(field.substr(point + 1));
    if (instance != model_.instances.end() && label) {
      model_.foreign.emplace(model_.references.size(), instance->second);
      model_.references.push_back(*label);
      return;
    }
  }
  fail_at(field, "expected a node number, got " + trismooth::quoted(field));
}

/// Numbers and names of other sets, or from, to and step.
void InpLinesReader::read_set(std::string_view line) {
  InpSetLines& lines = set_lines_->back();
  InpFields fields(line);
  if (generates_) {
    std::array<std::int64_t, 3> numbers{0, 0, 1};
    std::size_t count = 0;
    while (fields.next()) {
      if (!fields.text().empty() && count < numbers.size()) {
        numbers[count++] = label_of(fields.text(), "a number of GENERATE (first, last, step)");
      }
    }
    if (count < 2 || numbers[2] <= 0) {
      fail_at(line, "expected first, last and step of GENERATE, got " + trismooth::quoted(line));
    }
    lines.ranges.push_back({numbers[0], numbers[1], numbers[2]});
    return;
  }
  while (fields.next()) {
    if (const std::optional<std::int64_t> label = parse_integer(fields.text())) {
      lines.labels.push_back(*label);
    } else if (!fields.text().empty()) {
      lines.names.emplace_back(fields.text());
    }
  }
}

/// Nodes stand first in lines of conditions and loads, three fields apart in equations, behind the type in those of
/// constraints. Names of sets are no matter here: all sets hold their nodes.
void InpLinesReader::read_held(std::string_view line) {
  InpSetLines& lines = set_lines_->back();
  InpFields fields(line);
  for (std::size_t i = 0; fields.next(); ++i) {
    const bool is_node = block_ == Block::loads ? i == 0 : block_ == Block::equation ? i % 3 == 0 : i > 0;
    const std::string_view field = fields.text();
    if (!is_node || (block_ == Block::equation && line.find(',') == std::string_view::npos)) {
      continue;
    }
    if (const std::optional<std::int64_t> label = parse_integer(field)) {
      lines.labels.push_back(*label);
    } else if (field.find('.') != std::string_view::npos) {
      lines.names.emplace_back(field);
    }
  }
}

std::int64_t InpLinesReader::label_of(std::string_view field, std::string_view what) const {
  const std::optional<std::int64_t> label = parse_integer(field);
  if (!label || *label < 0) {
    fail_at(field, "expected " + std::string(what) + ", got " + trismooth::quoted(field));
  }
  return *label;
}

}  // namespace trismooth
