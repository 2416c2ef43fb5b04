// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/cell_list.h"

#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

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

/// Text ends with its last number; binary data with their last byte, unless something that is not read follows.
bool is_whole_ply(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "endian") && contains(file.name, "tail")) {
    return cut >= file.bytes.find("made for");
  }
  return contains(file.bytes, "format ascii") && cut > file.bytes.find_last_of("0123456789");
}

}  // namespace

FormatSample ply_sample() {
  return {.format = trismooth::FileFormat::ply,
          .add_files = &add_ply,
          .is_whole = &is_whole_ply,
          .cells = {{cell_type::triangle, cell_type::quad, cell_type::polygon}, {cell_type::line}}};
}

}  // namespace accepted_files
