// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/tables.h"

#include <array>
#include <string>
#include <vector>

#include "catch.h"
#include "sample_experiment.h"

using sample::Case;
using sample::ExperimentResult;
using sample::Form;
using sample::Layout;
using sample::Order;
using sample::Spread;
using sample::Version;
using trismooth::experiments::Table;
using trismooth::experiments::TableRow;
using trismooth::experiments::tables_of;

namespace {

void check_equal(const std::optional<Spread>& one, const std::optional<Spread>& other) {
  REQUIRE(one.has_value() == other.has_value());
  if (one) {
    CHECK(one->median == other->median);
    CHECK(one->least == other->least);
    CHECK(one->most == other->most);
  }
}

}  // namespace

TEST_CASE("the paper's four tables come first, in its order, then those beyond it") {
  const std::vector<Table> tables = tables_of(sample::experiment({1'000}, &sample::regular_time));
  std::vector<std::string> titles;
  for (const Table& table : tables) {
    titles.push_back(table.title);
  }
  CHECK(titles == std::vector<std::string>{
                      "Table 1: GPU version, Form A", "Table 2: GPU version, Form B, unordered as in the paper",
                      "Table 3: CDP version, Form A", "Table 4: CDP version, Form B, unordered as in the paper",
                      "GPU version, Form B, in colour order", "CDP version, Form B, in colour order",
                      "Resident version, Form A", "Resident version, Form B, in colour order"});
  for (std::size_t i = 0; i < tables.size(); ++i) {
    CHECK(tables[i].number == (i < 4 ? static_cast<int>(i) + 1 : 0));
  }
}

TEST_CASE("a table's cells are the measurements of its cases, and the paper's row stands beside them") {
  const ExperimentResult result = sample::experiment({1'000, 2'000, 100'000}, &sample::regular_time);
  for (const Table& table : tables_of(result)) {
    CAPTURE(table.title);
    REQUIRE(table.rows.size() == 3);
    CHECK(table.missing_reason.empty());
    for (const TableRow& row : table.rows) {
      const Case aos{table.version, table.form, table.order, Layout::aos};
      const Case soa{table.version, table.form, table.order, Layout::soa};
      check_equal(row.serial_ms, sample::regular_time(row.vertices, {Version::serial, table.form}));
      check_equal(row.aos_ms, sample::regular_time(row.vertices, aos));
      check_equal(row.soa_ms, has_layouts(table.version) ? sample::regular_time(row.vertices, soa) : std::nullopt);
      check_equal(row.aos_speedup, result.speedup(row.vertices, aos));
      check_equal(row.soa_speedup, result.speedup(row.vertices, soa));
      CHECK((row.published != nullptr) == (table.number > 0 && row.vertices != 2'000));
    }
  }
}

TEST_CASE("without a device the tables have the CPU's column and the paper's, and say what is missing") {
  for (const Table& table : tables_of(sample::experiment({1'000}, &sample::cpu_time))) {
    CHECK(table.missing_reason == "no device: for a <test>");
    CHECK(table.rows.front().serial_ms);
    CHECK_FALSE(table.rows.front().aos_ms);
    CHECK_FALSE(table.rows.front().soa_speedup);
  }
}

TEST_CASE("versions that were not asked for have no table, and without the serial version there are no speedups") {
  const std::vector<Table> tables = tables_of(sample::experiment({1'000}, &sample::regular_time, {Version::cdp}));
  REQUIRE(tables.size() == 3);
  for (const Table& table : tables) {
    CHECK(table.version == Version::cdp);
    CHECK(table.rows.front().aos_ms);
    CHECK_FALSE(table.rows.front().serial_ms);
    CHECK_FALSE(table.rows.front().aos_speedup);
  }
}
