// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/cell_list.h"

#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

/// What text files are made of: all but the head in front of the triangles, so that a file that is cut is seen to be.
constexpr std::string_view flat_vertices = "Vertices\n5\n0 0 1\n2 0 2\n2 2 3\n0 2 4\n0.75 1.25 0\n";
constexpr std::string_view vertices_in_space = "Vertices\n5\n0 0 0 0\n2 0 0 0\n2 2 0 0\n0 2 0 0\n0.75 1.25 0 0\n";
constexpr std::string_view triangle_section = "Triangles\n4\n1 2 5 7\n2 3 5 7\n3 4 5 8\n4 1 5 8\n";

void add_medit_text(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"medit_" + name, ".mesh", std::move(bytes)});
  };
  const std::string flat(flat_vertices);
  const std::string faces(triangle_section);
  const std::string plain = "MeshVersionFormatted 2\n\nDimension 2\n\n" + flat + "\n" + faces + "\nEnd\n";
  add("flat", plain);
  add("in_space", " MeshVersionFormatted 2\n Dimension\n 3\n " + std::string(vertices_in_space) + faces + " End\n");
  add("sections", "MeshVersionFormatted 1\nDimension 2\n" + flat +
                      "Edges\n2\n1 2 3\n2 3 4\nCorners\n2\n1\n3\nRequiredVertices\n1\n2\nRidges\n1\n1\n"
                      "RequiredEdges\n2\n1\n2\nTangents\n1\n0.5 0.5\nTangentAtVertices\n1\n1 1\nSomething\n" +
                      faces + "End\n");
  add("comments",
      "# a title\nMeshVersionFormatted # a version\n3\nDimension\n2 # flat\nvertices # of all\n5\n"
      "0e0 -0 0\n2.0\n0\n+0 # a corner\n20e-1 .2E1 0\n0. 2.0 -7 .75 1.25 0\nTRIANGLES\n4\n1 2 5 0 2 3 5 0\n3 4 5\n 0\n"
      "4 1 5 0\n\nend");
  add("triangles_first", "MeshVersionFormatted 4\nDimension 2\n" + faces + flat + "End\n");
  add("no_end", "MeshVersionFormatted 0\nDimension 2\n" + flat + faces);
  add("required_triangles", "MeshVersionFormatted 2\nDimension 2\nIdentifier\n\"G = a mesh\"\nGeometry \"a.gref\"\n" +
                                flat + faces + "RequiredTriangles\n1\n4\nSubDomainFromMesh\n1\n3 1 1 0\nEnd\n");
  add("wide_references", "MeshVersionFormatted 4\nDimension 2\n" + flat +
                             "Triangles\n4\n1 2 5 5000000000\n2 3 5 -1\n3 4 5 0\n4 1 5 0\nEnd\n");
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
}

/// A binary file as libMeshb writes it.
class BinaryMedit {
 public:
  BinaryMedit(int version, bool big_endian) : version_(version), big_endian_(big_endian) {
    add(std::int32_t{1});
    add(static_cast<std::int32_t>(version));
  }

  /// Numbers behind a keyword; `last` has no next one.
  template <class Add>
  void block(std::int32_t code, const Add& add_numbers, bool last = false) {
    add(code);
    const std::size_t position_at = bytes_.size();
    position(0);
    add_numbers();
    if (!last) {
      const std::string rest = bytes_.substr(position_at + position_bytes());
      const std::size_t next = bytes_.size();
      bytes_.resize(position_at);
      position(next);
      bytes_ += rest;
    }
  }

  void add(std::int32_t number) { bytes_ += vtk::number_bytes(number, big_endian_); }
  void integer(std::int64_t number) {
    bytes_ += version_ < 4 ? vtk::number_bytes(static_cast<std::int32_t>(number), big_endian_)
                           : vtk::number_bytes(number, big_endian_);
  }
  void real(double number) {
    bytes_ += version_ == 1 ? vtk::number_bytes(static_cast<float>(number), big_endian_)
                            : vtk::number_bytes(number, big_endian_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::size_t position_bytes() const { return version_ < 3 ? 4 : 8; }
  void position(std::size_t next) {
    bytes_ += version_ < 3 ? vtk::number_bytes(static_cast<std::int32_t>(next), big_endian_)
                           : vtk::number_bytes(static_cast<std::int64_t>(next), big_endian_);
  }

  int version_;
  bool big_endian_;
  std::string bytes_;
};

std::string binary_medit(int version, bool big_endian, std::size_t dimension) {
  const Mesh all = mesh(false);
  BinaryMedit file(version, big_endian);
  const auto integers = [&file](std::initializer_list<std::int64_t> numbers) {
    for (const std::int64_t number : numbers) {
      file.integer(number);
    }
  };
  file.block(3, [&] { file.add(static_cast<std::int32_t>(dimension)); });
  file.block(4, [&] {
    integers({5});
    for (std::size_t i = 0; i < all.points.size(); ++i) {
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        file.real(all.points[i][axis]);
      }
      integers({static_cast<std::int64_t>(i)});
    }
  });
  file.block(5, [&] { integers({1, 1, 2, 9}); });
  file.block(13, [&] { integers({2, 1, 3}); });
  file.block(16, [&] { integers({1, 1}); });
  file.block(61, [&] { integers({1, 1, 1}); });
  file.block(250, [&] { integers({7}); });
  file.block(6, [&] {
    integers({4});
    for (const auto& face : all.faces) {
      integers({face[0] + 1, face[1] + 1, face[2] + 1, 7});
    }
  });
  file.block(
      54, [] {}, true);
  return file.bytes();
}

void add_medit(std::vector<AcceptedFile>& files) {
  add_medit_text(files);
  for (const int version : {1, 2, 3, 4}) {
    const bool big_endian = version % 2 == 0;
    const std::size_t dimension = version == 3 ? 3 : 2;
    files.push_back({"medit_" + std::to_string(version) + (big_endian ? "_big" : "_little") + "_endian", ".meshb",
                     binary_medit(version, big_endian, dimension)});
  }
  files.push_back({"medit_2_little_endian", ".meshb", binary_medit(2, false, 3)});
}

/// What a section of a text of Medit needs beside its count for every row; nothing for sections that are not read.
std::optional<std::size_t> numbers_of_medit(const std::string& keyword, std::size_t dimension) {
  std::string lower = keyword;
  std::ranges::transform(lower, lower.begin(), [](char c) { return 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (lower == "vertices") {
    return dimension + 1;
  }
  if (lower == "edges" || lower == "triangles") {
    return lower == "edges" ? 3 : 4;
  }
  const bool is_set = lower == "corners" || lower == "ridges" || lower == "requiredvertices" ||
                      lower == "requirededges" || lower == "requiredtriangles";
  return is_set ? std::optional<std::size_t>(1) : std::nullopt;
}

/// Text of Medit may end behind every whole section, and in those that are not read, where it has its vertices.
bool is_whole_medit_text(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(file.bytes.find_first_of("#M "));
  text.resize(cut - std::min(cut, file.bytes.size() - text.size()));
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at)) {
    text.erase(at, std::min(text.find_first_of("\r\n", at), text.size()) - at);
  }
  const std::vector<std::string> all = words(text);
  std::size_t dimension = 0;
  bool has_vertices = false;
  for (std::size_t i = 2; i < all.size();) {
    const std::string& keyword = all[i++];
    if (keyword == "Dimension") {
      if (i == all.size()) {
        return false;
      }
      dimension = std::stoul(all[i++]);
    } else if (const auto numbers = numbers_of_medit(keyword, dimension)) {
      if (i == all.size() || *numbers * std::stoul(all[i]) > all.size() - i - 1) {
        return false;
      }
      has_vertices = has_vertices || *numbers == dimension + 1;
      i += 1 + *numbers * std::stoul(all[i]);
    } else {
      while (i < all.size() && contains("\"+-=.0123456789", all[i].substr(0, 1))) {
        ++i;
      }
    }
  }
  return has_vertices;
}

/// Binary files of Medit may end behind every block from the vertices on.
bool is_whole_medit_binary(const AcceptedFile& file, std::size_t cut) {
  const bool big_endian = contains(file.name, "_big_");
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = 256 * value + static_cast<unsigned char>(file.bytes[big_endian ? at + i : at + size - 1 - i]);
    }
    return value;
  };
  const std::size_t position_bytes = contains("12", file.name.substr(6, 1)) ? 4 : 8;
  const std::size_t vertices = number(12, position_bytes);
  std::size_t at = number(vertices + 4, position_bytes);
  while (at < cut && number(at + 4, position_bytes) != 0) {
    at = number(at + 4, position_bytes);
  }
  return at == cut;
}

bool is_whole_medit(const AcceptedFile& file, std::size_t cut) {
  return contains(file.name, "endian") ? is_whole_medit_binary(file, cut) : is_whole_medit_text(file, cut);
}

}  // namespace

FormatSample medit_sample() {
  return {.format = trismooth::FileFormat::medit,
          .add_files = &add_medit,
          .is_whole = &is_whole_medit,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::some_cells; },
          .cells = {{cell_type::line},
                    {cell_type::triangle},
                    {cell_type::quad},
                    {cell_type::tetrahedron},
                    {cell_type::wedge},
                    {cell_type::hexahedron},
                    {cell_type::pyramid},
                    {cell_type::quadratic_edge},
                    {cell_type::quadratic_triangle},
                    {cell_type::biquadratic_quad},
                    {cell_type::quadratic_tetrahedron}}};
}

}  // namespace accepted_files
