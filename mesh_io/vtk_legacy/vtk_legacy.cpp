// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_annotations.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_promotion.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_reader.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_roles.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_values.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_writer.h"

namespace trismooth {

namespace {

using Section = VtkLegacyLayout::Section;

class VtkLegacyFile : public OriginalFile {
 public:
  explicit VtkLegacyFile(FileBytes bytes) : bytes_(std::move(bytes)) {}

  MeshDocument read(const std::filesystem::path& path, const FileWorkers& workers) {
    return read_vtk_legacy(path, bytes_, workers, layout_);
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    if (document.points.size() != layout_.coordinates.offsets.size() || document.cells.size() != layout_.cell_count) {
      throw WriteError(path, "the file that was read has " + std::to_string(layout_.coordinates.offsets.size() / 3) +
                                 " points and " + std::to_string(layout_.cell_count) +
                                 " cells, the mesh to write has " + std::to_string(document.point_count()) + " and " +
                                 std::to_string(document.cells.size()));
    }
    std::string_view bytes = bytes_;
    const NumberSites* sites = &layout_.coordinates;
    VtkLegacyPromotion promotion;
    if (!holds_coordinates(layout_, document.points)) {
      promotion = promote_coordinates(bytes_, layout_);
      bytes = promotion.bytes;
      sites = &promotion.coordinates;
    }
    std::vector<VtkLegacyChanges> changes = changed_values(bytes_, layout_, document.point_arrays);
    const FileWorkers file_workers(workers);
    if (added_point_arrays.empty() && added_cell_arrays.empty() && !document.has_stale_annotations) {
      shift_sites(changes, bytes.size() - bytes_.size());
      write_changed(path, bytes, *sites, document, changes, {}, file_workers);
      return;
    }
    // All that is edited stands behind the coordinates.
    std::vector<ByteEdit> edits = layout_.without_annotations;
    const std::size_t unedited = edits.empty() ? bytes_.size() : edits.front().begin;
    while (!changes.empty() && changes.back().sites.offsets.front() >= unedited) {
      std::ranges::copy(edits_of(bytes_, changes.back()), std::back_inserter(edits));
      changes.pop_back();
    }
    std::ranges::sort(edits, {}, &ByteEdit::begin);
    shift_sites(changes, bytes.size() - bytes_.size());
    write_changed(
        path, bytes.substr(0, bytes.size() - (bytes_.size() - unedited)), *sites, document, changes,
        edited(bytes_, unedited, edits) + suffix(document, added_point_arrays, added_cell_arrays, file_workers),
        file_workers);
  }

  bool takes_added_arrays() const override { return true; }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(layout_.point_values, [point_array](const VtkLegacyValues& values) {
      return values.array.name == point_array;
    });
  }

 private:
  /// Where the coordinates take another number of bytes, all behind them stands `by` (which may wrap around) farther.
  static void shift_sites(std::span<VtkLegacyChanges> changes, std::size_t by) {
    for (VtkLegacyChanges& change : changes) {
      for (std::uint64_t& offset : change.sites.offsets) {
        offset += by;
      }
    }
  }

  /// Writes `bytes` with the document's coordinates and the changes, whose sites are in them.
  static void write_changed(const std::filesystem::path& path, std::string_view bytes, const NumberSites& coordinates,
                            const MeshDocument& document, std::span<const VtkLegacyChanges> changes,
                            std::string_view suffix, const FileWorkers& workers) {
    std::vector<std::vector<double>> copies;
    std::vector<PatchedSites> lists{{coordinates, column_values(coordinates, document, copies)}};
    for (const VtkLegacyChanges& change : changes) {
      lists.push_back({change.sites, {{change.values.data(), 1}}});
    }
    write_patched(path, bytes, lists, suffix, workers);
  }

  /// The added arrays, to stand behind the file's last byte. Annotations of an earlier run are gone then. VTK's reader
  /// takes POINT_DATA after CELL_DATA and the other way round, but neither after itself: arrays of the section that the
  /// file ends in stand first, as more of it.
  std::string suffix(const MeshDocument& document, std::span<const DataArray> point_arrays,
                     std::span<const DataArray> cell_arrays, const FileWorkers& workers) const {
    std::string text;
    VtkLegacyOutput output(
        layout_.binary, [&text](std::string_view block) { text += block; }, workers);
    // Ends an unfinished last line, and METADATA, which lasts until an empty line.
    output.text("\n\n");
    const auto add_points = [&] {
      if (!point_arrays.empty()) {
        if (layout_.last_section != Section::point_data) {
          output.text("POINT_DATA " + std::to_string(document.point_count()) + "\n");
        }
        output.field(point_arrays, layout_.point_names);
      }
    };
    const auto add_cells = [&] {
      if (!cell_arrays.empty()) {
        if (layout_.last_section != Section::cell_data) {
          output.text("CELL_DATA " + std::to_string(document.cells.size()) + "\n");
        }
        output.field(cell_arrays, layout_.cell_names);
      }
    };
    if (layout_.last_section == Section::cell_data) {
      add_cells();
      add_points();
    } else {
      add_points();
      add_cells();
    }
    return text;
  }

  FileBytes bytes_;
  VtkLegacyLayout layout_;
};

MeshDocument read(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const auto file = std::make_shared<VtkLegacyFile>(std::move(bytes));
  MeshDocument document = file->read(path, workers);
  document.original = file;
  return document;
}

bool is_vtk_legacy(std::string_view bytes) {
  constexpr std::string_view magic = "# vtk datafile version";
  return lower_case(text_head(bytes).substr(0, magic.size())) == magic;
}

}  // namespace

const Codec vtk_legacy_codec{{FileFormat::vtk,
                              "vtk",
                              "legacy VTK",
                              {".vtk"},
                              {.arrays = true, .units = true, .strips = true, .cells_of_any_order = true}},
                             &read,
                             &write_vtk_legacy,
                             &lost_in_vtk_legacy,
                             &is_vtk_legacy};

}  // namespace trismooth
