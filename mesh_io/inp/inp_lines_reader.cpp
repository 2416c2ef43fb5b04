// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_lines_reader.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Keywords that make nodes or elements by a rule, or move nodes: these have no lines of their own.
constexpr auto makers = std::to_array<std::string_view>({"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"});

/// File names may be in quotation marks.
std::filesystem::path file_named(std::string_view value) {
  return inp_label(value.starts_with('"') ? value : "\"" + std::string(value) + "\"");
}

}  // namespace

InpLinesReader::InpLinesReader(InpModel& model, const FileWorkers& workers) : model_(model), workers_(workers) {
  model_.scopes.emplace_back();
}

void InpLinesReader::read() {
  read_source(0);
  const InpSource& main = model_.sources.front();
  if (!has_nodes_) {
    throw ReadError(main.path, "is not an Abaqus mesh: it has no *NODE");
  }
}

void InpLinesReader::read_source(std::size_t source) {
  open_.push_back(source);
  InpLines lines(model_.sources[source].bytes);
  for (InpLines::Kind kind = lines.next(); kind != InpLines::Kind::end; kind = lines.next()) {
    if (kind == InpLines::Kind::data) {
      read_data(lines.line());
      continue;
    }
    if (is_in_element_) {
      fail_at(lines.line(), "the element before this line ends without its last nodes");
    }
    const InpKeyword keyword = lines.keyword();
    if (keyword.name == "INCLUDE") {
      const InpParameter* const input = keyword.find("INPUT");
      if (input == nullptr || input->value.empty()) {
        fail_at(lines.line(), "*INCLUDE names no file (INPUT=...)");
      }
      include(keyword, *input);
    } else {
      start_block(keyword);
    }
  }
  if (is_in_element_) {
    const std::string_view text = model_.sources[source].bytes;
    fail_at(text.substr(text.size()), "the last element ends without its last nodes");
  }
  open_.pop_back();
}

void InpLinesReader::start_block(const InpKeyword& keyword) {
  block_ = Block::other;
  set_lines_ = nullptr;
  has_keyword_ = true;
  const std::string_view text = model_.sources[open_.back()].bytes;
  const std::string_view line = text.substr(keyword.begin, keyword.end - keyword.begin);
  if (std::ranges::find(makers, keyword.name) != makers.end()) {
    fail_at(line, "*" + keyword.name +
                      " makes or moves nodes or elements by a rule, which have no lines here; write "
                      "each as a line of *NODE or *ELEMENT");
  }
  if (keyword.name == "NODE") {
    start_nodes(keyword, line);
  } else if (keyword.name == "ELEMENT") {
    start_elements(keyword, line);
  } else if (keyword.name == "NSET" || keyword.name == "ELSET") {
    start_set(keyword, line);
  } else if (keyword.name == "SYSTEM") {
    block_ = Block::system;
    has_system_ = false;
  } else if (keyword.name == "BOUNDARY" || keyword.name == "CLOAD" || keyword.name == "CFLUX") {
    start_held(keyword, Block::loads);
  } else if (keyword.name == "EQUATION") {
    start_held(keyword, Block::equation);
  } else if (keyword.name == "MPC") {
    start_held(keyword, Block::constraint);
  } else if (keyword.name == "USERELEMENT") {
    if (const std::string_view value = keyword.value_of("NODES"); !value.empty()) {
      const auto nodes = parse_integer(value);
      if (!nodes || *nodes <= 0) {
        fail_at(line, "expected the number of nodes of a user element (NODES=...), got " + trismooth::quoted(value));
      }
      user_types_[inp_key(keyword.value_of("TYPE"))] = {cell_type::poly_vertex, static_cast<std::size_t>(*nodes)};
    }
  } else if (keyword.name.ends_with("SECTION") && !keyword.value_of("ELSET").empty()) {
    model_.sections.push_back({scope_, std::string(keyword.value_of("ELSET"))});
  } else {
    start_scope(keyword);
  }
  const InpParameter* const input = keyword.find("INPUT");
  if (input != nullptr && block_ != Block::other && !input->value.empty()) {
    include(keyword, *input);
    block_ = Block::other;
  } else if (input != nullptr || keyword.find("FILE") != nullptr) {
    model_.names_other_files = true;
  }
}

/// Parts, instances and assemblies: each has labels and names of its own.
void InpLinesReader::start_scope(const InpKeyword& keyword) {
  const auto enter_new = [this, &keyword](InpNames* names) {
    scope_ = model_.scopes.size();
    const std::string_view name = keyword.value_of("NAME");
    model_.scopes.push_back({inp_label(name), std::nullopt, {}, {}});
    if (names != nullptr) {
      names->insert_or_assign(inp_key(name), scope_);
    }
  };
  if (keyword.name == "PART") {
    enter_new(&model_.parts);
  } else if (keyword.name == "ASSEMBLY") {
    enter_new(nullptr);
    assembly_ = scope_;
  } else if (keyword.name == "INSTANCE") {
    enter_new(&model_.instances);
    const auto part = model_.parts.find(inp_key(keyword.value_of("PART")));
    if (part != model_.parts.end()) {
      scope().part = part->second;
    }
  } else if (keyword.name == "ENDPART" || keyword.name == "ENDASSEMBLY") {
    scope_ = 0;
  } else if (keyword.name == "ENDINSTANCE") {
    scope_ = assembly_;
  }
}

void InpLinesReader::start_nodes(const InpKeyword& keyword, std::string_view line) {
  const std::string system = inp_key(keyword.value_of("SYSTEM"));
  if (has_system_ || (!system.empty() && system != "R")) {
    fail_at(line, "the coordinates of these nodes are in a system of their own (" +
                      std::string(has_system_ ? "*SYSTEM" : "SYSTEM=" + system) +
                      "), which is not read; state them in the global one");
  }
  block_ = Block::node;
  has_nodes_ = true;
  if (const std::string_view set = keyword.value_of("NSET"); !set.empty()) {
    start_lines_of_set(set, true);
  }
}

void InpLinesReader::start_elements(const InpKeyword& keyword, std::string_view line) {
  const std::string type = inp_key(keyword.value_of("TYPE"));
  if (type.empty()) {
    fail_at(line, "*ELEMENT states no TYPE");
  }
  const auto user_type = user_types_.find(type);
  block_ = Block::element;
  model_.blocks.push_back({model_.element_count(), scope_, type,
                           user_type != user_types_.end() ? user_type->second : inp_element_type(type)});
  if (const std::string_view set = keyword.value_of("ELSET"); !set.empty()) {
    start_lines_of_set(set, false);
    model_.element_sets[set_lines_->back().set].is_of_lines = true;
  }
}

void InpLinesReader::start_set(const InpKeyword& keyword, std::string_view line) {
  const bool of_nodes = keyword.name == "NSET";
  const std::string_view name = keyword.value_of(keyword.name);
  if (name.empty()) {
    fail_at(line, "*" + keyword.name + " states no name (" + keyword.name + "=...)");
  }
  start_lines_of_set(name, of_nodes);
  block_ = of_nodes ? Block::node_set : Block::element_set;
  generates_ = keyword.find("GENERATE") != nullptr;
  InpSetLines& lines = set_lines_->back();
  if (of_nodes) {
    lines.elements = keyword.value_of("ELSET");
  }
  if (const std::string_view instance = keyword.value_of("INSTANCE"); !instance.empty()) {
    const auto found = model_.instances.find(inp_key(instance));
    if (found == model_.instances.end()) {
      fail_at(line, "there is no instance " + trismooth::quoted(instance) + " before this line");
    }
    lines.scope = found->second;
  }
}

/// Nodes that a boundary condition, a load or a constraint names by number.
void InpLinesReader::start_held(const InpKeyword& keyword, Block block) {
  start_lines_of_set("\"*" + keyword.name + "\"", true);
  block_ = block;
}

/// What the block's lines say belongs to the set of that name.
void InpLinesReader::start_lines_of_set(std::string_view name, bool of_nodes) {
  InpNames& names = of_nodes ? scope().nodes.sets : scope().elements.sets;
  std::vector<InpSet>& sets = of_nodes ? model_.node_sets : model_.element_sets;
  const auto [entry, is_new] = names.emplace(inp_key(name), sets.size());
  if (is_new) {
    sets.push_back({inp_label(name), scope_});
  }
  set_lines_ = of_nodes ? &model_.node_set_lines : &model_.element_set_lines;
  const std::size_t count = of_nodes ? model_.node_offsets.size() : model_.element_count();
  set_lines_->push_back({.set = entry->second, .scope = scope_});
  set_lines_->back().first = set_lines_->back().behind = static_cast<std::int32_t>(count);
}

/// Reads the file that the keyword line names, as if its lines stood behind that line.
void InpLinesReader::include(const InpKeyword& keyword, const InpParameter& input) {
  const std::filesystem::path name = file_named(input.value);
  const bool is_line = keyword.name == "INCLUDE";
  const std::size_t source = add_included(model_.sources, open_, name, workers_,
                                          [&](const std::string& problem) { fail_at(input.value, problem); });
  model_.sources[open_.back()].includes.push_back(
      {source, name, is_line ? keyword.begin : input.begin, is_line ? keyword.end : input.end, keyword.end, !is_line});
  read_source(source);
}

std::size_t InpLinesReader::offset_of(std::string_view part) const {
  return static_cast<std::size_t>(part.data() - model_.sources[open_.back()].bytes.view().data());
}

void InpLinesReader::fail_at(std::string_view part, const std::string& message) const {
  const InpSource& source = model_.sources[open_.back()];
  fail_in_inp(source.path, source.bytes, offset_of(part), message);
}

}  // namespace trismooth
