// SPDX-License-Identifier: BSD-3-Clause
// What the command line says, and where.

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/version.h"

#include "catch.h"
#include "command_line_calls.h"
#include "sample_run.h"
#include "support/scratch_folder.h"

namespace command_line_output_test {

using namespace command_line_calls;
using trismooth::PipelineOptions;
using trismooth::PipelineResult;
using trismooth::Progress;
using trismooth::Stage;

TEST_CASE("quiet leaves errors and failed gates only") {
  const Outcome fine = smooth({"--quiet"});
  CHECK(fine.code == 0);
  CHECK(fine.out.empty());
  CHECK(fine.err.empty());
  const Outcome failed = smooth({"--quiet", "--require", "min_shape>=0.5"});
  CHECK(failed.code == 1);
  CHECK(failed.out.empty());
  CHECK(failed.err == "gate failed: min_shape >= 0.5, is 0.35\n");
}

TEST_CASE("notes go to standard error, a long list is cut unless --verbose asks for it") {
  const auto with_notes = [](std::size_t count) {
    return [count](const PipelineOptions&) {
      PipelineResult result = sample::result();
      result.notes.assign(count, "something to know");
      return result;
    };
  };
  const auto notes_in = [](const Outcome& outcome) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = outcome.err.find("trismooth: note: something to know\n", at)) != std::string::npos;
         ++at) {
      ++count;
    }
    return count;
  };
  CHECK(notes_in(call({"smooth", "a.vtk", "b.vtk"}, with_notes(3))) == 3);
  const Outcome cut = call({"smooth", "a.vtk", "b.vtk"}, with_notes(40));
  CHECK(notes_in(cut) == 5);
  CHECK(cut.says("35 more notes; --verbose shows them"));
  CHECK(notes_in(call({"smooth", "a.vtk", "b.vtk", "--verbose"}, with_notes(40))) == 40);
}

TEST_CASE("what is lost is said in full, however much it is and whatever else is to be said") {
  const auto lossy = [](const PipelineOptions&) {
    PipelineResult result = sample::result();
    result.notes.assign(40, "something to know");
    for (int i = 0; i < 30; ++i) {
      result.losses.push_back("array " + std::to_string(i) + " is not written");
    }
    return result;
  };
  const Outcome outcome = call({"smooth", "a.vtk", "b.off"}, lossy);
  for (int i = 0; i < 30; ++i) {
    CHECK(outcome.says("trismooth: note: array " + std::to_string(i) + " is not written\n"));
  }
  CHECK(outcome.says("35 more notes; --verbose shows them"));
  CHECK(call({"smooth", "a.vtk", "b.off", "--quiet"}, lossy).err.empty());
}

TEST_CASE("verbose records the smallest shape and prints every sweep and the times") {
  const Outcome outcome = call({"smooth", "a.vtk", "b.vtk", "--verbose"}, [](const PipelineOptions& options) {
    CHECK(options.smoothing.record_min_shape);
    CHECK(options.smoothing.progress({7, 100, 50, 0.125, 0.25}) == Progress::proceed);
    return sample::result();
  });
  CHECK(outcome.says("sweep 7: 100 evaluated, 50 moved, largest move 0.125 edges, smallest shape 0.25\n"));
  CHECK(outcome.says("times: read 1.50 ms"));
  CHECK(outcome.says("total 50 ms"));
}

TEST_CASE("progress is drawn on a terminal only, and not where quiet or verbose") {
  const Run run = [](const PipelineOptions& options) {
    options.stage_started(Stage::smooth);
    return sample::result();
  };
  const auto draws = [&](const Words& words, bool terminal) {
    return call(words, run, terminal).says("smoothing ...");
  };
  CHECK(draws({"smooth", "a.vtk", "b.vtk"}, true));
  CHECK_FALSE(draws({"smooth", "a.vtk", "b.vtk"}, false));
  CHECK_FALSE(draws({"smooth", "a.vtk", "b.vtk", "--quiet"}, true));
  CHECK_FALSE(draws({"smooth", "a.vtk", "b.vtk", "--verbose"}, true));
}

TEST_CASE("the progress line is gone before an error is printed") {
  const Outcome outcome = call(
      {"smooth", "a.vtk", "b.vtk"},
      [](const PipelineOptions& options) -> PipelineResult {
        options.stage_started(Stage::read);
        throw trismooth::ReadError("a.vtk", "is empty");
      },
      true);
  CHECK(outcome.says("\r\x1b[Ktrismooth: error: a.vtk: is empty\n"));
}

TEST_CASE("help and version go to standard output and run nothing") {
  const Outcome help = call({"--help"});
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  for (const char* words : {"smooth ", "quality ", "generate ", "bench ", "info ", "Examples:", "Exit codes:"}) {
    CAPTURE(words);
    CHECK(help.shows(words));
  }

  const Outcome version = call({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out == "trismooth " + std::string(trismooth::version()) + "\n");
}

TEST_CASE("help of a command describes each of its options, within 80 columns") {
  const Outcome help = call({"smooth", "--help"});
  CHECK(help.code == 0);
  for (const char* option :
       {"--method",         "--form",    "--layout",       "--backend",     "--execution", "--order",
        "--topology",       "--guard",   "--precision",    "--max-sweeps",  "--tolerance", "--time-limit",
        "--target-quality", "--threads", "--region-array", "--fixed-array", "--fixed-ids", "--report",
        "--annotate",       "--require", "--quiet",        "--verbose"}) {
    CAPTURE(option);
    CHECK((help.shows("  " + std::string(option)) || help.shows(", " + std::string(option))));
  }
  CHECK(help.out.find("\n\n\n") == std::string::npos);
  for (const Words& words : {Words{"--help"}, Words{"smooth", "--help"}, Words{"quality", "--help"},
                             Words{"generate", "--help"}, Words{"bench", "--help"}, Words{"info", "--help"}}) {
    std::istringstream lines(call(words).out);
    for (std::string line; std::getline(lines, line);) {
      CAPTURE(line);
      CHECK(line.size() <= 80);
    }
  }
}

TEST_CASE("smooth says in a few lines whether the mesh got better, and with --verbose everything") {
  const Outcome brief = smooth({});
  const Outcome verbose = smooth({"--verbose"});
  CHECK(std::ranges::count(brief.out, '\n') < 20);
  for (const char* word :
       {"input:", "smoothing:", "result:", "shape", "min_angle", "max_angle", "inverted", "written:"}) {
    CAPTURE(word);
    CHECK(brief.shows(word));
    CHECK(verbose.shows(word));
  }
  for (const char* word : {"aspect_ratio", "equiangle_skew", "centroid", "0.95 to 1.00", "stopped"}) {
    CAPTURE(word);
    CHECK(brief.shows(word) == (word == std::string("stopped")));
    CHECK(verbose.shows(word));
  }
}

TEST_CASE("nothing that comes from outside steers the terminal, whatever says it") {
  const std::string evil = "e\x1b[2J\nwritten: \r\xc2\x9b\xe2\x80\xae\xff";
  const auto check = [](const Outcome& outcome) {
    CAPTURE(outcome.out, outcome.err);
    for (const std::string& text : {outcome.out, outcome.err}) {
      CHECK(std::ranges::none_of(text, [](unsigned char c) { return (c < 0x20 && c != '\n') || c >= 0x7f; }));
      CHECK(text.find("\nwritten: \\") == std::string::npos);
    }
    CHECK((outcome.out + outcome.err).find("e\\x1b[2J\\x0awritten: \\x0d\\u009b\\u202e\\xff") != std::string::npos);
  };
  const Run run = [&](const PipelineOptions& options) {
    PipelineResult result = sample::result();
    result.input.path = options.input;
    result.input.region_array = evil;
    result.notes = {evil};
    result.warnings = {evil};
    options.warned(evil);
    result.smoothing->backend_note = evil;
    return result;
  };
  check(call({"smooth", evil, evil}, run));
  check(call({"smooth", evil, evil, "--verbose", "--fixed-array", evil, "--fixed-ids", evil}, run));
  check(call({evil}));
  check(call({"--" + evil}));
  check(call({"smooth", "a", "b", evil}));
  check(call({"smooth", "a", "b", "--" + evil}));
  for (const char* option : {"--method", "--threads", "--tolerance", "--report", "--require"}) {
    check(call({"smooth", "a", "b", option, evil}));
  }
  check(call({"bench", "--sizes", evil}));
  check(call({"generate", "x.off", "--vertices", evil}));
  check(call_failing_with(trismooth::ReadError(evil, 17, evil)));
  check(call_failing_with(trismooth::MeshError(evil)));
  check(call_failing_with(trismooth::WriteError(evil, evil)));
  check(call_failing_with(trismooth::DeviceError(evil)));
  check(call_failing_with(std::invalid_argument(evil)));
  check(call_failing_with(std::runtime_error(evil)));
}

TEST_CASE("a file of vertex numbers that names none is a warning, for it holds nothing") {
  const ScratchFolder folder;
  const std::string mesh = (folder / "mesh.off").string();
  REQUIRE(call({"generate", mesh, "--vertices", "50", "--boundary", "resolved"}).code == 0);
  const std::string ids = folder.write("ids.txt", "# none yet\n").string();
  const std::string warning = "trismooth: warning: " + ids + ": names no vertices, so it holds none\n";
  CHECK(call({"smooth", mesh, mesh, "--fixed-ids", ids}, &trismooth::run_pipeline).err == warning);
  CHECK(call({"quality", mesh, "--fixed-ids", ids}, &trismooth::run_pipeline).err == warning);
}

TEST_CASE("a standard output that takes nothing is answered with 4") {
  std::ostringstream err;
  std::ostream broken(nullptr);
  const char* const arguments[] = {"trismooth", "info"};
  CHECK(trismooth::run_command_line(2, arguments, {broken, err}) == 4);
  CHECK(err.str() == "trismooth: error: standard output: cannot be written\n");
}

}  // namespace command_line_output_test
