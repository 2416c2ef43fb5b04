#include "trismooth/pipeline/terminal_line.h"

#include <chrono>
#include <sstream>
#include <string>

#include "catch.h"

using trismooth::TerminalLine;
using namespace std::chrono_literals;

namespace {

const std::string erase_line = "\r\x1b[K";

}  // namespace

TEST_CASE("a line is drawn over the last one, with the seconds since the beginning") {
  std::ostringstream terminal;
  TerminalLine::Clock::time_point now{};
  TerminalLine line(terminal, [&now] { return now; });
  line.draw("one");
  now += 2500ms;
  line.draw("two");
  CHECK(terminal.str() == erase_line + "one, 0.0 s" + erase_line + "two, 2.5 s");
}

TEST_CASE("what happens often is drawn ten times a second at most, and at first at once") {
  std::ostringstream terminal;
  TerminalLine::Clock::time_point now{};
  TerminalLine line(terminal, [&now] { return now; });
  line.draw_now_and_then("a");
  now += 99ms;
  line.draw_now_and_then("b");
  now += 1ms;
  line.draw_now_and_then("c");
  CHECK(terminal.str() == erase_line + "a, 0.0 s" + erase_line + "c, 0.1 s");
}

TEST_CASE("a line of a terminal is erased at the end, and only if one was drawn") {
  std::ostringstream terminal;
  { const TerminalLine line(terminal); }
  CHECK(terminal.str().empty());
  {
    TerminalLine line(terminal);
    line.draw("text");
    terminal.str("");
  }
  CHECK(terminal.str() == erase_line);
}
