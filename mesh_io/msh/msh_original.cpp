#include "trismooth/mesh_io/msh/msh_original.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_affine_map.h"
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
    maps_.resize(layout_.nodes.size());
    std::string entities;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      MshNodeList& list = layout_.nodes[i];
      if (list.parametric.parameters > 0) {
        const auto points = points_of(list, document);
        list.parametric.points.assign(points.begin(), points.end());
        maps_[i] = MshAffineMap::find(points, list.parametric.values, list.parametric.parameters);
        if (!maps_[i] && list.parametric.dimension == 2) {
          entities.append(entities.empty() ? "" : ", ").append(std::to_string(list.parametric.entity));
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
    if (!added_point_arrays.empty() || !added_cell_arrays.empty()) {
      throw WriteError(path, "no arrays can be added to the file that was read");
    }
    if (document.point_count() != vertex_count_ || document.cells.size() != layout_.cell_count) {
      throw WriteError(path, "the file that was read has " + std::to_string(vertex_count_) + " points and " +
                                 std::to_string(layout_.cell_count) + " cells, the mesh to write has " +
                                 std::to_string(document.point_count()) + " and " +
                                 std::to_string(document.cells.size()));
    }
    std::vector<bool> left_out(layout_.nodes.size());
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      left_out[i] = layout_.nodes[i].parametric.parameters > 0 && !maps_[i] && has_moved(layout_.nodes[i], document);
    }
    if (std::ranges::find(left_out, true) != left_out.end()) {
      MshOriginal without{FileBytes(without_msh_parameters(bytes_, layout_, left_out))};
      without.read(path, FileWorkers(workers));
      without.write(path, document, {}, {}, workers);
      return;
    }
    write_numbers(path, document, FileWorkers(workers));
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(
        layout_.data, [point_array](const NumberSites& sites) { return sites.columns.front().array == point_array; });
  }

 private:
  static bool has_moved(const MshNodeList& list, const MeshDocument& document) {
    return !std::ranges::equal(list.parametric.points, points_of(list, document));
  }

  void write_numbers(const std::filesystem::path& path, const MeshDocument& document,
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
    std::ranges::sort(order, {}, [&lists](std::size_t i) { return lists[i].sites.offsets.front(); });
    std::vector<PatchedSites> ordered;
    ordered.reserve(lists.size());
    for (const std::size_t i : order) {
      ordered.push_back({lists[i].sites, std::move(lists[i].values)});
    }
    write_patched(path, bytes_, ordered, {}, workers);
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
