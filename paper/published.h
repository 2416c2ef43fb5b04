// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "trismooth/paper/versions.h"

namespace trismooth::experiments {

/// What the paper has measured: K. Zhao, G. Mei, N. Xu, J. Zhang, "On the Accelerating of Two-dimensional Smart
/// Laplacian Smoothing on the GPU", section "Results". Single precision, times in milliseconds.

/// A row of one of the paper's tables.
struct PublishedRow {
  std::int64_t vertices;
  double cpu_ms, aos_ms, soa_ms;
  double aos_speedup, soa_speedup;
};

/// One of its four tables.
struct PublishedTable {
  int number;  ///< in the paper
  Version version;
  Form form;
  std::array<PublishedRow, 5> rows;
};

std::span<const PublishedTable> published_tables();

/// The paper's row for this number of vertices; null where it has none.
const PublishedRow* published_row(Version version, Form form, std::int64_t vertices);

/// The paper's time of a case in milliseconds, and its speedup over the serial version of the same form. Nothing where
/// it has none: of cases that are not its own (is_of_paper()), and of other sizes.
std::optional<double> published_ms(const Case& what, std::int64_t vertices);
std::optional<double> published_speedup(const Case& what, std::int64_t vertices);

/// The sizes of the paper's meshes.
inline constexpr std::array<std::int64_t, 5> published_sizes{1'000, 5'000, 10'000, 50'000, 100'000};

inline constexpr std::string_view published_gpu = "GeForce GT640 (GDDR5), CUDA 6.5";
inline constexpr std::string_view published_cpu = "Intel i5, 3.2 GHz";

}  // namespace trismooth::experiments
