// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/published.h"

#include <algorithm>

namespace trismooth::experiments {

namespace {

constexpr std::array<PublishedTable, 4> printed_tables{{
    {1,
     Version::gpu,
     Form::swap,
     {{{1'000, 218, 16.0, 18.8, 13.63, 11.60},
       {5'000, 1217, 72.2, 86.0, 16.86, 14.15},
       {10'000, 2012, 117.6, 138.1, 17.11, 14.57},
       {50'000, 14383, 530.5, 618.0, 27.11, 23.27},
       {100'000, 33836, 802.8, 932.8, 42.15, 36.27}}}},
    {2,
     Version::gpu,
     Form::in_place,
     {{{1'000, 171, 14.9, 17.7, 11.48, 9.66},
       {5'000, 1139, 52.4, 76.6, 21.74, 14.87},
       {10'000, 1888, 79.3, 115.0, 23.81, 16.42},
       {50'000, 11918, 424.5, 513.1, 28.08, 23.23},
       {100'000, 26021, 776.1, 896.3, 33.53, 29.03}}}},
    {3,
     Version::cdp,
     Form::swap,
     {{{1'000, 218, 14.1, 16.5, 15.46, 13.21},
       {5'000, 1217, 59.2, 66.8, 20.56, 18.22},
       {10'000, 2012, 96.1, 107.7, 20.94, 18.68},
       {50'000, 14383, 477.7, 532.4, 30.11, 27.02},
       {100'000, 33836, 755.9, 832.5, 44.76, 40.64}}}},
    {4,
     Version::cdp,
     Form::in_place,
     {{{1'000, 171, 13.5, 15.4, 12.67, 11.10},
       {5'000, 1139, 50.0, 58.1, 22.78, 19.60},
       {10'000, 1888, 74.8, 82.8, 25.24, 22.80},
       {50'000, 11918, 404.4, 424.8, 29.47, 28.06},
       {100'000, 26021, 750.2, 801.7, 34.69, 32.46}}}},
}};

/// The row that a case of the paper on a device stands in, or null.
const PublishedRow* row_of_paper(const Case& what, std::int64_t vertices) {
  return is_of_paper(what) ? published_row(what.version, what.form, vertices) : nullptr;
}

}  // namespace

std::span<const PublishedTable> published_tables() {
  return printed_tables;
}

const PublishedRow* published_row(Version version, Form form, std::int64_t vertices) {
  const auto* const table = std::ranges::find_if(printed_tables, [&](const PublishedTable& candidate) {
    return candidate.version == version && candidate.form == form;
  });
  if (table == printed_tables.end()) {
    return nullptr;
  }
  const auto* const row = std::ranges::find(table->rows, vertices, &PublishedRow::vertices);
  return row == table->rows.end() ? nullptr : row;
}

std::optional<double> published_ms(const Case& what, std::int64_t vertices) {
  if (what.version == Version::serial) {
    const PublishedRow* const row = published_row(Version::gpu, what.form, vertices);  // every table repeats it
    return row == nullptr ? std::nullopt : std::optional(row->cpu_ms);
  }
  const PublishedRow* const row = row_of_paper(what, vertices);
  if (row == nullptr) {
    return std::nullopt;
  }
  return what.layout == Layout::aos ? row->aos_ms : row->soa_ms;
}

std::optional<double> published_speedup(const Case& what, std::int64_t vertices) {
  const PublishedRow* const row = row_of_paper(what, vertices);
  if (row == nullptr) {
    return std::nullopt;
  }
  return what.layout == Layout::aos ? row->aos_speedup : row->soa_speedup;
}

}  // namespace trismooth::experiments
