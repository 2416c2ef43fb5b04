// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <vtkDataCompressor.h>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_compressor.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"
#include "support/xml_arrays.h"

namespace accepted_files {

using vtk::base64_of;
using vtk::number_bytes;

namespace {

using trismooth::VtkXmlCompressor;
using trismooth::VtkXmlEncoding;
using trismooth::VtkXmlMode;

constexpr int line_type = 3;

/// The cells of the mesh as VTK has them: a line, then the faces.
struct Cells {
  std::vector<std::vector<int>> lines{{0, 1}};
  std::vector<std::vector<int>> faces = mesh(true).faces;

  std::vector<std::vector<int>> all() const {
    std::vector<std::vector<int>> cells = lines;
    cells.insert(cells.end(), faces.begin(), faces.end());
    return cells;
  }
  static int type_of(const std::vector<int>& cell) {
    constexpr std::array types{0, 0, line_type, 5, 9, 7};
    return types[cell.size()];
  }
};

template <class T>
std::vector<T> count_up(std::size_t count, double step) {
  std::vector<T> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<T>(static_cast<double>(i) * step));
  }
  return values;
}

/// The scale at which all coordinates are whole numbers.
constexpr double whole_scale = 4;

template <class T>
std::vector<T> coordinates(double scale = 1) {
  std::vector<T> values;
  for (const auto& point : mesh(true).points) {
    for (const double coordinate : point) {
      values.push_back(static_cast<T>(scale * coordinate));
    }
  }
  return values;
}

template <class T>
std::vector<T> connectivity_of(const std::vector<std::vector<int>>& cells) {
  std::vector<T> values;
  for (const auto& cell : cells) {
    values.insert(values.end(), cell.begin(), cell.end());
  }
  return values;
}

/// The places behind each cell.
template <class T>
std::vector<T> ends_of(const std::vector<std::vector<int>>& cells) {
  std::vector<T> values;
  for (const auto& cell : cells) {
    values.push_back(static_cast<T>(cell.size()) + (values.empty() ? 0 : values.back()));
  }
  return values;
}

/// Text and numbers of a legacy file.
class LegacyText {
 public:
  explicit LegacyText(bool binary) : binary_(binary) {}

  template <class T>
  LegacyText& add(const std::string& header, const std::vector<T>& numbers) {
    text_ += header + "\n";
    for (const T number : numbers) {
      text_ += binary_ ? number_bytes(number, true) : fmt::format("{} ", +number);
    }
    text_ += "\n";
    return *this;
  }
  LegacyText& add(const std::string& text) {
    text_ += text;
    return *this;
  }
  bool is_binary() const { return binary_; }
  const std::string& text() const { return text_; }

 private:
  bool binary_;
  std::string text_;
};

void add_cells(LegacyText& file, const std::string& keyword, const std::vector<std::vector<int>>& cells, bool offsets) {
  const auto connectivity = connectivity_of<std::int64_t>(cells);
  if (offsets) {
    auto ends = ends_of<std::int64_t>(cells);
    ends.insert(ends.begin(), 0);
    file.add(fmt::format("{} {} {}\nOFFSETS vtktypeint64", keyword, ends.size(), connectivity.size()), ends);
    file.add("CONNECTIVITY vtktypeint64", connectivity);
    return;
  }
  std::vector<std::int32_t> counted;
  for (const auto& cell : cells) {
    counted.push_back(static_cast<std::int32_t>(cell.size()));
    counted.insert(counted.end(), cell.begin(), cell.end());
  }
  file.add(fmt::format("{} {} {}", keyword, cells.size(), counted.size()), counted);
}

/// Attributes of nearly every kind.
void add_rich_data(LegacyText& file, std::size_t points, std::size_t cells) {
  file.add(fmt::format("POINT_DATA {}\nSCALARS heat%20flux float\nLOOKUP_TABLE table", points),
           count_up<float>(points, 0.25));
  file.add("LOOKUP_TABLE table 2\n");
  file.add(file.is_binary() ? std::string("\xff\0\0\xff\0\n\r\xff\n", 9) : "1 0 0 1 0 0 0.5 1\n");
  file.add("VECTORS velocity double", count_up<double>(3 * points, 0.125));
  file.add("METADATA\nCOMPONENT_NAMES\nu\nv%20w\n\nINFORMATION 1\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA m\n\n");
  file.add(fmt::format("CELL_DATA {}\nSCALARS region int 1\nLOOKUP_TABLE default", cells),
           count_up<std::int32_t>(cells, 0.5));
  file.is_binary() ? file.add("COLOR_SCALARS colours 3", count_up<std::uint8_t>(3 * cells, 3))
                   : file.add("COLOR_SCALARS colours 3", count_up<float>(3 * cells, 0.03125));
  file.add("FIELD FieldData 3\n");
  const std::string flags = fmt::format("flags 1 {} bit", cells);
  file.is_binary() ? file.add(flags, std::vector<std::uint8_t>{0xb4}) : file.add(flags, count_up<int>(cells, 0.125));
  file.add(fmt::format("words 1 {} string\n", cells));
  for (std::size_t i = 0; i < cells; ++i) {
    const std::string word(i % 3, 'x');
    file.add(file.is_binary() ? static_cast<char>(0xc0 | word.size()) + word : word + "\n");
  }
  file.add(fmt::format("\nlast 2 {} vtktypeint64", cells), count_up<std::int64_t>(2 * cells, 1e12));
}

std::string legacy(const std::string& version, bool binary, bool poly_data, bool with_double, bool rich,
                   bool whole = false) {
  const Cells cells;
  const std::size_t cell_count = cells.all().size();
  const bool offsets = version.starts_with('5');
  LegacyText file(binary);
  file.add(fmt::format("# vtk DataFile Version {}\na title\n{}\nDATASET {}\n", version, binary ? "BINARY" : "ASCII",
                       poly_data ? "POLYDATA" : "UNSTRUCTURED_GRID"));
  if (rich) {
    file.add("FIELD FieldData 1\nTIME 1 1 double", std::vector<double>{0.25});
  }
  const std::size_t points = mesh(true).points.size();
  whole         ? file.add(fmt::format("POINTS {} short", points), coordinates<std::int16_t>(whole_scale))
  : with_double ? file.add(fmt::format("POINTS {} double", points), coordinates<double>())
                : file.add(fmt::format("POINTS {} float", points), coordinates<float>());
  if (poly_data) {
    add_cells(file, "LINES", cells.lines, offsets);
    add_cells(file, "POLYGONS", cells.faces, offsets);
  } else {
    add_cells(file, "CELLS", cells.all(), offsets);
    std::vector<std::int32_t> types;
    for (const auto& cell : cells.all()) {
      types.push_back(Cells::type_of(cell));
    }
    file.add(fmt::format("CELL_TYPES {}", cell_count), types);
  }
  if (rich) {
    add_rich_data(file, points, cell_count);
  } else {
    file.add(fmt::format("CELL_DATA {}\nSCALARS material short 1\nLOOKUP_TABLE default", cell_count),
             count_up<std::int16_t>(cell_count, 0.5));
  }
  return file.text();
}

std::string without(std::string text, std::string_view part) {
  return text.replace(text.find(part), part.size(), "");
}

/// The file with a comment, and a blank before it, behind every line of text below the title, and one in a line of its
/// own.
std::string with_comments(const std::string& text, bool binary) {
  std::string changed;
  std::size_t lines = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    // Lines of binary files that are text begin with a keyword.
    const bool is_text =
        !binary || line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") > std::string_view("LINE").size() - 1;
    changed += line;
    changed += ++lines > 2 && is_text ? " \t# of a test" : lines > 2 ? "" : " ";
    changed += lines == 4 ? "\n# a line" : "";
    changed += end < text.size() ? "\n" : "";
    begin = end + 1;
  }
  return changed;
}

void add_legacy_dialects(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes, double scale = 1) {
    files.push_back({"legacy_" + name, ".vtk", std::move(bytes), scale});
  };
  add("mark", std::string(trismooth::byte_order_mark) + legacy("3.0", false, false, true, false));
  for (const bool binary : {false, true}) {
    const std::string encoding = binary ? "_binary" : "_ascii";
    const std::string plain = legacy("3.0", binary, false, true, false);
    add("no_table" + encoding, without(plain, "LOOKUP_TABLE default\n"));
    add("comments" + encoding, with_comments(plain, binary));
    add("whole" + encoding, legacy("3.0", binary, false, false, false, true), whole_scale);
  }
}

/// The elements of an XML file, and the section of appended data that they fill.
class XmlText {
 public:
  explicit XmlText(const VtkXmlEncoding& encoding)
      : encoding_(encoding), compressor_(trismooth::make_vtk_compressor(encoding.compressor)) {
    if (compressor_ != nullptr) {
      // LZMA's readers make room for the dictionary of the level: 1 MiB for this one.
      compressor_->SetCompressionLevel(1);
    }
  }

  /// More numbers than the counts ask for, and attributes that nobody knows.
  void exceed() { exceeds_ = true; }

  template <class T>
  std::string array(const std::string& type, std::string attributes, std::vector<T> numbers) {
    if (exceeds_ && attributes.find("offsets") == std::string::npos && attributes.find("types") == std::string::npos) {
      type == "String" ? numbers.insert(numbers.end(), {'d', 0}) : numbers.insert(numbers.end(), {1, 2, 3});
      attributes += " units=\"K\"";
    }
    const std::string tag = type == "String" ? "Array" : "DataArray";
    const std::string begin = fmt::format("<{} type=\"{}\" {}", tag, type, attributes);
    if (encoding_.mode == VtkXmlMode::ascii) {
      std::string text;
      for (const T number : numbers) {
        text += fmt::format("{} ", +number);
      }
      return fmt::format("{} format=\"ascii\">\n{}\n</{}>\n", begin, text, tag);
    }
    std::string bytes;
    for (const T number : numbers) {
      bytes += number_bytes(number, encoding_.big_endian);
    }
    if (encoding_.mode == VtkXmlMode::binary) {
      return fmt::format("{} format=\"binary\">\n{}\n</{}>\n", begin, encoded(bytes, true), tag);
    }
    const std::size_t offset = appended_.size();
    appended_ += encoded(bytes, encoding_.appended_base64);
    return fmt::format("{} format=\"appended\" offset=\"{}\"/>\n", begin, offset);
  }

  std::string file(const std::string& kind, const std::string& body) const {
    constexpr std::array compressors{"", " compressor=\"vtkZLibDataCompressor\"",
                                     " compressor=\"vtkLZ4DataCompressor\"", " compressor=\"vtkLZMADataCompressor\""};
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}Endian\" "
        "header_type=\"UInt{}\"{}>\n"
        "<{}>\n{}</{}>\n",
        kind, encoding_.big_endian ? "Big" : "Little", encoding_.wide_block_headers ? 64 : 32,
        compressors[static_cast<std::size_t>(encoding_.compressor)], kind, body, kind);
    if (encoding_.mode == VtkXmlMode::appended) {
      text += fmt::format("<AppendedData encoding=\"{}\">\n_{}\n</AppendedData>\n",
                          encoding_.appended_base64 ? "base64" : "raw", appended_);
    }
    return text + "</VTKFile>\n";
  }

 private:
  std::string words(const std::vector<std::size_t>& values) const {
    std::string bytes;
    for (const std::size_t value : values) {
      bytes += encoding_.wide_block_headers ? number_bytes(static_cast<std::uint64_t>(value), encoding_.big_endian)
                                            : number_bytes(static_cast<std::uint32_t>(value), encoding_.big_endian);
    }
    return bytes;
  }

  std::string encoded(const std::string& bytes, bool as_base64) const {
    if (compressor_ == nullptr && encoding_.sizes_apart && as_base64) {
      return base64_of(words({bytes.size()})) + base64_of(bytes);
    }
    if (compressor_ == nullptr) {
      const std::string all = words({bytes.size()}) + bytes;
      return as_base64 ? base64_of(all) : all;
    }
    // So small that the larger arrays have several blocks.
    constexpr std::size_t block_size = 96;
    std::vector<std::size_t> header{(bytes.size() + block_size - 1) / block_size, block_size,
                                    bytes.size() % block_size};
    std::string body;
    for (std::size_t begin = 0; begin < bytes.size(); begin += block_size) {
      const std::string block = bytes.substr(begin, block_size);
      std::vector<unsigned char> compressed(compressor_->GetMaximumCompressionSpace(block.size()));
      compressed.resize(compressor_->Compress(reinterpret_cast<const unsigned char*>(block.data()), block.size(),
                                              compressed.data(), compressed.size()));
      header.push_back(compressed.size());
      body.append(compressed.begin(), compressed.end());
    }
    return as_base64 ? base64_of(words(header)) + base64_of(body) : words(header) + body;
  }

  VtkXmlEncoding encoding_;
  vtkSmartPointer<vtkDataCompressor> compressor_;
  std::string appended_;
  bool exceeds_ = false;
};

template <class Index>
std::string xml_cells(XmlText& file, const std::string& type, const std::vector<std::vector<int>>& cells) {
  return file.array(type, "Name=\"connectivity\"", connectivity_of<Index>(cells)) +
         file.array(type, "Name=\"offsets\"", ends_of<Index>(cells));
}

/// Int64 indices and float64 points where `wide`, else Int32 and float32.
std::string xml_cells(XmlText& file, bool wide, const std::vector<std::vector<int>>& cells) {
  return wide ? xml_cells<std::int64_t>(file, "Int64", cells) : xml_cells<std::int32_t>(file, "Int32", cells);
}

enum class Xml : std::uint8_t { plain, exceeding, whole };

std::string xml(const VtkXmlEncoding& encoding, bool poly_data, bool wide, Xml dialect = Xml::plain) {
  const Cells cells;
  const std::size_t cell_count = cells.all().size();
  const std::size_t points = mesh(true).points.size();
  XmlText file(encoding);
  if (dialect == Xml::exceeding) {
    file.exceed();
  }
  std::string body = "<FieldData>\n" + file.array("Float64", "Name=\"TIME\" NumberOfTuples=\"1\"", std::vector{0.25});
  body += file.array("String", "Name=\"names\" NumberOfTuples=\"2\"", std::vector<std::int8_t>{'a', 'b', 0, 'c', 0}) +
          "</FieldData>\n";
  body += fmt::format("<Piece NumberOfPoints=\"{}\"", points);
  body += poly_data
              ? fmt::format(" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
                            cells.lines.size(), cells.faces.size())
              : fmt::format(" NumberOfCells=\"{}\">\n", cell_count);
  body += "<PointData Scalars=\"depth\">\n" + file.array("Float32", "Name=\"depth\"", count_up<float>(points, 0.25)) +
          "</PointData>\n<CellData>\n" +
          file.array("Int16", "Name=\"region\" NumberOfComponents=\"2\" ComponentName0=\"a\"",
                     count_up<std::int16_t>(2 * cell_count, 0.5)) +
          "</CellData>\n<Points>\n";
  const std::string points_attributes = "Name=\"Points\" NumberOfComponents=\"3\"";
  body += dialect == Xml::whole ? file.array("Int16", points_attributes, coordinates<std::int16_t>(whole_scale))
          : wide                ? file.array("Float64", points_attributes, coordinates<double>())
                                : file.array("Float32", points_attributes, coordinates<float>());
  body += "</Points>\n";
  if (poly_data) {
    body += "<Lines>\n" + xml_cells(file, wide, cells.lines) + "</Lines>\n<Polys>\n" +
            xml_cells(file, wide, cells.faces) + "</Polys>\n</Piece>\n";
    return file.file("PolyData", body);
  }
  std::vector<std::uint8_t> types;
  for (const auto& cell : cells.all()) {
    types.push_back(static_cast<std::uint8_t>(Cells::type_of(cell)));
  }
  body += "<Cells>\n" + xml_cells(file, wide, cells.all()) + file.array("UInt8", "Name=\"types\"", types) +
          "</Cells>\n</Piece>\n";
  return file.file("UnstructuredGrid", body);
}

void add_legacy(std::vector<AcceptedFile>& files) {
  bool rich = false;
  for (const std::string version : {"2.0", "3.0", "4.2", "5.1"}) {
    for (const bool poly_data : {false, true}) {
      for (const bool binary : {false, true}) {
        files.push_back({fmt::format("legacy_{}_{}_{}{}", version, poly_data ? "poly" : "grid",
                                     binary ? "binary" : "ascii", rich ? "_rich" : ""),
                         ".vtk", legacy(version, binary, poly_data, binary != poly_data, rich)});
      }
      rich = !rich;
    }
    // Both kinds of data set have both amounts of data.
    rich = !rich;
  }
  add_legacy_dialects(files);
}

void add_xml(std::vector<AcceptedFile>& files) {
  constexpr std::array modes{"ascii", "inline", "appended"};
  constexpr std::array compressors{"", "_zlib", "_lz4", "_lzma"};
  bool flip = false;
  for (const bool poly_data : {false, true}) {
    const auto add = [&](const VtkXmlEncoding& encoding) {
      const bool raw = encoding.mode == VtkXmlMode::appended && !encoding.appended_base64;
      files.push_back(
          {fmt::format("{}_{}{}{}_{}{}", poly_data ? "vtp" : "vtu", modes[static_cast<std::size_t>(encoding.mode)],
                       raw ? "_raw" : "", compressors[static_cast<std::size_t>(encoding.compressor)],
                       encoding.big_endian ? "big" : "little", encoding.wide_block_headers ? 64 : 32),
           poly_data ? ".vtp" : ".vtu", xml(encoding, poly_data, encoding.big_endian != poly_data)});
    };
    add({VtkXmlMode::ascii, true, VtkXmlCompressor::none, false, false});
    for (const auto compressor :
         {VtkXmlCompressor::none, VtkXmlCompressor::zlib, VtkXmlCompressor::lz4, VtkXmlCompressor::lzma}) {
      add({VtkXmlMode::binary, true, compressor, flip, !flip});
      add({VtkXmlMode::appended, true, compressor, !flip, !flip});
      add({VtkXmlMode::appended, false, compressor, flip, flip});
      flip = !flip;
    }
    flip = !flip;
  }
  const auto add = [&](const std::string& name, const VtkXmlEncoding& encoding, bool poly_data, Xml dialect) {
    const bool wide = encoding.big_endian != poly_data;
    files.push_back({(poly_data ? "vtp_" : "vtu_") + name, poly_data ? ".vtp" : ".vtu",
                     xml(encoding, poly_data, wide, dialect), dialect == Xml::whole ? whole_scale : 1});
  };
  add("inline_apart_little32", {VtkXmlMode::binary, true, VtkXmlCompressor::none, false, false, true}, false,
      Xml::plain);
  add("inline_apart_big64", {VtkXmlMode::binary, true, VtkXmlCompressor::none, true, true, true}, true, Xml::plain);
  add("ascii_exceeding", {VtkXmlMode::ascii, true, VtkXmlCompressor::none, false, false}, false, Xml::exceeding);
  add("inline_exceeding_zlib_big64", {VtkXmlMode::binary, true, VtkXmlCompressor::zlib, true, true}, false,
      Xml::exceeding);
  add("appended_raw_exceeding_big32", {VtkXmlMode::appended, false, VtkXmlCompressor::none, true, false}, true,
      Xml::exceeding);
  add("ascii_whole", {VtkXmlMode::ascii, true, VtkXmlCompressor::none, false, false}, false, Xml::whole);
}

constexpr std::string_view comment = " \t# of a test";

/// The file with blanks in place of comments.
std::string without_comments(std::string bytes) {
  for (std::size_t at = bytes.find(comment); at != bytes.npos; at = bytes.find(comment, at)) {
    bytes.replace(at, comment.size(), std::string(comment.size(), ' '));
  }
  return bytes;
}

template <bool poly_data>
void add_xml_of(std::vector<AcceptedFile>& files) {
  std::vector<AcceptedFile> both;
  add_xml(both);
  std::ranges::copy_if(both, std::back_inserter(files),
                       [](const AcceptedFile& file) { return (file.extension == ".vtp") == poly_data; });
}

/// After their cells, legacy files end before every attribute and within METADATA, but for the names in it. (The lines,
/// polygons and so on of a POLYDATA are attributes in this sense, but for the first.)
bool is_whole_legacy(const AcceptedFile& file, std::size_t cut) {
  const std::string bytes = without_comments(file.bytes);
  const bool binary = contains(bytes, "\nBINARY");
  const std::size_t cells_begin = bytes.find(contains(bytes, "POLYDATA") ? "\nLINES" : "\nCELL_TYPES") + 1;
  std::vector<std::size_t> starts;
  for (const std::string_view keyword : {"POLYGONS", "POINT_DATA", "CELL_DATA", "SCALARS", "LOOKUP_TABLE table 2",
                                         "VECTORS", "METADATA", "COLOR_SCALARS", "FIELD"}) {
    for (std::size_t at = bytes.find(keyword, cells_begin); at != bytes.npos; at = bytes.find(keyword, at + 1)) {
      // SCALARS stands in COLOR_SCALARS too.
      if (bytes[at - 1] == '\n') {
        starts.push_back(at);
      }
    }
  }
  starts.push_back(bytes.size());
  std::ranges::sort(starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    std::size_t end = starts[i] - 1;
    if (std::string_view(file.bytes).substr(0, end).ends_with(comment)) {
      end -= comment.size();
    }
    if (!binary) {
      while (is_space(bytes[end - 1])) {
        --end;
      }
      // A number cut is a number.
      while (!is_space(bytes[end - 2])) {
        --end;
      }
    }
    const bool metadata = i + 1 < starts.size() && bytes.compare(starts[i], 8, "METADATA") == 0;
    if ((end <= cut && cut <= starts[i]) || (metadata && starts[i] + 8 <= cut && cut < starts[i + 1])) {
      // Of the names of components there is a known number, the last of them an empty line.
      const std::size_t names = metadata ? bytes.find("COMPONENT_NAMES", starts[i]) : bytes.npos;
      return names == bytes.npos || cut < names + 15 || cut > bytes.find("\n\n", names) + 1;
    }
  }
  return false;
}

/// XML ends with the end of its root.
bool is_whole_xml(const AcceptedFile& file, std::size_t cut) {
  const std::string_view end = "</VTKFile>";
  return cut >= file.bytes.rfind(end) + end.size();
}

}  // namespace

FormatSample vtk_sample() {
  return {.format = trismooth::FileFormat::vtk,
          .add_files = &add_legacy,
          .is_whole = &is_whole_legacy,
          .rest_of = [](const AcceptedFile& file) {
            return contains(file.name, "_poly_") ? Rest::some_cells : Rest::all_cells;
          }};
}

FormatSample vtu_sample() {
  return {.format = trismooth::FileFormat::vtu, .add_files = &add_xml_of<false>, .is_whole = &is_whole_xml};
}

FormatSample vtp_sample() {
  return {.format = trismooth::FileFormat::vtp,
          .add_files = &add_xml_of<true>,
          .is_whole = &is_whole_xml,
          .cells = {{cell_type::vertex, cell_type::poly_vertex},
                    {cell_type::line, cell_type::poly_line},
                    {cell_type::triangle, cell_type::quad, cell_type::polygon},
                    {cell_type::triangle_strip}}};
}

}  // namespace accepted_files
