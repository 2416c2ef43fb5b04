// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/number_sites.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

/// Ends of number tokens: white space, separators, comments of all formats, the line continuation of OBJ, tags of XML.
constexpr std::string_view token_ends = " \t\v\f\r\n,;#%!$\\<\x1a";

/// The most bytes that a new number takes.
constexpr std::size_t most_number_bytes = 32;

/// The new bytes of a number.
class SitePatcher {
 public:
  /// A number in the file: the bytes that it takes there, and how many new ones are to stand in their place: none
  /// where it stays as it is.
  struct Patch {
    std::size_t old_bytes;
    std::size_t new_bytes;
  };

  SitePatcher(std::string_view bytes, const NumberSites& sites) : bytes_(bytes), sites_(sites) {}

  ScalarType type_of(std::size_t column) const {
    return sites_.column_types.empty() ? sites_.type : sites_.column_types[column];
  }

  /// Of a binary number of type T at `place`: makes it that value, unless it does not differ.
  template <class T>
  void replace(char* place, T value) const {
    const bool swapped = is_swapped(sites_.encoding);
    T stored{};
    std::memcpy(&stored, place, sizeof(T));
    if (changes(swapped ? with_bytes_reversed(stored) : stored, value)) {
      stored = swapped ? with_bytes_reversed(value) : value;
      std::memcpy(place, &stored, sizeof(T));
    }
  }

  /// Of text: writes the new bytes of the number at `offset` to `target`, most_number_bytes at most, where `value`
  /// differs from what stands there.
  Patch patch(std::size_t offset, std::size_t column, double value, char* target) const {
    return visit_scalar_type(type_of(column),
                             [&](auto zero) { return patch_as(offset, static_cast<decltype(zero)>(value), target); });
  }

 private:
  template <class T>
  Patch patch_as(std::size_t offset, T value, char* target) const {
    if constexpr (std::is_same_v<T, double>) {
      if (sites_.is_in_columns) {
        return patch_columns(offset, value, target);
      }
    }
    T plain{};
    PlainNumbers numbers(bytes_, offset);
    if (numbers.next(plain)) {
      return {numbers.offset() - offset, changes(plain, value) ? write_text(value, target) : 0};
    }
    const std::size_t end = std::min(bytes_.find_first_of(token_ends, offset), bytes_.size());
    const std::string_view token = bytes_.substr(offset, end - offset);
    std::optional<T> stored;
    if constexpr (std::is_floating_point_v<T>) {
      stored = parse_fortran_number<T>(token);
    } else {
      stored = parse_integer_as<T>(token);
    }
    const bool stays = stored ? !changes(*stored, value) : is_no_number(value);
    return {token.size(), stays ? 0 : write_text(value, target)};
  }

  /// Where the columns do not hold the new number, it takes more.
  Patch patch_columns(std::size_t offset, double value, char* target) const {
    const std::size_t begin = std::min(bytes_.find_first_not_of(" \t", offset), bytes_.size());
    const std::size_t end = std::min(bytes_.find_first_of(token_ends, begin), bytes_.size());
    const std::string_view token = bytes_.substr(begin, end - begin);
    const auto stored = parse_fortran_number<double>(token);
    if (stored && !changes(*stored, value)) {
      return {end - offset, 0};
    }
    const std::size_t letter = token.find_first_of("dDeEqQ");
    const std::string text = fortran_text(value, letter == std::string_view::npos ? 'E' : token[letter]);
    const std::size_t blank = begin > offset ? 1 : 0;
    const std::size_t columns = std::min(std::max(end - offset, text.size() + blank), most_number_bytes);
    std::fill_n(target, columns - text.size(), ' ');
    std::ranges::copy(text, target + (columns - text.size()));
    return {end - offset, columns};
  }

  template <class T>
  std::size_t write_text(T value, char* target) const {
    const auto shortest =
        static_cast<std::size_t>(std::to_chars(target, target + most_number_bytes, value).ptr - target);
    if constexpr (std::is_floating_point_v<T>) {
      if (sites_.most_characters > 0 && shortest > sites_.most_characters) {
        return write_within(value, sites_.most_characters, target);
      }
    }
    return shortest;
  }

  /// Texts of what is no number are as many as programs that write it.
  template <class T>
  static bool is_no_number(T value) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::isnan(value);
    }
    return false;
  }

  /// Where a vertex stands at several sites, they were found equal with whatever sign each zero has.
  template <class T>
  bool changes(T stored, T value) const {
    return differs(stored, value) && (sites_.vertices.empty() || stored != value);
  }

  std::string_view bytes_;
  const NumberSites& sites_;
};

/// A stretch of a file in blocks of sites: each block goes from its first site, or the begin of the stretch, to the
/// next block, the last one to the end of the last number.
class PatchedStretch {
 public:
  PatchedStretch(std::string_view bytes, std::size_t begin, const PatchedSites& patched, std::size_t sites_each)
      : bytes_(bytes),
        begin_(begin),
        sites_(patched.sites),
        values_(patched.values),
        patcher_(bytes, patched.sites),
        sites_each_(sites_each) {}

  std::size_t block_count() const { return (sites_.size() + sites_each_ - 1) / sites_each_; }

  /// Where the last number ends: what is behind it is no part of any block.
  std::size_t end_of_sites() const {
    if (sites_.size() == 0) {
      return begin_;
    }
    Order order;
    const std::size_t site = sites_.size() - 1;
    const std::size_t column = columns_of(site, order).back();
    const std::size_t offset = offset_of(site, column);
    if (sites_.encoding != NumberEncoding::text) {
      return offset + size_of(patcher_.type_of(column));
    }
    std::array<char, most_number_bytes> unused{};
    return offset + patcher_.patch(offset, column, 0, unused.data()).old_bytes;
  }

  void append_block(std::size_t block, MemoryBlock& out) const {
    const std::size_t first = block * sites_each_;
    const std::size_t last = std::min(first + sites_each_, sites_.size());
    const std::size_t end = last == sites_.size() ? end_of_sites() : begin_of(last);
    std::size_t done = block == 0 ? begin_ : begin_of(first);
    if (sites_.encoding != NumberEncoding::text) {
      append_binary(first, last, done, end, out);
      return;
    }
    char* const begin =
        reinterpret_cast<char*>(out.extend(end - done + sites_.columns.size() * (last - first) * most_number_bytes));
    char* target = begin;
    const auto copy_until = [&](std::size_t offset) {
      std::memcpy(target, bytes_.data() + done, offset - done);
      target += offset - done;
      done = offset;
    };
    Order order;
    for (std::size_t site = first; site < last; ++site) {
      const std::size_t vertex = sites_.vertex_at(site);
      for (const std::size_t column : columns_of(site, order)) {
        const ColumnValues& values = values_[column];
        if (values.first == nullptr) {
          continue;
        }
        const std::size_t offset = offset_of(site, column);
        char* const number = target + (offset - done);
        const SitePatcher::Patch patch = patcher_.patch(offset, column, values.first[vertex * values.stride], number);
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
  using Order = std::vector<std::size_t>;

  /// New numbers take the bytes of the old ones.
  void append_binary(std::size_t first, std::size_t last, std::size_t begin, std::size_t end, MemoryBlock& out) const {
    char* const target = reinterpret_cast<char*>(out.extend(end - begin));
    std::memcpy(target, bytes_.data() + begin, end - begin);
    for (std::size_t column = 0; column < sites_.columns.size(); ++column) {
      const ColumnValues& values = values_[column];
      if (values.first == nullptr) {
        continue;
      }
      visit_scalar_type(patcher_.type_of(column), [&](auto zero) {
        for (std::size_t site = first; site < last; ++site) {
          const std::size_t vertex = sites_.vertex_at(site);
          patcher_.replace(target + (offset_of(site, column) - begin),
                           static_cast<decltype(zero)>(values.first[vertex * values.stride]));
        }
      });
    }
  }

  std::size_t offset_of(std::size_t site, std::size_t column) const { return sites_.offset_of(site, column); }

  /// A file may list y before x: the bytes are written in their own order. `order` is memory for it.
  std::span<const std::size_t> columns_of(std::size_t site, Order& order) const {
    const std::size_t count = sites_.columns.size();
    if (order.size() != count) {
      order.resize(count);
      std::iota(order.begin(), order.end(), std::size_t{0});
    }
    const auto by_offset = [this, site](std::size_t column) { return offset_of(site, column); };
    if (!std::ranges::is_sorted(order, {}, by_offset)) {
      std::ranges::sort(order, {}, by_offset);
    }
    return order;
  }

  std::size_t begin_of(std::size_t site) const {
    Order order;
    return offset_of(site, columns_of(site, order).front());
  }

  std::string_view bytes_;
  std::size_t begin_;
  const NumberSites& sites_;
  std::span<const ColumnValues> values_;
  SitePatcher patcher_;
  std::size_t sites_each_;
};

}  // namespace

NumberSites binary_sites(NumberEncoding encoding, ScalarType type, std::uint64_t begin, std::size_t count,
                         std::vector<SiteColumn> columns) {
  NumberSites sites;
  sites.encoding = encoding;
  sites.type = type;
  sites.even = EvenSites{begin, columns.size() * size_of(type), count, size_of(type)};
  sites.columns = std::move(columns);
  return sites;
}

bool sort_apart(std::vector<NumberSites>& lists) {
  std::erase_if(lists, [](const NumberSites& list) { return list.size() == 0; });
  std::ranges::sort(lists, {}, [](const NumberSites& list) { return list.offset_of(0, 0); });
  std::uint64_t end = 0;
  for (const NumberSites& list : lists) {
    if (list.offset_of(0, 0) < end) {
      return false;
    }
    end = list.offset_of(list.size() - 1, list.columns.size() - 1) +
          (list.encoding == NumberEncoding::text ? 1 : size_of(list.type));
  }
  return true;
}

void write_patched(const std::filesystem::path& path, std::string_view bytes, std::span<const PatchedSites> lists,
                   std::string_view suffix, const FileWorkers& workers) {
  constexpr std::size_t bytes_a_number = 10;
  const std::size_t part_bytes = std::min(workers.part_bytes, FileWorkers::default_part_bytes);
  BufferedWriter writer(path);
  OrderedBlocks blocks([&writer](std::string_view block) { writer.write(block); }, workers);
  std::size_t done = 0;
  for (const PatchedSites& list : lists) {
    const std::size_t site_bytes = bytes_a_number * list.sites.columns.size();
    const PatchedStretch stretch(bytes, done, list, std::max(std::size_t{1}, part_bytes / site_bytes));
    blocks.write(stretch.block_count(),
                 [&stretch](std::size_t block, MemoryBlock& out) { stretch.append_block(block, out); });
    done = stretch.end_of_sites();
  }
  writer.write(bytes.substr(done));
  writer.write(suffix);
  writer.close();
}

void write_patched(const std::filesystem::path& path, std::string_view bytes, const NumberSites& sites,
                   std::span<const ColumnValues> values, std::string_view suffix, const FileWorkers& workers) {
  const PatchedSites list{sites, {values.begin(), values.end()}};
  write_patched(path, bytes, std::span(&list, 1), suffix, workers);
}

void write_patched(const std::filesystem::path& path, std::string_view bytes, const NumberSites& sites,
                   std::span<const double> points, std::string_view suffix, const FileWorkers& workers) {
  std::vector<ColumnValues> values;
  for (const SiteColumn& column : sites.columns) {
    values.push_back({points.data() + (points.empty() ? 0 : column.component), 3});
  }
  write_patched(path, bytes, sites, values, suffix, workers);
}

}  // namespace trismooth
