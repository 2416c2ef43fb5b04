// Text and binary files read in parts of any size, by any number of threads: the same document, notes and messages.
#include "support/accepted_files.h"
#include "support/dice.h"
#include "support/readings.h"
#include "vtk_legacy_files.h"

using accepted_files::AcceptedFile;
using test_support::Dice;
using test_support::reading_and_sites_of;
using trismooth::Codec;
using trismooth::FileWorkers;
using trismooth::Workers;

namespace {

struct Sample {
  std::string name;
  const Codec& codec;
  std::string bytes;
};

/// Of a format that is written back byte by byte; null for others.
const Codec* codec_of(const std::string& extension) {
  return extension == ".off"   ? &trismooth::off_codec
         : extension == ".obj" ? &trismooth::obj_codec
         : extension == ".ply" ? &trismooth::ply_codec
         : extension == ".stl" ? &trismooth::stl_codec
         : extension == ".vtk" ? &trismooth::vtk_legacy_codec
                               : nullptr;
}

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
  for (const bool with_offsets : {false, true}) {
    legacy_test::Builder file = legacy_test::grid_file(false, with_offsets);
    all.push_back({with_offsets ? "legacy VTK with offsets" : "legacy VTK", trismooth::vtk_legacy_codec, file.bytes()});
    file.text("POINT_DATA 9\n");
    legacy_test::add_attributes(file, 9, false, "p_");
    all.push_back({"legacy VTK with arrays", trismooth::vtk_legacy_codec, file.bytes()});
  }
  for (const AcceptedFile& file : accepted_files::all()) {
    if (const Codec* const codec = codec_of(file.extension)) {
      all.push_back({file.name, *codec, file.bytes});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("files give the same document in parts of any size, and the same errors when they are damaged") {
  Workers alone(1);
  Workers two(2);
  Dice dice;
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    const auto reading = [&sample](const std::string& bytes, const FileWorkers& workers) {
      return reading_and_sites_of(sample.codec, bytes, workers);
    };
    const std::string expected = reading(sample.bytes, FileWorkers(alone, FileWorkers::serial));
    for (std::size_t part_bytes = 1; part_bytes <= sample.bytes.size() + 1; part_bytes += 1 + part_bytes / 64) {
      INFO(part_bytes);
      REQUIRE(reading(sample.bytes, FileWorkers(alone, part_bytes)) == expected);
    }
    REQUIRE(reading(sample.bytes, FileWorkers(two, 16)) == expected);
    REQUIRE(reading(sample.bytes, FileWorkers(alone, FileWorkers::whole)) == expected);
    for (int round = 0; round < 200; ++round) {
      std::string damaged = sample.bytes + (sample.bytes.empty() ? "x" : "");
      constexpr std::string_view characters = "#x-+.e\n \t\\/190nN\r\0\x7F";
      damaged[dice.below(damaged.size())] = characters[dice.below(characters.size())];
      if (round % 4 == 0) {
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
