// SPDX-License-Identifier: BSD-3-Clause
// After the chapter "MSH file format" of Gmsh's manual.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mesh_io/msh/msh_element_types.h"

#include "support/accepted_msh_files.h"
#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files::msh {

namespace {

using vtk::number_bytes;

/// Numbers as the file writes them: a line of text, or bytes.
class Numbers {
 public:
  Numbers(const Spelling& spelling, std::string& bytes) : spelling_(spelling), bytes_(bytes) {}

  Numbers& integer(std::int32_t value) { return add(value); }
  Numbers& size(std::uint64_t value) {
    return spelling_.size_bytes == 4 && spelling_.version >= 41 ? add(static_cast<std::uint32_t>(value)) : add(value);
  }
  Numbers& real(double value) { return add(value); }
  /// A tag of a node or an element.
  Numbers& tag(int value) { return spelling_.version >= 41 ? size(static_cast<std::uint64_t>(value)) : integer(value); }
  /// Version 4.0 writes some counts as int.
  Numbers& count(int value) { return tag(value); }
  Numbers& end() {
    if (!spelling_.binary) {
      bytes_ += '\n';
    }
    begun_ = false;
    return *this;
  }

 private:
  template <class T>
  Numbers& add(T value) {
    bytes_ +=
        spelling_.binary ? number_bytes(value, spelling_.big_endian) : (begun_ ? " " : "") + fmt::format("{}", value);
    begun_ = true;
    return *this;
  }

  const Spelling& spelling_;
  std::string& bytes_;
  bool begun_ = false;
};

class Writer {
 public:
  explicit Writer(const Spelling& spelling) : spelling_(spelling), numbers_(spelling, bytes_) {}

  std::string write() {
    bytes_ = spelling_.head;
    if (spelling_.version >= 20) {
      header();
    }
    if (spelling_.with_groups) {
      bytes_ += "$PhysicalNames\n3\n1 5 \"the edge\"\n2 1 \"steel\"\n2 2 \"all\"\n$EndPhysicalNames\n";
    }
    if (spelling_.version >= 40) {
      entities();
      partitioned_entities();
      nodes();
      elements();
    } else {
      old_nodes();
      old_elements();
    }
    if (spelling_.with_data) {
      data("NodeData", "heat \"a\"", 1, {1, 2, 3, 4, 5});
      data("NodeData", "", 3, {1, 2, 3, 4, 5});
      data("ElementData", "stress", 1, {1, 2, 3, 4, 5, 6, 7});
    }
    return bytes_ + spelling_.tail;
  }

 private:
  bool is_old() const { return spelling_.version < 40; }

  void header() {
    bytes_ += fmt::format("$MeshFormat\n{}.{} {} {}\n", spelling_.version / 10, spelling_.version % 10,
                          spelling_.binary ? 1 : 0, spelling_.size_bytes);
    if (spelling_.binary) {
      bytes_ += number_bytes(std::int32_t{1}, spelling_.big_endian) + "\n";
    }
    bytes_ += "$EndMeshFormat\n";
  }

  int node_tag(int vertex) const { return spelling_.sparse ? 900 - 100 * (vertex * 3 % 5) : vertex + 1; }
  int element_tag(int element) const { return spelling_.sparse ? 70000 - 1000 * (element * 3 % 7) : element + 1; }

  void box(int dimension) {
    const int count = dimension == 0 && spelling_.version >= 41 ? 3 : 6;
    for (int i = 0; i < count; ++i) {
      numbers_.real(i < 3 ? 0 : 2);
    }
  }

  void groups(const std::vector<int>& tags) {
    numbers_.size(tags.size());
    for (const int tag : tags) {
      numbers_.integer(tag);
    }
  }

  void section(const std::string& name) { bytes_ += "$" + name + "\n"; }
  void end_section(const std::string& name) { bytes_ += (spelling_.binary ? "\n$End" : "$End") + name + "\n"; }

  void entities() {
    section("Entities");
    numbers_.size(1).size(1).size(2).size(0).end();
    numbers_.integer(1);
    box(0);
    groups({});
    numbers_.end();
    numbers_.integer(1);
    box(1);
    groups({-5});
    numbers_.size(0).end();
    for (int surface = 1; surface < 3; ++surface) {
      numbers_.integer(surface);
      box(2);
      groups(spelling_.with_groups && surface == 1 ? std::vector{1, 2} : std::vector{surface});
      numbers_.size(1).integer(surface == 1 ? 1 : -1).end();
    }
    end_section("Entities");
  }

  /// The second surface is a part of itself: 2 becomes 3.
  void partitioned_entities() {
    if (!spelling_.partitioned) {
      return;
    }
    section("PartitionedEntities");
    numbers_.count(2).end().count(1).end().integer(9).integer(2).end();
    numbers_.size(0).size(0).size(1).size(0).end();
    numbers_.integer(3).integer(2).integer(2).count(2).integer(2).integer(1);
    box(2);
    groups({2});
    numbers_.size(0).end();
    end_section("PartitionedEntities");
  }

  void point(int vertex) {
    for (const double x : mesh_.points[static_cast<std::size_t>(vertex)]) {
      numbers_.real(x);
    }
  }

  void block_head(int dimension, int entity, int third, int count) {
    numbers_.integer(spelling_.version >= 41 ? dimension : entity)
        .integer(spelling_.version >= 41 ? entity : dimension)
        .integer(third)
        .size(static_cast<std::uint64_t>(count))
        .end();
  }

  void nodes() {
    section("Nodes");
    numbers_.size(2).size(5);
    if (spelling_.version >= 41) {
      numbers_.size(spelling_.sparse ? 500 : 1).size(spelling_.sparse ? 900 : 5);
    }
    numbers_.end();
    for (int block = 0; block < 2; ++block) {
      const int first = block == 0 ? 0 : 4;
      const int last = block == 0 ? 4 : 5;
      block_head(block == 0 ? 1 : 2, 1, spelling_.parametric ? 1 : 0, last - first);
      for (int vertex = first; vertex < last && spelling_.version >= 41; ++vertex) {
        numbers_.tag(node_tag(vertex)).end();
      }
      for (int vertex = first; vertex < last; ++vertex) {
        if (spelling_.version < 41) {
          numbers_.tag(node_tag(vertex));
        }
        point(vertex);
        for (int i = 0; spelling_.parametric && i <= block; ++i) {
          numbers_.real(0.125 * vertex + i);
        }
        numbers_.end();
      }
    }
    end_section("Nodes");
  }

  /// Lines around the square, two triangles of the first surface, two of the second.
  void elements() {
    section("Elements");
    numbers_.size(3).size(7);
    if (spelling_.version >= 41) {
      numbers_.size(1).size(7);
    }
    numbers_.end();
    block_head(1, 1, 1, 3);
    for (int i = 0; i < 3; ++i) {
      numbers_.tag(element_tag(i)).tag(node_tag(i)).tag(node_tag(i + 1)).end();
    }
    for (int surface = 1; surface < 3; ++surface) {
      block_head(2, surface == 2 && spelling_.partitioned ? 3 : surface, 2, 2);
      for (int i = 2 * surface - 2; i < 2 * surface; ++i) {
        numbers_.tag(element_tag(3 + i));
        triangle(i);
        numbers_.end();
      }
    }
    end_section("Elements");
  }

  void triangle(int number) {
    for (const int vertex : mesh_.faces[static_cast<std::size_t>(number)]) {
      numbers_.tag(node_tag(vertex));
    }
  }

  void old_nodes() {
    const std::string name = spelling_.version < 20 ? "NOD" : spelling_.parametric ? "ParametricNodes" : "Nodes";
    bytes_ += "$" + name + "\n5\n";
    for (int vertex = 0; vertex < 5; ++vertex) {
      numbers_.integer(node_tag(vertex));
      point(vertex);
      if (spelling_.parametric) {
        const int dimension = vertex == 0 ? 0 : vertex < 4 ? 1 : 2;
        numbers_.integer(dimension).integer(1);
        for (int i = 0; i < dimension; ++i) {
          numbers_.real(0.125 * vertex + i);
        }
      }
      numbers_.end();
    }
    bytes_ += spelling_.version < 20 ? "$ENDNOD\n" : (spelling_.binary ? "\n$End" : "$End") + name + "\n";
  }

  /// An element in two groups stands there twice.
  void old_elements() {
    const bool is_first = spelling_.version < 20;
    const int repeated = spelling_.with_groups ? 2 : 0;
    bytes_ += fmt::format("${}\n{}\n", is_first ? "ELM" : "Elements", 7 + repeated);
    for (int i = 0; i < 7 + repeated; ++i) {
      const bool is_line = i < 3;
      const int face = i < 7 ? i - 3 : i - 7;
      const int group = is_line ? 5 : i < 5 ? 1 : 2;
      const int surface = is_line || face < 2 ? 1 : 2;
      const int type = is_line ? 1 : 2;
      std::vector<int> labels{group, surface};
      if (spelling_.partitioned) {
        labels.insert(labels.end(), {2, surface, -2});
      }
      const int tag = i < 7 ? element_tag(i) : 500 + i;
      if (spelling_.binary && (i == 0 || i == 3)) {
        numbers_.integer(type).integer(i == 0 ? 3 : 4 + repeated).integer(static_cast<int>(labels.size()));
      }
      numbers_.integer(tag);
      if (!spelling_.binary) {
        numbers_.integer(type);
        if (!is_first) {
          numbers_.integer(static_cast<int>(labels.size()));
        }
      }
      for (const int label : labels) {
        numbers_.integer(label);
      }
      if (is_first) {
        numbers_.integer(is_line ? 2 : 3);
      }
      if (is_line) {
        numbers_.integer(node_tag(i)).integer(node_tag(i + 1));
      } else {
        triangle(face);
      }
      numbers_.end();
    }
    bytes_ += is_first ? "$ENDELM\n" : spelling_.binary ? "\n$EndElements\n" : "$EndElements\n";
  }

  /// Rows of `components` numbers, the first of each from `values`.
  void data(const std::string& name, const std::string& title, int components, const std::vector<double>& values) {
    const bool of_nodes = name == "NodeData";
    bytes_ += fmt::format("${}\n1\n\"{}\"\n1\n0.5\n3\n2\n{}\n{}\n", name, title, components, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int row = static_cast<int>(i);
      numbers_.integer(of_nodes ? node_tag(row) : element_tag(row));
      for (int k = 0; k < components; ++k) {
        numbers_.real(values[i] + k * 0.25);
      }
      numbers_.end();
    }
    end_section(name);
  }

  const Spelling& spelling_;
  Mesh mesh_ = mesh(false);
  std::string bytes_;
  Numbers numbers_;
};

std::string replaced_all(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

constexpr const char* periodic = "$Periodic\n1\n1 1 1\n16 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1\n1 1\n$EndPeriodic\n";
constexpr const char* unknown = "$Mine\nanything 1 2\n$Nodes are no section here\n$EndMine\n";
constexpr const char* comments = "$Comments\nmade for a test\n$EndComments\n";

/// With a quadrangle and a pentagon, which text of version 2 alone can hold.
std::string with_polygons() {
  const Mesh all = mesh(true);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n";
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    text += fmt::format("{} {} {} {}\n", i + 1, all.points[i][0], all.points[i][1], all.points[i][2]);
  }
  text += "$EndNodes\n$Elements\n6\n";
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    const std::size_t size = all.faces[i].size();
    text += fmt::format("{} {} 2 1 1{}", i + 1, size == 3 ? 2 : size == 4 ? 3 : 34, size == 5 ? " 5" : "");
    for (const int vertex : all.faces[i]) {
      text += fmt::format(" {}", vertex + 1);
    }
    text += '\n';
  }
  return text + "$EndElements\n";
}

}  // namespace

std::string file(const Spelling& spelling) {
  return Writer(spelling).write();
}

namespace {

void add(std::vector<AcceptedFile>& files) {
  const auto push = [&files](const std::string& name, std::string bytes) {
    files.push_back({"msh_" + name, ".msh", std::move(bytes)});
  };
  for (const int version : {22, 40, 41}) {
    const std::string name = std::to_string(version);
    push(name, file({.version = version}));
    push(name + "_groups", file({.version = version, .with_groups = true}));
    push(name + "_parametric", file({.version = version, .parametric = true}));
    push(name + "_partitioned", file({.version = version, .partitioned = true, .tail = periodic}));
    push(name + "_data", file({.version = version, .with_data = true}));
    push(name + "_sparse", file({.version = version, .with_data = true, .sparse = true}));
    for (const bool big : {false, true}) {
      const std::string binary = name + (big ? "_big_endian" : "_little_endian");
      push(binary, file({.version = version, .binary = true, .big_endian = big}));
      push(binary + "_groups", file({.version = version, .binary = true, .big_endian = big, .with_groups = true}));
      push(binary + "_parametric", file({.version = version, .binary = true, .big_endian = big, .parametric = true}));
      push(binary + "_partitioned", file({.version = version, .binary = true, .big_endian = big, .partitioned = true}));
      push(binary + "_data",
           file({.version = version, .binary = true, .big_endian = big, .with_data = true, .sparse = true}));
    }
  }
  for (const bool big : {false, true}) {
    push(big ? "41_size_4_big_endian" : "41_size_4_little_endian",
         file({.binary = true, .big_endian = big, .size_bytes = 4, .partitioned = true, .with_groups = true}));
  }
  push("10", file({.version = 10}));
  push("10_groups",
       replaced_all(file({.version = 10, .with_groups = true}),
                    "$PhysicalNames\n3\n1 5 \"the edge\"\n2 1 \"steel\"\n2 2 \"all\"\n$EndPhysicalNames\n", ""));
  push("10_parametric", file({.version = 10, .parametric = true}));
  push("20", file({.version = 20}));
  push("21", file({.version = 21}));
  push("polygons", with_polygons());
  const std::string whole = file({.with_groups = true, .with_data = true, .head = comments, .tail = unknown});
  push("41_whole", whole);
  push("41_crlf", replaced_all(whole, "\n", "\r\n"));
  push("41_cr", replaced_all(whole, "\n", "\r"));
  push("41_mark", "\xEF\xBB\xBF" + file({}));
  push("41_blanks", replaced_all(replaced_all(file({}), " ", " \t "), "\n", " \n"));
  push("41_between", replaced_all(file({}), "$Nodes", "\nno section\n\n$Nodes"));
  const std::string plain = file({});
  push("41_no_final_newline", plain.substr(0, plain.size() - 1));
}

/// MSH is whole behind every section from its elements on.
bool is_whole_msh(const AcceptedFile& file, std::size_t cut) {
  const std::size_t elements = file.bytes.find(contains(file.bytes, "$ENDELM") ? "$ENDELM" : "$EndElements");
  for (std::size_t end = elements; end != file.bytes.npos; end = file.bytes.find("$End", end + 1)) {
    std::size_t from = end;
    while (from < file.bytes.size() && !is_space(file.bytes[from])) {
      ++from;
    }
    const std::size_t next = file.bytes.find('$', from);
    if (from <= cut && (next == file.bytes.npos || cut <= next)) {
      return true;
    }
  }
  return false;
}

}  // namespace

}  // namespace accepted_files::msh

namespace accepted_files {

FormatSample msh_sample() {
  return {.format = trismooth::FileFormat::msh,
          .add_files = &msh::add,
          .is_whole = &msh::is_whole_msh,
          .holds_cell = [](std::uint8_t type, std::size_t vertices) {
            return trismooth::msh_number_of(type, vertices) != 0;
          }};
}

}  // namespace accepted_files
