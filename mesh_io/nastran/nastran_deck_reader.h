// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/nastran/nastran_card.h"
#include "trismooth/mesh_io/nastran/nastran_elements.h"
#include "trismooth/mesh_io/nastran/nastran_model.h"
#include "trismooth/mesh_io/nastran/nastran_names.h"

namespace trismooth {

struct NastranHolder;

/// Goes through the cards of a deck and of the files that it includes, and fills a model.
class NastranDeckReader {
 public:
  NastranDeckReader(NastranModel& model, const FileWorkers& workers) : model_(model), workers_(workers) {}

  /// Reads model.sources.front(). Throws ReadError.
  void read();

 private:
  void read_source(std::size_t source);
  std::size_t include(std::size_t begin);

  void read_card(std::size_t begin);
  void check_marks(bool needs_more) const;
  void read_grid(std::size_t begin);
  void check_system(std::string_view text);
  void read_element(const NastranElement& element, std::size_t begin);
  void add_cell(const NastranElement& element, const std::array<std::int64_t, most_nastran_nodes>& nodes);
  void read_held(const NastranHolder& holder);
  void read_other();

  std::int64_t integer_of(std::string_view field, std::string_view what) const;
  double coordinate_of(std::string_view field, char axis) const;
  [[noreturn]] void fail_at(std::string_view part, const std::string& message) const;
  [[noreturn]] void fail(const std::string& message) const;

  NastranModel& model_;
  const FileWorkers& workers_;
  std::vector<std::size_t> open_;  ///< the sources that are read now, each included by the one before
  bool is_in_bulk_ = false;
  bool has_bulk_ = false;  ///< a line BEGIN BULK
  bool has_ended_ = false;
  NastranCard card_;
  NastranNames names_;
  const NastranElement* last_element_ = nullptr;  ///< cards of one kind stand together
  std::string last_element_name_;
  std::string default_system_;
  std::optional<std::int64_t> system_;  ///< of the nodes so far
  std::set<std::int64_t> rectangular_systems_;
};

}  // namespace trismooth
