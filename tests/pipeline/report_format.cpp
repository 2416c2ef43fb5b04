// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/report_format.h"

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::report_format_test {

using Writer = int (*)();

constexpr std::array<ReportFormat<Writer>, 3> formats{
    {{".json", [] { return 1; }}, {".csv", [] { return 2; }}, {".html", [] { return 3; }}}};

int chosen(const char* path) {
  return writer_for<Writer>(path, formats)();
}

TEST_CASE("the extension chooses the format, in any case") {
  CHECK(chosen("a.json") == 1);
  CHECK(chosen("folder.html/a.CSV") == 2);
  CHECK(chosen("a.json.Html") == 3);
}

TEST_CASE("another extension is refused with the path and all that there are") {
  for (const char* path : {"a.txt", "json", ".json", "a", ""}) {
    CAPTURE(path);
    CHECK_THROWS_WITH(chosen(path),
                      "'" + std::string(path) + "' is no report file; its name must end in .json, .csv or .html");
  }
}

TEST_CASE("a report that cannot be written leaves what was there") {
  const ScratchFolder folder;
  const auto path = folder.path() / "report.json";
  write_report_text(path, "one");
  write_report_text(path, "two");
  std::ifstream file(path);
  CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == "two");
  CHECK_THROWS_AS(write_report_text(folder.path() / "none" / "report.json", "x"), trismooth::WriteError);
}

}  // namespace trismooth::report_format_test
