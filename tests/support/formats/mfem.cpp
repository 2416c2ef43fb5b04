// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/cell_list.h"

#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

constexpr std::string_view mfem_elements = "elements\n4\n1 2 0 1 4\n1 2 1 2 4\n2 2 2 3 4\n2 2 3 0 4\n";
constexpr std::string_view mfem_boundary = "boundary\n2\n3 1 0 1\n4 1 1 2\n";
constexpr std::string_view mfem_vertices = "vertices\n5\n2\n0 0\n2 0\n2 2\n0 2\n0.75 1.25\n";

/// The same, their places in a grid function.
std::string with_nodes(std::string_view version, std::string_view collection, std::string_view places) {
  return "MFEM mesh " + std::string(version) + "\n\ndimension\n2\n\n" + std::string(mfem_elements) + "\n" +
         std::string(mfem_boundary) +
         "\nvertices\n5\n\nnodes\nFiniteElementSpace\nFiniteElementCollection: " + std::string(collection) +
         "\nVDim: 2\n" + std::string(places);
}

std::string text(std::string_view version, std::string_view end = "") {
  return "MFEM mesh " + std::string(version) + "\n\ndimension\n2\n\n" + std::string(mfem_elements) + "\n" +
         std::string(mfem_boundary) + "\n" + std::string(mfem_vertices) + std::string(end);
}

std::string with_line_end(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

void add_mfem(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"mfem_" + name, ".mesh", std::move(bytes)});
  };
  add("v10", text("v1.0"));
  add("v11", text("v1.1", "\nmfem_mesh_end\n"));
  // As a rank of a parallel run writes it.
  add("v12_parallel", text("v1.2", "\nmfem_serial_mesh_end\n\ncommunication_groups\nnumber_of_groups 1\n1 0\n"));
  add("v13_sets", "MFEM mesh v1.3\ndimension\n2\n" + std::string(mfem_elements) +
                      "attribute_sets\n2\n\"steel core\" 1 2\nall 2 1 2\n" + std::string(mfem_boundary) +
                      "bdr_attribute_sets\n1\n\"inlet\" 1 3\n" + std::string(mfem_vertices) + "mfem_mesh_end\n");
  add("in_space", "MFEM mesh v1.0\n\ndimension\n2\n" + std::string(mfem_elements) + "boundary\n0\n" +
                      "vertices\n5\n3\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0.75 1.25 0\n");
  add("comments",
      "MFEM mesh v1.0\n#\n# MFEM Geometry Types\n#\ndimension # of the mesh\n2\nelements # four\n4\n"
      "1 2 0 1 4 # one\n1 2 1 2 4\n-7 2 2 3\n 4\n2 2 3 0 4\nvertices # first x\n5\n2\n+0 -0\n2e0 0.\n"
      "20e-1 .2E1\n0.0 2.0\n\t0.75 1.25");
  add("nodes", with_nodes("v1.0", "H1_2D_P1", "Ordering: 1\n\n0 0\n2 0\n2 2\n0 2\n0.75 1.25\n"));
  add("nodes_by_axis", with_nodes("v1.0", "Linear", "Ordering: 0\n\n0\n2\n+2\n0\n0.75\n\n0\n0\n2\n2\n1.25\n"));
  add("nodes_of_elements", with_nodes("v1.1", "L2_T1_2D_P1",
                                      "Ordering: 1\n\n0 0\n2 0\n0.75 1.25\n\n2 0\n2 2\n.75 1.25\n\n2 2\n0 2\n"
                                      "0.75 1.25\n\n0 2\n0 0\n0.75 1.25\n\nmfem_mesh_end\n"));
  add("crlf", with_line_end(text("v1.0"), "\r\n"));
  add("cr", with_line_end(text("v1.0"), "\r"));
  add("mark", "\xEF\xBB\xBF" + text("v1.0"));
}

/// From version 1.1 on MFEM's meshes have an end. Older ones end with a coordinate, wherever that is cut.
bool is_whole_mfem(const AcceptedFile& file, std::size_t cut) {
  constexpr std::string_view end = "mesh_end";
  const std::size_t found = file.bytes.find(end);
  if (found != file.bytes.npos) {
    return cut >= found + end.size();
  }
  return cut > file.bytes.find_last_of(" \n", file.bytes.find_last_not_of(" \r\n")) + 1;
}

}  // namespace

FormatSample mfem_sample() {
  return {.format = trismooth::FileFormat::mfem,
          .add_files = &add_mfem,
          .is_whole = &is_whole_mfem,
          .rest_of =
              [](const AcceptedFile& file) {
                return contains(file.bytes, "mesh_end") ? Rest::all_cells : Rest::another_mesh;
              },
          .cells = {{cell_type::triangle, cell_type::quad}, {cell_type::line}}};
}

}  // namespace accepted_files
