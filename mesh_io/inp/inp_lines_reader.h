// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/inp/inp_model.h"
#include "trismooth/mesh_io/inp/inp_text.h"

namespace trismooth {

/// Goes through the lines of an input file and of those that it includes, and fills a model.
class InpLinesReader {
 public:
  InpLinesReader(InpModel& model, const FileWorkers& workers);

  /// Reads model.sources.front(). Throws ReadError.
  void read();

 private:
  /// What data lines are part of.
  enum class Block : std::uint8_t { other, node, element, node_set, element_set, system, loads, equation, constraint };

  void read_source(std::size_t source);
  void start_block(const InpKeyword& keyword);
  void read_data(std::string_view line);

  // Keywords; `line` is where they stand.
  void start_scope(const InpKeyword& keyword);
  void start_nodes(const InpKeyword& keyword, std::string_view line);
  void start_elements(const InpKeyword& keyword, std::string_view line);
  void start_set(const InpKeyword& keyword, std::string_view line);
  void start_held(const InpKeyword& keyword, Block block);
  void start_lines_of_set(std::string_view name, bool of_nodes);
  void include(const InpKeyword& keyword, const InpParameter& input);

  // Data lines.
  void read_node(std::string_view line);
  void add_sites(std::int32_t vertex, std::string_view line, const std::array<std::string_view, 3>& texts);
  void add_site(InpSource& source, std::int32_t vertex, std::uint8_t first, std::span<const std::string_view> texts);
  void read_element(std::string_view line);
  void add_reference(std::string_view field);
  void read_set(std::string_view line);
  void read_held(std::string_view line);
  std::int64_t label_of(std::string_view field, std::string_view what) const;

  InpScope& scope() { return model_.scopes[scope_]; }
  std::size_t offset_of(std::string_view part) const;
  [[noreturn]] void fail_at(std::string_view part, const std::string& message) const;

  InpModel& model_;
  const FileWorkers& workers_;
  std::vector<std::size_t> open_;  ///< the sources that are read now, each included by the one before
  bool has_keyword_ = false;
  bool has_nodes_ = false;    ///< a line *NODE
  bool has_system_ = false;   ///< coordinates are not the global ones
  std::size_t scope_ = 0;     ///< of labels and names now
  std::size_t assembly_ = 0;  ///< the scope that instances stand in
  std::map<std::string, InpElementType, std::less<>> user_types_;
  Block block_ = Block::other;
  std::vector<InpSetLines>* set_lines_ = nullptr;  ///< the last is of this block; null: it names no set
  bool generates_ = false;                         ///< a block of a set
  bool is_in_element_ = false;
  std::size_t missing_ = 0;  ///< nodes of that element, where they are known
};

}  // namespace trismooth
