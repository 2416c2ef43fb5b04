#include "targets.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "trismooth/mesh_io/errors.h"

#include "choices.h"
#include "document_checks.h"
#include "support/accepted_files.h"
#include "support/memory_file.h"
#include "support/test_meshes.h"

namespace fuzz {

using trismooth::FileFormat;
using trismooth::MeshDocument;

namespace {

template <FileFormat format>
constexpr Target reader(std::string_view name, bool is_xml = false) {
  return {name, [](std::span<const std::uint8_t> input) { run_reader(format, input); }, true, is_xml};
}

constexpr auto targets = std::to_array<Target>({
    reader<FileFormat::off>("off"),
    reader<FileFormat::obj>("obj"),
    reader<FileFormat::ply>("ply"),
    reader<FileFormat::stl>("stl"),
    reader<FileFormat::vtk>("vtk"),
    reader<FileFormat::vtu>("vtu", true),
    reader<FileFormat::vtp>("vtp", true),
    reader<FileFormat::msh>("msh"),
    reader<FileFormat::medit>("medit"),
    reader<FileFormat::su2>("su2"),
    reader<FileFormat::inp>("inp"),
    reader<FileFormat::adcirc>("adcirc"),
    reader<FileFormat::sms>("2dm"),
    reader<FileFormat::freefem>("freefem"),
    reader<FileFormat::mfem>("mfem"),
    reader<FileFormat::triangle>("triangle"),
    {"flat_arrays", &run_flat_arrays, false, false},
});

/// The accepted files have one free vertex; this has more.
std::string grid(FileFormat format) {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(5, 5, 0.6, 1);
  MeshDocument document;
  for (const test_meshes::Point p : mesh.points) {
    document.points.insert(document.points.end(), {p.x, p.y, 0});
  }
  for (const trismooth::Triangle& triangle : mesh.triangles) {
    document.cells.append(trismooth::cell_type::triangle, triangle);
  }
  const test_support::MemoryFile file;
  trismooth::codec_of(format).write(file.path(), document);
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

std::span<const Target> all_targets() {
  return targets;
}

const Target& find_target(std::string_view name) {
  const auto found = std::ranges::find(targets, name, &Target::name);
  if (found == targets.end()) {
    throw std::invalid_argument("no fuzz target is named " + std::string(name));
  }
  return *found;
}

std::vector<Seed> seeds_of(const Target& target) {
  const auto format = trismooth::format_named(target.name);
  if (!format) {
    return random_bytes();
  }
  std::vector<Seed> seeds{{"grid", grid(*format)}};
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (accepted_files::format_of(file) == *format) {
      seeds.push_back({file.name, file.bytes});
    }
  }
  return seeds;
}

}  // namespace fuzz
