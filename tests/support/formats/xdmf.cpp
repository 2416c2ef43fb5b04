// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/xdmf/xdmf_topology.h"

#include "support/format_sample.h"

namespace accepted_files {

namespace {

constexpr std::string_view triangles = "0 1 4\n1 2 4\n2 3 4\n3 0 4\n";
constexpr std::string_view flat_points = "0 0\n2 0\n2 2\n0 2\n0.75 1.25\n";
constexpr std::string_view points_in_space = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n0.75 1.25 0\n";

std::string item(std::string_view attributes, std::string_view numbers) {
  return "<DataItem " + std::string(attributes) + ">\n" + std::string(numbers) + "</DataItem>\n";
}

std::string element(std::string_view name, std::string_view attributes, std::string_view content) {
  return "<" + std::string(name) + " " + std::string(attributes) + ">\n" + std::string(content) + "</" +
         std::string(name) + ">\n";
}

std::string plain_topology() {
  return element("Topology", R"(TopologyType="Triangle" NumberOfElements="4" NodesPerElement="3")",
                 item(R"(NumberType="Int" Dimensions="4 3" Format="XML")", triangles));
}

std::string plain_geometry() {
  return element("Geometry", R"(GeometryType="XY")",
                 item(R"(DataType="Float" Precision="8" Dimensions="5 2" Format="XML")", flat_points));
}

std::string file(std::string_view domain, std::string_view head = "", std::string_view version = "3.0") {
  return "<?xml version=\"1.0\"?>\n" + std::string(head) + "<Xdmf Version=\"" + std::string(version) +
         "\" xmlns:xi=\"https://www.w3.org/2001/XInclude\">\n<Domain>\n" + std::string(domain) + "</Domain>\n</Xdmf>\n";
}

std::string uniform(std::string_view content, std::string_view name = "mesh") {
  return element("Grid", "Name=\"" + std::string(name) + "\" GridType=\"Uniform\"", content);
}

std::string plain_grid(std::string_view more = "") {
  return uniform(plain_topology() + plain_geometry() + std::string(more));
}

std::string with_line_ends(std::string text) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.replace(at, 1, "\r\n");
  }
  return text;
}

/// A step as dolfinx writes it, over the points and cells of a grid in front of it.
std::string step(std::string_view time, std::string_view values) {
  return uniform(
      R"x(<xi:include xpointer="xpointer(/Xdmf/Domain/Grid[@GridType='Uniform'][1]/*[self::Topology or self::Geometry])" />)x"
      "<Time Value=\"" +
          std::string(time) + "\" />" +
          element("Attribute", R"(Name="u" AttributeType="Scalar" Center="Node")",
                  item(R"(Dimensions="5 1" Format="XML" Precision="8")", values)),
      "u");
}

void add_xdmf(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"xdmf_" + name, ".xdmf", std::move(bytes)});
  };
  add("plain", file(plain_grid()));
  add("crlf", with_line_ends(file(plain_grid())));
  // XDMF 2 as FEniCS and ParaView wrote it.
  add("v2", file(element("Grid", "Name=\"mesh\" GridType=\"Uniform\"",
                         element("Topology", R"(Type="TRIANGLE" NumberOfElements="4")",
                                 item(R"(NumberType="UInt" Dimensions="4 3" Format="XML")", triangles)) +
                             element("Geometry", R"(Type="XYZ")",
                                     item(R"(Dimensions="5 3" Precision="4")", points_in_space))),
                 "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n", "2.0"));
  add("mixed",
      file(uniform(element("Topology", R"(TopologyType="Mixed" NumberOfElements="8")",
                           item(R"(NumberType="Int" Dimensions="35")",
                                "2 2 0 1\n1 1 3\n4 0 1 4\n4 1 2 4\n4 2 3 4\n4 3 0 4\n5 1 5 6 2\n3 5 3 2 6 7 8\n")) +
                   element("Geometry", R"(GeometryType="XYZ")",
                           item(R"(NumberType="Float" Precision="8" Dimensions="9 3")",
                                std::string(points_in_space) + "4 0 0\n4 2 0\n4 4 0\n0 4 0\n")))));
  add("split", file(uniform(plain_topology() + element("Geometry", R"(GeometryType="X_Y_Z")",
                                                       item(R"(Precision="8" Dimensions="5")", "0 2 2 0 0.75\n") +
                                                           item(R"(Precision="4" Dimensions="5")", "0 0 2 2 1.25\n") +
                                                           item(R"(Precision="8" Dimensions="5")", "0 0 0 0 0\n")))));
  add("reference",
      file(item(R"(Name="points" Precision="8" Dimensions="5 2" Format="XML")", flat_points) +
           uniform(plain_topology() +
                   element("Geometry", R"(GeometryType="XY")",
                           R"(<DataItem Reference="XML">/Xdmf/Domain/DataItem[@Name="points"]</DataItem>)"))));
  add("arrays",
      file(plain_grid(
          element("Attribute", R"(Name="depth" AttributeType="Scalar" Center="Node")",
                  item(R"(Precision="8" Dimensions="5 1")", "1 2 3 4 5.5\n")) +
          element("Attribute", R"(Name="flow" AttributeType="Vector" Center="Node")",
                  item(R"(Precision="4" Dimensions="5 3")", "0 0 1\n0 1 0\n1 0 0\n0 0 0\n-1 0.5 0\n")) +
          element("Attribute", R"(Name="region" AttributeType="Scalar" Center="Cell")",
                  item(R"(NumberType="Int" Precision="8" Dimensions="4")", "1 1 2 2\n")) +
          element("Set", R"(Name="inlet" SetType="Node")", item(R"(NumberType="Int" Dimensions="2")", "0 3\n")))));
  add("names",
      file(plain_grid(
          element("Attribute", R"(Name="inlet" AttributeType="Scalar" Center="Node")",
                  item(R"(NumberType="Int" Precision="1" Dimensions="5")", "1 0 0 1 0\n")) +
          element("Attribute", R"(Name="region" AttributeType="Scalar" Center="Cell")",
                  item(R"(NumberType="Int" Precision="8" Dimensions="4")", "1 1 2 2\n")) +
          R"x(<Information Name="names"><![CDATA[<main><map key="inlet" dim="0" array="inlet" set="1">1</map>)x" +
          R"x(<map key="steel" dim="2" array="region">1</map></main>]]></Information>)x")));
  add("tags",
      file(plain_grid() +
           uniform(R"x(<xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)" />)x" +
                       element("Topology", R"(TopologyType="PolyLine" NumberOfElements="2" NodesPerElement="2")",
                               item(R"(NumberType="Int" Dimensions="2 2")", "0 1\n1 2\n")) +
                       element("Attribute", R"(Name="facet_tags" AttributeType="Scalar" Center="Cell")",
                               item(R"(NumberType="Int" Dimensions="2 1")", "7\n8\n")),
                   "facet_tags")));
  add("time", file(plain_grid() + element("Grid", R"(Name="u" GridType="Collection" CollectionType="Temporal")",
                                          step("0", "1 2 3 4 5\n") + step("1", "2 3 4 5 6\n"))));
  add("comments",
      file("<!-- a mesh -->\n<Information Name=\"author\" Value=\"nobody\"/>\n" + plain_grid("<Time Value=\"1\"/>\n")));
}

bool is_whole_xdmf(const AcceptedFile& accepted, std::size_t cut) {
  const std::string_view end = "</Xdmf>";
  return cut >= accepted.bytes.rfind(end) + end.size();
}

}  // namespace

FormatSample xdmf_sample() {
  std::vector<std::uint8_t> types{cell_type::poly_vertex, cell_type::poly_line};
  for (const trismooth::XdmfCellType& type : trismooth::xdmf_cell_types) {
    types.push_back(type.type);
  }
  return {.format = trismooth::FileFormat::xdmf, .add_files = &add_xdmf, .is_whole = &is_whole_xdmf, .cells = {types}};
}

}  // namespace accepted_files
