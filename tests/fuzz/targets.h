// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/file_format.h"

namespace fuzz {

/// One thing that is fuzzed.
struct Target {
  std::string_view name;
  /// Of the files that inputs are, some of them text with numbers; none: the interface of flat arrays.
  std::optional<trismooth::FileFormat> format;

  bool is_xml() const { return format == trismooth::FileFormat::vtu || format == trismooth::FileFormat::vtp; }
  /// Throws Broken where the input shows that a promise is not kept.
  void run(std::span<const std::uint8_t> input) const;
};

/// Longer inputs are left alone.
inline constexpr std::size_t most_input_bytes = 32768;

/// One for each format, and the one of flat arrays.
std::span<const Target> all_targets();

/// Throws std::invalid_argument for a name that no target has.
const Target& find_target(std::string_view name);

struct Seed {
  std::string name;
  std::string bytes;
};

/// Small inputs to start from.
std::vector<Seed> seeds_of(const Target& target);

/// The reader of a format and all that stands behind it. See reader_target.cpp.
void run_reader(trismooth::FileFormat format, std::span<const std::uint8_t> input);

/// The interface of smoothing/smooth.h. See flat_arrays_target.cpp.
void run_flat_arrays(std::span<const std::uint8_t> input);

}  // namespace fuzz
