// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_base64_stream.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <vtkBase64OutputStream.h>
#include <vtkNew.h>

#include "trismooth/mesh_io/vtk_xml/encoding/base64.h"

#include "catch.h"

using trismooth::FileWorkers;
using trismooth::MemoryBlock;
using trismooth::VtkBase64Stream;
using trismooth::Workers;

namespace {

using Runs = std::vector<std::vector<std::string>>;

/// Runs of pieces of any bytes and of many lengths, none and one among them.
Runs random_runs(unsigned seed) {
  std::mt19937_64 random(seed);
  Runs runs(1 + random() % 5);
  for (auto& run : runs) {
    run.resize(random() % 6);
    for (std::string& piece : run) {
      piece.resize(random() % 4 == 0 ? random() % 3 : random() % 400);
      std::ranges::generate(piece, [&random] { return static_cast<char>(random()); });
    }
  }
  return runs;
}

std::string runs_through(vtkBase64OutputStream& stream, const Runs& runs) {
  std::ostringstream text;
  stream.SetStream(&text);
  for (const auto& run : runs) {
    CHECK(stream.StartWriting() == 1);
    for (const std::string& piece : run) {
      CHECK(stream.Write(piece.data(), piece.size()) == 1);
    }
    CHECK(stream.EndWriting() == 1);
    text << '|';
  }
  return text.str();
}

std::string written_by_vtk(const Runs& runs) {
  return runs_through(*vtkNew<vtkBase64OutputStream>(), runs);
}

}  // namespace

TEST_CASE("base64 is what VTK makes of the same bytes, and is decoded to them") {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Runs runs = random_runs(seed);
    for (const auto& run : runs) {
      for (const std::string& piece : run) {
        MemoryBlock text;
        trismooth::append_base64(reinterpret_cast<const std::byte*>(piece.data()), piece.size(), text);
        const std::string characters(reinterpret_cast<const char*>(text.data()), text.size());
        CHECK(characters + "|" == written_by_vtk({{piece}}));
        std::string back(piece.size() / 3 * 3, '\0');
        const std::size_t groups = piece.size() / 3;
        CHECK(trismooth::decode_base64_groups(characters.data(), groups, reinterpret_cast<std::byte*>(back.data())) ==
              groups);
        CHECK(back == piece.substr(0, back.size()));
      }
    }
  }
}

TEST_CASE("base64 is decoded up to the first group with another character") {
  const std::string good(40, 'A');
  std::array<std::byte, 30> bytes{};
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char other : {'=', ' ', '-', '\0', '\xFF'}) {
      std::string text = good;
      text[i] = other;
      CHECK(trismooth::decode_base64_groups(text.data(), 10, bytes.data()) == i / 4);
    }
  }
}

TEST_CASE("runs of base64 are those of VTK's stream for every number of threads and size of parts") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::size_t part_bytes : {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{64},
                                         FileWorkers::default_part_bytes, FileWorkers::whole}) {
      const FileWorkers in_parts(workers, part_bytes);
      for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(threads, part_bytes, seed);
        const Runs runs = random_runs(seed);
        CHECK(runs_through(*VtkBase64Stream::make(in_parts, VtkBase64Stream::Apart::nothing), runs) ==
              written_by_vtk(runs));
      }
    }
  }
}

TEST_CASE("what comes first in a run of base64 can have an end of its own") {
  Workers workers(3);
  for (const std::size_t part_bytes : {std::size_t{1}, std::size_t{64}, FileWorkers::whole}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Runs runs = random_runs(seed);
      std::string expected;
      for (const auto& run : runs) {
        Runs apart(2);
        for (std::size_t i = 0; i < run.size(); ++i) {
          apart[i == 0 ? 0 : 1].push_back(run[i]);
        }
        const std::string both = written_by_vtk(apart);
        const std::size_t end = both.find('|');
        expected += both.substr(0, end) + both.substr(end + 1);
      }
      const FileWorkers in_parts(workers, part_bytes);
      CHECK(runs_through(*VtkBase64Stream::make(in_parts, VtkBase64Stream::Apart::first), runs) == expected);
    }
  }
}

TEST_CASE("a stream that takes no more is said to be so") {
  Workers workers(2);
  const auto stream = VtkBase64Stream::make(FileWorkers(workers, 4), VtkBase64Stream::Apart::nothing);
  std::ostringstream text;
  text.setstate(std::ios::failbit);
  stream->SetStream(&text);
  CHECK(stream->StartWriting() == 1);
  CHECK(stream->Write("abcdefghijkl", 12) == 0);
  CHECK(stream->EndWriting() == 0);
}
