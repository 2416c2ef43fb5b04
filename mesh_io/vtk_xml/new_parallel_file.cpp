// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/new_parallel_file.h"

#include <bit>
#include <cstddef>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/xml/xml_names.h"

namespace trismooth {

namespace {

/// "Float64" for float64, as VTK has it.
std::string vtk_name_of(ScalarType type) {
  std::string name(to_string(type));
  if (name.starts_with("uint")) {
    name.replace(0, 4, "UInt");
  } else {
    name.front() = upper_letter(name.front());
  }
  return name;
}

std::string array_element(const std::string& name, ScalarType type, std::size_t components) {
  return "      <PDataArray type=\"" + vtk_name_of(type) + "\" Name=\"" + escape_xml_attribute(name) +
         "\" NumberOfComponents=\"" + std::to_string(components) + "\"/>\n";
}

std::string section_element(const std::string& element, std::span<const DataArray> arrays) {
  std::string role_texts;
  std::string text;
  for (const DataArray& array : arrays) {
    text += array_element(array.name, array.type, array.components);
    if (array.description != nullptr) {
      for (const std::string& role : array.description->roles) {
        role_texts.append(" ").append(role).append("=\"").append(escape_xml_attribute(array.name)).append("\"");
      }
    }
  }
  return "    <" + element + role_texts + ">\n" + text + "    </" + element + ">\n";
}

/// Where the line of `at` begins, if nothing but blanks is before it there; else `at`.
std::size_t begin_of_line(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.find_last_not_of(" \t", at - 1);
  return before != std::string::npos && text[before] == '\n' ? before + 1 : at;
}

/// Lists arrays in that section of a parallel file, which is made where there is none.
void list_arrays(std::string& text, const std::string& element, std::span<const DataArray> arrays) {
  if (arrays.empty()) {
    return;
  }
  std::string listed;
  for (const DataArray& array : arrays) {
    listed += array_element(array.name, array.type, array.components);
  }
  const std::string end_tag = "</" + element + ">";
  const std::size_t end = text.find(end_tag);
  const std::size_t begin = text.find("<" + element);
  const std::size_t empty_end = text.find("/>", begin);
  if (end != std::string::npos) {
    text.insert(begin_of_line(text, end), listed);
  } else if (begin != std::string::npos && empty_end != std::string::npos) {
    text.replace(empty_end, 2, ">\n" + listed + "    " + end_tag);
  } else if (const std::size_t points = text.find("<PPoints"); points != std::string::npos) {
    text.insert(begin_of_line(text, points), section_element(element, arrays));
  }
}

}  // namespace

std::string with_arrays(std::string text, const AddedArrays& added) {
  list_arrays(text, "PPointData", added.point_arrays);
  list_arrays(text, "PCellData", added.cell_arrays);
  return text;
}

NewParallelFile make_parallel_file(FileFormat piece_format, const MeshDocument& document,
                                   std::span<const std::string> sources) {
  const std::string grid = piece_format == FileFormat::vtu ? "PUnstructuredGrid" : "PPolyData";
  NewParallelFile made;
  made.file.piece_format = piece_format;
  std::string& text = made.bytes;
  text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"";
  text.append(grid).append(R"(" version="1.0" byte_order=")");
  text.append(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
  text.append("\" header_type=\"UInt64\">\n  <").append(grid).append(" GhostLevel=\"0\">\n");
  text += section_element("PPointData", document.point_arrays) + section_element("PCellData", document.cell_arrays);
  text += "    <PPoints>\n" + array_element("Points", document.point_type, 3) + "    </PPoints>\n";
  for (const std::string& source : sources) {
    text += "    <Piece Source=\"";
    const std::size_t begin = text.size();
    text += escape_xml_attribute(source);
    made.file.pieces.push_back({source, begin, text.size()});
    text += "\"/>\n";
  }
  text += "  </" + grid + ">\n</VTKFile>\n";
  return made;
}

}  // namespace trismooth
