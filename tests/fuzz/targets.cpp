// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "choices.h"
#include "document_checks.h"
#include "support/accepted_files.h"
#include "support/memory_file.h"
#include "support/one_file_codec.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace fuzz {

using trismooth::FileFormat;
namespace cell_type = trismooth::cell_type;

namespace {

std::vector<Target> make_targets() {
  std::vector<Target> targets;
  for (const FileFormat format : trismooth::all_formats()) {
    targets.push_back({to_string(format), format});
  }
  targets.push_back({"flat_arrays", std::nullopt});
  return targets;
}

/// The accepted files have one free vertex; this has more.
std::string grid(FileFormat format) {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(5, 5, 0.6, 1);
  const test_support::MemoryFile file;
  test_support::one_file_codec(format).write(file.path(), triangle_document(mesh));
  return file.bytes();
}

/// Quadrilaterals of so many nodes, curved where they have any between corners, and two triangles among them.
std::string quadrilaterals(FileFormat format, std::size_t nodes) {
  constexpr std::int32_t columns = 4;
  constexpr std::int32_t row_nodes = 2 * columns + 1;
  trismooth::MeshDocument document;
  HashedChoices choices(nodes);
  std::vector<std::int32_t> numbers(row_nodes * row_nodes, -1);
  const auto node = [&](std::int32_t place) {
    std::int32_t& number = numbers[static_cast<std::size_t>(place)];
    if (number < 0) {
      number = static_cast<std::int32_t>(document.point_count());
      const auto off = [&choices] { return static_cast<double>(choices.below(64)) / 80 - 0.4; };
      const std::int32_t row = place / row_nodes;
      const double x = place % row_nodes + off();
      document.points.insert(document.points.end(), {x, row + off(), 0});
    }
    return number;
  };
  for (std::int32_t square = 0; square < columns * columns; ++square) {
    const std::int32_t a = 2 * (square / columns * row_nodes + square % columns);
    std::vector<std::int32_t> places{a,
                                     a + 2,
                                     a + 2 + 2 * row_nodes,
                                     a + 2 * row_nodes,
                                     a + 1,
                                     a + 2 + row_nodes,
                                     a + 1 + 2 * row_nodes,
                                     a + row_nodes,
                                     a + 1 + row_nodes};
    places.resize(nodes);
    std::ranges::transform(places, places.begin(), node);
    if (square == 5) {
      document.cells.append(cell_type::triangle, std::vector<std::int32_t>{places[0], places[1], places[2]});
      document.cells.append(cell_type::triangle, std::vector<std::int32_t>{places[0], places[2], places[3]});
    } else {
      document.cells.append(nodes == 4   ? cell_type::quad
                            : nodes == 8 ? cell_type::quadratic_quad
                                         : cell_type::biquadratic_quad,
                            places);
    }
  }
  const test_support::MemoryFile file;
  test_support::one_file_codec(format).write(file.path(), document);
  return file.bytes();
}

/// Any bytes mean something to the flat arrays.
std::vector<Seed> random_bytes() {
  std::vector<Seed> seeds;
  for (std::uint64_t i = 0; i < 256; ++i) {
    HashedChoices choices(i);
    Seed seed{"random_" + std::to_string(i), std::string(16 + 2 * i, '\0')};
    std::ranges::generate(seed.bytes, [&] { return static_cast<char>(choices.below(256)); });
    seeds.push_back(std::move(seed));
  }
  return seeds;
}

}  // namespace

void Target::run(std::span<const std::uint8_t> input) const {
  if (format) {
    run_reader(*format, input);
  } else {
    run_flat_arrays(input);
  }
}

std::span<const Target> all_targets() {
  static const std::vector<Target> targets = make_targets();
  return targets;
}

const Target& find_target(std::string_view name) {
  const std::span<const Target> targets = all_targets();
  const auto found = std::ranges::find(targets, name, &Target::name);
  if (found == targets.end()) {
    throw std::invalid_argument("no fuzz target is named " + std::string(name));
  }
  return *found;
}

std::vector<Seed> seeds_of(const Target& target) {
  if (!target.format) {
    return random_bytes();
  }
  std::vector<Seed> seeds{{"grid", grid(*target.format)}};
  const trismooth::FormatContent& holds = test_support::one_file_codec(*target.format).description.holds;
  for (const std::size_t nodes : {4U, 8U, 9U}) {
    if (holds.quads && (nodes == 4 || holds.curved_cells) && (nodes != 8 || holds.eight_node_quads)) {
      seeds.push_back({"quadrilaterals_" + std::to_string(nodes), quadrilaterals(*target.format, nodes)});
    }
  }
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (accepted_files::format_of(file) == *target.format) {
      seeds.push_back({file.name, file.bytes});
    }
  }
  return seeds;
}

}  // namespace fuzz
