// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/command_line.h"

#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "command_line_calls.h"
#include "sample_run.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"

namespace command_line_test {

using namespace command_line_calls;
using trismooth::PipelineOptions;

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
  CHECK(options.smoothing.untangle == trismooth::Untangle::automatic);
  CHECK(options.smoothing.max_sweeps == 1000);
  CHECK(options.smoothing.tolerance == 1e-6);
  CHECK_FALSE(options.smoothing.target_quality);
  CHECK_FALSE(options.smoothing.record_min_shape);
  CHECK_FALSE(options.annotate);
  CHECK(options.region_arrays.empty());
}

TEST_CASE("every option of smooth reaches the pipeline") {
  const Outcome outcome = smooth({"--method",         "laplacian",
                                  "--form",           "a",
                                  "--layout",         "soa",
                                  "--backend",        "cpu",
                                  "--execution",      "single-block",
                                  "--order",          "colour",
                                  "--topology",       "device",
                                  "--guard",          "off",
                                  "--untangle",       "on",
                                  "--precision",      "single",
                                  "--max-sweeps",     "0",
                                  "--tolerance",      "2.5e-3",
                                  "--time-limit",     "7.5",
                                  "--target-quality", "0.25",
                                  "--threads",        "3",
                                  "--region-array",   "material",
                                  "--fixed-array",    "anchors",
                                  "--fixed-set",      "Corners",
                                  "--fixed-set",      "N left",
                                  "--fixed-ids",      "ids.txt",
                                  "--annotate"});
  REQUIRE(outcome.code == 0);
  const PipelineOptions& options = *outcome.options;
  CHECK(options.smoothing.method == trismooth::Method::laplacian);
  CHECK(options.smoothing.form == trismooth::Form::swap);
  CHECK(options.smoothing.layout == trismooth::Layout::soa);
  CHECK(options.smoothing.execution == trismooth::Execution::single_block);
  CHECK(options.smoothing.order == trismooth::Order::colour);
  CHECK(options.smoothing.topology == trismooth::Topology::device);
  CHECK(options.smoothing.precision == trismooth::Precision::single_precision);
  CHECK_FALSE(options.smoothing.guard);
  CHECK(options.smoothing.untangle == trismooth::Untangle::on);
  CHECK(options.smoothing.max_sweeps == 0);
  CHECK(options.smoothing.tolerance == 2.5e-3);
  CHECK(options.smoothing.time_limit_seconds == 7.5);
  CHECK(options.smoothing.target_quality == 0.25);
  CHECK(options.smoothing.record_min_shape);
  CHECK(options.smoothing.threads == 3);
  CHECK(options.region_arrays == std::vector<std::string>{"material"});
  CHECK(options.fixed_array == "anchors");
  CHECK(options.fixed_sets == std::vector<std::string>{"Corners", "N left"});
  CHECK(options.fixed_ids == std::filesystem::path("ids.txt"));
  CHECK(options.annotate);
}

TEST_CASE("the options of mean-ratio reach the pipeline") {
  const Outcome outcome = smooth({"--method", "mean-ratio", "--size-weight", "2.5", "--power", "8", "--target",
                                  "input-shape", "--size-array", "edge length"});
  REQUIRE(outcome.code == 0);
  const trismooth::SmoothingOptions& options = outcome.options->smoothing;
  CHECK(options.method == trismooth::Method::mean_ratio);
  CHECK(options.mean_ratio.size_weight == 2.5);
  CHECK(options.mean_ratio.power == 8);
  CHECK(options.mean_ratio.target == trismooth::TargetShape::input);
  CHECK(outcome.options->size_array == "edge length");
  const Outcome defaults = smooth({"--method", "mean-ratio"});
  REQUIRE(defaults.code == 0);
  CHECK(defaults.options->smoothing.mean_ratio.size_weight == 1);
  CHECK(defaults.options->smoothing.mean_ratio.power == 0);
  CHECK_FALSE(defaults.options->size_array);
  CHECK(defaults.options->smoothing.mean_ratio.target == trismooth::TargetShape::uniform);
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
      {{"smooth", "a.off", "b.off", "--method", "laplcian"}, "mean-ratio (did you mean 'laplacian'?)"},
      {{"smooth", "a.off", "b.off", "--require", "min_shap>=1"}, "(did you mean 'min_shape'?)"},
      {{"bench", "--versions", "cpu,serail"}, "(did you mean 'serial'?)"},
      {{"smooth", "a.off", "b.off", "--form"}, "--form"},
      {{"smooth", "a.off", "b.off", "--form", "a", "--form", "b"}, "--form: expected one value, and to be given once"},
      {{"smooth", "a.off", "b.off", "--form", "c"}, "unknown form 'c'; valid are a, b"},
      {{"smooth", "a.off", "b.off", "--method", "x"}, "unknown method 'x'; valid are smart, laplacian, "},
      {{"smooth", "a.off", "b.off", "--target", "x"}, "valid are uniform, input-shape"},
      {{"smooth", "a.off", "b.off", "--size-weight", "-1"}, "--size-weight: expected a number from 0, got '-1'"},
      {{"smooth", "a.off", "b.off", "--size-weight", "inf"}, "--size-weight"},
      {{"smooth", "a.off", "b.off", "--size-weight", "nan"}, "--size-weight"},
      {{"smooth", "a.off", "b.off", "--power", "9"}, "--power"},
      {{"smooth", "a.off", "b.off", "--power", "-1"}, "--power"},
      {{"smooth", "a.off", "b.off", "--power", "1.5"}, "--power"},
      {{"smooth", "a.off", "b.off", "--layout", "x"}, "valid are aos, soa"},
      {{"smooth", "a.off", "b.off", "--backend", "x"}, "valid are auto, cpu, cuda"},
      {{"smooth", "a.off", "b.off", "--devices", ""}, "--devices"},
      {{"smooth", "a.off", "b.off", "--devices", "0,-1"}, "--devices"},
      {{"smooth", "a.off", "b.off", "--devices", "0;1"}, "'0;1'"},
      {{"smooth", "a.off", "b.off", "--devices", "0", "--backend", "cpu"}, "'--devices' is for the CUDA backend"},
      {{"smooth", "a.off", "b.off", "--devices", "0,1", "--execution", "cdp"}, "for one device"},
      {{"smooth", "a.off", "b.off", "--execution", "x"}, "valid are resident, single-block, cdp"},
      {{"smooth", "a.off", "b.off", "--order", "x"}, "valid are colour, unordered"},
      {{"smooth", "a.off", "b.off", "--topology", "x"}, "valid are auto, host, halfedge, device"},
      {{"smooth", "a.off", "b.off", "--guard", "x"}, "valid are on, off"},
      {{"smooth", "a.off", "b.off", "--untangle", "x"}, "valid are auto, off, on"},
      {{"smooth", "a.off", "b.off", "--precision", "x"}, "valid are double, single"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "-1"}, "--max-sweeps"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "10x"}, "'10x'"},
      {{"smooth", "a.off", "b.off", "--max-sweeps", "9223372036854775808"}, "--max-sweeps"},
      {{"smooth", "a.off", "b.off", "--tolerance", "1,5"}, "expected a number, got '1,5'"},
      {{"smooth", "a.off", "b.off", "--tolerance", "nan"}, "--tolerance"},
      {{"smooth", "a.off", "b.off", "--tolerance", "-1"}, "--tolerance"},
      {{"smooth", "a.off", "b.off", "--time-limit", "-1"}, "--time-limit: expected a number from 0"},
      {{"smooth", "a.off", "b.off", "--target-quality", "2"}, "quality target"},
      {{"smooth", "a.off", "b.off", "--threads", "-1"}, "--threads"},
      {{"smooth", "a.off", "b.off", "--threads", "4294967297"}, "--threads"},
      {{"smooth", "a.off", "b.off", "--report", "r.txt"}, "must end in .json or .html"},
      {{"smooth", "a.off", "b.off", "--require", "shape>=1"}, "unknown metric 'shape'"},
      {{"smooth", "a.off", "b.off", "--quiet", "--verbose"}, "--quiet excludes --verbose"},
      {{"smooth", "a.off", "b.off", "--verbose", "--quiet"}, "--quiet excludes --verbose"},
      {{"smooth", "a.off", "b.off", "--order", "unordered"}, "unordered"},
      {{"smooth", "a.off", "b.off", "--layout", "soa"}, "layout 'soa' goes with execution single-block or cdp only"},
      {{"smooth", "a.off", "b.off", "--layout", "soa", "--backend", "cpu"}, "layout 'soa' goes with"},
      {{"smooth", "a.off", "b.off", "--execution", "cdp", "--method", "mean-ratio", "--backend", "cpu"},
       "execution single-block or cdp goes with methods smart and laplacian only; execution resident goes with all"},
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

TEST_CASE("devices that are named are those of the backend, as they are listed") {
  const fakes::FakeBackend all;
  CudaSupport cuda = cuda_with(all, "");
  const trismooth::Backend* made = nullptr;
  std::vector<int> asked;
  cuda.on_devices = [&](std::span<const int> devices) {
    asked.assign(devices.begin(), devices.end());
    auto backend = std::make_unique<fakes::FakeBackend>();
    made = backend.get();
    return backend;
  };
  const auto result = [](const PipelineOptions&) { return sample::result(); };
  const Outcome several = call({"smooth", "a.off", "b.off", "--devices", "2,0,2"}, result, false, cuda);
  CHECK(several.code == 0);
  CHECK(several.options->smoothing.backend == made);
  CHECK(asked == std::vector<int>{2, 0, 2});
  CHECK(call({"smooth", "a.off", "b.off", "--devices", "1", "--backend", "cuda", "--execution", "single-block"}, result,
             false, cuda)
            .code == 0);
  CHECK(asked == std::vector<int>{1});

  cuda.on_devices = [](std::span<const int>) -> std::unique_ptr<trismooth::Backend> {
    throw trismooth::DeviceError("CUDA: there is no device 7");
  };
  const Outcome missing = call({"smooth", "a.off", "b.off", "--devices", "7"}, result, false, cuda);
  CHECK(missing.code == 5);
  CHECK(missing.says("there is no device 7"));
  CHECK_FALSE(missing.options.has_value());
  CHECK(call({"smooth", "a.off", "b.off", "--devices", "0"}, result).code == 5);
}

TEST_CASE("where neither input nor output is of a known format, both are told, as a fault of the input") {
  const Outcome both = call({"smooth", "missing.xyz", "out.abc"}, &trismooth::run_pipeline);
  CHECK(both.code == 3);
  CHECK(
      both.says("missing.xyz: the extension '.xyz' names no format, nor does that of the output, out.abc; known are "
                ".off, .obj"));
  const Outcome input = call({"quality", "missing.xyz"}, &trismooth::run_pipeline);
  CHECK(input.code == 3);
  CHECK(input.says("missing.xyz: cannot be opened"));
}

TEST_CASE("an output of no known format is told before the work") {
  const Outcome outcome = call({"smooth", "missing.vtk", "out.xyz"}, &trismooth::run_pipeline);
  CHECK(outcome.code == 4);
  CHECK(outcome.says("out.xyz: the extension '.xyz' names no format; --format NAME tells it; known are .off, .obj"));
  const Outcome compressed = call({"smooth", "missing.off", "out.off.xz"}, &trismooth::run_pipeline);
  CHECK(compressed.code == 4);
  CHECK(compressed.says("out.off.xz: nothing is written compressed but by gzip (.gz); leave out '.xz'"));
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

TEST_CASE("short forms do the same as the long ones") {
  CHECK(call({"-V"}).out == call({"--version"}).out);
  CHECK(smooth({"-q"}).out.empty());
  CHECK(smooth({"-v"}).out == smooth({"--verbose"}).out);
  CHECK(smooth({"-q", "-v"}).code == 2);
}

}  // namespace command_line_test
