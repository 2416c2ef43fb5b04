// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_original.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/nastran/nastran_grid.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

class NastranOriginal : public OriginalFile {
 public:
  NastranOriginal(std::deque<NastranSource> sources, std::vector<double> points)
      : sources_(std::move(sources)), points_(std::move(points)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, points_.size() / 3, "nodes", added_point_arrays, added_cell_arrays);
    const std::vector<bool> comes_in =
        sources_that_come_in(sources_, path.parent_path(), [&](const NastranSource& source) {
          return std::ranges::any_of(source.vertices, [&](std::int32_t vertex) {
            return has_moved(document, static_cast<std::size_t>(vertex));
          });
        });
    BufferedWriter writer(path);
    OrderedBlocks blocks([&writer](std::string_view block) { writer.write(block); }, FileWorkers(workers));
    write_source(0, comes_in, document, blocks);
    writer.close();
  }

 private:
  bool has_moved(const MeshDocument& document, std::size_t vertex) const {
    const auto place = [vertex](const std::vector<double>& points) { return std::span(points).subspan(3 * vertex, 3); };
    return !std::ranges::equal(place(document.points), place(points_), [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    });
  }

  void write_source(std::size_t index, const std::vector<bool>& comes_in, const MeshDocument& document,
                    OrderedBlocks& blocks) const {
    const NastranSource& source = sources_[index];
    const std::string_view bytes = source.bytes;
    std::size_t done = index > 0 ? begin_of_text(bytes) : 0;
    for (const NastranInclude& include : source.includes) {
      if (!comes_in[include.source]) {
        continue;
      }
      write_stretch(source, done, include.begin, document, blocks);
      write_source(include.source, comes_in, document, blocks);
      const std::string_view included = sources_[include.source].bytes;
      if (!included.empty() && !included.ends_with('\n') && !included.ends_with('\r')) {
        blocks.write("\n");
      }
      done = include.end;
    }
    write_stretch(source, done, bytes.size(), document, blocks);
  }

  /// The source's bytes from `begin` to before `end`, in blocks of GRIDs: each goes from its first one to the next
  /// block's.
  void write_stretch(const NastranSource& source, std::size_t begin, std::size_t end, const MeshDocument& document,
                     OrderedBlocks& blocks) const {
    constexpr std::size_t grids_each = 4096;
    const auto place = [&source](std::size_t offset) {
      return static_cast<std::size_t>(std::ranges::lower_bound(source.grids, offset) - source.grids.begin());
    };
    const std::size_t first = place(begin);
    const std::size_t last = place(end);
    const std::size_t count = std::max(std::size_t{1}, (last - first + grids_each - 1) / grids_each);
    blocks.write(count, [&](std::size_t block, MemoryBlock& out) {
      const std::size_t begin_grid = first + block * grids_each;
      const std::size_t end_grid = std::min(begin_grid + grids_each, last);
      const std::size_t from = block == 0 ? begin : source.grids[begin_grid];
      const std::size_t to = block + 1 == count ? end : source.grids[end_grid];
      const std::string text = patched(source, begin_grid, end_grid, from, to, document);
      if (!text.empty()) {
        std::memcpy(out.extend(text.size()), text.data(), text.size());
      }
    });
  }

  std::string patched(const NastranSource& source, std::size_t first, std::size_t last, std::size_t begin,
                      std::size_t end, const MeshDocument& document) const {
    const std::string_view bytes = source.bytes;
    std::string text;
    text.reserve(end - begin);
    std::size_t done = begin;
    for (std::size_t grid = first; grid < last; ++grid) {
      const std::size_t vertex = source.vertices.empty() ? grid : static_cast<std::size_t>(source.vertices[grid]);
      if (has_moved(document, vertex)) {
        const auto offset = static_cast<std::size_t>(source.grids[grid]);
        text.append(bytes.substr(done, offset - done));
        done = append_moved_grid(bytes, offset, place_of(points_, vertex), place_of(document.points, vertex), text);
      }
    }
    return text.append(bytes.substr(done, end - done));
  }

  static std::array<double, 3> place_of(const std::vector<double>& points, std::size_t vertex) {
    return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
  }

  std::deque<NastranSource> sources_;
  std::vector<double> points_;
};

}  // namespace

std::shared_ptr<const OriginalFile> make_nastran_original(std::deque<NastranSource> sources,
                                                          std::vector<double> points) {
  return std::make_shared<NastranOriginal>(std::move(sources), std::move(points));
}

}  // namespace trismooth
