// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_original.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_affine_map.h"
#include "trismooth/mesh_io/msh/msh_excerpt.h"
#include "trismooth/mesh_io/msh/msh_fields.h"
#include "trismooth/mesh_io/msh/msh_without_parameters.h"

namespace trismooth {

namespace {

std::span<const double> points_of(const MshNodeList& list, const MeshDocument& document) {
  return std::span(document.points).subspan(3 * list.first_vertex, 3 * list.size());
}

class MshOriginal : public OriginalFile {
 public:
  explicit MshOriginal(FileBytes bytes) : bytes_(std::move(bytes)) {}

  MeshDocument read(const std::filesystem::path& path, const FileWorkers& workers) {
    MeshDocument document = read_msh(path, bytes_, workers, layout_);
    vertex_count_ = document.point_count();
    if (const auto run = layout_.node_tags.only_run()) {
      document.first_point_label = run->first;
    } else {
      set_point_labels(document, layout_.node_tags.listed());
    }
    maps_.resize(layout_.nodes.size());
    std::string entities;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      MshNodeList& list = layout_.nodes[i];
      if (list.parametric.parameters > 0) {
        const auto points = points_of(list, document);
        list.parametric.points.assign(points.begin(), points.end());
        maps_[i] = MshAffineMap::find(points, list.parametric.values, list.parametric.parameters);
        if (!maps_[i] && list.parametric.dimension == 2) {
          add_to_list(entities, std::to_string(list.parametric.entity));
        }
      }
    }
    if (!entities.empty()) {
      document.notes.push_back("The parametric coordinates on surfaces that are not plane (" + entities +
                               ") are left out of MSH output where a node of the surface moves.");
    }
    return document;
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    if (document.point_count() != vertex_count_ || document.cells.size() != layout_.cell_count) {
      throw WriteError(path, "the file that was read has " + std::to_string(vertex_count_) + " points and " +
                                 std::to_string(layout_.cell_count) + " cells, the mesh to write has " +
                                 std::to_string(document.point_count()) + " and " +
                                 std::to_string(document.cells.size()));
    }
    const bool adds = !added_point_arrays.empty() || !added_cell_arrays.empty();
    if (adds && !takes_added_arrays()) {
      throw WriteError(path, "no arrays can be added to the file that was read");
    }
    if ((adds || document.has_stale_annotations) && !layout_.annotations.empty()) {
      write_as(without_annotations(), path, document, added_point_arrays, added_cell_arrays, workers);
      return;
    }
    std::vector<bool> left_out(layout_.nodes.size());
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      left_out[i] = layout_.nodes[i].parametric.parameters > 0 && !maps_[i] && has_moved(layout_.nodes[i], document);
    }
    if (std::ranges::find(left_out, true) != left_out.end()) {
      write_as(without_msh_parameters(bytes_, layout_, left_out), path, document, added_point_arrays, added_cell_arrays,
               workers);
      return;
    }
    const FileWorkers file_workers(workers);
    write_numbers(path, document, adds ? sections_of(added_point_arrays, added_cell_arrays, file_workers) : "",
                  file_workers);
  }

  /// Version 1 has no fields. The tags in fields are ints in every version.
  bool takes_added_arrays() const override {
    return layout_.header.version >= 20 && layout_.node_tags.largest() <= largest_msh_int &&
           layout_.element_tags.largest() <= largest_msh_int;
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(layout_.data,
                               [point_array](const NumberSites& sites) { return sites.has_values_of(point_array); });
  }

 private:
  /// As if `bytes` were the file that was read, which has the same nodes and elements.
  static void write_as(const std::string& bytes, const std::filesystem::path& path, const MeshDocument& document,
                       std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
                       Workers& workers) {
    MshOriginal other{FileBytes(bytes)};
    other.read(path, FileWorkers(workers));
    other.write(path, document, added_point_arrays, added_cell_arrays, workers);
  }

  std::string without_annotations() const {
    MshExcerpt excerpt(bytes_);
    for (const MshSpan& section : layout_.annotations) {
      excerpt.copy_until(section.begin);
      excerpt.pass(section.end);
    }
    return excerpt.finish();
  }

  /// To stand behind the file's last byte.
  std::string sections_of(std::span<const DataArray> point_arrays, std::span<const DataArray> cell_arrays,
                          const FileWorkers& workers) const {
    const std::string_view bytes = bytes_;
    std::string text(bytes.ends_with('\n') ? "" : "\n");
    OrderedBlocks blocks([&text](std::string_view block) { text += block; }, workers);
    FreeNames names;
    for (const std::string& name : layout_.field_names) {
      names.take(name);
    }
    const auto add = [&](DataArray array, const MshFieldRows& rows) {
      array.name = names.claim(array.name);
      write_msh_field(blocks, layout_.header, rows, array);
    };
    const std::vector<std::int64_t> nodes = layout_.node_tags.listed();
    for (const DataArray& array : point_arrays) {
      add(array, {.of_nodes = true, .size = nodes.size(), .tags = nodes});
    }
    const std::vector<std::int64_t> elements = layout_.element_tags.listed();
    for (const DataArray& array : cell_arrays) {
      add(array, {.of_nodes = false, .size = elements.size(), .tags = elements, .places = layout_.element_cells});
    }
    return text;
  }

  static bool has_moved(const MshNodeList& list, const MeshDocument& document) {
    return !std::ranges::equal(list.parametric.points, points_of(list, document));
  }

  void write_numbers(const std::filesystem::path& path, const MeshDocument& document, std::string_view suffix,
                     const FileWorkers& workers) const {
    std::vector<std::vector<double>> parameters(layout_.nodes.size());
    std::vector<std::vector<double>> copies;
    std::vector<PatchedSites> lists;
    lists.reserve(layout_.nodes.size() + layout_.data.size());
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      const MshNodeList& list = layout_.nodes[i];
      if (list.size() == 0) {
        continue;
      }
      const double* const points = points_of(list, document).data();
      std::vector<ColumnValues> values{{points, 3}, {points + 1, 3}, {points + 2, 3}};
      const std::size_t count = list.parametric.parameters;
      values.resize(3 + count);
      if (count > 0 && has_moved(list, document)) {
        parameters[i] = moved_parameters(list, *maps_[i], document);
        for (std::size_t k = 0; k < count; ++k) {
          values[3 + k] = {parameters[i].data() + k, count};
        }
      }
      lists.push_back({list.sites, std::move(values)});
    }
    for (const NumberSites& sites : layout_.data) {
      if (sites.size() > 0) {
        lists.push_back({sites, column_values(sites, document, copies)});
      }
    }
    std::vector<std::size_t> order(lists.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    // Fields may stand in front of the nodes.
    std::ranges::sort(order, {}, [&lists](std::size_t i) { return lists[i].sites.offset_of(0, 0); });
    std::vector<PatchedSites> ordered;
    ordered.reserve(lists.size());
    for (const std::size_t i : order) {
      ordered.push_back({lists[i].sites, std::move(lists[i].values)});
    }
    write_patched(path, bytes_, ordered, suffix, workers);
  }

  static std::vector<double> moved_parameters(const MshNodeList& list, const MshAffineMap& map,
                                              const MeshDocument& document) {
    const std::span<const double> before = list.parametric.points;
    const std::span<const double> after = points_of(list, document);
    std::vector<double> values = list.parametric.values;
    const std::size_t count = list.parametric.parameters;
    for (std::size_t node = 0; node < list.size(); ++node) {
      const std::array<double, 3> way{after[3 * node] - before[3 * node], after[3 * node + 1] - before[3 * node + 1],
                                      after[3 * node + 2] - before[3 * node + 2]};
      if (way != std::array<double, 3>{}) {
        for (std::size_t k = 0; k < count; ++k) {
          values[count * node + k] += map.change(way, k);
        }
      }
    }
    return values;
  }

  FileBytes bytes_;
  MshLayout layout_;
  std::vector<std::optional<MshAffineMap>> maps_;  ///< of every list of nodes
  std::size_t vertex_count_ = 0;
};

}  // namespace

MeshDocument read_msh_file(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const auto file = std::make_shared<MshOriginal>(std::move(bytes));
  MeshDocument document = file->read(path, workers);
  document.original = file;
  return document;
}

}  // namespace trismooth
