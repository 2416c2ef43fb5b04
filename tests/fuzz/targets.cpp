// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

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
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (accepted_files::format_of(file) == *target.format) {
      seeds.push_back({file.name, file.bytes});
    }
  }
  return seeds;
}

}  // namespace fuzz
