// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <string>
#include <vector>

#include "trismooth/paper/experiment_report.h"

#include "catch.h"
#include "sample_experiment.h"

using trismooth::experiments::csv_of;
using trismooth::experiments::ExperimentReport;
using trismooth::experiments::make_report;
using trismooth::experiments::Table;
using trismooth::experiments::TableRow;

namespace {

std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back(1);
    for (const char c : line) {
      if (c == ',') {
        rows.back().emplace_back();
      } else {
        rows.back().back() += c;
      }
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("every row of every table is a line with as many cells as there are columns") {
  const ExperimentReport report = make_report(sample::experiment({1'000, 2'000}, &sample::regular_time), "", "", "");
  const auto rows = cells_of(csv_of(report));
  REQUIRE(rows.size() == 1 + 8 * 2);
  for (const auto& row : rows) {
    CHECK(row.size() == rows.front().size());
  }
  std::size_t line = 1;
  for (const Table& table : report.tables) {
    for (const TableRow& row : table.rows) {
      const auto& cells = rows[line++];
      CHECK(cells[0] == (table.number > 0 ? std::to_string(table.number) : ""));
      CHECK(cells[1] == trismooth::to_string(table.version));
      CHECK(cells[2] == trismooth::to_string(table.form));
      CHECK(cells[3] == trismooth::to_string(table.order));
      CHECK(cells[4] == "single");
      CHECK(std::stoll(cells[5]) == row.vertices);
      CHECK(std::stod(cells[6]) == row.serial_ms->median);
      CHECK(std::stod(cells[10]) == row.aos_ms->least);
      CHECK(std::stod(cells[15]) == row.aos_speedup->median);
      const bool has_soa = has_layouts(table.version);
      REQUIRE(row.soa_ms.has_value() == has_soa);
      CHECK((has_soa ? std::stod(cells[14]) == row.soa_ms->most : cells[14].empty()));
      CHECK((has_soa ? std::stod(cells[18]) == row.soa_speedup->median : cells[18].empty()));
      CHECK(cells[21].empty() == (row.published == nullptr));
      CHECK(cells[25].empty() == (row.published == nullptr));
    }
  }
  CHECK(rows[1][21] == "218");
  CHECK(rows[1][25] == "11.6");
}

TEST_CASE("the columns are named") {
  const auto names = cells_of(csv_of(make_report(sample::experiment({1'000}, &sample::cpu_time), "", "", ""))).front();
  CHECK(names[5] == "size");
  CHECK(names[10] == "aos_ms_least");
  CHECK(names[20] == "soa_speedup_most");
  CHECK(names[25] == "paper_soa_speedup");
}

TEST_CASE("what was not measured is empty") {
  const auto rows = cells_of(csv_of(make_report(sample::experiment({1'000}, &sample::cpu_time), "", "", "")));
  CHECK_FALSE(rows[1][6].empty());
  for (std::size_t column = 9; column < 21; ++column) {
    CHECK(rows[1][column].empty());
  }
}
