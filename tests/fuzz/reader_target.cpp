// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/smooth.h"
#include "trismooth/space/plane_smoothing.h"

#include "broken.h"
#include "choices.h"
#include "document_checks.h"
#include "range_checks.h"
#include "smoothing_checks.h"
#include "support/memory_file.h"
#include "support/one_file_codec.h"
#include "support/readings.h"
#include "targets.h"

/// A file that may be anything: it is read or refused; what was read keeps all promises, is written back as it was, is
/// smoothed to something that is not worse, written and read again, and converted.
namespace fuzz {

using test_support::MemoryFile;
using trismooth::DataArray;
using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::ReadError;
using trismooth::WriteError;

namespace {

constexpr const char* input_path = "input";

/// Reads what must be readable, having been written by us.
MeshDocument read_again(FileFormat format, const std::string& bytes, const std::string& what) {
  try {
    MeshDocument document = test_support::one_file_codec(format).read(input_path, bytes);
    document.format = format;
    require_guarantees(document);
    return document;
  } catch (const ReadError& error) {
    throw Broken(what + " cannot be read: " + error.what());
  }
}

/// Whether files of the format are HDF5, or may be.
bool may_be_hdf5(FileFormat format) {
  return trismooth::codec_of(format).description.library == "HDF5" || format == FileFormat::exodus ||
         format == FileFormat::ugrid;
}

/// Nothing where a library refuses it: what HDF5 needs to change a file may be damaged, and nothing of what it needs to
/// read it.
std::optional<std::string> written_back(const MeshDocument& document) {
  const MemoryFile file;
  try {
    document.original->write(file.path(), document, {}, {});
  } catch (const WriteError&) {
    require(may_be_hdf5(document.format), "what was read is not written back");
    return std::nullopt;
  }
  return file.bytes();
}

bool keeps_bytes(FileFormat format) {
  return format != FileFormat::vtu && format != FileFormat::vtp;
}

void require_equal(const std::string& difference, const std::string& what) {
  require(difference.empty(), what + ": " + difference);
}

void check_written_back(const MeshDocument& document, std::string_view bytes) {
  const std::optional<std::string> written = written_back(document);
  if (!written) {
    return;
  }
  if (keeps_bytes(document.format)) {
    require(*written == bytes, "writing an unmoved mesh changes its file");
    return;
  }
  const MeshDocument again = read_again(document.format, *written, "what was written back");
  require_equal(difference(document, again, Comparison::exact), "writing back loses something");
  require(written_back(again) == written, "writing back twice gives another file");
}

/// The mesh in the document as the pipeline makes it, with what a smoothing of it needs.
struct Prepared {
  trismooth::PlanarMesh mesh;
  trismooth::LocalPoints local;
  trismooth::Regions regions;
  std::vector<std::uint8_t> fixed;
  trismooth::MeshRings found;

  void enter_frame() { local = trismooth::entered(fuzz::frame_of_used(mesh.points, mesh.in_cell), mesh.points); }

  trismooth::Constraints constraints() const {
    return {.fixed = fixed, .other_cells = mesh.in_other_cell, .regions = regions.of_triangle};
  }
};

/// Nothing for what is no planar mesh.
std::optional<Prepared> prepare(const MeshDocument& document) {
  Prepared prepared;
  try {
    prepared.mesh = trismooth::planar_mesh(document, input_path, trismooth::Quads::hold);
  } catch (const ReadError&) {
    return std::nullopt;
  }
  const trismooth::PlanarMesh& mesh = prepared.mesh;
  prepared.enter_frame();
  prepared.regions = trismooth::find_regions(document, mesh);
  prepared.fixed = trismooth::find_fixed_array(document, std::nullopt).flags;
  const NaiveTopology naive = naive_topology(mesh.points, mesh.elements.triangles(), prepared.constraints());
  trismooth::Workers workers(1);
  try {
    prepared.found =
        trismooth::find_mesh_rings(prepared.local.points, mesh.elements.triangles(), prepared.constraints(), workers);
  } catch (const trismooth::MeshError&) {
    require(!naive.orientable, "a mesh that can be oriented is refused");
    return std::nullopt;
  }
  require(naive.orientable, "a mesh that cannot be oriented is accepted");
  require(prepared.found.reversed == naive.reversed, "triangles are oriented otherwise than their majority");
  const trismooth::MeshRings other =
      trismooth::read_halfedge_rings(trismooth::connect_halfedges(document.points, mesh.elements.triangles(), workers),
                                     prepared.local.points, mesh.elements.triangles(), prepared.constraints(), workers);
  require(other.fixed == prepared.found.fixed && other.reversed == prepared.found.reversed &&
              other.rings.offsets == prepared.found.rings.offsets &&
              other.rings.neighbours == prepared.found.rings.neighbours,
          "halfedges give other rings than the triangle list");
  try {
    if (trismooth::settle_plane(prepared.mesh, document, prepared.found.fixed, input_path, workers)) {
      prepared.enter_frame();
    }
  } catch (const ReadError&) {
    return std::nullopt;
  }
  return prepared;
}

trismooth::SmoothingOptions choose_options(HashedChoices& choices) {
  trismooth::SmoothingOptions options;
  const auto methods = all_methods();
  options.method = methods[choices.below(methods.size())];
  options.form = choices.flag() ? trismooth::Form::swap : trismooth::Form::in_place;
  options.precision = choices.flag() ? trismooth::Precision::single_precision : trismooth::Precision::double_precision;
  const std::size_t guard = choices.below(32);
  options.guard = guard % 8 != 0;
  options.untangle = guard / 8 == 1 ? trismooth::Untangle::on : trismooth::Untangle::off;
  options.max_sweeps = 1 + static_cast<std::int64_t>(choices.below(4));
  options.threads = 1;
  return options;
}

/// Smooths the document's mesh in place, as the pipeline does. False where there is none.
bool smooth(MeshDocument& document, HashedChoices& choices) {
  std::optional<Prepared> prepared = prepare(document);
  if (!prepared) {
    return false;
  }
  trismooth::PlanarMesh& mesh = prepared->mesh;
  const trismooth::SmoothingOptions options = choose_options(choices);
  const auto before = mesh.points;
  const std::vector<double> stored_before = document.points;
  const auto storage = document.moved_point_type() == trismooth::ScalarType::float32 ? trismooth::Storage::float32
                                                                                     : trismooth::Storage::float64;
  const trismooth::SmoothingResult result =
      trismooth::smooth_in_plane(prepared->found, mesh.elements.triangles(), mesh.plane, document.points, mesh.points,
                                 prepared->local, storage, options);
  require_guarantees(document);
  std::vector<Point2<double>> after(before.size());
  for (std::size_t v = 0; v < after.size(); ++v) {
    // Where the plane has no finite coordinates for a vertex of no cell, any do.
    after[v] = mesh.in_cell[v] != 0
                   ? mesh.plane.project(Eigen::Map<const Eigen::Vector3d>(document.points.data() + 3 * v))
                   : before[v];
    const bool moved = !std::equal(
        stored_before.begin() + static_cast<std::ptrdiff_t>(3 * v),
        stored_before.begin() + static_cast<std::ptrdiff_t>(3 * v + 3),
        document.points.begin() + static_cast<std::ptrdiff_t>(3 * v),
        [](double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); });
    require(!moved || prepared->found.fixed[v] == 0, "a fixed vertex moved in space");
    require(fuzz::same_bits(after[v], mesh.points[v]), "reports other coordinates than it stores");
  }
  const NaiveTopology topology = naive_topology(before, mesh.elements.triangles(), prepared->constraints());
  require_never_worse({mesh.elements.triangles(), topology, before, after, options, result});
  return true;
}

bool has_quadrilaterals(const MeshDocument& document) {
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (trismooth::quad_of_cell(document.cells.types[cell], document.cells[cell])) {
      return true;
    }
  }
  return false;
}

/// Smooths the mesh with its quadrilaterals as the program does. What is refused has not moved, the smallest shape is
/// no smaller, nothing more is invalid, and the bits are those of another number of threads.
void check_quadrilaterals(const MeshDocument& read, HashedChoices& choices) {
  trismooth::PipelineOptions options;
  options.input = input_path;
  options.smoothing = choose_options(choices);
  std::vector<double> found;
  for (const int threads : {1, 2}) {
    MeshDocument document = read;
    options.smoothing.threads = threads;
    try {
      const trismooth::PipelineResult result = trismooth::smooth_document(document, options);
      const trismooth::QualityReport& before = result.before;
      const trismooth::QualityReport& after = *result.after;
      if (options.smoothing.guard && result.smoothing->moved_vertices > 0) {
        constexpr trismooth::Metric shape = trismooth::Metric::shape;
        const bool is_turned = result.smoothing->untangling && result.smoothing->untangling->turned_components > 0;
        require(is_turned || after[shape].min >= before[shape].min, "the smallest shape of both kinds is smaller");
        require(after.inverted + after.degenerate <= before.inverted + before.degenerate,
                "more elements are not valid");
        require(!result.quadratic_after || result.quadratic_after->invalid <= result.quadratic_before->invalid,
                "more curved elements are not valid");
      }
    } catch (const ReadError&) {
      require(document.points == read.points, "a mesh that is refused has moved");
    } catch (const std::invalid_argument&) {
      require(document.points == read.points, "a mesh that is refused has moved");
    }
    require_guarantees(document);
    require(threads == 1 || document.points == found, "the bits of quadrilaterals depend on threads");
    found = document.points;
  }
}

/// What is stored of a coordinate that moves is what the file has characters for.
void round_moved(MeshDocument& document, const std::vector<double>& before) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (document.points[i] != before[i]) {
      document.points[i] = trismooth::rounded_to_characters(document.points[i], document.most_coordinate_characters,
                                                            document.coordinate_form);
    }
  }
}

void check_moved(const MeshDocument& document) {
  const std::optional<std::string> written = written_back(document);
  if (!written) {
    return;
  }
  const MeshDocument again = read_again(document.format, *written, "a smoothed mesh");
  // Corners that came to lie on each other become one vertex in STL.
  require_equal(document.format == FileFormat::stl ? difference_of_corners(document, again)
                                                   : difference(document, again, Comparison::exact),
                "a smoothed mesh is not read as it was written");
}

/// Arrays may be added to what is written back; all else is as without them.
void check_added_arrays(const MeshDocument& document) {
  if (!document.original->takes_added_arrays()) {
    return;
  }
  MeshDocument expected = document;
  // MSH has one type of number.
  const std::vector<DataArray> of_points{
      document.format == FileFormat::msh
          ? trismooth::make_data_array("fixed", 1, std::vector<double>(document.point_count(), 1))
          : trismooth::make_data_array("fixed", 1, std::vector<std::uint8_t>(document.point_count(), 1)),
      trismooth::make_data_array("displacement", 3, std::vector<double>(document.points.size(), -0.1))};
  const std::vector<DataArray> of_cells{
      trismooth::make_data_array("shape", 1, std::vector<double>(document.cells.size(), 1e-300))};
  expected.point_arrays.insert(expected.point_arrays.end(), of_points.begin(), of_points.end());
  expected.cell_arrays.insert(expected.cell_arrays.end(), of_cells.begin(), of_cells.end());
  const MemoryFile file;
  document.original->write(file.path(), document, of_points, of_cells);
  const MeshDocument again = read_again(document.format, file.bytes(), "a mesh with arrays added");
  require_equal(difference(expected, again, Comparison::converted), "with arrays added");
}

/// In parts of any size, the reader says what it says number by number. HDF5 is read in one, by a process for each
/// reading.
void check_parts(FileFormat format, const std::string& bytes) {
  if (bytes.starts_with("\x89HDF")) {
    return;
  }
  trismooth::Workers alone(1);
  using trismooth::FileWorkers;
  const auto reading = [&](std::size_t part_bytes) {
    const FileWorkers workers(alone, part_bytes);
    return keeps_bytes(format)
               ? test_support::reading_and_sites_of(test_support::one_file_codec(format), bytes, workers)
               : test_support::reading_of(test_support::one_file_codec(format), bytes, workers);
  };
  const std::string serial = reading(FileWorkers::serial);
  for (const std::size_t part_bytes : {std::size_t{1}, 2 + bytes.size() % 61, FileWorkers::whole}) {
    require(reading(part_bytes) == serial,
            "in parts of " + std::to_string(part_bytes) + " bytes, another document or error");
  }
}

void check_conversion(const MeshDocument& read, FileFormat target) {
  const std::string what = "as " + std::string(to_string(target));
  const MeshDocument document = straightened(read, target);
  const MemoryFile file;
  try {
    test_support::one_file_codec(target).write(file.path(), document);
  } catch (const WriteError&) {
    return;
  }
  const bool loses_nothing = test_support::one_file_codec(target).what_is_lost(document).empty();
  const MeshDocument converted = read_again(target, file.bytes(), "the mesh " + what);
  if (target == FileFormat::stl) {
    require_equal(difference_of_corners(document, converted), what);
    return;
  }
  if (loses_nothing && !trismooth::has_names(target)) {
    require_equal(difference(document, converted, Comparison::converted), what);
  }
  const auto cells_alone = [target](const MeshDocument& mesh) {
    MeshDocument held = held_cells(mesh, target);
    if (trismooth::has_names(target)) {
      // Many of these formats are flat: they say what they lose of z.
      for (std::size_t i = 2; i < held.points.size(); i += 3) {
        held.points[i] = 0;
      }
    }
    return held;
  };
  require_equal(difference(cells_alone(document), cells_alone(converted), Comparison::converted), what);
}

}  // namespace

void run_reader(FileFormat format, std::span<const std::uint8_t> input) {
  const std::string bytes(input.begin(), input.end());
  MeshDocument document;
  HashedChoices choices(input);
  check_parts(format, bytes);
  try {
    document = test_support::one_file_codec(format).read(input_path, bytes);
  } catch (const ReadError&) {
    check_ranges(format, bytes, nullptr, choices);
    return;
  }
  document.format = format;
  require_guarantees(document);
  check_ranges(format, bytes, &document, choices);
  if (bytes.find("LZMA") != std::string::npos && choices.below(16) != 0) {
    return;  // its encoder takes half a second; what it decodes has been checked
  }
  check_written_back(document, bytes);
  check_conversion(document, trismooth::all_formats()[choices.below(trismooth::all_formats().size())]);
  const std::vector<double> before = document.points;
  const std::optional<MeshDocument> read = has_quadrilaterals(document) ? std::optional(document) : std::nullopt;
  if (smooth(document, choices)) {
    round_moved(document, before);
    check_moved(document);
    if (choices.below(4) == 0) {
      check_added_arrays(document);
    }
  }
  if (read) {
    check_quadrilaterals(*read, choices);
  }
}

}  // namespace fuzz
