// SPDX-License-Identifier: BSD-3-Clause
// Text and binary files read in parts of any size, by any number of threads: the same document, notes and messages.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "byte_files.h"
#include "catch.h"
#include "part_samples.h"
#include "support/accepted_files.h"
#include "support/accepted_vtk_files.h"
#include "support/dice.h"
#include "support/one_file_codec.h"
#include "support/readings.h"
#include "support/sanitized.h"
#include "support/share_of_cases.h"
#include "vtk_legacy_files.h"

namespace trismooth::reading_in_parts_test {

using accepted_files::AcceptedFile;
using part_samples::Sample;
using test_support::Dice;
using test_support::reading_and_sites_of;

std::string with_line_ends(const std::string& text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) {
    changed += c == '\n' ? line_end : std::string(1, c);
  }
  return changed;
}

std::string off_text(const std::string& keyword, const std::string& after_vertex, const std::string& line_end,
                     const std::string& face) {
  std::string text = keyword + line_end + "9 8 0" + line_end;
  for (int i = 0; i < 9; ++i) {
    text += "0." + std::to_string(i * 37) + " " + std::to_string(-i) + "e-3 " + std::to_string(i % 2) + after_vertex +
            line_end;
  }
  for (int i = 0; i < 8; ++i) {
    text += face + line_end;
  }
  return text;
}

/// Faces of different degrees, with and without colours, and what breaks the rules in the midst of them.
void add_off_samples(std::vector<Sample>& all) {
  const auto add = [&all](const std::string& name, const std::string& keyword, const std::string& fields,
                          const std::vector<std::string>& faces) {
    std::string text = keyword + "\n9 " + std::to_string(3 * faces.size()) + " 0\n";
    for (int i = 0; i < 9; ++i) {
      text += std::to_string(i) + ".5 " + std::to_string(i * i) + " 0" + fields + "\n";
    }
    for (int round = 0; round < 3; ++round) {
      for (const std::string& face : faces) {
        text += face + "\n";
      }
    }
    all.push_back({"OFF: " + name, trismooth::off_codec, text});
  };
  const std::vector<std::string> mixed{"3 0 1 2", "5 0 1 2 3 4", "3 2 1 0", "4 5 6 7 8"};
  add("mixed degrees", "OFF", "", mixed);
  add("fields", "STCNOFF", " 0 0 1 1 0.5 0.25 0.5 0.75", mixed);
  add("fields in MeshLab's order", "NCOFF", " 255 0 7 255 0 0 1", mixed);
  add("undeclared colours", "OFF", " 1 2 3 4", mixed);
  add("colours of mixed faces", "OFF", "", {"3 0 1 2 9 8 7", "4 5 6 7 8 0 0.5 1", "3 1 2 3 1 2 3"});
  add("colours of some faces", "OFF", "", {"3 0 1 2 9 8 7", "4 5 6 7 8", "3 1 2 3 1 2 3"});
  add("colours of different lengths", "OFF", "", {"3 0 1 2 9 8 7", "4 5 6 7 8 1", "3 1 2 3 1 2 3 4"});
  add("three and four that make two times three and a colour", "OFF", "", {"3 0 1 2 4", "4 0 1 2 3 3", "3 1 2 3 4"});
  add("mixed faces over lines", "OFF", "", {"3 0 1 2", "4 0\n1\n2 3", "5 0 1 2 3 4"});
  add("a face too short", "OFF", "", {"3 0 1 2", "4 0 1 2", "3 4 3 5", "5 0 1 2 3 4"});
  add("a face too long", "OFF", "", {"3 0 1 2", "4 0 1 2 3 5", "3 4 3 5", "5 0 1 2 3 4"});
  add("a degree of two", "OFF", "", {"3 0 1 2", "2 0 1", "3 4 3 5", "5 0 1 2 3 4"});
  add("a degree beyond the file", "OFF", "", {"3 0 1 2", "99999 0 1", "3 4 3 5", "5 0 1 2 3 4"});
  add("an infinite colour", "OFF", " 1 2 inf", mixed);
  add("two colour numbers", "OFF", " 1 2", mixed);
}

/// In MeshLab's order of fields.
void add_binary_off_samples(std::vector<Sample>& all) {
  for (const float last : {1.0F, std::numeric_limits<float>::infinity()}) {
    std::string data = "NCOFF BINARY\n";
    const auto put = [&](auto number) { data += byte_files::number_bytes(number, std::endian::big); };
    std::ranges::for_each(std::array{9, 1, 0}, put);
    for (int i = 0; i < 9; ++i) {
      for (int j = 0; j < 9; ++j) {
        put(i == 8 && j == 0 ? last : static_cast<float>(10 * i + j));
      }
    }
    std::ranges::for_each(std::array{3, 0, 1, 2, 0}, put);
    all.push_back({"OFF: binary, " + std::to_string(last), trismooth::off_codec, data});
  }
}

void add_ply_samples(std::vector<Sample>& all) {
  const std::string head = "element vertex 9\nproperty double x\nproperty float y\nproperty double z\n";
  const std::string list = "element face 8\nproperty list uchar int vertex_indices\n";
  const auto add = [&](const std::string& name, const std::string& vertex_more, const std::string& more,
                       const std::string& fields, const std::vector<std::string>& faces) {
    std::string text = "ply\nformat ascii 1.0\n" + head + vertex_more + list + more + "end_header\n";
    for (int i = 0; i < 9; ++i) {
      text += std::to_string(i) + ".5 " + std::to_string(i * i) + " 0" + fields + "\n";
    }
    for (std::size_t i = 0; i < 8; ++i) {
      text += faces[i % faces.size()] + "\n";
    }
    all.push_back({"PLY: " + name, trismooth::ply_codec, text});
    all.push_back({"PLY: " + name + ", CR LF", trismooth::ply_codec, with_line_ends(text, "\r\n")});
  };
  const std::vector<std::string> mixed{"3 0 1 2", "5 0 1 2 3 4", "3 2 1 0", "4 5 6 7 8"};
  const std::string bytes = "property uchar red\nproperty int8 a\nproperty float b\n";
  add("triangles", "", "", "", {"3 0 1 2"});
  add("mixed", "", "", "", mixed);
  add("scalars", bytes, bytes, " 255 -128 nan", {"3 0 1 2 1 -2 inf", "3 0 2 1 255 127 1e-3"});
  add("mixed with scalars", bytes, bytes, " 0 -0 -inf", {"3 0 1 2 1 -2 1.5", "4 0 2 1 8 255 127 1e-3"});
  add("a scalar out of range", "", bytes, "", {"3 0 1 2 1 -2 1.5", "3 0 2 1 256 127 1e-3"});
  add("an index out of range", "", "", "", {"3 0 1 2", "3 0 1 9"});
  add("a negative index", "", "", "", {"3 0 1 2", "4 0 1 2 -1"});
  add("rows over lines", bytes, "", "\n255 0\n1", {"3\n0 1 2", "4 0 1 2\n3"});
  add("too much on a line", "", "", "", {"3 0 1 2", "3 0 1 2 3"});
  add("too little on a line", "", "", "", {"4 0 1 2 3", "4 0 1 2"});
  add("large whole numbers", "property uint64 a\nproperty int64 b\n", "", " 18446744073709551615 -9223372036854775808",
      mixed);
  add("another list", "property list uchar int more\n", "", " 2 7 7", mixed);
}

void add_stl_samples(std::vector<Sample>& all) {
  const auto facets = [](int count, const std::string& odd) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      const std::string x = std::to_string(i % 3);
      text += " facet normal 0 0 1\n  outer loop\n   vertex " + x + " 0 -0\n   vertex 1 " + x + " 0\n" +
              (i == count / 2 ? odd : "") + "   vertex 1e-3 -" + x + ".5 0.0\n  endloop\n endfacet\n";
    }
    return text;
  };
  const auto add = [&all](const std::string& name, const std::string& text) {
    all.push_back({"STL: " + name, trismooth::stl_codec, text});
    all.push_back({"STL: " + name + ", CR LF", trismooth::stl_codec, with_line_ends(text, "\r\n")});
  };
  add("one solid", "solid a\n" + facets(9, "") + "endsolid a\n");
  add("no end", "solid facet a\n" + facets(9, ""));
  add("two solids", "solid a\n" + facets(3, "") + "endsolid a\nsolid b\n" + facets(3, "") + "endsolid b\n");
  add("words behind the end", "solid a\n" + facets(3, "") + "endsolid a\nsolid\n");
  add("a color", "solid a\n" + facets(3, "color 1 2 3\n") + "endsolid\n");
  add("a facet in a name", "solid a\n" + facets(3, "facet 1 2 3\n") + "endsolid\n");
  add("no number", "solid a\n" + facets(3, "vertex 1 2 x\n") + "endsolid\n");
  add("four vertices", "solid a\n" + facets(3, "vertex 1 2 3\n") + "endsolid\n");
  add("all in capitals", "SOLID a\n" + facets(3, "VERTEX 1 2 3\n") + "ENDSOLID\n");
  for (const float odd : {0.0F, -0.0F, std::numeric_limits<float>::infinity()}) {
    for (const std::size_t more : {0, 1, 50}) {
      std::string data(80, ' ');
      const auto put = [&data](auto number) { data += accepted_files::vtk::number_bytes(number, false); };
      put(std::uint32_t{12});
      for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) {
          put(i == 7 && j == 8 ? odd : static_cast<float>(j < 3 ? 0 : (i + j) % 4));
        }
        put(static_cast<std::uint16_t>(odd == 0 ? i / 8 : 0));
      }
      all.push_back({"STL: binary", trismooth::stl_codec, data + std::string(more, '\0')});
    }
  }
}

std::vector<Sample> samples() {
  using trismooth::off_codec;
  std::vector<Sample> all{
      {"plain", off_codec, off_text("OFF", "", "\n", "3 0 1 2")},
      {"quads, CR LF", off_codec, off_text("OFF", "", "\r\n", "4 0 1 2 3")},
      {"blanks", off_codec, off_text("  OFF ", " \t", " \n\n ", "3  0\t1 \v2 ")},
      {"comments", off_codec, off_text("OFF # 1 2 3", " # 7 8", "\n", "3 0 1 2 # 3")},
      {"vertex colours", off_codec, off_text("COFF", " 1 0 0.5", "\n", "3 0 1 2")},
      {"face colours", off_codec, off_text("OFF", "", "\n", "3 0 1 2 255 0 0")},
      {"a face over two lines", off_codec, off_text("OFF", "", "\n", "3 0\n1 2")},
      {"an index out of range", off_codec, off_text("OFF", "", "\n", "3 0 1 9")},
      {"plus signs", off_codec, off_text("OFF", "", "\n", "3 +0 1 2")},
      {"counts glued to the keyword", off_codec, "OFF" + off_text("", "", "\n", "3 0 1 2").substr(1)},
  };
  const std::string vertices = "v 0 0 0\nv 1e0 -2 0.5\nv 3 4.25 -0\n\n  v\t7 8 9  \nv 0.1 0.2 0.3\n";
  const std::string faces = "f 1 2 3\nf 2 3 4 5\nf 1/2 2/3 5/4\nfo 1//1 3//2 5//1\nf 1/1/1 2/ 3/7/8\nl 1 2\np 4\n";
  const std::string plain = "# a comment \\\nmtllib a b.mtl\no one\n" + vertices + "vt 0 0\nvn 0 0 1\ns off\n" + faces;
  const auto add_obj = [&all](const std::string& name, const std::string& text) {
    all.push_back({"OBJ: " + name, trismooth::obj_codec, text});
  };
  add_obj("plain", plain);
  add_obj("CR LF", with_line_ends(plain, "\r\n"));
  add_obj("CR", with_line_ends(plain, "\r"));
  add_obj("without a line end behind it", plain.substr(0, plain.size() - 1));
  add_obj("groups and materials", "g one\n" + vertices + "g  one two\nusemtl a#b\n" + faces + "g\n" + faces +
                                      "usemtl a#b \n" + faces + "g one\n");
  add_obj("faces first, and again vertices", faces + vertices + faces + vertices + "f -1 -2 -3\nf -10 10 -7/-1/-2\n");
  add_obj("colours and weights", "v 1 2 3 4\nv 1 2 3 4 5 6\nv 1 2 3 4 5 6 7\n" + plain);
  std::string many_keywords = vertices;
  for (int i = 0; i < 20; ++i) {
    many_keywords += "word_" + std::to_string(i * 7 % 20) + " x\n" + faces;
  }
  add_obj("more other statements than are named", many_keywords);
  for (const std::string odd : {"v 1 2\n",
                                "v 1 2 3 4 5\n",
                                "v 1 2 nan\n",
                                "v 1 2 3 inf\n",
                                "v 1 2 3 # x\n",
                                "v 1 \\\n2 3\n",
                                "v +1 2 3\n",
                                "v 1e999 0 0\n",
                                "f 1 2\n",
                                "f 1 2 0\n",
                                "f 1 2 11\n",
                                "f 1 2 -6\n",
                                "f 1 2 -9\n",
                                "f 1 2 3/1/1/1\n",
                                "f 1 2 3/x\n",
                                "f 1 2 3/-\n",
                                "f 1 2 3/99999999999999999999\n",
                                "f 1 2 9999999999\n",
                                "f 1 2 +3\n",
                                "f 1 2 3 \\\n 4\n",
                                "f 1 2 3#\n",
                                "l 1\n",
                                "p\n",
                                "7 8 9\n",
                                "vn\\\n v 1 2 3\n",
                                "vn 1 \\\n v 1 2 3\n",
                                "g a \\\n b\n",
                                "#g a \\\nf 1 2 3\n",
                                "vt#1\n",
                                "v#1\n",
                                "g#1\n",
                                "f\\\n 1 2 3\n",
                                "-\n",
                                "s off\\"}) {
    add_obj("with '" + odd + "'", vertices + faces + odd + faces + vertices);
  }
  add_obj("no vertices", faces);
  add_obj("comments alone", "# nothing\n\n");
  add_obj("nothing", "");
  add_off_samples(all);
  add_binary_off_samples(all);
  add_ply_samples(all);
  add_stl_samples(all);
  part_samples::add_msh_samples(all);
  for (const bool with_offsets : {false, true}) {
    legacy_test::Builder file = legacy_test::grid_file(false, with_offsets);
    all.push_back({with_offsets ? "legacy VTK with offsets" : "legacy VTK", trismooth::vtk_legacy_codec, file.bytes()});
    file.text("POINT_DATA 9\n");
    legacy_test::add_attributes(file, 9, false, "p_");
    all.push_back({"legacy VTK with arrays", trismooth::vtk_legacy_codec, file.bytes()});
  }
  for (const AcceptedFile& file : accepted_files::all()) {
    const trismooth::FileFormat format = accepted_files::format_of(file);
    // A library reads files as a whole.
    if (trismooth::codec_of(format).description.library.empty()) {
      all.push_back({file.name, test_support::one_file_codec(format), file.bytes});
    }
    if (file.name == "off_big_endian" || file.name == "off_little_endian") {
      // The second number of the fifth vertex, behind the keyword's line and the counts.
      std::string infinite = file.bytes;
      const bool is_big_endian = file.name == "off_big_endian";
      infinite.replace(11 + 12 + 4 * 12 + 4, 4,
                       accepted_files::vtk::number_bytes(std::numeric_limits<float>::infinity(), is_big_endian));
      all.push_back({file.name + ", infinite", trismooth::off_codec, infinite});
    }
  }
  return all;
}

/// With another number, mostly beyond the range of something, in place of one of the text; unchanged where it has none.
std::string with_another_number(std::string text, Dice& dice) {
  constexpr std::string_view digits = "0123456789";
  constexpr auto others = std::to_array<std::string_view>(
      {"0", "-1", "7", "2147483647", "2147483648", "4294967295", "4294967296", "4294967298", "9223372036854775807",
       "9223372036854775808", "18446744073709551615", "1e400", "1.5", "0.1e-320", "-0"});
  std::size_t begin = text.find_first_of(digits, dice.below(text.size()));
  if (begin == std::string::npos) {
    return text;
  }
  while (begin > 0 && digits.find(text[begin - 1]) != std::string_view::npos) {
    --begin;
  }
  const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
  return text.replace(begin, end - begin, others[dice.below(others.size())]);
}

TEST_CASE("files give the same document in parts of any size, and the same errors when they are damaged") {
  Workers alone(1);
  Workers two(2);
  Dice dice;
  // (Fuzzers read damaged files in parts as well: tests/fuzz/reader_target.cpp.)
  const std::int64_t rounds = is_sanitized ? 8 : 40 * per_cent_of_cases() / 100;
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    const auto reading = [&sample](const std::string& bytes, const FileWorkers& workers) {
      return reading_and_sites_of(sample.codec, bytes, workers);
    };
    const std::string expected = reading(sample.bytes, FileWorkers(alone, FileWorkers::serial));
    for (std::size_t part_bytes = 1; part_bytes <= sample.bytes.size() + 1;
         part_bytes += 1 + part_bytes / (is_sanitized ? 2 : 8)) {
      INFO(part_bytes);
      REQUIRE(reading(sample.bytes, FileWorkers(alone, part_bytes)) == expected);
    }
    REQUIRE(reading(sample.bytes, FileWorkers(two, 16)) == expected);
    REQUIRE(reading(sample.bytes, FileWorkers(alone, FileWorkers::whole)) == expected);
    for (std::int64_t round = 0; round < rounds; ++round) {
      std::string damaged = sample.bytes + (sample.bytes.empty() ? "x" : "");
      if (round % 2 == 0) {
        damaged = with_another_number(std::move(damaged), dice);
      } else {
        constexpr std::string_view characters = "#x-+.e\n \t\\/190nN\r\0\x7F";
        damaged[dice.below(damaged.size())] = characters[dice.below(characters.size())];
      }
      if (round % 4 == 1) {
        damaged.resize(dice.below(damaged.size()));
      }
      INFO(damaged);
      const std::string serial = reading(damaged, FileWorkers(alone, FileWorkers::serial));
      for (const std::size_t part_bytes : {1 + dice.below(8), 1 + dice.below(200), FileWorkers::whole}) {
        REQUIRE(reading(damaged, FileWorkers(alone, part_bytes)) == serial);
      }
    }
  }
}

}  // namespace trismooth::reading_in_parts_test
