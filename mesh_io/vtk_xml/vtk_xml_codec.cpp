// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/vtk_xml/vtk_array_description.h"
#include "trismooth/mesh_io/vtk_xml/vtk_arrays.h"
#include "trismooth/mesh_io/vtk_xml/vtk_cells.h"
#include "trismooth/mesh_io/vtk_xml/vtk_data_sets.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_descriptions.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_reader.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_writer.h"

namespace trismooth {

namespace {

/// The points of the document as an unnamed VTK array of its point type; a view of the document's where it can be.
vtkSmartPointer<vtkDataArray> make_points_array(const MeshDocument& document) {
  if (document.point_type == ScalarType::float64) {
    return view_as_vtk_array({"", ScalarType::float64, 3, std::as_bytes(std::span(document.points)), nullptr});
  }
  MemoryBlock numbers;
  auto* const target = reinterpret_cast<float*>(numbers.extend(document.points.size() * sizeof(float)));
  std::ranges::transform(document.points, target, [](double coordinate) { return static_cast<float>(coordinate); });
  return make_vtk_array(ScalarType::float32, 3, std::move(numbers));
}

void set_points(vtkPointSet& data, vtkDataArray& array) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(&array);
  data.SetPoints(points);
}

/// Adds views of the arrays; where a name is taken, "_1", "_2", ... makes another.
void add_arrays(std::span<const DataArray> arrays, vtkFieldData& fields) {
  FreeNames names;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    if (const char* const name = fields.GetArrayName(i)) {
      names.take(name);
    }
  }
  reserve_vtk_arrays(fields, arrays.size());
  for (const DataArray& array : arrays) {
    add_vtk_array(fields, *view_as_vtk_array(array), names.claim(array.name));
  }
}

/// Puts the point arrays of a document in the place of those of its file that have other numbers. `read` are the
/// file's, `data` is a copy of it.
void replace_changed(vtkFieldData& read, std::span<const DataArray> arrays, vtkPointSet& data) {
  std::size_t next = 0;
  for (int i = 0; i < read.GetNumberOfArrays() && next < arrays.size(); ++i) {
    const std::optional<DataArray> view = view_as_data_array(read.GetAbstractArray(i));
    if (!view) {
      continue;
    }
    auto* const old = vtkDataArray::SafeDownCast(read.GetAbstractArray(i));
    const DataArray& array = arrays[next++];
    const bool is_other = array.name == view->name && array.type == view->type &&
                          array.components == view->components && array.bytes.size() == view->bytes.size() &&
                          array.bytes.data() != view->bytes.data();
    if (!is_other) {
      continue;
    }
    const vtkSmartPointer<vtkDataArray> changed =
        view_as_vtk_array({array.name, array.type, array.components, array.bytes, array.owner});
    changed->SetName(old->GetName());
    for (int component = 0; component < old->GetNumberOfComponents(); ++component) {
      if (const char* const name = old->GetComponentName(component)) {
        changed->SetComponentName(component, name);
      }
    }
    changed->CopyInformation(old->GetInformation(), 1);
    replace_point_array(data, i, *changed);
  }
}

void remove_annotations(vtkFieldData& fields) {
  for (int i = fields.GetNumberOfArrays() - 1; i >= 0; --i) {
    const char* const name = fields.GetAbstractArray(i)->GetName();
    if (name != nullptr && is_annotation(name)) {
      fields.RemoveArray(i);
    }
  }
}

/// Points and arrays of a document from elsewhere; `cell_arrays` in the order of the cells of `data`.
void set_points_and_arrays(vtkPointSet& data, const MeshDocument& document, std::span<const DataArray> cell_arrays) {
  std::vector<std::string> losses;  // said by lost_descriptions()
  const vtkSmartPointer<vtkDataArray> points = make_points_array(document);
  points->SetName("Points");
  describe(*points, document.points_description.get(), losses);
  set_points(data, *points);
  add_arrays(document.point_arrays, *data.GetPointData());
  add_arrays(cell_arrays, *data.GetCellData());
  add_arrays(document.field_arrays, *data.GetFieldData());
  set_roles(document.point_arrays, *data.GetPointData(), losses);
  set_roles(cell_arrays, *data.GetCellData(), losses);
}

class VtkXmlOriginal : public OriginalFile {
 public:
  /// The document holds the coordinates: here is kept what else the file says of them.
  explicit VtkXmlOriginal(VtkXmlFile file) : file_(std::move(file)) {
    vtkDataArray* const points = file_.data->GetPoints()->GetData();
    point_value_count_ = points->GetNumberOfValues();
    points->Initialize();
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    const vtkSmartPointer<vtkPointSet> copy = shallow_copy(*file_.data);
    vtkDataArray* const old_points = file_.data->GetPoints()->GetData();
    const vtkSmartPointer<vtkDataArray> points = make_points_array(document);
    if (points->GetNumberOfValues() != point_value_count_) {
      throw WriteError(path, "the mesh has not the points of the file that was read");
    }
    points->SetName(old_points->GetName());
    for (int i = 0; i < 3; ++i) {
      if (const char* const name = old_points->GetComponentName(i)) {
        points->SetComponentName(i, name);
      }
    }
    points->CopyInformation(old_points->GetInformation(), 1);
    set_points(*copy, *points);
    replace_changed(*file_.data->GetPointData(), document.point_arrays, *copy);
    if (!added_point_arrays.empty() || !added_cell_arrays.empty() || document.has_stale_annotations) {
      remove_annotations(*copy->GetPointData());
      remove_annotations(*copy->GetCellData());
    }
    add_arrays(added_point_arrays, *copy->GetPointData());
    add_arrays(added_cell_arrays, *copy->GetCellData());
    write_vtk_xml(path, *copy, file_.encoding, file_.attributes, FileWorkers(workers));
  }

  bool takes_added_arrays() const override { return true; }

  bool keeps_values_of(std::string_view point_array) const override {
    vtkFieldData& arrays = *file_.data->GetPointData();
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
      const std::optional<DataArray> view = view_as_data_array(arrays.GetAbstractArray(i));
      if (view && view->name == point_array &&
          (view->type == ScalarType::float32 || view->type == ScalarType::float64)) {
        return true;
      }
    }
    return false;
  }

 private:
  VtkXmlFile file_;
  vtkIdType point_value_count_;
};

void copy_points(const std::filesystem::path& path, vtkPointSet& data, const FileWorkers& workers,
                 MeshDocument& document) {
  vtkDataArray* const array = data.GetPoints()->GetData();
  const std::optional<DataArray> view = view_as_data_array(array);
  document.point_type = view->type;
  document.points_description = view->description;
  shared_resize(document.points, view->bytes.size() / size_of(view->type), workers.workers);
  const auto copy = [&](auto values) {
    const auto is_finite = [](auto x) { return std::isfinite(x); };
    const bool all_finite =
        all_file_blocks(workers, values.size(), sizeof(double), [&](std::size_t begin, std::size_t end) {
          const auto block = values.subspan(begin, end - begin);
          std::ranges::copy(block, document.points.begin() + static_cast<std::ptrdiff_t>(begin));
          return std::ranges::all_of(block, is_finite);
        });
    if (!all_finite) {
      const auto bad = std::ranges::find_if_not(values, is_finite);
      throw ReadError(path, "point " + std::to_string((bad - values.begin()) / 3) + " is not finite");
    }
  };
  view->type == ScalarType::float64 ? copy(view->as<double>()) : copy(view->as<float>());
}

void copy_cells(vtkPointSet& data, const FileWorkers& workers, CellList& cells) {
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data)) {
    vtkUnsignedCharArray* const types = grid->GetCellTypesArray();
    const auto count = static_cast<std::size_t>(types->GetNumberOfValues());
    append_cells(*grid->GetCells(), std::span(types->GetPointer(0), count), workers, cells);
    return;
  }
  auto& poly_data = *vtkPolyData::SafeDownCast(&data);
  append_cells(*poly_data.GetVerts(), PolyDataGroup::verts, workers, cells);
  append_cells(*poly_data.GetLines(), PolyDataGroup::lines, workers, cells);
  append_cells(*poly_data.GetPolys(), PolyDataGroup::polys, workers, cells);
  append_cells(*poly_data.GetStrips(), PolyDataGroup::strips, workers, cells);
}

/// What of the descriptions a data set does not get, found by giving them to arrays without numbers of their own.
std::vector<std::string> lost_descriptions(const MeshDocument& document) {
  std::vector<std::string> losses;
  std::vector<DataArray> with_roles;
  const auto try_all = [&](std::span<const DataArray> arrays) {
    with_roles.clear();
    for (const DataArray& array : arrays) {
      if (array.description != nullptr) {
        view_as_vtk_array(array, losses);
        if (!array.description->roles.empty()) {
          with_roles.push_back(array);
        }
      }
    }
  };
  const auto try_roles = [&](vtkDataSetAttributes& attributes) {
    add_arrays(with_roles, attributes);
    set_roles(with_roles, attributes, losses);
  };
  try_all(document.point_arrays);
  try_roles(*vtkNew<vtkPointData>());
  try_all(document.cell_arrays);
  try_roles(*vtkNew<vtkCellData>());
  try_all(document.field_arrays);
  view_as_vtk_array({"Points", ScalarType::float64, 3, {}, nullptr, document.points_description}, losses);
  return losses;
}

std::vector<DataArray> views_of(vtkFieldData& fields, std::string_view where, VtkXmlMode mode,
                                std::vector<std::string>& notes) {
  std::vector<DataArray> views;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    vtkAbstractArray* const array = fields.GetAbstractArray(i);
    if (std::optional<DataArray> view = view_as_data_array(array)) {
      if (mode == VtkXmlMode::ascii && holds_non_finite(*view)) {
        notes.push_back("the " + std::string(where) + " array " + view->name +
                        " holds values that are not finite; VTU and VTP get it as base64, which VTK can read");
      }
      views.push_back(std::move(*view));
    } else {
      const bool has_strings = vtkStringArray::SafeDownCast(array) != nullptr;
      notes.push_back(std::string(where) + " array " + trismooth::quoted(array->GetName()) +
                      (has_strings ? " holds strings" : " holds no numbers") +
                      ": it is kept in VTU and VTP only, not in other formats");
    }
  }
  if (auto* const attributes = vtkDataSetAttributes::SafeDownCast(&fields)) {
    add_roles(*attributes, views);
  }
  return views;
}

/// The arrays of strings of one component.
std::vector<LabelArray> labels_of(vtkFieldData& fields) {
  std::vector<LabelArray> labels;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    auto* const array = vtkStringArray::SafeDownCast(fields.GetAbstractArray(i));
    if (array != nullptr && array->GetNumberOfComponents() == 1) {
      const auto count = static_cast<std::size_t>(array->GetNumberOfValues());
      const auto* const strings = count == 0 ? nullptr : array->GetPointer(0);
      const std::vector<std::string_view> texts(strings, strings + count);
      labels.push_back(make_label_array(array->GetName(), texts));
    }
  }
  return labels;
}

template <VtkXmlKind kind>
MeshDocument read(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  try {
    constexpr std::size_t for_buffers = std::size_t{4} << 20;
    require_host_memory(2 * bytes.size() + for_buffers);  // what VTK's arrays take at least
    VtkXmlFile file = read_vtk_xml(path, bytes, kind, workers);
    // The bytes go before the cells come: not both in memory at once.
    bytes = FileBytes();
    MeshDocument document;
    document.losses = std::move(file.losses);
    document.notes = std::move(file.notes);
    copy_points(path, *file.data, workers, document);
    copy_cells(*file.data, workers, document.cells);
    document.point_arrays = views_of(*file.data->GetPointData(), "point", file.encoding.mode, document.notes);
    document.cell_arrays = views_of(*file.data->GetCellData(), "cell", file.encoding.mode, document.notes);
    document.cell_labels = labels_of(*file.data->GetCellData());
    document.field_arrays = views_of(*file.data->GetFieldData(), "field", file.encoding.mode, document.notes);
    document.original = std::make_shared<VtkXmlOriginal>(std::move(file));
    return document;
  } catch (const std::bad_alloc&) {
    throw ReadError(path, "is too large for the memory of this machine");
  }
}

std::vector<std::size_t> all_cells(const CellList& cells) {
  std::vector<std::size_t> all(cells.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

void write_unstructured_grid(const std::filesystem::path& path, const MeshDocument& document,
                             const FileWorkers& workers) {
  const auto types = vtkSmartPointer<vtkUnsignedCharArray>::New();
  types->SetNumberOfValues(static_cast<vtkIdType>(document.cells.size()));
  std::ranges::copy(document.cells.types, types->GetPointer(0));
  const vtkSmartPointer<vtkUnstructuredGrid> grid = make_unstructured_grid();
  grid->SetCells(types, make_vtk_cells(document.cells, all_cells(document.cells), workers));
  set_points_and_arrays(*grid, document, document.cell_arrays);
  write_vtk_xml(path, *grid, {}, {}, workers);
}

/// The cells that a vtkPolyData holds, group by group.
std::array<std::vector<std::size_t>, poly_data_groups> group_cells(const CellList& cells) {
  std::array<std::vector<std::size_t>, poly_data_groups> groups;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (const auto group = poly_data_group_of(cells.types[cell])) {
      groups[static_cast<std::size_t>(*group)].push_back(cell);
    }
  }
  return groups;
}

std::vector<std::size_t> joined(const std::array<std::vector<std::size_t>, poly_data_groups>& groups) {
  std::vector<std::size_t> order;
  for (const auto& group : groups) {
    order.insert(order.end(), group.begin(), group.end());
  }
  return order;
}

DataArray with_ordered_rows(const DataArray& array, std::span<const std::size_t> rows) {
  const std::size_t row_size = array.components * size_of(array.type);
  auto bytes = std::make_shared<std::vector<std::byte>>();
  bytes->reserve(rows.size() * row_size);
  for (const std::size_t row : rows) {
    const auto from = array.bytes.subspan(row * row_size, row_size);
    bytes->insert(bytes->end(), from.begin(), from.end());
  }
  return {array.name, array.type, array.components, *bytes, bytes, array.description};
}

void write_poly_data(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const auto groups = group_cells(document.cells);
  const vtkSmartPointer<vtkPolyData> data = make_poly_data();
  data->SetVerts(make_vtk_cells(document.cells, groups[static_cast<std::size_t>(PolyDataGroup::verts)], workers));
  data->SetLines(make_vtk_cells(document.cells, groups[static_cast<std::size_t>(PolyDataGroup::lines)], workers));
  data->SetPolys(make_vtk_cells(document.cells, groups[static_cast<std::size_t>(PolyDataGroup::polys)], workers));
  data->SetStrips(make_vtk_cells(document.cells, groups[static_cast<std::size_t>(PolyDataGroup::strips)], workers));
  std::vector<DataArray> cell_arrays = document.cell_arrays;
  const std::vector<std::size_t> order = joined(groups);
  if (order.size() != document.cells.size() || !std::ranges::is_sorted(order)) {
    std::ranges::transform(document.cell_arrays, cell_arrays.begin(),
                           [&order](const DataArray& array) { return with_ordered_rows(array, order); });
  }
  set_points_and_arrays(*data, document, cell_arrays);
  write_vtk_xml(path, *data, {}, {}, workers);
}

std::vector<std::string> lost_in_unstructured_grid(const MeshDocument& document) {
  return lost_descriptions(document);
}

std::vector<std::string> lost_in_poly_data(const MeshDocument& document) {
  std::map<std::uint8_t, std::size_t> dropped;
  for (const std::uint8_t type : document.cells.types) {
    if (!poly_data_group_of(type)) {
      ++dropped[type];
    }
  }
  std::vector<std::string> sentences = lost_descriptions(document);
  for (const auto& [type, count] : dropped) {
    sentences.push_back("VTP holds no cells of type " + std::to_string(type) + ": " +
                        counted(count, "cell is", "cells are") + " not written");
  }
  if (!std::ranges::is_sorted(joined(group_cells(document.cells)))) {
    sentences.emplace_back("VTP holds vertices, lines, polygons and strips apart: the order of the cells changes");
  }
  return sentences;
}

/// By the type that the root of the document states.
template <VtkXmlKind kind>
bool is_vtk_xml(std::string_view bytes) {
  const std::string_view head = text_head(bytes);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  const std::size_t root = head.find("<VTKFile");
  if (root == head.npos || head[first] != '<') {
    return false;
  }
  const std::string_view tag = head.substr(root, head.substr(root).find('>'));
  const std::string name(to_string(kind));
  return tag.find('"' + name + '"') != tag.npos || tag.find("'" + name + "'") != tag.npos;
}

}  // namespace

const Codec vtu_codec{vtu_description, &read<VtkXmlKind::unstructured_grid>, &write_unstructured_grid,
                      &lost_in_unstructured_grid, &is_vtk_xml<VtkXmlKind::unstructured_grid>};
const Codec vtp_codec{vtp_description, &read<VtkXmlKind::poly_data>, &write_poly_data, &lost_in_poly_data,
                      &is_vtk_xml<VtkXmlKind::poly_data>};

}  // namespace trismooth
