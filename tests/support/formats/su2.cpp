// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/cell_list.h"

#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

std::string su2_replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string su2_points(bool numbered, std::string_view blank = " ") {
  const Mesh all = mesh(false);
  std::string text = fmt::format("NPOIN= {}\n", all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    text += fmt::format("{}{}{}", all.points[i][0], blank, all.points[i][1]);
    text += numbered ? fmt::format("{}{}\n", blank, i) : "\n";
  }
  return text;
}

/// The triangles [first, last) of the mesh, with the numbers of their points less `less`.
std::string su2_elements(std::size_t first, std::size_t last, bool numbered) {
  const Mesh all = mesh(false);
  std::string text = fmt::format("NELEM= {}\n", last - first);
  for (std::size_t i = first; i < last; ++i) {
    text += fmt::format("5 {}", fmt::join(all.faces[i], " ")) + (numbered ? fmt::format(" {}\n", i - first) : "\n");
  }
  return text;
}

const char* const su2_markers =
    "NMARK= 2\nMARKER_TAG= lower\nMARKER_ELEMS= 1\n3 0 1\nMARKER_TAG= others\nMARKER_ELEMS= 3\n3 1 2\n3 2 3\n3 3 0\n";

/// The mesh in the second of two zones; the first one is empty, since its points would be more than the mesh has.
std::string su2_zones() {
  return "NZONE= 2\n\nIZONE= 1\nNDIME= 2\nNELEM= 0\nNPOIN= 0\nNMARK= 0\n\nIZONE= 2\nNDIME= 2\n" +
         su2_elements(0, 4, true) + su2_points(true) + su2_markers;
}

void add_su2(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"su2_" + name, ".su2", std::move(bytes)});
  };
  const std::string plain = "NDIME= 2\n" + su2_elements(0, 4, false) + su2_points(false) + su2_markers;
  // As Gmsh writes it.
  add("numbered", "NDIME= 2\n" + su2_elements(0, 4, true) + su2_points(true) +
                      su2_replaced(su2_markers, "\n3 0 1\n", "\n3 0 1 \n"));
  add("plain", plain);
  add("points_first", "NDIME= 2\n" + su2_points(false) + su2_elements(0, 4, false) + su2_markers);
  add("dimension_last", su2_points(true, "\t") + su2_elements(0, 4, false) + su2_markers + "NDIME=2\n");
  add("blanks", su2_replaced(plain, "= ", " =\t"));
  add("no_blanks", su2_replaced(plain, "= ", "="));
  add("comments",
      "% a title\n%\n" + su2_replaced(su2_replaced(plain, "NPOIN= 5\n", "% points = 7\n\nNPOIN= 5 5 % all\n"),
                                      "\n5 1 2", " % first\n\n5 1 2"));
  add("halo", su2_replaced(plain, "NMARK= 2\n",
                           "NMARK= 3\nMARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_RECV= 1\n1 0 0\n1 2 0\n"));
  add("no_markers", "NDIME= 2\n" + su2_points(false) + su2_elements(0, 4, false) + "NMARK= 0\n");
  add("more", "AOA_OFFSET= 0.5\n" + plain +
                  "NPERIODIC= 1\nPERIODIC_INDEX= 0\n0 0 0\n0 0 0\n0 0 0\nNCHUNK= 1\nFFD_NBOX= 1\nFFD_TAG= 0\n"
                  "FFD_CORNER_POINTS= 2\n0 0\n2.5 2.5\nFFD_SURFACE_POINTS= 1\nlower 0 0.25 0.5\nthe end\n");
  add("zones", su2_zones());
  add("three_dimensions",
      su2_replaced(su2_replaced(su2_replaced(plain, "NDIME= 2", "NDIME= 3"), "0.75 1.25", "7.5e-1 +1.25 0."),
                   "NPOIN= 5\n0 0\n2 0\n2 2\n0 2\n", "NPOIN= 5\n0 0 0\n2 0 0\n2 2 -0\n0 2 0\n"));
  add("crlf", su2_replaced(plain, "\n", "\r\n"));
  add("cr", su2_replaced(plain, "\n", "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("no_final_newline", plain.substr(0, plain.size() - 1));
}

/// SU2 ends with its last marker, of which the last row may be cut within a last number, or with the dimension; what
/// follows may be any text.
bool is_whole_su2(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "no_markers")) {
    return cut >= file.bytes.find("NMARK= 0") + 8;
  }
  const std::string end = contains(file.name, "dimension_last") ? "NDIME=2" : "3 3 0";
  return cut >= file.bytes.find(end) + end.size();
}

}  // namespace

FormatSample su2_sample() {
  return {.format = trismooth::FileFormat::su2,
          .add_files = &add_su2,
          .is_whole = &is_whole_su2,
          .cells = {{cell_type::triangle, cell_type::quad}},
          .written_point = [](const std::array<double, 3>& point) {
            return std::array<double, 3>{point[0], point[1], 0};
          }};
}

}  // namespace accepted_files
