// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/tables.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace trismooth::experiments {

namespace {

std::string title_of(const Table& table) {
  std::string title = table.number > 0 ? fmt::format("Table {}: ", table.number) : std::string{};
  title += fmt::format("{}, Form {}", name_of(table.version), letter_of(table.form));
  if (table.order == Order::unordered) {
    title += ", unordered as in the paper";
  } else if (table.form == Form::in_place) {
    title += ", in colour order";
  }
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  return title;
}

std::string missing_in(const ExperimentResult& result, const Table& table) {
  std::string reason;
  for (const Row& row : result.rows) {
    if (row.what.version == table.version && row.what.form == table.form && row.what.order == table.order) {
      if (row.measured) {
        return {};
      }
      reason = row.missing_reason;
    }
  }
  return reason;
}

Table table_of(const ExperimentResult& result, int number, Version version, Form form, Order order) {
  Table table{number, {}, version, form, order, {}, {}};
  table.title = title_of(table);
  table.missing_reason = missing_in(result, table);
  const Case aos{version, form, order, Layout::aos};
  const Case soa{version, form, order, Layout::soa};
  for (const std::int64_t size : result.options.sizes) {
    table.rows.push_back({size, result.smoothing_ms(size, {Version::serial, form}), result.smoothing_ms(size, aos),
                          result.smoothing_ms(size, soa), result.speedup(size, aos), result.speedup(size, soa),
                          number > 0 ? published_row(version, form, size) : nullptr});
  }
  return table;
}

}  // namespace

bool any_measured_on(const ExperimentResult& result, const MeshCounts& mesh) {
  return std::ranges::any_of(result.rows, [&](const Row& row) { return row.vertices == mesh.asked && row.measured; });
}

std::vector<Table> tables_of(const ExperimentResult& result) {
  std::vector<Table> tables;
  const auto add = [&](int number, Version version, Form form, Order order) {
    if (std::ranges::find(result.options.versions, version) != result.options.versions.end()) {
      tables.push_back(table_of(result, number, version, form, order));
    }
  };
  for (const PublishedTable& table : published_tables()) {
    add(table.number, table.version, table.form, order_of_paper(table.version, table.form));
  }
  add(0, Version::gpu, Form::in_place, Order::colour);
  add(0, Version::cdp, Form::in_place, Order::colour);
  add(0, Version::resident, Form::swap, Order::colour);
  add(0, Version::resident, Form::in_place, Order::colour);
  return tables;
}

}  // namespace trismooth::experiments
