// SPDX-License-Identifier: BSD-3-Clause
#include "part_samples.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace part_samples {

namespace {

/// Lists of elements of versions 2, which are of any type and have any number of labels.
void add_version_2_samples(std::vector<Sample>& all) {
  constexpr int nodes = 9;
  const auto add = [&all](const std::string& name, const std::string& version, const std::vector<std::string>& rows,
                          std::int64_t step = 1) {
    std::string text = "$MeshFormat\n" + version + " 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(nodes) + "\n";
    for (int i = 1; i <= nodes; ++i) {
      text += std::to_string(i) + " " + std::to_string(i) + ".5 " + std::to_string(i * i) + "e-1 0\n";
    }
    text += "$EndNodes\n$Elements\n" + std::to_string(3 * rows.size()) + "\n";
    for (std::size_t i = 0; i < 3 * rows.size(); ++i) {
      text += std::to_string(static_cast<std::int64_t>(i) * step + 7) + " " + rows[i % rows.size()] + "\n";
    }
    all.push_back({"MSH " + version + ": " + name, trismooth::msh_codec, text + "$EndElements\n"});
  };
  for (const std::string version : {"2", "2.1", "2.2"}) {
    add("triangles", version, {"2 2 1 1 1 2 3", "2 2 1 2 3 2 5"});
    add("triangles without labels", version, {"2 0 1 2 3", "2 0 3 2 5"});
    add("lines, triangles and quadrilaterals", version, {"1 2 1 1 1 2", "2 2 2 1 1 2 3", "3 2 2 1 3 4 5 6"});
    add("partitions", version, {"2 4 1 1 1 2 1 2 3", "1 4 1 1 1 -2 1 2"});
    add("labels that differ in number", version, {"2 2 1 1 1 2 3", "2 3 1 1 1 4 5 6", "1 0 3 2"});
    add("the same elements in several groups", version, {"2 2 1 1 1 2 3", "2 2 2 1 1 2 3"});
    add("quadratic triangles", version, {"9 2 1 1 1 2 3 4 5 6"});
    add("quadratic tetrahedra, whose middles stand in another order", version, {"11 2 1 1 1 2 3 4 5 6 7 8 9 1"});
    add("polygons", version, {"2 2 1 1 1 2 3", "34 2 1 1 5 1 2 3 4 5"});
    add("an unknown type", version, {"2 2 1 1 1 2 3", "999 2 1 1 1 2 3"});
    add("elements over lines", version, {"2 2 1 1 1\n2 3", "1 2 1 1\n1 2"});
    add("two elements in a line", version, {"2 2 1 1 1 2 3 70 2 2 1 1 1 2 3"});
    add("a line and a quadrilateral that are as long as two triangles", version,
        {"2 2 1 1 1 2 3", "1 2 1 1 1 2", "3 2 1 1 1 2 3 4"});
    add("a node that there is not", version, {"2 2 1 1 1 2 3", "2 2 1 1 1 2 10"});
    add("a label out of range", version, {"2 2 1 1 1 2 3", "2 2 1 -2147483648 1 2 3"});
    add("large labels", version, {"2 2 -2147483647 2147483647 1 2 3"});
    add("tags in steps", version, {"2 2 1 1 1 2 3", "1 2 1 1 1 2"}, 3);
    add("tags that go down", version, {"2 2 1 1 1 2 3"}, -1);
    add("tags given twice", version, {"2 2 1 1 1 2 3", "1 2 1 1 1 2"}, 0);
    add("tags out of range", version, {"2 2 1 1 1 2 3", "1 2 1 1 1 2"}, 1'000'000'000);
  }
  const std::string large = "3000000000";
  all.push_back({"MSH 2.2: a node's tag out of range", trismooth::msh_codec,
                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n" + large +
                     " 0 0 0\n$EndNodes\n$Elements\n0\n$EndElements\n"});
  all.push_back({"MSH 4.1: a large tag", trismooth::msh_codec,
                 "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 0 1\n" + large +
                     "\n0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n0 1 15 1\n" + large + " " + large + "\n$EndElements\n"});
}

/// Of version 4.1, with blocks of few nodes and of many.
void add_binary_samples(std::vector<Sample>& all) {
  for (const bool swapped : {false, true}) {
    for (const bool is_finite : {true, false}) {
      std::string data = "$MeshFormat\n4.1 1 8\n";
      const auto put = [&](auto number) {
        const std::string stored(reinterpret_cast<const char*>(&number), sizeof(number));
        data += swapped ? std::string(stored.rbegin(), stored.rend()) : stored;
      };
      const auto put_sizes = [&put](const std::vector<std::uint64_t>& numbers) {
        for (const std::uint64_t number : numbers) {
          put(number);
        }
      };
      const std::vector<std::uint64_t> blocks{3, 40, 2, 20, 30};
      put(1);
      data += "\n$EndMeshFormat\n$Nodes\n";
      put_sizes({blocks.size(), 95, 1, 95});
      std::uint64_t tag = 0;
      for (const std::uint64_t size : blocks) {
        for (const int number : {2, static_cast<int>(size), 0}) {
          put(number);
        }
        put(size);
        for (std::uint64_t i = 0; i < size; ++i) {
          put(++tag);
        }
        for (std::uint64_t i = 0; i < 3 * size; ++i) {
          put(!is_finite && size == 20 && i == 7 ? std::numeric_limits<double>::infinity()
                                                 : 0.25 * static_cast<double>(i + size));
        }
      }
      data += "\n$EndNodes\n$Elements\n";
      put_sizes({2, 12, 1, 12});
      tag = 0;
      for (const std::uint64_t corners : {3, 4}) {
        for (const int number : {2, 40, static_cast<int>(corners) - 1}) {
          put(number);
        }
        put(std::uint64_t{6});
        for (std::uint64_t i = 0; i < 6; ++i) {
          put(++tag);
          for (std::uint64_t corner = 0; corner < corners; ++corner) {
            put(1 + 15 * i + corner);
          }
        }
      }
      all.push_back({"MSH: binary", trismooth::msh_codec, data + "\n$EndElements\n"});
    }
  }
}

/// A text of version 4.1 or 4.0: a block of nodes, and one of triangles, each with its tag and its nodes.
std::string block_text(const std::string& version, const std::vector<std::string>& node_tags,
                       const std::vector<std::string>& triangles) {
  const bool of_4_1 = version == "4.1";
  const std::string extremes = of_4_1 ? " 1 100" : "";
  const std::string nodes = std::to_string(node_tags.size());
  std::string text = "$MeshFormat\n" + version + " 0 8\n$EndMeshFormat\n$Nodes\n1 " + nodes + extremes + "\n" +
                     (of_4_1 ? "2 1" : "1 2") + " 0 " + nodes + "\n";
  const auto coordinates = [](std::size_t i) { return std::to_string(i) + ".5 " + std::to_string(i * i) + "e-1 0\n"; };
  for (std::size_t i = 0; i < node_tags.size(); ++i) {
    text += node_tags[i] + (of_4_1 ? "\n" : " " + coordinates(i));
  }
  for (std::size_t i = 0; of_4_1 && i < node_tags.size(); ++i) {
    text += coordinates(i);
  }
  const std::string count = std::to_string(triangles.size());
  text += "$EndNodes\n$Elements\n1 " + count + extremes + "\n" + (of_4_1 ? "2 1" : "1 2") + " 2 " + count + "\n";
  for (const std::string& triangle : triangles) {
    text += triangle + "\n";
  }
  return text + "$EndElements\n";
}

std::vector<std::string> counting_from(std::int64_t first, int count) {
  std::vector<std::string> numbers;
  for (int i = 0; i < count; ++i) {
    numbers.push_back(std::to_string(first + i));
  }
  return numbers;
}

void add_block_samples(std::vector<Sample>& all) {
  for (const std::string version : {"4.1", "4.0"}) {
    const auto add = [&](const std::string& name, const std::vector<std::string>& node_tags,
                         const std::vector<std::string>& triangles) {
      all.push_back({"MSH " + version + ": " + name, trismooth::msh_codec, block_text(version, node_tags, triangles)});
    };
    for (const std::int64_t first : {1, 7, 95, 99'996, 9'999'996, 99'999'995}) {
      const std::vector<std::string> nodes = counting_from(first, 9);
      std::vector<std::string> triangles;
      for (int i = 0; i < 7; ++i) {
        triangles.push_back(std::to_string(first + 2 + i) + " " + nodes[i] + " " + nodes[i + 1] + " " + nodes[i + 2]);
      }
      add("tags from " + nodes[0], nodes, triangles);
      std::vector<std::string> behind = triangles;
      behind[6] += '0';
      add("a node behind the last, tags from " + nodes[0], nodes, behind);
      behind[6] = "1 " + nodes[0] + " " + nodes[1] + " " + std::to_string(first - 1);
      add("a node before the first, tags from " + nodes[0], nodes, behind);
      std::vector<std::string> gap = nodes;
      gap[8] = std::to_string(first + 12);
      add("a gap in the nodes, tags from " + nodes[0], gap, triangles);
      std::vector<std::string> zeros = triangles;
      zeros[3].insert(0, "00");
      add("zeros before a tag, tags from " + nodes[0], nodes, zeros);
      std::vector<std::string> anew = triangles;
      anew[5].insert(0, "3");
      add("elements' tags with a gap, tags from " + nodes[0], nodes, anew);
    }
    add("zeros before the tags", {"01", "02", "03"}, {"1 1 2 3", "002 03 02 01"});
    add("a negative node", {"1", "2", "3"}, {"1 1 2 -3"});
    add("nodes from 0", {"0", "1", "2"}, {"0 0 1 2"});
    add("a node given twice", {"1", "2", "2"}, {"1 1 2 2"});
    add("a node far away", {"1", "2", "3"}, {"1 1 2 9223372036854775807"});
    add("tags down", {"3", "2", "1"}, {"3 1 2 3", "2 2 1 3"});
    add("a fraction", {"1", "2", "3"}, {"1 1 2 3", "2.5 1 2 3"});
  }
  const std::string huge = "9223372036854775806";
  all.push_back({"MSH 4.1: tags up to the largest", trismooth::msh_codec,
                 block_text("4.1", {huge, "9223372036854775807"}, {huge + " " + huge + " " + huge + " " + huge})});
  all.push_back({"MSH 4.1: tags beyond the largest", trismooth::msh_codec,
                 block_text("4.1", {huge, "9223372036854775807", "9223372036854775808"}, {"1 1 1 1"})});
}

}  // namespace

void add_msh_samples(std::vector<Sample>& all) {
  add_version_2_samples(all);
  add_block_samples(all);
  add_binary_samples(all);
}

}  // namespace part_samples
