// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/terminal_line.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <sstream>
#include <string>
#include <thread>

#include "catch.h"

namespace trismooth::terminal_line_test {

using namespace std::chrono_literals;

const std::string erase_line = "\r\x1b[K";

TEST_CASE("a line is drawn over the last one, with the seconds since the beginning") {
  std::ostringstream terminal;
  TerminalLine::Clock::time_point now{};
  TerminalLine line({&terminal}, [&now] { return now; });
  line.draw({"one"});
  now += 2500ms;
  line.draw({"t", "wo"});
  CHECK(terminal.str() == erase_line + "one, 0.0 s" + erase_line + "two, 2.5 s");
}

TEST_CASE("what happens often is drawn ten times a second at most, and at first at once") {
  std::ostringstream terminal;
  TerminalLine::Clock::time_point now{};
  TerminalLine line({&terminal}, [&now] { return now; });
  line.draw_now_and_then({"a"});
  now += 99ms;
  line.draw_now_and_then({"b"});
  now += 1ms;
  line.draw_now_and_then({"c"});
  CHECK(terminal.str() == erase_line + "a, 0.0 s" + erase_line + "c, 0.1 s");
}

TEST_CASE("a line of a terminal is erased at the end, and only if one was drawn") {
  std::ostringstream terminal;
  const auto now = [] { return TerminalLine::Clock::time_point{}; };
  { const TerminalLine line({&terminal}, now); }
  CHECK(terminal.str().empty());
  {
    TerminalLine line({&terminal}, now);
    line.draw({"text"});
    terminal.str("");
  }
  CHECK(terminal.str() == erase_line);
}

TEST_CASE("a tick draws what stands there with the time of now, and the latest of what happened in between") {
  std::ostringstream terminal;
  TerminalLine::Clock::time_point now{};
  TerminalLine line({&terminal}, [&now] { return now; });
  line.tick();
  CHECK(terminal.str().empty());
  line.draw({"one"});
  line.draw_now_and_then({"two"});
  terminal.str("");
  now += 3s;
  line.tick();
  CHECK(terminal.str() == erase_line + "two, 3.0 s");
  line.erase();
  terminal.str("");
  line.tick();
  CHECK(terminal.str().empty());
}

TEST_CASE("a line fits a terminal of any width, and says most where there is room") {
  std::ostringstream terminal;
  std::size_t columns = 0;
  TerminalLine line({&terminal, [&columns] { return columns; }}, [] { return TerminalLine::Clock::time_point{}; });
  const auto drawn_in = [&](std::size_t width) {
    columns = width;
    terminal.str("");
    line.tick();
    return terminal.str().substr(erase_line.size());
  };
  line.draw({"smoothing", ": sweep 12", " of at most 1000", ", 3456 vertices moved"});
  CHECK(drawn_in(200) == "smoothing: sweep 12 of at most 1000, 3456 vertices moved, 0.0 s");
  CHECK(drawn_in(64) == "smoothing: sweep 12 of at most 1000, 3456 vertices moved, 0.0 s");
  CHECK(drawn_in(63) == "smoothing: sweep 12 of at most 1000, 0.0 s");
  CHECK(drawn_in(40) == "smoothing: sweep 12, 0.0 s");
  CHECK(drawn_in(20) == "smoothing, 0.0 s");
  CHECK(drawn_in(16) == "smoothing");
  CHECK(drawn_in(8) == "smoot..");
  line.draw({"checking the quality", " ..."});
  CHECK(drawn_in(20) == "checking t.., 0.0 s");
  for (std::size_t width = 0; width <= 100; ++width) {
    CAPTURE(width);
    CHECK(drawn_in(width).size() < std::max<std::size_t>(width, 2));
  }
}

TEST_CASE("the clock of a line runs by itself while other threads draw") {
  std::ostringstream terminal;
  std::atomic<int> draws{0};
  {
    TerminalLine line({&terminal, [&draws] { return ++draws, std::size_t{80}; }});
    line.draw({"working"});
    for (int i = 0; i < 1000; ++i) {
      line.draw_now_and_then({"working", " on"});
    }
    while (draws < 3) {  // two more than were asked for
      std::this_thread::sleep_for(1ms);
    }
  }
  const std::string text = terminal.str();
  CHECK(text.starts_with(erase_line + "working, 0."));
  CHECK(text.find(erase_line + "working on, 0.") != std::string::npos);
  CHECK(text.ends_with(" s" + erase_line));
}

}  // namespace trismooth::terminal_line_test
