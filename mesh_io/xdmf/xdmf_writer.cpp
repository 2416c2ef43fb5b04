// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/xdmf/xdmf_names.h"
#include "trismooth/mesh_io/xdmf/xdmf_topology.h"
#include "trismooth/mesh_io/xml/xml_names.h"
#ifdef TRISMOOTH_HAS_HDF5
#include "trismooth/mesh_io/hdf5/hdf5_writer.h"
#endif

namespace trismooth {

namespace {

std::vector<std::uint8_t> written_types() {
  std::vector<std::uint8_t> types{cell_type::poly_vertex, cell_type::poly_line};
  std::ranges::transform(xdmf_cell_types, std::back_inserter(types), &XdmfCellType::type);
  return types;
}

/// "Int", and the bytes of one.
std::pair<std::string_view, std::size_t> number_name(ScalarType type) {
  const bool is_signed = visit_scalar_type(type, [](auto number) { return std::is_signed_v<decltype(number)>; });
  const bool is_real = type == ScalarType::float32 || type == ScalarType::float64;
  return {is_real ? "Float" : is_signed ? "Int" : "UInt", size_of(type)};
}

/// Writes <DataItem>s: their numbers to an HDF5 file beside the text, or into it.
class ItemWriter {
 public:
  ItemWriter(BufferedWriter& text, [[maybe_unused]] const std::vector<std::filesystem::path>& others) : text_(text) {
#ifdef TRISMOOTH_HAS_HDF5
    if (!others.empty()) {
      heavy_.emplace(Hdf5Writer::make(OutputFile::place_of(others.front())));
      heavy_name_ = others.front().filename().string();
    }
#endif
  }

  void write(const std::string& dataset, std::span<const std::uint64_t> extents, ScalarType type,
             std::span<const std::byte> values) {
    const auto [name, bytes] = number_name(type);
    std::string tag = "        <DataItem DataType=\"" + std::string(name) + "\" Dimensions=\"";
    for (std::size_t i = 0; i < extents.size(); ++i) {
      tag.append(i == 0 ? "" : " ").append(std::to_string(extents[i]));
    }
    tag.append("\" Format=\"").append(heavy_name_.empty() ? "XML" : "HDF");
    tag.append("\" Precision=\"").append(std::to_string(bytes)).append("\">");
    text_.write(tag);
#ifdef TRISMOOTH_HAS_HDF5
    if (heavy_) {
      heavy_->write(dataset, extents, type, values);
      text_.write(escape_xml_attribute(heavy_name_) + ":" + dataset + "</DataItem>\n");
      return;
    }
#endif
    write_numbers(extents.size() > 1 ? static_cast<std::size_t>(extents[1]) : 1, type, values);
    text_.write("        </DataItem>\n");
  }

  template <class T>
  void write(const std::string& dataset, std::span<const std::uint64_t> extents, ScalarType type,
             const std::vector<T>& values) {
    write(dataset, extents, type, std::as_bytes(std::span(values)));
  }

  void close() {
#ifdef TRISMOOTH_HAS_HDF5
    if (heavy_) {
      heavy_->close();
    }
#endif
  }

 private:
  void write_numbers(std::size_t columns, ScalarType type, std::span<const std::byte> values) {
    visit_scalar_type(type, [&](auto number) {
      using T = decltype(number);
      const std::span<const T> numbers(reinterpret_cast<const T*>(values.data()), values.size() / sizeof(T));
      std::string lines = "\n";
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if constexpr (std::is_floating_point_v<T>) {
          append_number(lines, numbers[i]);
        } else {
          lines += std::to_string(numbers[i]);
        }
        lines += (i + 1) % columns == 0 ? '\n' : ' ';
        if (lines.size() > std::size_t{1} << 16) {
          text_.write(lines);
          lines.clear();
        }
      }
      text_.write(lines);
    });
  }

  BufferedWriter& text_;
  std::string heavy_name_;
#ifdef TRISMOOTH_HAS_HDF5
  std::optional<Hdf5Writer> heavy_;
#endif
};

/// The cells that are written: all whose type XDMF has.
struct WrittenCells {
  std::vector<std::size_t> cells;  ///< empty: all
  bool is_uniform = true;
  std::size_t count = 0;

  explicit WrittenCells(const CellList& all) {
    std::array<const XdmfCellType*, 256> types{};
    for (std::size_t type = 0; type < types.size(); ++type) {
      types[type] = xdmf_cell_type(static_cast<std::uint8_t>(type));
    }
    const bool are_all = std::ranges::all_of(all.types, [&types](std::uint8_t type) { return types[type] != nullptr; });
    std::size_t first = all.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (types[all.types[i]] == nullptr) {
        continue;
      }
      first = std::min(first, i);
      is_uniform = is_uniform && all.types[i] == all.types[first] && all[i].size() == all[first].size();
      ++count;
      if (!are_all) {
        cells.push_back(i);
      }
    }
  }

  std::size_t operator[](std::size_t i) const { return cells.empty() ? i : cells[i]; }
};

void write_topology(BufferedWriter& text, ItemWriter& items, const CellList& all, const WrittenCells& written) {
  const std::string count = std::to_string(written.count);
  if (written.is_uniform && written.count > 0) {
    const XdmfCellType& type = *xdmf_cell_type(all.types[written[0]]);
    const std::size_t vertices = all[written[0]].size();
    text.write("      <Topology TopologyType=\"" + std::string(type.names[0]) + "\" NumberOfElements=\"" + count +
               "\" NodesPerElement=\"" + std::to_string(vertices) + "\">\n");
    const std::array<std::uint64_t, 2> extents{written.count, vertices};
    if (written.cells.empty()) {
      items.write("/topology", extents, ScalarType::int32, all.connectivity);
    } else {
      std::vector<std::int32_t> picked;
      for (const std::size_t cell : written.cells) {
        picked.insert(picked.end(), all[cell].begin(), all[cell].end());
      }
      items.write("/topology", extents, ScalarType::int32, picked);
    }
  } else {
    std::vector<std::int32_t> numbers;
    for (std::size_t i = 0; i < written.count; ++i) {
      const auto cell = all[written[i]];
      const XdmfCellType& type = *xdmf_cell_type(all.types[written[i]]);
      numbers.push_back(static_cast<std::int32_t>(type.number));
      if (type.vertices == 0) {
        numbers.push_back(static_cast<std::int32_t>(cell.size()));
      }
      numbers.insert(numbers.end(), cell.begin(), cell.end());
    }
    text.write(R"(      <Topology TopologyType="Mixed" NumberOfElements=")" + count + "\">\n");
    const std::array<std::uint64_t, 1> extents{numbers.size()};
    items.write("/topology", extents, ScalarType::int32, numbers);
  }
  text.write("      </Topology>\n");
}

template <class T>
void write_points(ItemWriter& items, ScalarType type, const std::vector<double>& points, std::size_t axes) {
  std::vector<T> values;
  values.reserve(points.size() / 3 * axes);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      values.push_back(static_cast<T>(points[i + axis]));
    }
  }
  const std::array<std::uint64_t, 2> extents{points.size() / 3, axes};
  items.write("/geometry", extents, type, values);
}

void write_geometry(BufferedWriter& text, ItemWriter& items, const MeshDocument& document) {
  bool is_flat = true;
  for (std::size_t i = 2; i < document.points.size(); i += 3) {
    is_flat = is_flat && document.points[i] == 0 && !std::signbit(document.points[i]);
  }
  const std::size_t axes = is_flat ? 2 : 3;
  text.write(is_flat ? "      <Geometry GeometryType=\"XY\">\n" : "      <Geometry GeometryType=\"XYZ\">\n");
  if (document.point_type == ScalarType::float32) {
    write_points<float>(items, ScalarType::float32, document.points, axes);
  } else if (axes == 3) {
    const std::array<std::uint64_t, 2> extents{document.point_count(), axes};
    items.write("/geometry", extents, ScalarType::float64, document.points);
  } else {
    write_points<double>(items, ScalarType::float64, document.points, axes);
  }
  text.write("      </Geometry>\n");
}

std::string_view attribute_type(std::size_t components) {
  switch (components) {
    case 1:
      return "Scalar";
    case 2:
    case 3:
      return "Vector";
    case 6:
      return "Tensor6";
    case 9:
      return "Tensor";
    default:
      return "Matrix";
  }
}

/// `rows`: those of the array that are written; null: all.
void write_array(BufferedWriter& text, ItemWriter& items, const DataArray& array, std::string_view center,
                 const std::string& dataset, const std::vector<std::size_t>* rows) {
  text.write("      <Attribute Name=\"" + escape_xml_attribute(array.name) + "\" AttributeType=\"" +
             std::string(attribute_type(array.components)) + "\" Center=\"" + std::string(center) + "\">\n");
  std::vector<std::byte> picked;
  const std::size_t bytes = array.components * size_of(array.type);
  if (rows != nullptr) {
    for (const std::size_t row : *rows) {
      const auto values = array.bytes.subspan(row * bytes, bytes);
      picked.insert(picked.end(), values.begin(), values.end());
    }
  }
  const std::array<std::uint64_t, 2> extents{rows == nullptr ? array.rows() : rows->size(), array.components};
  items.write(dataset, std::span(extents).first(array.components == 1 ? 1 : 2), array.type,
              rows == nullptr ? array.bytes : std::span<const std::byte>(picked));
  text.write("      </Attribute>\n");
}

}  // namespace

std::vector<std::filesystem::path> xdmf_other_files([[maybe_unused]] const std::filesystem::path& path) {
#ifdef TRISMOOTH_HAS_HDF5
  if (const auto format = format_of(path); !names_gzip(path) && format == FileFormat::xdmf) {
    return {std::filesystem::path(path).replace_extension(".h5")};
  }
#endif
  return {};
}

void write_xdmf(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& /*workers*/) {
  BufferedWriter text(path);
  ItemWriter items(text, xdmf_other_files(OutputFile::name_of(path)));
  const WrittenCells written(document.cells);
  text.write(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"mesh\" GridType=\"Uniform\">\n");
  write_topology(text, items, document.cells, written);
  write_geometry(text, items, document);
  const XdmfWrittenArrays arrays = xdmf_written_arrays(document);
  std::size_t number = 0;
  for (const DataArray& array : arrays.of_points) {
    write_array(text, items, array, "Node", "/point_array_" + std::to_string(number++), nullptr);
  }
  number = 0;
  for (const DataArray& array : arrays.of_cells) {
    write_array(text, items, array, "Cell", "/cell_array_" + std::to_string(number++),
                written.count == document.cells.size() ? nullptr : &written.cells);
  }
  if (const std::string names = xdmf_names(document, arrays); !names.empty()) {
    text.write("      <Information Name=\"names\"><![CDATA[" + names + "]]></Information>\n");
  }
  text.write("    </Grid>\n  </Domain>\n</Xdmf>\n");
  items.close();
  text.close();
}

std::vector<std::string> lost_in_xdmf(const MeshDocument& document) {
  std::vector<std::string> sentences =
      describe_lost_cells("XDMF", "cells of other types", written_types(), document.cells);
  std::ranges::move(describe_lost_field_arrays("XDMF", document), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
