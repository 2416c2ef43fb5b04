// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_values.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_writer.h"

namespace trismooth {

namespace {

constexpr std::string_view value_separators = " \t\v\f\r\n";

/// Steps over the numbers of an ASCII file, past comments.
class ValueTokens {
 public:
  ValueTokens(std::string_view bytes, std::size_t offset) : bytes_(bytes), end_(offset) {}

  /// Where the next one begins.
  std::size_t next() {
    std::size_t begin = skipped(end_);
    while (begin < bytes_.size() && bytes_[begin] == '#') {
      begin = skipped(std::min(bytes_.find_first_of("\r\n", begin), bytes_.size()));
    }
    end_ = token_end(bytes_, begin);
    return begin;
  }

  static std::size_t token_end(std::string_view bytes, std::size_t begin) {
    return std::min(bytes.find_first_of(value_separators, begin), bytes.size());
  }

 private:
  std::size_t skipped(std::size_t offset) const {
    return std::min(bytes_.find_first_not_of(value_separators, offset), bytes_.size());
  }

  std::string_view bytes_;
  std::size_t end_;
};

bool is_comparable(const DataArray& read, const DataArray& now) {
  return read.name == now.name && read.type == now.type && read.components == now.components &&
         read.bytes.size() == now.bytes.size();
}

VtkLegacyChanges changes_of(std::string_view bytes, bool binary, const VtkLegacyValues& file, const DataArray& now) {
  VtkLegacyChanges changes;
  changes.sites.encoding = binary ? NumberEncoding::big_endian : NumberEncoding::text;
  changes.sites.type = now.type;
  changes.sites.columns = {{now.name, 0}};
  const std::size_t size = size_of(now.type);
  ValueTokens tokens(bytes, file.begin);
  for (std::size_t i = 0; i < now.bytes.size() / size; ++i) {
    const std::size_t offset = binary ? file.begin + i * size : tokens.next();
    if (std::memcmp(file.array.bytes.data() + i * size, now.bytes.data() + i * size, size) != 0) {
      changes.sites.offsets.push_back(offset);
      changes.values.push_back(now.value(i / now.components, i % now.components));
    }
  }
  return changes;
}

}  // namespace

std::vector<VtkLegacyChanges> changed_values(std::string_view bytes, const VtkLegacyLayout& layout,
                                             std::span<const DataArray> arrays) {
  std::vector<VtkLegacyChanges> all;
  for (const VtkLegacyValues& file : layout.point_values) {
    if (file.number >= arrays.size()) {
      continue;
    }
    const DataArray& now = arrays[file.number];
    if (!is_comparable(file.array, now) || file.array.bytes.data() == now.bytes.data()) {
      continue;
    }
    VtkLegacyChanges changes = changes_of(bytes, layout.binary, file, now);
    if (!changes.values.empty()) {
      all.push_back(std::move(changes));
    }
  }
  return all;
}

std::vector<ByteEdit> edits_of(std::string_view bytes, const VtkLegacyChanges& changes) {
  const bool binary = changes.sites.encoding != NumberEncoding::text;
  std::vector<ByteEdit> edits;
  for (std::size_t i = 0; i < changes.values.size(); ++i) {
    const std::size_t begin = changes.sites.offsets[i];
    MemoryBlock text;
    std::size_t end = begin;
    visit_scalar_type(changes.sites.type, [&](auto zero) {
      VtkLegacyNumbers(binary, text).append(static_cast<decltype(zero)>(changes.values[i]), ' ');
      end = binary ? begin + sizeof(zero) : ValueTokens::token_end(bytes, begin);
    });
    std::string number(reinterpret_cast<const char*>(text.data()), text.size());
    if (!binary) {
      number.pop_back();
    }
    edits.push_back({begin, end, std::move(number)});
  }
  return edits;
}

}  // namespace trismooth
