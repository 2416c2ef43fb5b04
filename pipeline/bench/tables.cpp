#include "trismooth/pipeline/bench/tables.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "trismooth/quality/report_text.h"

namespace trismooth::bench {

namespace {

std::optional<Spread> smoothing_ms(const ExperimentResult& result, std::int64_t vertices, const Case& what) {
  const Measurement* const measured = result.find(vertices, what);
  return measured == nullptr ? std::nullopt : std::optional(measured->smoothing);
}

std::string title_of(const Table& table) {
  std::string title = table.number > 0 ? fmt::format("Table {}: ", table.number) : std::string{};
  title += fmt::format("{}, Form {}", name_of(table.version), table.form == Form::swap ? "A" : "B");
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
      reason = row.missing;
    }
  }
  return reason;
}

Table table_of(const ExperimentResult& result, int number, Version version, Form form, Order order) {
  Table table{number, {}, version, form, order, {}, {}};
  table.title = title_of(table);
  table.missing = missing_in(result, table);
  const Case aos{version, form, order, Layout::aos};
  const Case soa{version, form, order, Layout::soa};
  for (const std::int64_t size : result.options.sizes) {
    table.rows.push_back({size, smoothing_ms(result, size, {Version::serial, form}), smoothing_ms(result, size, aos),
                          smoothing_ms(result, size, soa), result.speedup(size, aos), result.speedup(size, soa),
                          number > 0 ? published_row(version, form, size) : nullptr});
  }
  return table;
}

}  // namespace

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

std::string size_text(std::int64_t vertices) {
  constexpr std::int64_t thousand = 1'000;
  constexpr std::int64_t million = thousand * thousand;
  if (vertices >= million && vertices % (million / 10) == 0) {
    return fmt::format("{}M", static_cast<double>(vertices) / million);
  }
  if (vertices >= thousand && vertices % (thousand / 10) == 0) {
    return fmt::format("{}K", static_cast<double>(vertices) / thousand);
  }
  return count_text(vertices);
}

std::string runs_text(int runs) {
  return fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

std::string sweeps_text(const Spread& sweeps) {
  return sweeps.least == sweeps.most ? fmt::format("{:.0f}", sweeps.median)
                                     : fmt::format("{:.0f} ({:.0f}-{:.0f})", sweeps.median, sweeps.least, sweeps.most);
}

}  // namespace trismooth::bench
