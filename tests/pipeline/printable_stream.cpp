// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/printable_stream.h"

#include <sstream>
#include <streambuf>
#include <string>

#include "trismooth/base/text/printable_text.h"

#include "catch.h"

namespace trismooth::printable_stream_test {

const std::string mixed = "a\x1b[2J\n\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xe2\x80\xae\xff\xe2\x82 \xc2\x9b\t\xf0\x9f";

class FullDevice : public std::streambuf {};

TEST_CASE("text comes out printable, wherever the writes cut it") {
  for (std::size_t first = 0; first <= mixed.size(); ++first) {
    for (std::size_t second = first; second <= mixed.size(); ++second) {
      std::ostringstream target;
      {
        PrintableStream stream(target);
        stream << mixed.substr(0, first) << mixed.substr(first, second - first) << mixed.substr(second);
      }
      CHECK(target.str() == printable_lines(mixed));
    }
  }
  std::ostringstream target;
  {
    PrintableStream stream(target);
    for (const char byte : mixed) {
      stream.put(byte);
    }
  }
  CHECK(target.str() == printable_lines(mixed));
}

TEST_CASE("whole characters go out at once, a begun one at the latest with a flush") {
  std::ostringstream target;
  PrintableStream stream(target);
  stream << "ready " << 5 << "\n";
  CHECK(target.str() == "ready 5\n");
  stream << "\xe2";
  CHECK(target.str() == "ready 5\n");
  stream << std::flush;
  CHECK(target.str() == "ready 5\n\\xe2");
}

TEST_CASE("a stream that takes nothing is a failure of the one before it") {
  FullDevice device;
  std::ostream target(&device);
  PrintableStream stream(target);
  stream << "text" << std::flush;
  CHECK_FALSE(stream.good());
  std::ostream nowhere(nullptr);
  PrintableStream none(nowhere);
  none.flush();
  CHECK_FALSE(none.good());
}

}  // namespace trismooth::printable_stream_test
