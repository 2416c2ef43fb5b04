// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "byte_files.h"

/// PLY files as the tests write them: their own idea of the format.
namespace ply_files {

using byte_files::number_bytes;

enum class Flavour { ascii, little, big };

inline std::string to_text(Flavour flavour) {
  return flavour == Flavour::ascii    ? "ascii"
         : flavour == Flavour::little ? "binary_little_endian"
                                      : "binary_big_endian";
}

/// Writes rows in one flavour.
class Rows {
 public:
  explicit Rows(Flavour flavour) : flavour_(flavour) {}

  template <class T>
  Rows& add(T number, const std::string& text) {
    if (flavour_ == Flavour::ascii) {
      bytes_ += text + " ";
    } else {
      bytes_ += number_bytes(number, flavour_ == Flavour::little ? std::endian::little : std::endian::big);
    }
    return *this;
  }
  template <class T>
  Rows& add(T number) {
    return add(number, std::to_string(number));
  }
  void end() {
    if (flavour_ == Flavour::ascii) {
      bytes_.back() = '\n';
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Flavour flavour_;
  std::string bytes_;
};

struct Coordinate {
  double value;
  std::string text;
};

/// A square of two triangles and a quad, its coordinates in texts that no writer would choose.
inline const std::vector<std::array<Coordinate, 3>> square{{{{0, "0"}, {0, "-0.0"}, {0, "0e5"}}},
                                                           {{{1, "1.000"}, {0, "0"}, {0, "0"}}},
                                                           {{{1, "+1"}, {1, "1e0"}, {0, "0"}}},
                                                           {{{0, "0"}, {1, "01"}, {0, "0"}}},
                                                           {{{0.5, ".5"}, {0.25, "0.25"}, {0, "0"}}}};

inline const std::string square_header_body =
    "comment made by hand\nobj_info nothing\nelement vertex 5\nproperty double x\nproperty uchar red\n"
    "property double y\nproperty double z\nelement camera 1\nproperty list uchar short shape\nproperty float focus\n"
    "element face 3\nproperty char side\nproperty list uchar int vertex_indices\nproperty list int float uv\n"
    "property ushort region\nend_header\n";

/// The square in one flavour.
inline std::string square_file(Flavour flavour) {
  Rows rows(flavour);
  std::uint8_t red = 250;
  for (const auto& [x, y, z] : square) {
    rows.add(x.value, x.text).add(red++).add(y.value, y.text).add(z.value, z.text).end();
  }
  rows.add(std::uint8_t{2}).add(std::int16_t{-3}).add(std::int16_t{4}).add(1.5F, "1.5").end();
  const std::vector<std::vector<std::int32_t>> faces{{0, 1, 4}, {1, 2, 4}, {2, 3, 0, 4}};
  std::int8_t side = -1;
  for (const auto& face : faces) {
    rows.add(side).add(static_cast<std::uint8_t>(face.size()));
    for (const std::int32_t vertex : face) {
      rows.add(vertex);
    }
    rows.add(std::int32_t{1}).add(0.5F, "0.5").add(static_cast<std::uint16_t>(65533 - side)).end();
    ++side;
  }
  return "ply\nformat " + to_text(flavour) + " 1.0\n" + square_header_body + rows.bytes();
}

inline std::string ascii(const std::string& declarations, const std::string& rows) {
  return "ply\nformat ascii 1.0\n" + declarations + "end_header\n" + rows;
}

inline const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
inline const std::string three = "element vertex 3\n" + xyz;
inline const std::string three_rows = "0 0 0\n1 0 0\n0 1 0\n";
inline const std::string face = "property list uchar int vertex_indices\n";

}  // namespace ply_files
