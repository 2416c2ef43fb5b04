// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/text/report_text.h"

#include "catch.h"

namespace trismooth::report_text_test {

TEST_CASE("sizes are written short where that is exact") {
  CHECK(size_text(4) == "4");
  CHECK(size_text(1'000) == "1K");
  CHECK(size_text(1'500) == "1.5K");
  CHECK(size_text(1'234) == "1,234");
  CHECK(size_text(50'000) == "50K");
  CHECK(size_text(1'000'000) == "1M");
  CHECK(size_text(2'500'000) == "2.5M");
  CHECK(size_text(9'999'000) == "9999K");
}

TEST_CASE("an amount of memory has the digits that matter") {
  CHECK(trismooth::bytes_text(0) == "0.00 MiB");
  CHECK(trismooth::bytes_text(262144) == "0.25 MiB");
  CHECK(trismooth::bytes_text(std::int64_t{213} << 20) == "213 MiB");
  CHECK(trismooth::bytes_text((std::int64_t{139} << 30) + (std::int64_t{1} << 29)) == "139.5 GiB");
}

}  // namespace trismooth::report_text_test
