// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_entity_plan.h"
#include "trismooth/mesh_io/msh/msh_fields.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

/// A stretch of points or cells that are written as one block.
struct MshStretch {
  std::size_t begin;
  std::size_t end;
};

/// Whether the entities of the file say what the array says.
bool is_of_entities(const DataArray& array, const MshEntityPlan& plan) {
  return plan.group_arrays.has(array.name) || (plan.keeps_entities && array.name == "gmsh:geometrical");
}

class MshWriter {
 public:
  MshWriter(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers)
      : document_(document), plan_(plan_msh_entities(document)), writer_(path, workers) {
    for (std::size_t cell = 0; cell < plan_.of_cell.size(); ++cell) {
      if (plan_.of_cell[cell] >= 0) {
        written_.push_back(static_cast<std::int32_t>(cell));
      }
    }
  }

  void write() {
    line("$MeshFormat");
    line("4.1 0 8");
    line("$EndMeshFormat");
    write_physical_names();
    write_entities();
    write_nodes();
    write_elements();
    for (const DataArray& array : document_.point_arrays) {
      write_msh_field(writer_.blocks(), header_, {.of_nodes = true, .size = document_.point_count()}, array);
    }
    for (const DataArray& array : document_.cell_arrays) {
      if (!is_of_entities(array, plan_)) {
        write_msh_field(writer_.blocks(), header_,
                        {.of_nodes = false, .size = written_.size(), .tags = {}, .places = written_}, array);
      }
    }
    writer_.close();
  }

 private:
  void line(std::string_view text) {
    writer_.write_line([text](TextLines& lines) { lines.word(text); });
  }

  void write_physical_names() {
    const auto is_named = [](const MshPlannedGroup& group) { return !group.name.empty(); };
    const auto named = std::ranges::count_if(plan_.groups, is_named);
    if (named == 0) {
      return;
    }
    line("$PhysicalNames");
    line(std::to_string(named));
    for (const MshPlannedGroup& group : plan_.groups) {
      if (is_named(group)) {
        writer_.write_line([&group](TextLines& lines) {
          lines.number(group.dimension).number(group.tag).word(quoted_msh_name(group.name));
        });
      }
    }
    line("$EndPhysicalNames");
  }

  /// The box around the points of every entity: smallest and largest x, y, z.
  using Box = std::array<double, 6>;
  std::vector<Box> boxes() const {
    constexpr double most = std::numeric_limits<double>::infinity();
    std::vector<Box> found(plan_.entities.size(), {most, most, most, -most, -most, -most});
    const auto add = [&](std::int32_t entity, std::size_t point) {
      Box& box = found[static_cast<std::size_t>(entity)];
      for (std::size_t i = 0; i < 3; ++i) {
        box[i] = std::min(box[i], document_.points[3 * point + i]);
        box[3 + i] = std::max(box[3 + i], document_.points[3 * point + i]);
      }
    };
    for (std::size_t cell = 0; cell < plan_.of_cell.size(); ++cell) {
      if (plan_.of_cell[cell] >= 0) {
        for (const std::int32_t vertex : document_.cells[cell]) {
          add(plan_.of_cell[cell], static_cast<std::size_t>(vertex));
        }
      }
    }
    for (std::size_t point = 0; point < plan_.of_point.size(); ++point) {
      add(plan_.of_point[point], point);
    }
    return found;
  }

  void write_entities() {
    const std::vector<Box> all = boxes();
    line("$Entities");
    writer_.write_line([this](TextLines& lines) {
      for (int dimension = 0; dimension < 4; ++dimension) {
        lines.number(std::ranges::count(plan_.entities, dimension, &MshPlannedEntity::dimension));
      }
    });
    writer_.write_lines(plan_.entities.size(), [&](TextLines& lines, std::size_t i) {
      const MshPlannedEntity& entity = plan_.entities[i];
      lines.number(entity.tag);
      for (std::size_t k = 0; k < (entity.dimension == 0 ? 3U : 6U); ++k) {
        lines.number(all[i][k]);
      }
      lines.number(entity.physical.size());
      for (const std::int32_t group : entity.physical) {
        lines.number(group);
      }
      if (entity.dimension > 0) {
        lines.number(0);
      }
      lines.end_line();
    });
    line("$EndEntities");
  }

  /// Stretches of the first `size` things of which neighbours are alike.
  template <class Alike>
  static std::vector<MshStretch> stretches(std::size_t size, const Alike& alike) {
    std::vector<MshStretch> found;
    for (std::size_t begin = 0; begin < size;) {
      std::size_t end = begin + 1;
      while (end < size && alike(begin, end)) {
        ++end;
      }
      found.push_back({begin, end});
      begin = end;
    }
    return found;
  }

  /// "blocks, things, smallest tag, largest tag": tags count from 1.
  void write_counts(std::size_t blocks, std::size_t things) {
    writer_.write_line(
        [=](TextLines& lines) { lines.number(blocks).number(things).number(things == 0 ? 0 : 1).number(things); });
  }

  /// Points stay in their order: an entity may have several blocks.
  void write_nodes() {
    const std::vector<MshStretch> blocks = stretches(
        plan_.of_point.size(), [this](std::size_t a, std::size_t b) { return plan_.of_point[a] == plan_.of_point[b]; });
    line("$Nodes");
    write_counts(blocks.size(), plan_.of_point.size());
    for (const MshStretch& block : blocks) {
      const auto& entity = plan_.entities[static_cast<std::size_t>(plan_.of_point[block.begin])];
      const std::size_t count = block.end - block.begin;
      writer_.write_line(
          [&](TextLines& lines) { lines.number(entity.dimension).number(entity.tag).number(0).number(count); });
      writer_.write_lines(count,
                          [&](TextLines& lines, std::size_t i) { lines.number(block.begin + i + 1).end_line(); });
      writer_.write_lines(count, [&, points = &document_.points[3 * block.begin]](TextLines& lines, std::size_t i) {
        lines.number(points[3 * i]).number(points[3 * i + 1]).number(points[3 * i + 2]).end_line();
      });
    }
    line("$EndNodes");
  }

  void write_elements() {
    const auto cell_at = [this](std::size_t row) { return static_cast<std::size_t>(written_[row]); };
    const std::vector<MshStretch> blocks = stretches(written_.size(), [&](std::size_t a, std::size_t b) {
      return plan_.of_cell[cell_at(a)] == plan_.of_cell[cell_at(b)] &&
             plan_.element_types[cell_at(a)] == plan_.element_types[cell_at(b)];
    });
    line("$Elements");
    write_counts(blocks.size(), written_.size());
    for (const MshStretch& block : blocks) {
      const std::size_t first = cell_at(block.begin);
      const auto& entity = plan_.entities[static_cast<std::size_t>(plan_.of_cell[first])];
      const int type_number = plan_.element_types[first];
      const MshElementType& type = msh_element_type(type_number);
      const std::size_t count = block.end - block.begin;
      writer_.write_line([&](TextLines& lines) {
        lines.number(entity.dimension).number(entity.tag).number(type_number).number(count);
      });
      writer_.write_lines(count, [&](TextLines& lines, std::size_t i) {
        lines.number(block.begin + i + 1);
        const auto vertices = document_.cells[cell_at(block.begin + i)];
        for (std::size_t k = 0; k < vertices.size(); ++k) {
          lines.number(vertices[type.places.empty() ? k : type.places[k]] + std::int64_t{1});
        }
        lines.end_line();
      });
    }
    line("$EndElements");
  }

  const MeshDocument& document_;
  MshHeader header_{.version = 41};  ///< of what is written
  MshEntityPlan plan_;
  TextMeshWriter writer_;
  std::vector<std::int32_t> written_;  ///< cells
};

}  // namespace

void write_msh(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  MshWriter(path, document, workers).write();
}

std::vector<std::string> lost_in_msh(const MeshDocument& document) {
  const MshEntityPlan plan = plan_msh_entities(document);
  CellList lost_cells;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (plan.element_types[cell] == 0) {
      lost_cells.append(document.cells.types[cell], document.cells[cell]);
    }
  }
  std::vector<std::string> sentences = describe_lost_cells("MSH", "elements of Gmsh", {}, lost_cells);
  std::vector<DataArray> padded;
  std::vector<DataArray> refused;
  std::vector<const DataArray*> held;
  const auto sort = [&](const std::vector<DataArray>& arrays, bool of_cells) {
    for (const DataArray& array : arrays) {
      if (of_cells && is_of_entities(array, plan)) {
        continue;
      }
      const std::size_t components = msh_components(array);
      if (components == 0) {
        refused.push_back(array);
      } else if (components != array.components) {
        padded.push_back(array);
      }
      if (components != 0) {
        held.push_back(&array);
      }
    }
  };
  sort(document.point_arrays, false);
  sort(document.cell_arrays, true);
  if (!refused.empty()) {
    sentences.push_back("MSH holds fields of 1, 3 or 9 numbers: " + array_names(refused) + not_written(refused.size()));
  }
  if (!padded.empty()) {
    sentences.push_back("MSH holds fields of 1, 3 or 9 numbers: " + array_names(padded) +
                        (padded.size() == 1 ? " gets" : " get") + " a third one, 0");
  }
  std::ranges::move(describe_rounded("MSH", "fields of floating point", held), std::back_inserter(sentences));
  if (!plan.renamed.empty()) {
    sentences.push_back("MSH holds names without quotation marks: changed are " + list_text(plan.renamed));
  }
  if (plan.renumbers_groups) {
    sentences.push_back("MSH numbers groups from 1: those of " + plan.group_arrays.text() +
                        " with other numbers get new ones");
  }
  for (const MshPlannedGroup& rest : plan.rests) {
    constexpr std::array<std::string_view, 4> kinds{"points", "lines", "surfaces", "volumes"};
    sentences.push_back("MSH drops what is in no physical group where any is, once Gmsh saves it again: " +
                        std::string(kinds.at(static_cast<std::size_t>(rest.dimension))) +
                        " without a group are written in a further one, " + std::to_string(rest.tag));
  }
  MeshDocument others;
  others.point_sets = document.point_sets;
  std::ranges::move(describe_lost_field_arrays("MSH", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_sets("MSH", others), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
