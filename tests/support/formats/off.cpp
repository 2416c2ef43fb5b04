// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/cell_list.h"

#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

/// How an OFF file spells the mesh.
struct OffSpelling {
  std::string head = "OFF\n";
  bool others = false;
  std::string counts_end = " 0";
  std::function<std::string(std::size_t)> vertex_fields = [](std::size_t) { return ""; };
  std::function<std::string(std::size_t)> face_fields = [](std::size_t) { return ""; };
};

std::string off(const OffSpelling& spelling) {
  const Mesh all = mesh(spelling.others);
  std::string text =
      fmt::format("{}{} {}{}\n", spelling.head, all.points.size(), all.faces.size(), spelling.counts_end);
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    text += text_of(all.points[i]) + spelling.vertex_fields(i) + "\n";
  }
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    text += fmt::format("{} {}{}\n", all.faces[i].size(), fmt::join(all.faces[i], " "), spelling.face_fields(i));
  }
  return text;
}

void add_off(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"off_" + name, ".off", std::move(bytes)});
  };
  const auto bytes_rgba = [](std::size_t i) { return fmt::format(" {} 128 9 255", i * 50); };
  const auto bytes_rgb = [](std::size_t i) { return fmt::format(" {} 128 9", i * 40); };
  const auto real_rgba = [](std::size_t i) { return fmt::format(" 0.{} 0.25 1 1.0", i); };
  const auto normal = [](std::size_t) { return std::string(" 0 0 1"); };
  const std::string plain = off({});
  add("plain", plain);
  add("polygons", off({.others = true}));
  add("colours", off({.head = "COFF\n", .vertex_fields = bytes_rgba}));
  add("real_colours", off({.head = "COFF\n", .vertex_fields = real_rgba}));
  add("normals", off({.head = "NOFF\n", .vertex_fields = normal}));
  add("texture", off({.head = "STOFF\n", .vertex_fields = [](std::size_t i) { return fmt::format(" 0.{} 0", i); }}));
  add("all_fields", off({.head = "STCNOFF\n",
                         .vertex_fields = [&](std::size_t i) { return normal(i) + real_rgba(i) + " 0.5 0.25"; }}));
  add("face_colours", off({.others = true, .face_fields = bytes_rgb}));
  add("real_face_colours", off({.face_fields = real_rgba}));
  add("mixed_face_colours", off({.face_fields = [&](std::size_t i) { return i % 2 == 0 ? " 7" : bytes_rgb(i); }}));
  add("comments", off({.head = "# a title\nOFF # of a mesh\n\n# counts\n",
                       .counts_end = " 8 # edges",
                       .vertex_fields = [](std::size_t i) { return fmt::format(" # vertex {}\n", i); },
                       .face_fields = [](std::size_t) { return "\t"; }}));
  add("lower_case", off({.head = "off\n"}));
  add("lower_case_fields", off({.head = "stcnoff\n", .vertex_fields = [&](std::size_t i) {
                                  return normal(i) + bytes_rgba(i) + " 0.5 0.25";
                                }}));
  add("undeclared_colours", off({.others = true, .vertex_fields = bytes_rgb}));
  add("colours_of_faces_alone", off({.head = "COFF\n", .face_fields = bytes_rgb}));
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("counts_on_first_line", off({.head = "OFF "}));
  add("counts_glued", off({.head = "OFF"}));
  add("no_keyword", off({.head = ""}));
  add("no_edge_count", off({.counts_end = ""}));
  add("no_final_newline", plain.substr(0, plain.size() - 1));
  add("words_at_end", plain + "made for a test\n");
  add("exponents",
      "OFF\n\t5\t4 0\n 0e0\t-0.0\t+0\n2E+00 0.0 -0\n\t20e-1 .2E1 0.\n0 2.000000000000000000000000 0\n7.5E-1\t"
      "+12.5e-1 \t 0.0e+00 \n\t3 0 1 4\n 3 1 2 4\n3\t2 3 4\n3 3 0 4 \n");
}

/// How a binary OFF file spells the mesh: in fields of 32 bits.
struct BinaryOffSpelling {
  std::string keyword = "OFF";
  bool big_endian = true;
  bool others = false;
  std::vector<float> vertex_reals = {};
  std::vector<std::int32_t> vertex_integers = {};
  bool counts_face_colours = true;
  std::vector<float> face_reals = {};
  std::vector<std::int32_t> face_integers = {};
};

std::string binary_off(const BinaryOffSpelling& spelling) {
  const Mesh all = mesh(spelling.others);
  std::string bytes = spelling.keyword + " BINARY\n";
  const auto add = [&](auto number) { bytes += vtk::number_bytes(number, spelling.big_endian); };
  const auto count = [](const auto& container) { return static_cast<std::int32_t>(container.size()); };
  add(count(all.points));
  add(count(all.faces));
  add(std::int32_t{0});
  for (const auto& point : all.points) {
    for (const double coordinate : point) {
      add(static_cast<float>(coordinate));
    }
    std::ranges::for_each(spelling.vertex_reals, add);
    std::ranges::for_each(spelling.vertex_integers, add);
  }
  for (const auto& face : all.faces) {
    add(count(face));
    std::ranges::for_each(face, add);
    if (spelling.counts_face_colours) {
      add(count(spelling.face_reals) + count(spelling.face_integers));
    }
    std::ranges::for_each(spelling.face_reals, add);
    std::ranges::for_each(spelling.face_integers, add);
  }
  return bytes;
}

void add_binary_off(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, const BinaryOffSpelling& spelling) {
    files.push_back({"off_" + name, ".off", binary_off(spelling)});
  };
  // As Geomview and CGAL write it.
  add("big_endian", {.others = true});
  add("big_endian_fields", {.keyword = "STCNOFF", .vertex_reals = {0, 0, 1, 0.5F, 0.25F, 1, 1, 0.5F, 0.25F}});
  add("big_endian_face_fields", {.face_reals = {1, 0.5F, 0.25F}});
  // As OpenMesh and pmp-library do.
  add("little_endian", {.big_endian = false, .others = true, .counts_face_colours = false});
  add("little_endian_fields", {.keyword = "CNOFF",
                               .big_endian = false,
                               .vertex_reals = {0, 0, 1},
                               .vertex_integers = {200, 100, 7},
                               .counts_face_colours = false,
                               .face_integers = {9, 8, 7}});
}

void add_all_off(std::vector<AcceptedFile>& files) {
  add_off(files);
  add_binary_off(files);
}

/// OFF ends with its last face, and that face may have no colour, or one of 1, 3 or 4 numbers.
bool is_whole_off(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "endian")) {
    return false;  // every byte counts
  }
  const std::string last_face = contains(file.bytes, "6 7 8") ? "6 7 8" : contains(file.bytes, "3 0 4") ? "3 0 4" : "?";
  const std::size_t end = file.bytes.rfind(last_face) + last_face.size();
  if (cut < end) {
    return false;
  }
  const std::size_t numbers =
      contains(file.name, "colours") ? words(std::string_view(file.bytes).substr(end, cut - end)).size() : 0;
  return numbers <= 4 && numbers != 2;
}

}  // namespace

FormatSample off_sample() {
  return {.format = trismooth::FileFormat::off,
          .add_files = &add_all_off,
          .is_whole = &is_whole_off,
          .cells = {{cell_type::triangle, cell_type::quad, cell_type::polygon}}};
}

}  // namespace accepted_files
