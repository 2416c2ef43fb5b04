// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases.h"
#include "tool_runs.h"

/// Files of the formats with groups and names: many of whatever they may have many of.
namespace {

/// Four triangles around a vertex, as rows with something in front of each and behind each.
std::string rows(const std::vector<std::string>& all, const std::function<std::string(std::size_t)>& begin,
                 std::string_view separator, std::string_view end = "\n") {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += begin(i);
    for (const char c : all[i]) {
      text += c == ' ' ? std::string(separator) : std::string(1, c);
    }
    text += end;
  }
  return text;
}

const std::vector<std::string> plate_points{"0 0", "1 0", "1 1", "0 1", ".6 .7"};
const std::vector<std::string> plate_corners_from_0{"0 1 4", "1 2 4", "2 3 4", "3 0 4"};
const std::vector<std::string> plate_corners_from_1{"1 2 5", "2 3 5", "3 4 5", "4 1 5"};

std::string number_of(std::size_t i) {
  return std::to_string(i + 1) + " ";
}
constexpr auto nothing_of = [](std::size_t /*i*/) { return std::string(); };

constexpr std::string_view msh_4_begin = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
constexpr std::string_view msh_2_begin = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

std::string msh_2_nodes() {
  return "$Nodes\n5\n" + rows(plate_points, &number_of, " ", " 0\n") + "$EndNodes\n";
}

/// Every element on an entity of its own, whose group has a name, and as many nodes, each on an entity of its own.
std::string msh_entities(int count) {
  const std::string all = std::to_string(count + 4);
  std::string text = std::string(msh_4_begin) + "$PhysicalNames\n" + all + "\n";
  text += repeated(count + 4, [](const auto& number) { return "2 " + number + " \"group " + number + "\"\n"; });
  text += "$EndPhysicalNames\n$Entities\n0 0 " + all + " 0\n";
  text += repeated(count + 4, [](const auto& number) { return number + " 0 0 0 1 1 0 1 " + number + " 0\n"; });
  text += "$EndEntities\n$Nodes\n" + std::to_string(count + 5) + " " + std::to_string(count + 5) + " 1 9\n";
  for (std::size_t i = 0; i < plate_points.size(); ++i) {
    text += "2 0 0 1\n" + std::to_string(i + 1) + "\n" + plate_points[i] + " 0\n";
  }
  text += repeated(count, [](const auto& number) { return "2 0 0 1\n9" + number + "7\n" + number + " 3 0\n"; });
  text += "$EndNodes\n$Elements\n" + all + " " + all + " 1 9\n";
  for (std::size_t i = 0; i < plate_corners_from_1.size(); ++i) {
    text += "2 " + std::to_string(i) + " 2 1\n" + std::to_string(i + 1) + " " + plate_corners_from_1[i] + "\n";
  }
  for (int i = 4; i < count + 4; ++i) {
    text += "2 " + std::to_string(i) + " 15 1\n" + std::to_string(i + 1) + " 1\n";
  }
  return text + "$EndElements\n";
}

/// One cell in many groups, as version 2 says it.
std::string msh_repeated_elements(int count) {
  std::string text = std::string(msh_2_begin) + msh_2_nodes() + "$Elements\n" + std::to_string(count + 4) + "\n";
  text += rows(
      plate_corners_from_1, [](std::size_t i) { return number_of(i) + "2 2 1 1 "; }, " ");
  text += repeated(count, [](const auto& number) { return "9" + number + "5 2 2 2" + number + " 1 1 2 5\n"; });
  return text + "$EndElements\n";
}

/// Many fields, each of one value, and sections that nobody knows.
std::string msh_data(int count) {
  std::string text = std::string(msh_2_begin) + msh_2_nodes() + "$Elements\n4\n" +
                     rows(
                         plate_corners_from_1, [](std::size_t i) { return number_of(i) + "2 2 1 1 "; }, " ") +
                     "$EndElements\n";
  return text + repeated(count, [](const auto& number) {
           return "$NodeData\n1\n\"f" + number + "\"\n1\n0\n3\n0\n1\n1\n5 0.5\n$EndNodeData\n$Other" + number +
                  "\n1\n$EndOther" + number + "\n";
         });
}

std::string medit_text(const std::string& triangles, const std::string& rest) {
  return "MeshVersionFormatted 2\nDimension 2\nVertices 5\n" + rows(plate_points, nothing_of, " ", " 0\n") + triangles +
         rest + "End\n";
}
/// Every triangle of a region of its own, and keywords that nobody knows.
std::string medit_regions(int count) {
  std::string triangles = "Triangles " + std::to_string(count + 4) + "\n" +
                          rows(plate_corners_from_1, nothing_of, " ", " 1\n") +
                          repeated(count, [](const auto& number) { return "1 2 5 9" + number + "\n"; });
  return medit_text(triangles, repeated(count, [](const auto& number) { return "Unknown" + number + " 1\n2\n"; }));
}

/// A strip of triangles with a row of vertices inside, each of a marker of its own.
std::string medit_markers(int count) {
  const std::string points = "Vertices " + std::to_string(3 * count + 3) + "\n";
  const auto column = [](const std::string& x, const std::string& marker) {
    return x + " 0 1\n" + x + " 1 " + marker + "\n" + x + " 2 1\n";
  };
  std::string triangles = "Triangles " + std::to_string(4 * count) + "\n";
  for (int first = 1; first <= 3 * count; ++first) {
    if (first % 3 != 0) {
      const std::string a = number_of(static_cast<std::size_t>(first - 1));
      const std::string b = number_of(static_cast<std::size_t>(first));
      const std::string c = number_of(static_cast<std::size_t>(first) + 2);
      const std::string d = number_of(static_cast<std::size_t>(first) + 3);
      triangles.append(a).append(c).append(b).append("1\n").append(b).append(c).append(d).append("1\n");
    }
  }
  return "MeshVersionFormatted 2\nDimension 2\n" + points +
         repeated(count, [&](const auto& number) { return column(number, "1" + number); }) +
         column(std::to_string(count), "0") + triangles + "End\n";
}

std::string su2_markers(int count) {
  return "NDIME= 2\nNELEM= 4\n" +
         rows(
             plate_corners_from_0, [](std::size_t) { return "5 "; }, " ") +
         "NPOIN= 5\n" + rows(plate_points, nothing_of, " ") + "NMARK= " + std::to_string(count) + "\n" +
         repeated(count, [](const auto& number) { return "MARKER_TAG= m" + number + "\nMARKER_ELEMS= 1\n3 0 1\n"; });
}

std::string inp_mesh() {
  return "*NODE\n" +
         rows(
             plate_points, [](std::size_t i) { return std::to_string(i + 1) + ","; }, ",") +
         "*ELEMENT, TYPE=CPS3, ELSET=all\n" +
         rows(
             plate_corners_from_1, [](std::size_t i) { return std::to_string(i + 1) + ","; }, ",");
}
/// Each a set of the one before it.
std::string inp_sets_of_sets(int count) {
  return inp_mesh() + "*ELSET, ELSET=s\n1\n*NSET, NSET=n\n1\n" + repeated(count, [](const auto& number) {
           return "*ELSET, ELSET=s" + number + "\ns, 2\n*NSET, NSET=n" + number + ", ELSET=s" + number +
                  "\n*NSET, NSET=g" + number + ", GENERATE\n1, 5\n";
         });
}
std::string inp_sections(int count) {
  return inp_mesh() + repeated(count, [](const auto& number) {
           return "*ELSET, ELSET=s" + number + "\n1\n*SOLID SECTION, ELSET=s" + number + ", MATERIAL=m\n1.\n";
         });
}
/// Parts with a mesh each, each in the assembly.
std::string inp_parts(int count) {
  return repeated(count,
                  [](const auto& number) { return "*PART, NAME=p" + number + "\n" + inp_mesh() + "*END PART\n"; }) +
         "*ASSEMBLY, NAME=a\n" +
         repeated(count,
                  [](const auto& number) {
                    return "*INSTANCE, NAME=i" + number + ", PART=p" + number + "\n*END INSTANCE\n*NSET, NSET=s" +
                           number + ", INSTANCE=i" + number + "\n1, 2\n";
                  }) +
         "*END ASSEMBLY\n";
}
/// Rows of which all leave a coordinate out, and blocks of one element.
std::string inp_gaps(int count) {
  return inp_mesh() + "*NODE\n" + repeated(count, [](const auto& number) { return "9" + number + "9, , 3, 0\n"; }) +
         repeated(count, [](const auto& number) { return "*ELEMENT, TYPE=MASS\n9" + number + "9,\n1\n"; });
}

std::string adcirc_grid(const std::string& rest) {
  return "a grid\n4 5\n" + rows(plate_points, &number_of, " ", " 7.5\n") +
         rows(
             plate_corners_from_1, [](std::size_t i) { return number_of(i) + "3 "; }, " ") +
         rest;
}
std::string adcirc_boundaries(int count) {
  const std::string all = std::to_string(count);
  const std::string nodes = std::to_string(2 * count);
  const auto boundaries = [&](const std::string& type) {
    return all + "\n" + nodes + "\n" + repeated(count, [&](const auto&) { return "2" + type + "\n1\n2\n"; });
  };
  return adcirc_grid(boundaries("") + boundaries(" 20"));
}
/// Nodes of no element, whose numbers are far apart and descend.
std::string adcirc_far_numbers(int count) {
  std::string text = "a grid\n4 " + std::to_string(count + 5) + "\n" + rows(plate_points, &number_of, " ", " 7.5\n");
  for (int i = count; i > 0; --i) {
    text += std::to_string(1000 * i) + " 0 5 7.5\n";
  }
  return text + rows(
                    plate_corners_from_1, [](std::size_t i) { return number_of(i) + "3 "; }, " ");
}

std::string sms_strings(int count) {
  return "MESH2D\n" +
         rows(
             plate_points, [](std::size_t i) { return "ND " + number_of(i); }, " ", " 7.5\n") +
         rows(
             plate_corners_from_1, [](std::size_t i) { return "E3T " + number_of(i); }, " ", " 1\n") +
         repeated(count, [](const auto& number) {
           return "NS 1\nNS 2 -3 \"s" + number + "\"\nMAT " + number + " \"m" + number + "\"\nCARD" + number +
                  " 1\nE3T 9" + number + "5 1 2 5 " + number + "\n";
         });
}

std::string freefem_labels(int count) {
  const std::string all = std::to_string(count);
  return "5 4 " + all + "\n" + rows(plate_points, nothing_of, " ", " 3\n") +
         rows(plate_corners_from_1, nothing_of, " ", " 1\n") +
         repeated(count, [](const auto& number) { return "1 2 " + number + "\n"; });
}

std::string mfem_attributes(int count) {
  const std::string all = std::to_string(count);
  return "MFEM mesh v1.3\ndimension\n2\nelements\n4\n" +
         rows(
             plate_corners_from_0, [](std::size_t i) { return number_of(i) + "2 "; }, " ") +
         "attribute_sets\n" + all + "\n" +
         repeated(count, [](const auto& number) { return "\"s" + number + "\" 2 1 2\n"; }) + "boundary\n" + all + "\n" +
         repeated(count, [](const auto& number) { return "9" + number + " 1 0 1\n"; }) + "bdr_attribute_sets\n" + all +
         "\n" + repeated(count, [](const auto& number) { return "\"b" + number + "\" 1 9" + number + "\n"; }) +
         "vertices\n5\n2\n" + rows(plate_points, nothing_of, " ") + "mfem_mesh_end\n";
}

/// A fan of triangles whose sides have middles in a grid function.
std::string mfem_nodes(int count) {
  const auto half = [](const std::string& number, int more) {
    return std::to_string((std::stoi(number) + more) / 2.0);
  };
  return "MFEM mesh v1.0\ndimension\n2\nelements\n" + std::to_string(count) + "\n" +
         repeated(count,
                  [](const auto& number) {
                    const int i = std::stoi(number) + 1;
                    return "1 2 0 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
                  }) +
         "boundary\n0\nvertices\n" + std::to_string(count + 2) +
         "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_2D_P2\nVDim: 2\nOrdering: 1\n0 1\n" +
         repeated(count + 1, [](const auto& number) { return std::to_string(std::stoi(number) + 1) + " 0\n"; }) +
         "0.5 0.5\n" + repeated(count, [&half](const auto& number) {
           return std::to_string(std::stoi(number) + 1) + ".5 0\n" + half(number, 2) + " 0.5\n";
         });
}

/// Groups that overlap, each with a point, and data sets of others.
std::string unv_groups(int count) {
  const auto set = [](const std::string& number, const std::string& records) {
    return "    -1\n" + number + "\n" + records + "    -1\n";
  };
  return set("2411", rows(
                         plate_points, [](std::size_t i) { return number_of(i) + "1 1 11\n"; }, " ", " 0\n")) +
         set("2412", rows(
                         plate_corners_from_1, [](std::size_t i) { return number_of(i) + "91 1 0 7 3\n"; }, " ")) +
         set("2467", repeated(count,
                              [](const auto& number) {
                                return number + " 0 0 0 0 0 0 3\ng" + number + "\n8 1 0 0 8 2 0 0\n7 5 0 0\n";
                              })) +
         repeated(count, [&set](const auto& number) { return set("5" + number, "of others\n"); });
}

/// Attributes of its own for every triangle of a mesh in two files.
GrowthCase triangle_regions() {
  return {"regions: node to node", 200, [](int count, const ScratchFolder& folder) {
            folder.write("in.ele", std::to_string(count + 4) + " 3 1\n" +
                                       rows(plate_corners_from_1, &number_of, " ", " 1\n") +
                                       repeated(count, [n = 4](const auto& number) mutable {
                                         return std::to_string(++n) + " 1 2 5 9" + number + "\n";
                                       }));
            const std::string from = folder.write("in.node", "5 2\n" + rows(plate_points, &number_of, " "));
            const std::string to = folder / "out.node";
            return [=] { run_tool(from, to); };
          }};
}

}  // namespace

std::vector<GrowthCase> fem_file_cases() {
  std::vector<GrowthCase> cases;
  for (const auto& [name, extension] : std::vector<std::pair<std::string, std::string>>{{"msh", "msh"},
                                                                                        {"medit", "mesh"},
                                                                                        {"medit", "meshb"},
                                                                                        {"su2", "su2"},
                                                                                        {"inp", "inp"},
                                                                                        {"adcirc", "14"},
                                                                                        {"2dm", "2dm"},
                                                                                        {"freefem", "msh"},
                                                                                        {"mfem", "mesh"},
                                                                                        {"triangle", "node"},
                                                                                        {"unv", "unv"},
                                                                                        {"exodus", "exo"},
                                                                                        {"ugrid", "nc"},
                                                                                        {"xdmf", "xdmf"},
                                                                                        {"med", "med"},
                                                                                        {"cgns", "cgns"},
                                                                                        {"selafin", "slf"},
                                                                                        {"off", "off.gz"}}) {
    cases.push_back(chain_in(name, extension));
  }
  for (const char* const output : {"msh", "vtu"}) {
    cases.push_back(file_case("entities", 100, "msh", output, &msh_entities));
    cases.push_back(file_case("cells in many groups", 400, "msh", output, &msh_repeated_elements));
    cases.push_back(file_case("data", 50, "msh", output, &msh_data));
  }
  // A group of CGNS takes HDF5 longer than all the rest.
  for (const auto& [output, groups] :
       std::vector<std::pair<std::string, int>>{{"xdmf", 100}, {"exo", 400}, {"med", 400}, {"cgns", 20}}) {
    cases.push_back(file_case("cells in many groups", groups, "msh", output, &msh_repeated_elements));
    cases.push_back(file_case("regions", std::min(groups, 50), "mesh", output, &medit_regions));
  }
  for (const char* const output : {"mesh", "vtu", "msh"}) {
    cases.push_back(file_case("regions", 100, "mesh", output, &medit_regions));
  }
  cases.push_back(file_case("markers of points", 200, "mesh", "mesh", &medit_markers));
  for (const char* const output : {"su2", "msh"}) {
    cases.push_back(file_case("markers", 100, "su2", output, &su2_markers));
  }
  for (const char* const output : {"inp", "vtu"}) {
    cases.push_back(file_case("sets of sets", 100, "inp", output, &inp_sets_of_sets));
    cases.push_back(file_case("sections", 100, "inp", output, &inp_sections));
    cases.push_back(file_case("parts", 50, "inp", output, &inp_parts));
    cases.push_back(file_case("gaps and small blocks", 100, "inp", output, &inp_gaps));
  }
  cases.push_back(file_case("sections", 100, "inp", "msh", &inp_sections));
  cases.push_back(file_case("boundaries", 100, "14", "14", &adcirc_boundaries));
  cases.push_back(file_case("boundaries", 100, "14", "2dm", &adcirc_boundaries));
  cases.push_back(file_case("numbers far apart", 200, "14", "14", &adcirc_far_numbers));
  cases.push_back(file_case("nodestrings and materials", 100, "2dm", "2dm", &sms_strings));
  cases.push_back(file_case("nodestrings and materials", 100, "2dm", "inp", &sms_strings));
  cases.push_back(file_case("labels", 200, "msh", "mesh", &freefem_labels));
  cases.push_back(file_case("attributes and their sets", 100, "mesh", "msh", &mfem_attributes));
  cases.push_back(file_case("attributes and their sets", 100, "mesh", "vtu", &mfem_attributes));
  cases.push_back(file_case("nodes of degree 2", 100, "mesh", "mesh", &mfem_nodes));
  cases.push_back(file_case("groups", 100, "unv", "unv", &unv_groups));
  cases.push_back(file_case("groups", 100, "unv", "msh", &unv_groups));
  cases.push_back(file_case("groups", 100, "unv", "exo", &unv_groups));
  cases.push_back(triangle_regions());
  return cases;
}
