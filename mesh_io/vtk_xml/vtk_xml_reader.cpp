// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_reader.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/bytes/exact_integers.h"
#include "trismooth/mesh_io/document/array_limits.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_arrays.h"
#include "trismooth/mesh_io/vtk_xml/vtk_data_sets.h"
#include "trismooth/mesh_io/vtk_xml/vtk_information.h"
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_attributes.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_cells_reader.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_cuts.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_shared_arrays.h"

namespace trismooth {

namespace {

using Values = VtkXmlArrayType::Values;

/// The values of an array as they are decoded piece by piece.
struct DecodedArray {
  VtkXmlArrayType type;
  MemoryBlock numbers;  ///< of bits, one byte each
  std::vector<std::string> strings;

  std::size_t value_size() const { return type.values == Values::numbers ? size_of(type.type) : 1; }
};

void decode(VtkXmlDecoder& decoder, const XmlElement& array, std::uint64_t rows, DecodedArray& into) {
  const std::uint64_t count = rows * into.type.components;
  switch (into.type.values) {
    case Values::numbers:
      return decoder.read_numbers(array, into.type.type, count, into.numbers);
    case Values::bits:
      return decoder.read_bits(array, count, into.numbers);
    case Values::strings:
      return decoder.read_strings(array, count, into.strings);
  }
}

/// Row i becomes what row order[i] was.
void reorder(DecodedArray& array, const std::vector<std::uint64_t>& order) {
  const std::size_t components = array.type.components;
  if (array.type.values == Values::strings) {
    std::vector<std::string> strings;
    for (const std::uint64_t row : order) {
      std::move(array.strings.begin() + static_cast<std::ptrdiff_t>(row * components),
                array.strings.begin() + static_cast<std::ptrdiff_t>((row + 1) * components),
                std::back_inserter(strings));
    }
    array.strings = std::move(strings);
    return;
  }
  const std::size_t row_size = components * array.value_size();
  MemoryBlock numbers;
  std::byte* target = numbers.extend(array.numbers.size());
  for (const std::uint64_t row : order) {
    std::memcpy(target, array.numbers.data() + row * row_size, row_size);
    target += row_size;
  }
  array.numbers = std::move(numbers);
}

vtkSmartPointer<vtkAbstractArray> make_values(DecodedArray array) {
  const auto components = static_cast<int>(array.type.components);
  if (array.type.values == Values::numbers) {
    return make_vtk_array(array.type.type, array.type.components, std::move(array.numbers), array.type.ids);
  }
  if (array.type.values == Values::strings) {
    auto strings = vtkSmartPointer<vtkStringArray>::New();
    strings->SetNumberOfComponents(components);
    strings->SetNumberOfValues(static_cast<vtkIdType>(array.strings.size()));
    for (std::size_t i = 0; i < array.strings.size(); ++i) {
      strings->SetValue(static_cast<vtkIdType>(i), array.strings[i]);
    }
    return strings;
  }
  auto bits = vtkSmartPointer<vtkBitArray>::New();
  bits->SetNumberOfComponents(components);
  const auto count = static_cast<vtkIdType>(array.numbers.size());
  bits->SetNumberOfValues(count);
  if (count > 0) {
    // The last byte has bits that no value sets.
    bits->GetPointer(0)[(count - 1) / 8] = 0;
  }
  for (vtkIdType i = 0; i < count; ++i) {
    bits->SetValue(i, static_cast<int>(array.numbers.data()[i]));
  }
  return bits;
}

void set_component_names(const XmlElement& element, vtkAbstractArray& array) {
  constexpr std::string_view prefix = "ComponentName";
  for (const auto& [attribute, value] : element.attributes) {
    int component = -1;
    const char* const end = attribute.data() + attribute.size();
    if (attribute.starts_with(prefix) && std::from_chars(attribute.data() + prefix.size(), end, component).ptr == end &&
        component >= 0 && component < array.GetNumberOfComponents()) {
      array.SetComponentName(component, value.c_str());
    }
  }
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, std::string_view bytes, VtkXmlKind kind, const FileWorkers& workers)
      : path_(path),
        workers_(workers),
        head_(parse_xml_head(path, bytes, "AppendedData", {"InformationKey", "Value"})),
        header_(read_vtk_xml_header(path, bytes, head_, kind)),
        decoder_(path, bytes, header_, workers, file_.losses) {
    file_.kind = kind;
    file_.encoding = header_.encoding;
    file_.attributes = vtk_file_attributes(head_.root);
  }

  VtkXmlFile read();

 private:
  vtkSmartPointer<vtkPoints> read_points();
  void note_cuts(vtkPoints& points);
  MemoryBlock as_float64(ScalarType type, const MemoryBlock& numbers, std::size_t line) const;
  vtkSmartPointer<vtkPointSet> read_unstructured_grid();
  vtkSmartPointer<vtkPointSet> read_poly_data();
  void read_attributes(const std::string& section, std::uint64_t VtkXmlPiece::*rows,
                       const std::vector<std::uint64_t>& order, vtkDataSetAttributes& target);
  void read_field_data(const XmlElement& section);
  void set_active_attributes(const XmlElement& section, vtkDataSetAttributes& target);
  void add(const XmlElement& element, DecodedArray array, vtkFieldData& target);
  std::vector<std::uint64_t> poly_data_cell_order() const;

  const std::filesystem::path& path_;
  FileWorkers workers_;
  VtkXmlFile file_;
  XmlHead head_;
  VtkXmlHeader header_;
  VtkXmlDecoder decoder_;
  std::vector<VtkXmlPiece> pieces_;
};

/// Whole numbers of that type as float64, which holds each of them.
MemoryBlock Reader::as_float64(ScalarType type, const MemoryBlock& numbers, std::size_t line) const {
  MemoryBlock converted;
  visit_scalar_type(type, [&](auto zero) {
    using T = decltype(zero);
    const std::span values(reinterpret_cast<const T*>(numbers.data()), numbers.size() / sizeof(T));
    auto* const target = reinterpret_cast<double*>(converted.extend(values.size() * sizeof(double)));
    for (std::size_t i = 0; i < values.size(); ++i) {
      target[i] = static_cast<double>(values[i]);
      if (!holds_exactly<T>(target[i]) || static_cast<T>(target[i]) != values[i]) {
        throw ReadError(path_, line,
                        "point " + std::to_string(i / 3) + " has the coordinate " + std::to_string(values[i]) +
                            ", which double precision does not hold");
      }
    }
  });
  return converted;
}

/// Pieces that do not share their points are apart from each other.
void Reader::note_cuts(vtkPoints& points) {
  if (const std::size_t shared = pieces_.size() > 1 ? count_shared_places(pieces_, points) : 0; shared > 0) {
    file_.notes.push_back("the pieces have points of their own in " + counted(shared, "place", "places") +
                          " where they meet: the cuts between them are boundaries, whose vertices are held");
  }
}

vtkSmartPointer<vtkPoints> Reader::read_points() {
  std::optional<VtkXmlArrayType> type;
  const XmlElement* first = nullptr;
  MemoryBlock numbers;
  for (const VtkXmlPiece& piece : pieces_) {
    const XmlElement* const section = piece.element->child("Points");
    const std::vector<const XmlElement*> arrays = vtk_xml_arrays_of(section);
    if (arrays.size() != 1) {
      if (piece.points == 0) {
        continue;
      }
      throw ReadError(path_, (section == nullptr ? piece.element : section)->line,
                      "expected one array in <Points>, got " + std::to_string(arrays.size()));
    }
    VtkXmlArrayType here = vtk_xml_array_type_of(path_, *arrays[0]);
    if (here.values != Values::numbers || here.components != 3) {
      throw ReadError(path_, arrays[0]->line,
                      "expected points as 3 components of a type of number, got " + std::to_string(here.components) +
                          " of " + trismooth::quoted(*arrays[0]->attribute("type")));
    }
    if (type && type->type != here.type) {
      throw ReadError(path_, arrays[0]->line, "the points of this piece are of another type than those of the first");
    }
    if (!type) {
      type = std::move(here);
      first = arrays[0];
    }
    decoder_.read_numbers(*arrays[0], type->type, 3 * piece.points, numbers);
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  if (type) {
    if (type->type != ScalarType::float32 && type->type != ScalarType::float64) {
      numbers = as_float64(type->type, numbers, first->line);
      file_.losses.push_back("the points are written as Float64, not " + *first->attribute("type"));
      type->type = ScalarType::float64;
    }
    const vtkSmartPointer<vtkDataArray> array = make_vtk_array(type->type, 3, std::move(numbers));
    array->SetName(type->name.empty() ? "Points" : type->name.c_str());
    set_component_names(*first, *array);
    read_information_keys(*first, *array->GetInformation(), file_.losses);
    points->SetData(array);
  }
  return points;
}

void Reader::add(const XmlElement& element, DecodedArray decoded, vtkFieldData& target) {
  const std::string name = decoded.type.name;
  if (decoded.numbers.size() == 0 && decoded.strings.empty() &&
      decoded.type.components > most_components_without_rows) {
    throw ReadError(path_, element.line,
                    "array " + trismooth::quoted(name) + " has " + std::to_string(decoded.type.components) +
                        " components, but no rows");
  }
  const vtkSmartPointer<vtkAbstractArray> array = make_values(std::move(decoded));
  set_component_names(element, *array);
  read_information_keys(element, *array->GetInformation(), file_.losses);
  add_vtk_array(target, *array, name);
}

void Reader::set_active_attributes(const XmlElement& section, vtkDataSetAttributes& target) {
  VtkMessages messages;
  messages.watch(&target);
  for (int attribute = 0; attribute < vtkDataSetAttributes::NUM_ATTRIBUTES; ++attribute) {
    const char* const attribute_name = vtkDataSetAttributes::GetAttributeTypeAsString(attribute);
    const std::string* const name = section.attribute(attribute_name);
    if (name == nullptr || name->empty()) {
      continue;
    }
    // VTK's writer takes every active array for one of numbers.
    if (target.GetArray(name->c_str()) == nullptr || target.SetActiveAttribute(name->c_str(), attribute) < 0) {
      file_.losses.push_back("the attribute " + std::string(attribute_name) + " of <" + section.name + "> names " +
                             trismooth::quoted(*name) + ", which cannot be one; it is not kept");
    }
  }
  messages.unwatch(&target);
}

void Reader::read_attributes(const std::string& section, std::uint64_t VtkXmlPiece::*rows,
                             const std::vector<std::uint64_t>& order, vtkDataSetAttributes& target) {
  const VtkXmlSharedArrays shared = find_shared_arrays(path_, pieces_, section, rows, file_.losses);
  const XmlElement* const model_section = shared.first_section;
  const std::vector<const XmlElement*>& arrays = shared.of_first;
  std::vector<DecodedArray> decoded(arrays.size());
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    decoded[i].type = vtk_xml_array_type_of(path_, *arrays[i]);
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (pieces_[p].*rows == 0) {
      for (const XmlElement* const array : vtk_xml_arrays_of(pieces_[p].element->child(section))) {
        decoder_.expect_empty(*array);
      }
      continue;
    }
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      decode(decoder_, *shared.of_piece[p][i], pieces_[p].*rows, decoded[i]);
    }
  }
  reserve_vtk_arrays(target, arrays.size());
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const auto is_id_attribute = [&](const char* attribute) {
      const std::string* const name = model_section->attribute(attribute);
      return name != nullptr && *name == decoded[i].type.name;
    };
    // VTK accepts no other type for these; older files do not mark it.
    if (decoded[i].type.type == ScalarType::int64 && (is_id_attribute("GlobalIds") || is_id_attribute("PedigreeIds"))) {
      decoded[i].type.ids = true;
    }
    if (!order.empty()) {
      reorder(decoded[i], order);
    }
    add(*arrays[i], std::move(decoded[i]), target);
  }
  if (model_section != nullptr) {
    set_active_attributes(*model_section, target);
  }
}

void Reader::read_field_data(const XmlElement& section) {
  const std::vector<const XmlElement*> elements = vtk_xml_arrays_of(&section);
  reserve_vtk_arrays(*file_.data->GetFieldData(), elements.size());
  for (const XmlElement* const element : elements) {
    DecodedArray array;
    array.type = vtk_xml_array_type_of(path_, *element);
    if (element->attribute("Name") == nullptr) {
      throw ReadError(path_, element->line, "an array of <FieldData> has no Name");
    }
    const std::optional<std::uint64_t> rows = whole_number_attribute(path_, *element, "NumberOfTuples");
    constexpr std::uint64_t most_rows = std::uint64_t{1} << 40;
    if (rows > most_rows || (!rows && array.type.values != Values::numbers)) {
      throw ReadError(path_, element->line,
                      "array " + trismooth::quoted(array.type.name) + " has no sensible NumberOfTuples");
    }
    if (rows) {
      decode(decoder_, *element, *rows, array);
    } else {
      decoder_.read_numbers(*element, array.type.type, std::nullopt, array.numbers);
      if (array.numbers.size() % (array.value_size() * array.type.components) != 0) {
        throw ReadError(path_, element->line,
                        "array " + trismooth::quoted(array.type.name) + " has a last row that is cut off");
      }
    }
    add(*element, std::move(array), *file_.data->GetFieldData());
  }
}

vtkSmartPointer<vtkPointSet> Reader::read_unstructured_grid() {
  std::vector<std::uint64_t> counts;
  for (const VtkXmlPiece& piece : pieces_) {
    counts.push_back(piece.cells);
  }
  const vtkSmartPointer<vtkUnstructuredGrid> grid = make_unstructured_grid();
  VtkXmlCellsReader reader(path_, pieces_, decoder_, workers_, file_.losses);
  const vtkSmartPointer<vtkCellArray> cells = reader.read_cells("Cells", counts);
  grid->SetCells(reader.read_types(*cells), cells);
  return grid;
}

vtkSmartPointer<vtkPointSet> Reader::read_poly_data() {
  const vtkSmartPointer<vtkPolyData> data = make_poly_data();
  VtkXmlCellsReader reader(path_, pieces_, decoder_, workers_, file_.losses);
  for (std::size_t i = 0; i < poly_data_groups; ++i) {
    const auto group = static_cast<PolyDataGroup>(i);
    std::vector<std::uint64_t> counts;
    for (const VtkXmlPiece& piece : pieces_) {
      counts.push_back(piece.groups[i]);
    }
    const vtkSmartPointer<vtkCellArray> cells = reader.read_group(group, counts);
    switch (group) {
      case PolyDataGroup::verts:
        data->SetVerts(cells);
        break;
      case PolyDataGroup::lines:
        data->SetLines(cells);
        break;
      case PolyDataGroup::polys:
        data->SetPolys(cells);
        break;
      case PolyDataGroup::strips:
        data->SetStrips(cells);
        break;
    }
  }
  return data;
}

std::vector<std::uint64_t> Reader::poly_data_cell_order() const {
  std::vector<std::uint64_t> order;
  if (file_.kind == VtkXmlKind::unstructured_grid || pieces_.size() == 1) {
    return order;
  }
  for (std::size_t group = 0; group < poly_data_groups; ++group) {
    std::uint64_t first_of_piece = 0;
    for (const VtkXmlPiece& piece : pieces_) {
      std::uint64_t row = first_of_piece;
      for (std::size_t earlier = 0; earlier < group; ++earlier) {
        row += piece.groups[earlier];
      }
      for (std::uint64_t i = 0; i < piece.groups[group]; ++i) {
        order.push_back(row + i);
      }
      first_of_piece += piece.cells;
    }
  }
  return order;
}

VtkXmlFile Reader::read() {
  const std::string data_set_name(to_string(file_.kind));
  const XmlElement* const data_set = head_.root.child(data_set_name);
  if (data_set == nullptr) {
    throw ReadError(path_, head_.root.line, "<VTKFile> has no <" + data_set_name + ">");
  }
  refuse_second(path_, head_.root, data_set_name);
  pieces_ = find_vtk_xml_pieces(path_, *data_set, file_.kind, file_.losses);
  const vtkSmartPointer<vtkPoints> points = read_points();
  note_cuts(*points);
  file_.data = file_.kind == VtkXmlKind::unstructured_grid ? read_unstructured_grid() : read_poly_data();
  file_.data->SetPoints(points);
  read_attributes("PointData", &VtkXmlPiece::points, {}, *file_.data->GetPointData());
  read_attributes("CellData", &VtkXmlPiece::cells, poly_data_cell_order(), *file_.data->GetCellData());
  if (const XmlElement* const field_data = data_set->child("FieldData")) {
    read_field_data(*field_data);
  }
  decoder_.check_empty_arrays();
  file_.encoding.sizes_apart = decoder_.has_sizes_apart() && file_.encoding.mode == VtkXmlMode::binary;
  if (decoder_.has_sizes_apart() && !file_.encoding.sizes_apart) {
    file_.losses.emplace_back("the sizes of the arrays are written as base64 together with their numbers, not apart");
  }
  std::ranges::move(unknown_vtk_xml_attributes(head_.root), std::back_inserter(file_.losses));
  if (const std::string names = unknown_vtk_file_attributes(head_.root); !names.empty()) {
    file_.notes.push_back("what <VTKFile> says as " + names + " is kept in this format only");
  }
  return std::move(file_);
}

}  // namespace

VtkXmlFile read_vtk_xml(const std::filesystem::path& path, std::string_view bytes, VtkXmlKind kind,
                        const FileWorkers& workers) {
  return Reader(path, bytes, kind, workers).read();
}

}  // namespace trismooth
