// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <string>

#include <fmt/format.h>

#include "trismooth/paper/experiment_report.h"

namespace trismooth::experiments {

namespace {

std::string fields(const std::optional<Spread>& spread) {
  return spread ? fmt::format(",{},{},{}", spread->median, spread->least, spread->most) : ",,,";
}

std::string fields(const PublishedRow* row) {
  return row == nullptr ? ",,,,,"
                        : fmt::format(",{},{},{},{},{}", row->cpu_ms, row->aos_ms, row->soa_ms, row->aos_speedup,
                                      row->soa_speedup);
}

std::string column_names() {
  std::string names = "table,version,form,order,precision,size";
  for (const char* const column : {"serial_ms", "aos_ms", "soa_ms", "aos_speedup", "soa_speedup"}) {
    names += fmt::format(",{0},{0}_least,{0}_most", column);
  }
  return names + ",paper_serial_ms,paper_aos_ms,paper_soa_ms,paper_aos_speedup,paper_soa_speedup\n";
}

}  // namespace

std::string csv_of(const ExperimentReport& report) {
  std::string csv = column_names();
  for (const Table& table : report.tables) {
    for (const TableRow& row : table.rows) {
      csv += fmt::format("{},{},{},{},{},{}", table.number > 0 ? std::to_string(table.number) : std::string{},
                         to_string(table.version), to_string(table.form), to_string(table.order),
                         to_string(report.result.options.precision), row.vertices);
      for (const auto& spread : {row.serial_ms, row.aos_ms, row.soa_ms, row.aos_speedup, row.soa_speedup}) {
        csv += fields(spread);
      }
      csv += fields(row.published) + '\n';
    }
  }
  return csv;
}

}  // namespace trismooth::experiments
