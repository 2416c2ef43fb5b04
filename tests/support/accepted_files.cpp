#include "support/accepted_files.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "trismooth/mesh_io/codec.h"

#include "support/accepted_freefem_files.h"
#include "support/accepted_inp_files.h"
#include "support/accepted_medit_files.h"
#include "support/accepted_mfem_files.h"
#include "support/accepted_msh_files.h"
#include "support/accepted_nastran_files.h"
#include "support/accepted_ocean_files.h"
#include "support/accepted_su2_files.h"
#include "support/accepted_triangle_files.h"
#include "support/accepted_unv_files.h"
#include "support/accepted_vtk_files.h"

namespace accepted_files {

namespace {

std::string with_line_ends(std::string_view text, std::string_view line_end) {
  std::string changed;
  for (const char c : text) {
    changed += c == '\n' ? std::string(line_end) : std::string(1, c);
  }
  return changed;
}

std::string text_of(const std::array<double, 3>& point) {
  return fmt::format("{} {} {}", point[0], point[1], point[2]);
}

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

/// The faces in the words of OBJ; `word` makes one of a vertex, counted from 0.
std::string obj_faces(const Mesh& all, const std::function<std::string(int)>& word) {
  std::string text;
  for (const std::vector<int>& face : all.faces) {
    text += 'f';
    for (const int vertex : face) {
      text += " " + word(vertex);
    }
    text += '\n';
  }
  return text;
}

std::string obj_vertices(const Mesh& all, std::string_view more = "") {
  std::string text;
  for (const auto& point : all.points) {
    text += fmt::format("v {}{}\n", text_of(point), more);
  }
  return text;
}

void add_obj(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"obj_" + name, ".obj", std::move(bytes)});
  };
  const Mesh triangles = mesh(false);
  const Mesh others = mesh(true);
  const auto number = [](int v) { return fmt::format("{}", v + 1); };
  const std::string plain = "# a title\nmtllib a b.mtl\no plate\n" + obj_vertices(triangles) + "g one two\ns off\n" +
                            obj_faces(triangles, number);
  add("plain", plain);
  add("polygons", obj_vertices(others) + "usemtl steel # 1\nl 1 2\nl 1 2 3\np 9\n" + obj_faces(others, number));
  add("texture_normal", obj_vertices(others) + "vt 0.5 0.25\nvn 0 0 1\n" +
                            obj_faces(others, [](int v) { return fmt::format("{}/1/1", v + 1); }));
  add("normal", obj_vertices(triangles, " 0.5 0.25 1") + "vn 0 0 1\n" +
                    obj_faces(triangles, [](int v) { return fmt::format("{}//-1", v + 1); }));
  add("relative", obj_vertices(triangles, " 1.0") + "vt 0 0\n" +
                      obj_faces(triangles, [](int v) { return fmt::format("{}/1", v - 5); }));
  add("faces_first", obj_faces(triangles, number) + obj_vertices(triangles));
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  std::string broken = obj_vertices(triangles) + obj_faces(triangles, number);
  for (std::size_t at = broken.find(" 4\n"); at != std::string::npos; at = broken.find(" 4\n", at + 5)) {
    broken.replace(at, 1, " \\\n ");
  }
  add("continued", "g a \\\n b\nv \\\n" + broken.substr(2));
  add("no_final_newline", plain.substr(0, plain.size() - 1));
}

enum class PlyEncoding : std::uint8_t { ascii, little, big };

const char* ply_format(PlyEncoding encoding) {
  constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  return names[static_cast<int>(encoding)];
}

/// The rows behind a header.
class PlyRows {
 public:
  explicit PlyRows(PlyEncoding encoding) : encoding_(encoding) {}

  template <class T>
  void add(T value) {
    if (encoding_ == PlyEncoding::ascii) {
      text_ += fmt::format("{} ", +value);
    } else {
      text_ += vtk::number_bytes(value, encoding_ == PlyEncoding::big);
    }
  }
  void end_row() {
    if (encoding_ == PlyEncoding::ascii) {
      text_.back() = '\n';
    }
  }
  const std::string& text() const { return text_; }

 private:
  PlyEncoding encoding_;
  std::string text_;
};

std::string ply(PlyEncoding encoding, bool with_double, bool rich) {
  const Mesh all = mesh(rich);
  const bool is_text = encoding == PlyEncoding::ascii;
  const char* const real = with_double ? "double" : "float";
  std::string text = fmt::format("ply\nformat {} 1.0\n", ply_format(encoding));
  text += rich ? "comment made for a test\nobj_info 1\nelement material 1\nproperty list uchar uchar name\n" : "";
  text +=
      fmt::format("element vertex {}\n{}", all.points.size(), rich ? "property uchar red\nproperty int8 tag\n" : "");
  text += fmt::format("property {0} x\nproperty {0} y\nproperty {0} z\n", real);
  text += rich ? "property float32 depth\nproperty list ushort short near\n" : "";
  text += fmt::format("element face {}\n", all.faces.size());
  text += rich ? "property uint16 region\nproperty list uchar int vertex_indices\nproperty list int8 double more\n"
               : "property list uint8 uint32 vertex_index\n";
  text += rich ? "element edge 1\nproperty int vertex1\nproperty int vertex2\n" : "";
  text += "end_header\n";
  const auto add = [&](auto value) {
    if (is_text) {
      text += fmt::format("{} ", +value);
    } else {
      text += vtk::number_bytes(value, encoding == PlyEncoding::big);
    }
  };
  const auto add_real = [&](double value) { with_double ? add(value) : add(static_cast<float>(value)); };
  const auto end_row = [&] {
    if (is_text) {
      text.back() = '\n';
    }
  };
  if (rich) {
    for (const int c : {3, 97, 98, 99}) {
      add(static_cast<std::uint8_t>(c));
    }
    end_row();
  }
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (rich) {
      add(static_cast<std::uint8_t>(25 * i));
      add(static_cast<std::int8_t>(-3 * static_cast<int>(i)));
    }
    std::ranges::for_each(all.points[i], add_real);
    if (rich) {
      add(static_cast<float>(i) / 4);
      add(static_cast<std::uint16_t>(i % 2));
      for (std::size_t k = 0; k < i % 2; ++k) {
        add(std::int16_t{-300});
      }
    }
    end_row();
  }
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    if (rich) {
      add(static_cast<std::uint16_t>(1 + i / 3));
    }
    add(static_cast<std::uint8_t>(all.faces[i].size()));
    for (const int vertex : all.faces[i]) {
      add(vertex);
    }
    if (rich) {
      add(std::int8_t{1});
      add(0.125);
    }
    end_row();
  }
  if (rich) {
    add(0);
    add(1);
    end_row();
  }
  return text;
}

/// The coordinates in two types, and 64-bit integers, which the format lacks.
std::string wide_ply(PlyEncoding encoding) {
  const Mesh all = mesh(false);
  PlyRows rows(encoding);
  std::string text = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty float y\nproperty double z\n"
      "element face {}\nproperty uint64 id\nproperty list uint8 int64 vertex_indices\nend_header\n",
      ply_format(encoding), all.points.size(), all.faces.size());
  for (const auto& [x, y, z] : all.points) {
    rows.add(x);
    rows.add(static_cast<float>(y));
    rows.add(z);
    rows.end_row();
  }
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    rows.add((std::uint64_t{1} << 63) + i);
    rows.add(static_cast<std::uint8_t>(all.faces[i].size()));
    for (const int vertex : all.faces[i]) {
      rows.add(static_cast<std::int64_t>(vertex));
    }
    rows.end_row();
  }
  return text + rows.text();
}

/// The faces as triangle strips in one list, as Stanford's programs write them.
std::string strips_ply(PlyEncoding encoding) {
  const Mesh all = mesh(false);
  PlyRows rows(encoding);
  std::string text = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n",
      ply_format(encoding), all.points.size());
  for (const auto& point : all.points) {
    for (const double coordinate : point) {
      rows.add(static_cast<float>(coordinate));
    }
    rows.end_row();
  }
  rows.add(static_cast<std::int32_t>(4 * all.faces.size()));
  for (const auto& face : all.faces) {
    std::ranges::for_each(face, [&](int vertex) { rows.add(std::int32_t{vertex}); });
    rows.add(std::int32_t{-1});
  }
  rows.end_row();
  return text + rows.text();
}

void add_ply(std::vector<AcceptedFile>& files) {
  constexpr const char* names[] = {"ascii", "little_endian", "big_endian"};
  for (const auto encoding : {PlyEncoding::ascii, PlyEncoding::little, PlyEncoding::big}) {
    const char* const name = names[static_cast<int>(encoding)];
    files.push_back({fmt::format("ply_{}_wide", name), ".ply", wide_ply(encoding)});
    files.push_back({fmt::format("ply_{}_strips", name), ".ply", strips_ply(encoding)});
    files.push_back({fmt::format("ply_{}_tail", name), ".ply", ply(encoding, false, false) + "made for a test\n"});
  }
  for (const auto encoding : {PlyEncoding::ascii, PlyEncoding::little, PlyEncoding::big}) {
    for (const bool with_double : {false, true}) {
      for (const bool rich : {false, true}) {
        files.push_back({fmt::format("ply_{}_{}{}", names[static_cast<int>(encoding)], with_double ? "double" : "float",
                                     rich ? "_rich" : ""),
                         ".ply", ply(encoding, with_double, rich)});
      }
    }
  }
  const std::string plain = ply(PlyEncoding::ascii, true, false);
  files.push_back({"ply_mark", ".ply", "\xEF\xBB\xBF" + plain});
  files.push_back({"ply_crlf", ".ply", with_line_ends(plain, "\r\n")});
  files.push_back({"ply_cr", ".ply", with_line_ends(plain, "\r")});
  std::string crlf_header = ply(PlyEncoding::little, false, false);
  const std::size_t header_size = crlf_header.find("end_header\n") + 11;
  crlf_header.replace(0, header_size, with_line_ends(crlf_header.substr(0, header_size), "\r\n"));
  files.push_back({"ply_little_endian_crlf", ".ply", crlf_header});
}

std::string text_stl(int solids) {
  const Mesh all = mesh(false);
  const std::size_t each = all.faces.size() / static_cast<std::size_t>(solids);
  std::string text;
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    text += i % each == 0 ? fmt::format("solid part {}\n", i / each) : "";
    text += " facet normal 0 0 1\n  outer loop\n";
    for (const int vertex : all.faces[i]) {
      text += "   vertex " + text_of(all.points[static_cast<std::size_t>(vertex)]) + "\n";
    }
    text += "  endloop\n endfacet\n";
    text += (i + 1) % each == 0 ? fmt::format("endsolid part {}\n", i / each) : "";
  }
  return text;
}

std::string binary_stl(std::string title, bool attributes) {
  const Mesh all = mesh(false);
  title.resize(80);
  title += vtk::number_bytes(static_cast<std::uint32_t>(all.faces.size()), false);
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    std::vector<std::array<double, 3>> rows{{0, 0, 1}};
    for (const int vertex : all.faces[i]) {
      rows.push_back(all.points[static_cast<std::size_t>(vertex)]);
    }
    for (const auto& row : rows) {
      for (const double number : row) {
        title += vtk::number_bytes(static_cast<float>(number), false);
      }
    }
    title += vtk::number_bytes(static_cast<std::uint16_t>(attributes ? i : 0), false);
  }
  return title;
}

void add_stl(std::vector<AcceptedFile>& files) {
  const std::string text = text_stl(1);
  std::string upper = text;
  std::ranges::transform(upper, upper.begin(), [](char c) { return 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c; });
  files.push_back({"stl_ascii", ".stl", text});
  files.push_back({"stl_ascii_solids", ".stl", text_stl(2)});
  files.push_back({"stl_ascii_crlf", ".stl", with_line_ends(upper, "\r\n")});
  files.push_back({"stl_ascii_cr", ".stl", with_line_ends(text, "\r")});
  files.push_back({"stl_ascii_mark", ".stl", "\xEF\xBB\xBF" + text});
  files.push_back({"stl_ascii_no_end", ".stl", text.substr(0, text.find("endsolid"))});
  std::string coloured = text_stl(2);
  for (std::size_t at = coloured.find(" facet"); at != std::string::npos; at = coloured.find(" facet", at + 30)) {
    coloured.insert(at, " color 0.5 0.25 1\n");
  }
  coloured.insert(coloured.find("  endloop"), "\tMaterial brass\n");
  files.push_back({"stl_ascii_coloured", ".stl", coloured});
  files.push_back({"stl_binary_tail", ".stl", binary_stl("COLOR=", true) + "made for a test\n"});
  files.push_back({"stl_binary", ".stl", binary_stl("", false)});
  files.push_back({"stl_binary_solid", ".stl", binary_stl("solid that is none", true)});
}

std::vector<AcceptedFile> make_all() {
  std::vector<AcceptedFile> files;
  add_off(files);
  add_binary_off(files);
  add_obj(files);
  add_ply(files);
  add_stl(files);
  vtk::add_legacy(files);
  vtk::add_xml(files);
  add_su2(files);
  add_ocean_files(files);
  add_medit(files);
  add_freefem(files);
  add_inp(files);
  add_mfem(files);
  add_triangle(files);
  add_nastran(files);
  add_unv(files);
  msh::add(files);
  return files;
}

}  // namespace

Mesh mesh(bool others) {
  Mesh all{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0.75, 1.25, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  if (others) {
    all.points.insert(all.points.end(), {{4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}});
    all.faces.insert(all.faces.end(), {{1, 5, 6, 2}, {3, 2, 6, 7, 8}});
  }
  return all;
}

trismooth::FileFormat format_of(const AcceptedFile& file) {
  const std::string first_word = file.name.substr(0, file.name.find('_'));
  const auto named = trismooth::format_named(first_word == "legacy" ? "vtk" : first_word);
  const auto formats = trismooth::formats_of("file" + file.extension);
  return named && std::ranges::find(formats, *named) != formats.end() ? *named : formats.at(0);
}

bool is_one_file(const AcceptedFile& file) {
  return trismooth::codec_of(format_of(file)).partner_of == nullptr;
}

const std::vector<AcceptedFile>& all() {
  static const std::vector<AcceptedFile> files = make_all();
  return files;
}

}  // namespace accepted_files
