#include "trismooth/mesh_io/document/coordinate_sites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <type_traits>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

/// Ends of coordinate tokens: white space, a comment, the line continuation of OBJ.
constexpr std::string_view token_ends = " \t\v\f\r\n#\\";

/// The most bytes that a new coordinate takes.
constexpr std::size_t most_coordinate_bytes = 32;

/// The new bytes of a coordinate.
class SitePatcher {
 public:
  /// A coordinate in the file: the bytes that it takes there, and how many new ones are to stand in their place: none
  /// where it stays as it is.
  struct Patch {
    std::size_t old_bytes;
    std::size_t new_bytes;
  };

  SitePatcher(std::string_view bytes, const CoordinateSites& sites) : bytes_(bytes), sites_(sites) {}

  /// Writes the new bytes of the coordinate at `offset` to `target`, most_coordinate_bytes at most, where `value`
  /// differs from what stands there.
  Patch patch(std::size_t offset, std::size_t axis, double value, char* target) const {
    const ScalarType type = sites_.axis_types.empty() ? sites_.type : sites_.axis_types[axis];
    return visit_scalar_type(type,
                             [&](auto zero) { return patch_as(offset, static_cast<decltype(zero)>(value), target); });
  }

 private:
  template <class T>
  Patch patch_as(std::size_t offset, T value, char* target) const {
    if (sites_.encoding == CoordinateEncoding::text) {
      T plain{};
      PlainNumbers numbers(bytes_, offset);
      if (numbers.next(plain)) {
        return {numbers.offset() - offset, differs(plain, value) ? write_text(value, target) : 0};
      }
      const std::size_t end = std::min(bytes_.find_first_of(token_ends, offset), bytes_.size());
      const std::string_view token = bytes_.substr(offset, end - offset);
      std::optional<T> stored;
      if constexpr (std::is_floating_point_v<T>) {
        stored = parse_number<T>(token);
      } else {
        stored = parse_integer_as<T>(token);
      }
      return {token.size(), !stored || differs(*stored, value) ? write_text(value, target) : 0};
    }
    std::array<char, sizeof(T)> stored{};
    std::memcpy(stored.data(), bytes_.data() + offset, sizeof(T));
    const bool swapped =
        (sites_.encoding == CoordinateEncoding::big_endian) == (std::endian::native == std::endian::little);
    if (swapped) {
      std::ranges::reverse(stored);
    }
    if (!differs(std::bit_cast<T>(stored), value)) {
      return {sizeof(T), 0};
    }
    std::memcpy(target, &value, sizeof(T));
    if (swapped) {
      std::reverse(target, target + sizeof(T));
    }
    return {sizeof(T), sizeof(T)};
  }

  template <class T>
  static std::size_t write_text(T value, char* target) {
    return static_cast<std::size_t>(std::to_chars(target, target + most_coordinate_bytes, value).ptr - target);
  }

  /// A zero's sign counts: what is written is read back bit for bit. Where a vertex stands at several sites, they were
  /// found equal with whatever sign each has.
  template <class T>
  bool differs(T stored, T value) const {
    if constexpr (std::is_floating_point_v<T>) {
      return stored != value || (sites_.vertices.empty() && std::signbit(stored) != std::signbit(value));
    } else {
      return stored != value;
    }
  }

  std::string_view bytes_;
  const CoordinateSites& sites_;
};

/// A file in blocks of sites: each block goes from its first site, or the file's begin, to the next block, the last one
/// to the end of the last coordinate.
class PatchedFile {
 public:
  PatchedFile(std::string_view bytes, const CoordinateSites& sites, std::span<const double> points,
              std::size_t sites_each)
      : bytes_(bytes), sites_(sites), points_(points), patcher_(bytes, sites), sites_each_(sites_each) {}

  std::size_t block_count() const { return (site_count() + sites_each_ - 1) / sites_each_; }

  /// Where the last coordinate ends: what is behind it is no part of any block.
  std::size_t end_of_sites() const {
    if (site_count() == 0) {
      return 0;
    }
    const std::size_t site = site_count() - 1;
    const std::size_t axis = axes_of(site)[2];
    const std::size_t offset = sites_.offsets[3 * site + axis];
    std::array<char, most_coordinate_bytes> unused{};
    return offset + patcher_.patch(offset, axis, 0, unused.data()).old_bytes;
  }

  void append_block(std::size_t block, MemoryBlock& out) const {
    const std::size_t first = block * sites_each_;
    const std::size_t last = std::min(first + sites_each_, site_count());
    const std::size_t end = last == site_count() ? end_of_sites() : begin_of(last);
    std::size_t done = block == 0 ? 0 : begin_of(first);
    char* const begin = reinterpret_cast<char*>(out.extend(end - done + 3 * (last - first) * most_coordinate_bytes));
    char* target = begin;
    const auto copy_until = [&](std::size_t offset) {
      std::memcpy(target, bytes_.data() + done, offset - done);
      target += offset - done;
      done = offset;
    };
    for (std::size_t site = first; site < last; ++site) {
      const std::size_t vertex = sites_.vertices.empty() ? site : static_cast<std::size_t>(sites_.vertices[site]);
      for (const std::size_t axis : axes_of(site)) {
        const std::size_t offset = sites_.offsets[3 * site + axis];
        char* const number = target + (offset - done);
        const SitePatcher::Patch patch = patcher_.patch(offset, axis, points_[3 * vertex + axis], number);
        if (patch.new_bytes > 0) {
          copy_until(offset);
          target += patch.new_bytes;
          done = offset + patch.old_bytes;
        }
      }
    }
    copy_until(end);
    out.truncate(static_cast<std::size_t>(target - begin));
  }

 private:
  std::size_t site_count() const { return sites_.offsets.size() / 3; }

  /// A file may list y before x: the bytes are written in their own order.
  std::array<std::size_t, 3> axes_of(std::size_t site) const {
    const std::uint64_t* const offsets = sites_.offsets.data() + 3 * site;
    std::array<std::size_t, 3> axes{0, 1, 2};
    if (offsets[0] > offsets[1] || offsets[1] > offsets[2]) {
      std::ranges::sort(axes, {}, [offsets](std::size_t axis) { return offsets[axis]; });
    }
    return axes;
  }

  std::size_t begin_of(std::size_t site) const { return sites_.offsets[3 * site + axes_of(site)[0]]; }

  std::string_view bytes_;
  const CoordinateSites& sites_;
  std::span<const double> points_;
  SitePatcher patcher_;
  std::size_t sites_each_;
};

}  // namespace

void write_patched(const std::filesystem::path& path, std::string_view bytes, const CoordinateSites& sites,
                   std::span<const double> points, std::string_view suffix, const FileWorkers& workers) {
  constexpr std::size_t bytes_a_site = 32;
  const std::size_t part_bytes = std::min(workers.part_bytes, FileWorkers::default_part_bytes);
  BufferedWriter writer(path);
  const PatchedFile file(bytes, sites, points, std::max(std::size_t{1}, part_bytes / bytes_a_site));
  OrderedBlocks([&writer](std::string_view block) { writer.write(block); }, workers)
      .write(file.block_count(), [&file](std::size_t block, MemoryBlock& out) { file.append_block(block, out); });
  writer.write(bytes.substr(file.end_of_sites()));
  writer.write(suffix);
  writer.close();
}

}  // namespace trismooth
