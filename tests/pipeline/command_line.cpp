#include "trismooth/pipeline/cli/command_line.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/backend_choice.h"
#include "trismooth/pipeline/version.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "sample_run.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"

using trismooth::CudaSupport;
using trismooth::PipelineOptions;
using trismooth::PipelineResult;
using trismooth::Progress;
using trismooth::Stage;

namespace {

using Words = std::vector<std::string>;
using Run = std::function<PipelineResult(const PipelineOptions&)>;

/// What a command line did.
struct Outcome {
  int code = 0;
  std::string out;
  std::string err;
  std::optional<PipelineOptions> options;  ///< what the pipeline was run with, if it was

  bool says(const std::string& words) const { return err.find(words) != std::string::npos; }
  /// Wherever lines are broken: names of scratch files may be long.
  bool shows(const std::string& words) const {
    std::string text = out;
    const std::string line_break = "\n            ";
    for (std::size_t at = text.find(line_break); at != std::string::npos; at = text.find(line_break, at)) {
      text.replace(at, line_break.size(), " ");
    }
    return text.find(words) != std::string::npos;
  }
};

/// Calls the command line with a pipeline that answers `run`, as in a build without CUDA unless `cuda` is another.
Outcome call(Words words, const Run& run, bool terminal = false, const CudaSupport& cuda = {}) {
  words.insert(words.begin(), "trismooth");
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  Outcome outcome;
  std::ostringstream out;
  std::ostringstream err;
  const auto recorded = [&](const PipelineOptions& options) {
    outcome.options = options;
    return run(options);
  };
  outcome.code = trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(),
                                             {out, err, {terminal ? &err : nullptr}, recorded, [&] { return cuda; }});
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

Outcome call(const Words& words) {
  return call(words, [](const PipelineOptions& options) {
    return options.output ? sample::result() : sample::quality_result();
  });
}

Outcome smooth(Words more) {
  more.insert(more.begin(), {"smooth", "plate.vtk", "out.vtk"});
  return call(more);
}

/// A build with CUDA on a machine where `problem` says why there is no device, or where there is one.
CudaSupport cuda_with(const fakes::FakeBackend& backend, const std::string& problem) {
  return {&backend, false, [problem] { return problem; }, [] { return "CUDA:       lines of a test\n"; }};
}

template <class Error>
Outcome call_failing_with(const Error& error) {
  return call({"smooth", "plate.vtk", "out.vtk"}, [&](const PipelineOptions&) -> PipelineResult { throw error; });
}

}  // namespace

TEST_CASE("without options, smooth uses the documented defaults") {
  const Outcome outcome = smooth({});
  REQUIRE(outcome.code == 0);
  const PipelineOptions& options = *outcome.options;
  CHECK(options.input == "plate.vtk");
  CHECK(options.output == std::filesystem::path("out.vtk"));
  CHECK(options.smoothing.method == trismooth::Method::smart);
  CHECK(options.smoothing.form == trismooth::Form::in_place);
  CHECK(options.smoothing.precision == trismooth::Precision::double_precision);
  CHECK(options.smoothing.guard);
  CHECK(options.smoothing.max_sweeps == 1000);
  CHECK(options.smoothing.tolerance == 1e-6);
  CHECK_FALSE(options.smoothing.target_quality);
  CHECK_FALSE(options.smoothing.record_min_shape);
  CHECK_FALSE(options.annotate);
  CHECK(options.region_arrays.empty());
}

TEST_CASE("every option of smooth reaches the pipeline") {
  const Outcome outcome = smooth({"--method",         "weighted",     "--form",        "a",
                                  "--layout",         "soa",          "--backend",     "cpu",
                                  "--execution",      "single-block", "--order",       "colour",
                                  "--topology",       "device",       "--guard",       "off",
                                  "--precision",      "single",       "--max-sweeps",  "0",
                                  "--tolerance",      "2.5e-3",       "--time-limit",  "7.5",
                                  "--target-quality", "0.25",         "--threads",     "3",
                                  "--region-array",   "material",     "--fixed-array", "anchors",
                                  "--fixed-ids",      "ids.txt",      "--annotate"});
  REQUIRE(outcome.code == 0);
  const PipelineOptions& options = *outcome.options;
  CHECK(options.smoothing.method == trismooth::Method::weighted);
  CHECK(options.smoothing.form == trismooth::Form::swap);
  CHECK(options.smoothing.layout == trismooth::Layout::soa);
  CHECK(options.smoothing.execution == trismooth::Execution::single_block);
  CHECK(options.smoothing.order == trismooth::Order::colour);
  CHECK(options.smoothing.topology == trismooth::Topology::device);
  CHECK(options.smoothing.precision == trismooth::Precision::single_precision);
  CHECK_FALSE(options.smoothing.guard);
  CHECK(options.smoothing.max_sweeps == 0);
  CHECK(options.smoothing.tolerance == 2.5e-3);
  CHECK(options.smoothing.time_limit_seconds == 7.5);
  CHECK(options.smoothing.target_quality == 0.25);
  CHECK(options.smoothing.record_min_shape);
  CHECK(options.smoothing.threads == 3);
  CHECK(options.region_arrays == std::vector<std::string>{"material"});
  CHECK(options.fixed_array == "anchors");
  CHECK(options.fixed_ids == std::filesystem::path("ids.txt"));
  CHECK(options.annotate);
}

TEST_CASE("options may stand before, between and after the files") {
  const Outcome outcome =
      call({"smooth", "--require", "inverted==0", "plate.vtk", "--form=a", "out.vtk", "--annotate"});
  REQUIRE(outcome.code == 0);
  CHECK(outcome.options->input == "plate.vtk");
  CHECK(outcome.options->output == std::filesystem::path("out.vtk"));
  CHECK(outcome.options->smoothing.form == trismooth::Form::swap);
}

TEST_CASE("quality runs the pipeline without an output") {
  const Outcome outcome = call({"quality", "plate.vtk", "--region-array", "material", "--threads", "2"});
  REQUIRE(outcome.code == 0);
  CHECK(outcome.options->input == "plate.vtk");
  CHECK_FALSE(outcome.options->output.has_value());
  CHECK(outcome.options->region_arrays == std::vector<std::string>{"material"});
  CHECK(outcome.shows("120 vertices"));
  CHECK(outcome.shows("equiangle_skew"));
}

TEST_CASE("wrong usage is answered with 2, a reason and nothing run") {
  struct Case {
    Words words;
    std::string reason;
  };
  const std::vector<Case> cases{
      {{}, "no command given"},
      {{"smoothe"}, "unknown command 'smoothe' (did you mean 'smooth'?); 'trismooth --help'"},
      {{"plate.off", "--quiet"}, "unknown command 'plate.off'; "},
      {{"--vresion"}, "unknown option '--vresion' (did you mean '--version'?)"},
      {{"bench", "--sizes", "1Q"}, "--sizes"},
      {{"smooth"}, "INPUT is required"},
      {{"smooth", "a.off"}, "OUTPUT is required"},
      {{"smooth", "a.off", "b.off", "c.off"}, "c.off"},
      {{"smooth", "a.off", "b.off", "--frm", "a"}, "unknown option '--frm' (did you mean '--form'?)"},
      {{"smooth", "--frm=a", "a.off", "b.off"}, "unknown option '--frm=a' (did you mean '--form'?)"},
      {{"smooth", "a.off", "--max-sweep", "9", "b.off"}, "'--max-sweep' (did you mean '--max-sweeps'?)"},
      {{"smooth", "a.off", "--wibble"}, "unknown option '--wibble'; "},
      {{"smooth", "a.off", "b.off", "c", "d", "e"}, "unexpected arguments 'c', 'd', 'e'; "},
      {{"smooth", "a.off", "b.off", "c"}, "unexpected argument 'c'; "},
      {{"smooth", "a.off", "b.off", "--method", "laplcian"}, "weighted (did you mean 'laplacian'?)"},
      {{"smooth", "a.off", "b.off", "--require", "min_shap>=1"}, "(did you mean 'min_shape'?)"},
      {{"bench", "--versions", "cpu,serail"}, "(did you mean 'serial'?)"},
      {{"smooth", "a.off", "b.off", "--form"}, "--form"},
      {{"smooth", "a.off", "b.off", "--form", "a", "--form", "b"}, "--form: expected one value, and to be given once"},
      {{"smooth", "a.off", "b.off", "--form", "c"}, "unknown form 'c'; valid are a, b"},
      {{"smooth", "a.off", "b.off", "--method", "x"}, "valid are smart, laplacian, weighted"},
      {{"smooth", "a.off", "b.off", "--layout", "x"}, "valid are aos, soa"},
      {{"smooth", "a.off", "b.off", "--backend", "x"}, "valid are auto, cpu, cuda"},
      {{"smooth", "a.off", "b.off", "--execution", "x"}, "valid are resident, single-block, cdp"},
      {{"smooth", "a.off", "b.off", "--order", "x"}, "valid are colour, unordered"},
      {{"smooth", "a.off", "b.off", "--topology", "x"}, "valid are halfedge, device"},
      {{"smooth", "a.off", "b.off", "--guard", "x"}, "valid are on, off"},
      {{"smooth", "a.off", "b.off", "--precision", "x"}, "valid are double, single"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "-1"}, "--max-sweeps"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "10x"}, "'10x'"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "9223372036854775808"}, "--max-sweeps"},
      {{"smooth", "a.off", "b.off", "--tolerance", "1,5"}, "expected a number, got '1,5'"},
      {{"smooth", "a.off", "b.off", "--tolerance", "nan"}, "--tolerance"},
      {{"smooth", "a.off", "b.off", "--tolerance", "-1"}, "tolerance"},
      {{"smooth", "a.off", "b.off", "--time-limit", "-1"}, "time limit"},
      {{"smooth", "a.off", "b.off", "--target-quality", "2"}, "quality target"},
      {{"smooth", "a.off", "b.off", "--threads", "-1"}, "--threads"},
      {{"smooth", "a.off", "b.off", "--threads", "4294967297"}, "--threads"},
      {{"smooth", "a.off", "b.off", "--report", "r.txt"}, "must end in .json or .html"},
      {{"smooth", "a.off", "b.off", "--require", "shape>=1"}, "unknown metric 'shape'"},
      {{"smooth", "a.off", "b.off", "--quiet", "--verbose"}, "--quiet excludes --verbose"},
      {{"smooth", "a.off", "b.off", "--verbose", "--quiet"}, "--quiet excludes --verbose"},
      {{"smooth", "a.off", "b.off", "--order", "unordered"}, "unordered"},
      {{"smooth", "a.off", "b.off", "--order", "unordered", "--execution", "cdp"}, "CUDA"},
      {{"quality"}, "INPUT is required"},
      {{"quality", "a.off", "--form", "a"}, "--form"},
      {{"generate", "a.off"}, "--vertices is required"},
      {{"generate", "a.off", "--vertces", "3"}, "unknown option '--vertces' (did you mean '--vertices'?)"},
      {{"generate", "a.off", "--vertices", "3"}, "from 4 to"},
      {{"generate", "a.off", "--vertices", "1Q"}, "with K or M for thousands or millions, got '1Q'"},
      {{"generate", "a.off", "--vertices", "1e3"}, "'1e3'"},
      {{"generate", "a.off", "--vertices", "10", "--seed", "-1"}, "--seed"},
      {{"info", "x"}, "x"},
  };
  for (const Case& wrong : cases) {
    const Outcome outcome = call(wrong.words);
    CAPTURE(wrong.words, outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.says("trismooth: error: "));
    CHECK(outcome.says(wrong.reason));
    CHECK(outcome.out.empty());
    CHECK_FALSE(outcome.options.has_value());
  }
}

TEST_CASE("CUDA that cannot be had is answered with 5 and what to do, before anything is read") {
  const Outcome not_built = smooth({"--backend", "cuda"});
  CHECK(not_built.code == 5);
  CHECK(not_built.says("this build has no CUDA backend"));
  CHECK(not_built.says("leave out '--backend cuda'"));
  CHECK_FALSE(not_built.options.has_value());

  const fakes::FakeBackend backend;
  const auto call_on = [&](const std::string& problem, const Words& more) {
    Words words{"smooth", "plate.vtk", "out.vtk"};
    words.insert(words.end(), more.begin(), more.end());
    return call(
        words, [](const PipelineOptions&) { return sample::result(); }, false, cuda_with(backend, problem));
  };
  const std::string no_device = "cudaErrorNoDevice (no CUDA-capable device is detected)";
  const Outcome missing = call_on(no_device, {"--backend", "cuda"});
  CHECK(missing.code == 5);
  CHECK(missing.err == "trismooth: error: no CUDA device to smooth on: " + no_device +
                           "; use '--backend cpu', or see what 'trismooth info' finds\n");
  CHECK_FALSE(missing.options.has_value());
  CHECK(call_on("", {"--backend", "cuda", "--execution", "cdp"}).code == 5);
  CHECK(call_on(no_device, {"--order", "unordered", "--execution", "single-block"}).code == 5);
  CHECK(call_on("", {"--order", "unordered", "--execution", "single-block", "--backend", "cpu"}).code == 2);

  CHECK(call_on(no_device, {}).code == 0);
  CHECK(call_on("", {"--backend", "cpu"}).options->smoothing.backend == nullptr);
  CHECK(call_on("", {"--backend", "cuda"}).options->smoothing.backend == &backend);
  CHECK(call_on("", {"--order", "unordered", "--execution", "single-block"}).options->smoothing.backend == &backend);
}

TEST_CASE("where neither input nor output is of a known format, both are told, as a fault of the input") {
  const Outcome both = call({"smooth", "missing.xyz", "out.abc"}, &trismooth::run_pipeline);
  CHECK(both.code == 3);
  CHECK(
      both.says("missing.xyz: the extension '.xyz' names no format, nor does that of the output, out.abc; known are "
                ".off"));
  const Outcome input = call({"smooth", "missing.xyz", "out.vtu"}, &trismooth::run_pipeline);
  CHECK(input.code == 3);
  CHECK(input.says("missing.xyz: the extension '.xyz' names no format; known are .off"));
  const Outcome checked = call({"quality", "missing.vtu.gz"}, &trismooth::run_pipeline);
  CHECK(checked.code == 3);
  CHECK(checked.says("missing.vtu.gz: is compressed (gzip); decompress it first"));
  const Outcome compressed = call({"smooth", "missing.gz", "out.vtu.xz"}, &trismooth::run_pipeline);
  CHECK(compressed.code == 3);
  CHECK(compressed.says("missing.gz: is compressed (gzip)"));
  const Outcome output = call({"smooth", "missing.off", "out.off.gz"}, &trismooth::run_pipeline);
  CHECK(output.code == 4);
  CHECK(output.says("out.off.gz: nothing is written compressed; leave out '.gz'"));
}

TEST_CASE("an output of no known format is told before the work") {
  const Outcome outcome = call({"smooth", "missing.vtk", "out.xyz"}, &trismooth::run_pipeline);
  CHECK(outcome.code == 4);
  CHECK(outcome.says("out.xyz: the extension '.xyz' names no format; known are .off"));
}

TEST_CASE("each kind of failure has its exit code and one line of message") {
  const auto check = [](const Outcome& outcome, int code, const std::string& message) {
    CAPTURE(outcome.err);
    CHECK(outcome.code == code);
    CHECK(outcome.err == "trismooth: error: " + message + "\n");
    CHECK(outcome.out.empty());
  };
  check(call_failing_with(std::invalid_argument("no array 'x'")), 2, "no array 'x'");
  check(call_failing_with(trismooth::ReadError("plate.vtk", 17, "expected 3 coordinates")), 3,
        "plate.vtk:17: expected 3 coordinates");
  check(call_failing_with(trismooth::MeshError("triangle 3 repeats a vertex")), 3,
        "plate.vtk: triangle 3 repeats a vertex");
  check(call_failing_with(std::bad_alloc()), 3,
        "plate.vtk: not enough memory for this mesh; use a machine with more, fewer threads (--threads 1), or a "
        "smaller mesh");
  check(call_failing_with(trismooth::WriteError("out.vtk", "the disk is full")), 4, "out.vtk: the disk is full");
  check(call_failing_with(trismooth::DeviceError("the device was lost")), 5, "the device was lost");
  check(call_failing_with(trismooth::Cancelled()), 130, "cancelled; nothing was written");
  check(call_failing_with(std::runtime_error("what nobody foresaw")), 3, "unexpected failure: what nobody foresaw");
}

TEST_CASE("failed gates are told one by one and answered with 1, after everything is written") {
  const ScratchFolder folder;
  const Outcome outcome = smooth({"--require", "min_shape>=0.5", "--require", "inverted==0", "--require",
                                  "triangles>1000", "--report", (folder / "r.json").string()});
  CHECK(outcome.code == 1);
  CHECK(outcome.says("gate failed: min_shape >= 0.5, is 0.35\n"));
  CHECK(outcome.says("gate failed: triangles > 1000, is 210\n"));
  CHECK_FALSE(outcome.says("inverted"));
  CHECK(outcome.shows("written:    out.vtk"));
  CHECK_FALSE(bytes_of(folder / "r.json").empty());
}

TEST_CASE("gates of smooth look at the result, those of quality at the mesh") {
  CHECK(smooth({"--require", "min_shape>=0.3"}).code == 0);
  CHECK(call({"quality", "plate.vtk", "--require", "min_shape>=0.3"}).code == 1);
}

TEST_CASE("reports of both kinds are written, as often as asked for") {
  const ScratchFolder folder;
  const Outcome outcome = smooth({"--report", (folder / "a.json").string(), "--report", (folder / "b.HTML").string(),
                                  "--report", (folder / "c.json").string()});
  REQUIRE(outcome.code == 0);
  CHECK(nlohmann::json::parse(bytes_of(folder / "a.json"))["input"]["vertices"] == 120);
  CHECK(bytes_of(folder / "b.HTML").starts_with("<!DOCTYPE html>"));
  CHECK(bytes_of(folder / "c.json") == bytes_of(folder / "a.json"));
  CHECK(outcome.shows((folder / "a.json").string()));
  CHECK(folder.size() == 3);
}

TEST_CASE("a report that cannot be written is answered with 4") {
  const ScratchFolder folder;
  const Outcome outcome = smooth({"--report", (folder / "missing/a.json").string()});
  CHECK(outcome.code == 4);
  CHECK(outcome.says((folder / "missing/a.json").string() + ": "));
}

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

TEST_CASE("short forms do the same as the long ones") {
  CHECK(call({"-V"}).out == call({"--version"}).out);
  CHECK(smooth({"-q"}).out.empty());
  CHECK(smooth({"-v"}).out == smooth({"--verbose"}).out);
  CHECK(smooth({"-q", "-v"}).code == 2);
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

TEST_CASE("info names version, formats, instructions and devices") {
  const Outcome outcome = call({"info"});
  CHECK(outcome.code == 0);
  for (const char* words : {"trismooth ", ".off, .obj, .ply, .stl, .vtk, .vtu, .vtp",
                            "SIMD:", "threads:", "CUDA:       not in this build"}) {
    CAPTURE(words);
    CHECK(outcome.shows(words));
  }
  const fakes::FakeBackend backend;
  const Outcome with_cuda = call({"info"}, {}, false, cuda_with(backend, "cudaErrorNoDevice"));
  CHECK(with_cuda.code == 0);
  CHECK(with_cuda.shows("CUDA:       lines of a test\n"));
}

TEST_CASE("info never fails on the CUDA that is or is not on this machine") {
  const Outcome outcome = call({"info"}, {}, false, trismooth::cuda_support());
  CHECK(outcome.code == 0);
  CHECK(outcome.shows("CUDA:"));
}

TEST_CASE("a generated mesh has as many vertices as asked for and can be smoothed in place") {
  const ScratchFolder folder;
  const std::string mesh = (folder / "mesh.off").string();
  const Outcome made = call({"generate", mesh, "--vertices", "500", "--seed", "7"});
  REQUIRE(made.code == 0);
  CHECK(made.shows("500 vertices"));
  const Outcome smoothed =
      call({"smooth", mesh, mesh, "--require", "triangles>500", "--require", "inverted==0"}, &trismooth::run_pipeline);
  CAPTURE(smoothed.err);
  CHECK(smoothed.code == 0);
  CHECK(smoothed.shows("500 vertices"));
  CHECK(folder.size() == 1);
}

TEST_CASE("the same seed makes the same file, another seed another") {
  const ScratchFolder folder;
  const auto made_with = [&](const std::string& seed) {
    REQUIRE(call({"generate", (folder / (seed + ".off")).string(), "--vertices", "300", "--seed", seed}).code == 0);
    return bytes_of(folder / (seed + ".off"));
  };
  const std::string first = made_with("1");
  REQUIRE(call({"generate", (folder / "again.off").string(), "--vertices", "300"}).code == 0);
  CHECK(bytes_of(folder / "again.off") == first);
  CHECK(made_with("18446744073709551615") != first);
}

TEST_CASE("the number of vertices may have a unit, as the sizes of bench") {
  const ScratchFolder folder;
  const auto made = [&](const std::string& count) {
    REQUIRE(call({"generate", (folder / (count + ".off")).string(), "--vertices", count}).code == 0);
    return bytes_of(folder / (count + ".off"));
  };
  CHECK(made("1K") == made("1000"));
  CHECK(made("2k") == made("2000"));
}

TEST_CASE("a file of vertex numbers that names none is a warning, for it holds nothing") {
  const ScratchFolder folder;
  const std::string mesh = (folder / "mesh.off").string();
  REQUIRE(call({"generate", mesh, "--vertices", "50"}).code == 0);
  const std::string ids = folder.write("ids.txt", "# none yet\n").string();
  const std::string warning = "trismooth: warning: " + ids + ": names no vertices, so it holds none\n";
  CHECK(call({"smooth", mesh, mesh, "--fixed-ids", ids}, &trismooth::run_pipeline).err == warning);
  CHECK(call({"quality", mesh, "--fixed-ids", ids}, &trismooth::run_pipeline).err == warning);
}

TEST_CASE("generate cannot write where there is no folder or no format") {
  const ScratchFolder folder;
  CHECK(call({"generate", (folder / "mesh.xyz").string(), "--vertices", "10"}).code == 4);
  CHECK(call({"generate", (folder / "missing/mesh.off").string(), "--vertices", "10"}).code == 4);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a standard output that takes nothing is answered with 4") {
  std::ostringstream err;
  std::ostream broken(nullptr);
  const char* const arguments[] = {"trismooth", "info"};
  CHECK(trismooth::run_command_line(2, arguments, {broken, err}) == 4);
  CHECK(err.str() == "trismooth: error: standard output: cannot be written\n");
}
