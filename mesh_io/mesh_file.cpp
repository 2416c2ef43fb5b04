// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mesh_file.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/bytes/file_content.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/collapsed_quads.h"
#include "trismooth/mesh_io/document/cells/empty_groups.h"
#include "trismooth/mesh_io/document/cells/halved_quads.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/document/cells/straight_cells.h"
#include "trismooth/mesh_io/document/cells/strip_triangles.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/format_choice.h"
#include "trismooth/mesh_io/mesh_output.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Formats state the rows of arrays by the counts of points and cells.
void require_rows(const std::filesystem::path& path, std::span<const DataArray> arrays, std::size_t rows,
                  std::string_view of) {
  for (const DataArray& array : arrays) {
    if (array.bytes.size() != rows * array.components * size_of(array.type)) {
      throw WriteError(path, "the array " + trismooth::quoted(array.name) + " has " + std::to_string(array.rows()) +
                                 " rows, the mesh to write has " + std::to_string(rows) + " " + std::string(of));
    }
  }
}

/// A file that can neither take arrays nor leave them out is made anew where it has stale ones.
bool is_written_back(const MeshDocument& document, FileFormat target) {
  return document.original != nullptr && document.format == target &&
         (!document.has_stale_annotations || document.original->takes_added_arrays());
}

void replace_annotations(std::vector<DataArray>& arrays, std::span<const DataArray> added) {
  std::erase_if(arrays, [](const DataArray& array) { return is_annotation(array.name); });
  arrays.insert(arrays.end(), added.begin(), added.end());
}

/// What has_strips() as a format holds it that has no strips.
std::string describe_strips(const MeshDocument& document, const MeshDocument& expanded, FileFormat target) {
  const auto strips = std::ranges::count(document.cells.types, cell_type::triangle_strip);
  const std::size_t triangles = expanded.cells.size() + static_cast<std::size_t>(strips) - document.cells.size();
  return upper_case(to_string(target)) + " holds no triangle strips: " + counted(strips, "is", "are") + " written as " +
         counted(triangles, "triangle", "triangles");
}

/// What has_curved_cells() as a format holds it that has none of these, or straight ones only.
std::string describe_straight(const MeshDocument& document, const MeshDocument& straight, CurvedCells which,
                              FileFormat target) {
  std::size_t cells = 0;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    cells += document.cells.types[cell] == straight.cells.types[cell] ? 0 : 1;
  }
  const std::size_t points = document.point_count() - straight.point_count();
  return std::string(title_of(target)) +
         (which == CurvedCells::all
              ? " holds straight cells only: " + counted(cells, "curved one is", "curved ones are")
              : " holds no quadrilaterals of eight nodes: " + counted(cells, "one is", "ones are")) +
         " written by their corners" +
         (points == 0 ? "" : ", without " + std::to_string(points) + " points in the middle of sides");
}

/// What a format that holds triangles only gets in place of that many quadrilaterals.
std::string describe_halved(std::size_t quads, FileFormat target) {
  return std::string(title_of(target)) + " holds triangles only: " +
         counted(quads, "quadrilateral is written as the two into which its shorter diagonal cuts it",
                 "quadrilaterals are written as the two each into which their shorter diagonals cut them");
}

/// What a format gets in place of that many quadrilaterals that repeat a corner, if it does not hold these.
std::string describe_collapsed(std::size_t quads, FileFormat target) {
  return std::string(title_of(target)) + " holds no quadrilaterals that repeat a corner: " +
         counted(quads, "is written as the triangle that it is", "are written as the triangles that they are");
}

/// The document as the target can hold it, where it cannot hold strips, curved cells, quadrilaterals, cells of any
/// order or groups without members that the document has; what changes thereby is added to `losses`.
std::optional<MeshDocument> adapted(const MeshDocument& document, FileFormat target, std::vector<std::string>& losses) {
  const FormatContent& holds = codec_of(target).description.holds;
  std::optional<MeshDocument> changed;
  const auto now = [&]() -> const MeshDocument& { return changed ? *changed : document; };
  if (!holds.cells_of_any_order && has_cells_of_any_order(document)) {
    changed = with_fixed_orders(document);
  }
  if (!holds.strips && has_strips(now())) {
    MeshDocument expanded = with_strips_as_triangles(now());
    losses.push_back(describe_strips(now(), expanded, target));
    changed = std::move(expanded);
  }
  if (const std::size_t quads = holds.collapsed_quads ? 0 : count_collapsed_quads(now()); quads > 0) {
    losses.push_back(describe_collapsed(quads, target));
    changed = with_collapsed_quads_as_triangles(now());
  }
  const bool holds_curved = holds.curved_cells && (holds.quads || !has_curved_quads(now()));
  const CurvedCells not_held = holds_curved ? CurvedCells::eight_node_quads : CurvedCells::all;
  if (!(holds_curved && holds.eight_node_quads) && has_curved_cells(now(), not_held)) {
    MeshDocument straight = with_straight_cells(now(), not_held);
    losses.push_back(describe_straight(now(), straight, not_held, target));
    changed = std::move(straight);
  }
  if (const std::size_t quads = holds.quads ? 0 : count_quads(now()); quads > 0) {
    losses.push_back(describe_halved(quads, target));
    changed = with_halved_quads(now());
  }
  if (const auto names = holds.empty_groups ? std::vector<std::string>{} : names_of_empty_groups(now());
      !names.empty()) {
    losses.push_back(std::string(title_of(target)) + " output has no groups without members: " + list_text(names) +
                     not_written(names.size()));
    changed = without_empty_groups(now());
  }
  return changed;
}

std::vector<std::string> lost_in(const MeshDocument& document, FileFormat target) {
  std::vector<std::string> lost = codec_of(target).what_is_lost(document);
  if (has_arrays(target) && !codec_of(target).description.holds.units) {
    std::ranges::move(describe_lost_units(title_of(target), document), std::back_inserter(lost));
  }
  if (!has_names(target)) {
    // Names of arrays that are lost as a whole are not worth a word.
    if (has_arrays(target)) {
      std::ranges::move(describe_lost_names(title_of(target), document), std::back_inserter(lost));
    }
    std::ranges::move(describe_lost_sets(title_of(target), document), std::back_inserter(lost));
  }
  if (!document.point_labels.empty()) {
    const auto [least, most] = std::ranges::minmax(document.point_labels);
    lost.push_back(std::string(title_of(target)) + " output numbers points anew: the file's own numbers, from " +
                   std::to_string(least) + " to " + std::to_string(most) + ", are not written");
  }
  return lost;
}

void write_plain(const std::filesystem::path& path, FileFormat format, const MeshDocument& document,
                 const AddedArrays& added, Workers& workers) {
  if (is_written_back(document, format)) {
    document.original->write(path, document, added.point_arrays, added.cell_arrays, workers);
    return;
  }
  const bool adds = takes_added_arrays(document, format) && !(added.point_arrays.empty() && added.cell_arrays.empty());
  std::optional<MeshDocument> changed;
  if (adds) {
    changed = document;
    replace_annotations(changed->point_arrays, added.point_arrays);
    replace_annotations(changed->cell_arrays, added.cell_arrays);
  }
  std::vector<std::string> losses;  // said by what_is_lost()
  if (auto held = adapted(changed ? *changed : document, format, losses)) {
    changed = std::move(held);
  }
  codec_of(format).write_shared(path, changed ? *changed : document, FileWorkers(workers));
}

}  // namespace

MeshDocument read_mesh(const std::filesystem::path& path, const FileOptions& options) {
  Workers workers(options.threads);
  const FileWorkers file_workers(workers);
  FileContent content = read_content(path, file_workers);
  FormatChoice choice = choose_format(content.name, content.bytes, options.format);
  const Codec& codec = codec_of(choice.format);
  if (codec.partner_of != nullptr && !content.is_plain_file) {
    throw ReadError(content.name, std::string(title_of(choice.format)) +
                                      " has a mesh in several files: they are read as plain files, uncompressed");
  }
  MeshDocument document = codec.read_shared(content.name, std::move(content.bytes), file_workers);
  document.format = choice.format;
  if (!document.first_point_label) {
    document.first_point_label = codec.description.first_point_label;
  }
  for (std::string& note : {std::ref(content.note), std::ref(choice.note)}) {
    if (!note.empty()) {
      document.notes.push_back(std::move(note));
    }
  }
  return document;
}

MeshDocument read_mesh(const std::filesystem::path& path, int threads) {
  return read_mesh(path, FileOptions{threads, std::nullopt});
}

WrittenAside write_mesh_aside(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                              const FileOptions& options) {
  const FileFormat format = output_format(path, document.format, options.format);
  const std::filesystem::path name = shown_output(path);
  Workers workers(options.threads);
  for (const auto& arrays : {std::span(document.point_arrays), std::span(added.point_arrays)}) {
    require_rows(name, arrays, document.point_count(), "points");
  }
  for (const auto& arrays : {std::span(document.cell_arrays), std::span(added.cell_arrays)}) {
    require_rows(name, arrays, document.cells.size(), "cells");
  }
  const auto write = [&](const std::filesystem::path& plain) { write_plain(plain, format, document, added, workers); };
  const Codec& codec = codec_of(format);
  if (codec.partner_of != nullptr) {
    return write_two_files_aside(path, codec.partner_of, write);
  }
  std::vector<std::filesystem::path> others;
  if (is_written_back(document, format)) {
    others = document.original->other_files(path);
  } else if (codec.other_files_of != nullptr) {
    others = codec.other_files_of(path);
  }
  return others.empty() ? write_content_aside(path, FileWorkers(workers), write)
                        : write_files_aside(path, others, write);
}

void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                const FileOptions& options) {
  try {
    require_sound(document);
  } catch (const MeshError& error) {
    throw WriteError(shown_output(path), error.what());
  }
  write_mesh_aside(path, document, added, options).commit();
}

void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                int threads) {
  write_mesh(path, document, added, FileOptions{threads, std::nullopt});
}

std::vector<std::string> what_is_lost(const MeshDocument& document, FileFormat target) {
  if (is_written_back(document, target)) {
    return {};
  }
  std::vector<std::string> lost;
  const std::optional<MeshDocument> changed = adapted(document, target, lost);
  std::ranges::move(lost_in(changed ? *changed : document, target), std::back_inserter(lost));
  return lost;
}

bool writes_values_of(const MeshDocument& document, FileFormat target, std::string_view point_array) {
  return !is_written_back(document, target) || document.original->keeps_values_of(point_array);
}

bool takes_added_arrays(const MeshDocument& document, FileFormat target) {
  return is_written_back(document, target) ? document.original->takes_added_arrays() : has_arrays(target);
}

}  // namespace trismooth
