// SPDX-License-Identifier: BSD-3-Clause
#include "range_checks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/ranges/msh_range.h"
#include "trismooth/mesh_io/ranges/vtu_range.h"
#include "trismooth/mesh_io/vtk_support.h"

#include "broken.h"
#include "document_checks.h"
#include "support/memory_file.h"

namespace fuzz {

using trismooth::DataArray;
using trismooth::FileFormat;
using trismooth::FileWorkers;
using trismooth::MeshDocument;
using trismooth::NumberRange;

namespace {

NumberRange part_of(std::uint64_t count, std::uint64_t part, std::uint64_t parts) {
  return {count * part / parts, count * (part + 1) / parts};
}

/// The documents of so many ranges; nothing where the file is not one that can be read so.
std::vector<MeshDocument> read_in_ranges(FileFormat format, const std::filesystem::path& path, std::uint64_t parts) {
  trismooth::Workers alone(1);
  const FileWorkers workers(alone);
  std::vector<MeshDocument> ranges;
  try {
    if (format == FileFormat::msh) {
      const trismooth::MshRanges file(path);
      for (std::uint64_t part = 0; part < parts; ++part) {
        ranges.push_back(
            file.read(part_of(file.point_count(), part, parts), part_of(file.cell_count(), part, parts), workers));
      }
    } else {
      const trismooth::VtuCounts counts = trismooth::count_vtu(path);
      for (std::uint64_t part = 0; part < parts; ++part) {
        ranges.push_back(trismooth::read_vtu_range(path, part_of(counts.points, part, parts),
                                                   part_of(counts.cells, part, parts), part == 0, workers));
      }
    }
  } catch (const trismooth::ReadError&) {
    return {};
  }
  return ranges;
}

/// That rows are those of the whole array behind the first `done` bytes, which then are more.
void check_rows(const std::vector<DataArray>& whole, const std::vector<DataArray>& range,
                std::vector<std::size_t>& done) {
  require(whole.size() == range.size(), "a range has other arrays");
  done.resize(whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    require(whole[i].name == range[i].name && whole[i].type == range[i].type, "a range has its arrays otherwise");
    const std::size_t count = range[i].bytes.size();
    require(count <= whole[i].bytes.size() - done[i] &&
                std::ranges::equal(whole[i].bytes.subspan(done[i], count), range[i].bytes),
            "rows of '" + whole[i].name + "' are others in a range");
    done[i] += count;
  }
}

/// Points and cells of the ranges, one after the other.
MeshDocument joined(const std::vector<MeshDocument>& ranges) {
  MeshDocument all;
  all.point_type = ranges.front().point_type;
  for (const MeshDocument& range : ranges) {
    all.points.insert(all.points.end(), range.points.begin(), range.points.end());
    for (std::size_t c = 0; c < range.cells.size(); ++c) {
      all.cells.append(range.cells.types[c], range.cells[c]);
    }
  }
  return all;
}

}  // namespace

void check_ranges(FileFormat format, const std::string& bytes, const MeshDocument* whole, HashedChoices& choices) {
  if (format != FileFormat::msh && (format != FileFormat::vtu || !trismooth::has_vtk())) {
    return;
  }
  const test_support::MemoryFile file;
  std::ofstream(file.path(), std::ios::binary) << bytes;
  const std::vector<MeshDocument> ranges = read_in_ranges(format, file.path(), 1 + choices.below(3));
  if (ranges.empty()) {
    return;
  }
  require(whole != nullptr, "a file is read by ranges that is refused as a whole");
  MeshDocument bare;
  bare.points = whole->points;
  bare.point_type = whole->point_type;
  bare.cells = whole->cells;
  const MeshDocument all = joined(ranges);
  if (format == FileFormat::msh && all.cells.size() != bare.cells.size()) {
    require(all.cells.size() > bare.cells.size(), "ranges lack cells");
    return;  // elements that are listed for one group each are joined in the whole
  }
  const std::string wrong = difference(bare, all, Comparison::exact);
  require(wrong.empty(), "by ranges: " + wrong);
  if (format == FileFormat::vtu) {
    std::vector<std::size_t> point_bytes;
    std::vector<std::size_t> cell_bytes;
    for (const MeshDocument& range : ranges) {
      check_rows(whole->point_arrays, range.point_arrays, point_bytes);
      check_rows(whole->cell_arrays, range.cell_arrays, cell_bytes);
    }
    const auto is_complete = [](const DataArray& array, std::size_t done) { return array.bytes.size() == done; };
    require(std::ranges::equal(whole->point_arrays, point_bytes, is_complete) &&
                std::ranges::equal(whole->cell_arrays, cell_bytes, is_complete),
            "ranges lack rows");
  }
}

}  // namespace fuzz
