// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_deck_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/nastran/nastran_holders.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr auto most_nastran_items = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

/// Whether lines of other sections come first: a line begins the bulk data, before any node.
bool has_control_section(std::string_view text, std::size_t begin) {
  NastranLines lines(text, begin);
  while (lines.next()) {
    if (begins_with_nastran_word(lines.line(), "BEGIN")) {
      return true;
    }
    if (begins_with_nastran_word(lines.line(), "GRID")) {
      return false;
    }
  }
  return false;
}

}  // namespace

void NastranDeckReader::read() {
  const NastranSource& main = model_.sources.front();
  is_in_bulk_ = !has_control_section(main.bytes, 0);
  read_source(0);
  // A whole deck may be a mesh of nothing, one that is cut off is not.
  if (model_.node_ids.empty() && !(has_bulk_ && has_ended_)) {
    throw ReadError(main.path, "is not a Nastran mesh: it has no GRID");
  }
  if (system_.value_or(0) != 0 && !rectangular_systems_.contains(*system_)) {
    const NastranPlace place = place_of_nastran_node(model_, 0);
    const NastranSource& source = model_.sources[place.source];
    TextScanner(source.bytes, source.path)
        .fail_at(place.offset, "the coordinates of the nodes are in the system " + std::to_string(*system_) +
                                   ", which no CORD1R or CORD2R of the file states; state them in the basic one");
  }
  model_.system = system_.value_or(0);
  model_.property_names = names_.take();
}

void NastranDeckReader::read_source(std::size_t source) {
  open_.push_back(source);
  const std::string_view text = without_end_mark(model_.sources[source].bytes);
  NastranLines lines(text, begin_of_text(text));
  while (!has_ended_ && lines.next()) {
    const std::string_view line = lines.line();
    const auto begin = static_cast<std::size_t>(line.data() - text.data());
    if (is_empty_nastran_line(line)) {
      names_.read_comment(line);
    } else if (begins_with_nastran_word(line, "INCLUDE")) {
      lines.seek(include(begin));
    } else if (begins_with_nastran_word(line, "BEGIN")) {
      if (has_bulk_) {
        fail_at(line, "another section of bulk data begins here: decks of several (BEGIN SUPER) are not read");
      }
      is_in_bulk_ = has_bulk_ = true;
    } else if (is_in_bulk_) {
      has_ended_ = begins_with_nastran_word(line, "ENDDATA");
      if (!has_ended_) {
        lines.seek(read_nastran_card(text, begin, card_));
        read_card(begin);
      }
    }
  }
  open_.pop_back();
}

/// Reads the file that the statement at `begin` names, as if its lines stood there; where the statement ends. The name
/// may go on over lines up to its closing mark.
std::size_t NastranDeckReader::include(std::size_t begin) {
  const std::string_view text = model_.sources[open_.back()].bytes;
  NastranLines lines(text, begin);
  lines.next();
  const std::string_view statement = trimmed(lines.line());
  std::string_view rest = trimmed(statement.substr(std::string_view("INCLUDE").size()), " \t=");
  std::string name;
  if (rest.starts_with('\'') || rest.starts_with('"')) {
    const char mark = rest.front();
    rest.remove_prefix(1);
    std::size_t end = rest.find(mark);
    while (end == std::string_view::npos) {
      name += trimmed(rest);
      if (!lines.next()) {
        fail_at(statement,
                "the name of the file that is included here has no end: expected another " + std::string(1, mark));
      }
      rest = trimmed(lines.line());
      end = rest.find(mark);
    }
    name += rest.substr(0, end);
  } else {
    name = trimmed(rest.substr(0, rest.find('$')));
  }
  const std::size_t source = add_included(model_.sources, open_, name, workers_,
                                          [&](const std::string& problem) { fail_at(statement, problem); });
  model_.sources[open_.back()].includes.push_back({source, name, begin, lines.offset()});
  read_source(source);
  return lines.offset();
}

void NastranDeckReader::read_card(std::size_t begin) {
  const std::string_view head = trimmed(card_.lines.front().head);
  if (head.starts_with('=') || head.starts_with("*(")) {
    fail("cards that repeat the one before (=) are not read; state each in full");
  }
  if (card_.lines.front().is_continuation()) {
    fail("this line goes on with a card, but there is none before it");
  }
  if (last_element_ == nullptr || last_element_name_ != card_.name) {
    if (const NastranElement* const element = find_nastran_element(card_.name)) {
      last_element_ = element;
      last_element_name_ = card_.name;
    } else if (card_.name == "GRID") {
      read_grid(begin);
      return;
    } else {
      if (const NastranHolder* const holder = find_nastran_holder(card_.name)) {
        read_held(*holder);
      }
      read_other();
      return;
    }
  }
  read_element(*last_element_, begin);
}

void NastranDeckReader::read_other() {
  const std::string& name = card_.name;
  if (name.starts_with("GRID ") || name.starts_with("GRID\t")) {
    fail("the fields of this GRID are neither in columns of 8 or 16 nor divided by commas");
  }
  if (name == "GRDSET") {
    default_system_ = card_.field(1);
  } else if (name == "CORD1R" || name == "CORD2R") {
    // A line of CORD1R may state two.
    for (const std::size_t i : {std::size_t{0}, std::size_t{4}}) {
      const auto system = i == 0 || name == "CORD1R" ? parse_integer(card_.field(i)) : std::nullopt;
      if (system) {
        rectangular_systems_.insert(*system);
      }
    }
  }
  names_.read_card(card_);
  model_.other_cards.insert(name);
}

/// Lines that go on have marks, which say to what.
void NastranDeckReader::check_marks(bool needs_more) const {
  const auto is_mark = [](std::string_view mark) {
    return mark.size() > 1 && (mark.starts_with('+') || mark.starts_with('*'));
  };
  for (std::size_t i = 0; i < card_.lines.size(); ++i) {
    const std::string_view mark = card_.lines[i].mark();
    if (!is_mark(mark)) {
      continue;
    }
    const bool is_last = i + 1 == card_.lines.size();
    const std::string_view next = is_last ? std::string_view() : trimmed(card_.lines[i + 1].head);
    if (is_last ? needs_more : is_mark(next) && next.substr(1) != mark.substr(1)) {
      fail_at(card_.lines[i].text, "expected this card to go on in the next line with " + trismooth::quoted(mark) +
                                       (is_last ? "" : ", got " + trismooth::quoted(next)));
    }
  }
}

void NastranDeckReader::read_grid(std::size_t begin) {
  if (model_.node_ids.size() >= most_nastran_items) {
    fail("has more nodes than 32-bit indices can tell apart");
  }
  const NastranLine& first = card_.lines.front();
  if (first.is_large() && card_.lines.size() > 1 &&
      (!card_.lines[1].is_large() || card_.lines[1].is_free != first.is_free)) {
    fail("the second line of this GRID is not in large field, as the first one is");
  }
  const std::int64_t id = integer_of(card_.field(0), "the number of a node");
  check_system(card_.field(1));
  constexpr std::string_view axes = "123";
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    model_.points.push_back(coordinate_of(card_.field(2 + axis), axes[axis]));
  }
  check_marks(card_.field(4).empty());
  if (const std::string_view constrained = card_.field(6); !constrained.empty() && constrained != "0") {
    model_.held["GRID " + std::string(constrained)].push_back({id, id});
  }
  model_.has_short_free_grids = model_.has_short_free_grids || (first.is_free && !first.is_large());
  NastranSource& source = model_.sources[open_.back()];
  source.grids.push_back(begin);
  source.vertices.push_back(static_cast<std::int32_t>(model_.node_ids.size()));
  model_.node_ids.push_back(id);
}

/// All nodes have to be in one system: what is smoothed is the mesh as it is in that.
void NastranDeckReader::check_system(std::string_view text) {
  const std::string_view stated = text.empty() ? std::string_view(default_system_) : text;
  const std::int64_t system = stated.empty() ? 0 : integer_of(stated, "the number of a coordinate system");
  if (system_ && *system_ != system) {
    fail("this node's coordinates are in the system " + std::to_string(system) + ", those before it in " +
         std::to_string(*system_) + ": nodes in different systems are not read");
  }
  system_ = system;
}

void NastranDeckReader::read_element(const NastranElement& element, std::size_t begin) {
  if (model_.element_types.size() >= most_nastran_items) {
    fail("has more elements than 32-bit indices can tell apart");
  }
  integer_of(card_.field(0), "the number of an element");
  const std::string_view property = element.has_property ? card_.field(1) : std::string_view();
  model_.properties.push_back(property.empty() ? 0 : integer_of(property, "the number of a property"));
  std::array<std::int64_t, most_nastran_nodes> nodes{};
  for (std::size_t i = 0; i < element.most_nodes(); ++i) {
    const std::string_view text = card_.field(element.first_node() + i);
    nodes.at(i) = text.empty() ? 0 : integer_of(text, "a node of " + card_.name);
  }
  check_marks(element.first_node() + element.most_nodes() > card_.field_count());
  add_cell(element, nodes);
  model_.element_places.push_back({open_.back(), begin});
}

void NastranDeckReader::add_cell(const NastranElement& element,
                                 const std::array<std::int64_t, most_nastran_nodes>& nodes) {
  const NastranShape& most = element.curved.nodes > 0 ? element.curved : element.plain;
  const auto add = [&](std::uint8_t type, std::size_t count) {
    model_.element_types.push_back(type);
    for (std::size_t i = 0; i < count; ++i) {
      model_.references.push_back(nodes.at(most.place(i)));
    }
    model_.element_begins.push_back(model_.references.size());
  };
  std::size_t corners = 0;
  std::size_t middles = 0;
  for (std::size_t i = 0; i < most.nodes; ++i) {
    (i < most.corners ? corners : middles) += nodes.at(most.place(i)) != 0 ? 1 : 0;
  }
  if (corners < most.corners) {
    fail(card_.name + " has " + std::to_string(most.corners) + " corners, this one names " + std::to_string(corners));
  }
  if (middles == 0) {
    add(element.plain.type, most.corners);
  } else if (middles == most.nodes - most.corners) {
    add(element.curved.type, most.nodes);
  } else if (most.type == cell_type::biquadratic_quad && middles == 4 && nodes.at(8) == 0) {
    add(cell_type::quadratic_quad, 8);
  } else {
    // Its nodes are held, whatever its shape is.
    model_.partly_curved.insert(card_.name);
    model_.element_types.push_back(cell_type::poly_vertex);
    std::copy_if(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(most.nodes),
                 std::back_inserter(model_.references), [](std::int64_t node) { return node != 0; });
    model_.element_begins.push_back(model_.references.size());
  }
}

void NastranDeckReader::read_held(const NastranHolder& holder) {
  std::vector<NastranRange> ranges = nodes_of_nastran_card(holder, card_);
  const std::string name = holder.has_set ? card_.name + " " + std::string(card_.field(0)) : card_.name;
  std::vector<NastranRange>& all = model_.held[name];
  all.insert(all.end(), ranges.begin(), ranges.end());
}

/// Numbers from 0 on.
std::int64_t NastranDeckReader::integer_of(std::string_view field, std::string_view what) const {
  const auto number = parse_integer(field);
  if (!number || *number < 0) {
    fail("expected " + std::string(what) + ", got " + (field.empty() ? "a blank field" : trismooth::quoted(field)));
  }
  return *number;
}

double NastranDeckReader::coordinate_of(std::string_view field, char axis) const {
  if (field.empty()) {
    return 0;
  }
  const auto number = parse_fortran_number<double>(field);
  if (!number || !std::isfinite(*number)) {
    fail("expected X" + std::string(1, axis) + " of a node (a finite number), got " + trismooth::quoted(field));
  }
  return *number;
}

void NastranDeckReader::fail_at(std::string_view part, const std::string& message) const {
  const NastranSource& source = model_.sources[open_.back()];
  TextScanner(source.bytes, source.path)
      .fail_at(static_cast<std::size_t>(part.data() - source.bytes.view().data()), message);
}

void NastranDeckReader::fail(const std::string& message) const {
  fail_at(card_.lines.front().text, message);
}

}  // namespace trismooth
