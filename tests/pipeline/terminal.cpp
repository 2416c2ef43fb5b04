// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include "catch.h"

namespace trismooth::terminal_test {

TEST_CASE("what is no terminal has the width of printed lines") {
  const int descriptor = ::open("/dev/null", O_WRONLY);
  REQUIRE(descriptor >= 0);
  CHECK(trismooth::terminal_columns(descriptor) == 80);
  ::close(descriptor);
  CHECK(trismooth::terminal_columns(-1) == 80);
}

}  // namespace trismooth::terminal_test
