// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/bench_command.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/pipeline/cli/command_line.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"

namespace trismooth::bench_command_test {

/// What a command line did.
struct Outcome {
  int code = 0;
  std::string out;
  std::string err;

  bool says(const std::string& words) const { return err.find(words) != std::string::npos; }
  /// In the output as if no line were broken.
  bool shows(const std::string& words) const {
    std::string one_line;
    for (const char c : out) {
      if (c != ' ' && c != '\n') {
        one_line += c;
      } else if (!one_line.empty() && one_line.back() != ' ') {
        one_line += ' ';
      }
    }
    return one_line.find(words) != std::string::npos;
  }
};

/// Calls `trismooth bench` on meshes of 60 and 200 vertices, in a build without CUDA unless `cuda` is another.
Outcome bench(std::vector<std::string> words, const CudaSupport& cuda = {}, bool terminal = false) {
  words.insert(words.begin(), {"trismooth", "bench", "--runs", "2"});
  if (std::find(words.begin(), words.end(), "--sizes") == words.end()) {
    words.insert(words.end(), {"--sizes", "60,200"});
  }
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream out;
  std::ostringstream err;
  Outcome outcome;
  trismooth::CommandEnvironment environment{out, err, {terminal ? &err : nullptr}, {}, [&] { return cuda; }};
  environment.more_commands = {&trismooth::add_bench_command};
  outcome.code = trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(), environment);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

CudaSupport cuda_with(const fakes::FakeBackend& backend, const std::string& problem = "") {
  return {&backend, true, [problem] { return problem; }, [] { return "CUDA: lines of a test\n"; }};
}

nlohmann::json json_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

TEST_CASE("bench prints the tables and the claims, and writes the reports") {
  const ScratchFolder folder;
  const auto json = folder.path() / "b.json";
  const auto csv = folder.path() / "b.csv";
  const auto html = folder.path() / "b.html";
  const Outcome outcome = bench({"--report", json.string(), "--report", csv.string(), "--report", html.string()});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.shows("200: 200 vertices"));
  CHECK(outcome.shows("Table 4: CDP version"));
  CHECK(outcome.shows("Not measured, for they need a CUDA device: GPU-AoS, GPU-SoA, CDP-AoS"));
  CHECK(outcome.shows("report: " + html.string()));
  CHECK(json_of(json)["rows"].size() == 36);
  CHECK(std::filesystem::file_size(csv) > 500);
  CHECK(std::filesystem::file_size(html) > 10'000);
}

TEST_CASE("every option of bench takes effect") {
  const ScratchFolder folder;
  const auto path = folder.path() / "b.json";
  const Outcome chosen = bench({"--sizes", "60,1k,60", "--precision", "double", "--versions", "cpu,serial", "--seconds",
                                "2.5", "--seed", "9", "--threads", "1", "--report", path.string()});
  REQUIRE(chosen.code == 0);
  const nlohmann::json json = json_of(path);
  CHECK(json["options"]["sizes"] == nlohmann::json{60, 1'000});
  CHECK(json["options"]["versions"] == nlohmann::json{"cpu", "serial"});
  CHECK(json["options"]["precision"] == "double");
  CHECK(json["options"]["runs"] == 2);
  CHECK(json["options"]["seconds"] == 2.5);
  CHECK(json["options"]["seed"] == 9);
  CHECK(json["machine"]["threads"] == 1);
  CHECK(json["command"] ==
        "trismooth bench --sizes 60,1000 --versions cpu,serial --precision double --runs 2 --seconds 2.5 --seed 9 "
        "--threads 1");
  CHECK(json["rows"].size() == 8);
}

TEST_CASE("wrong usage of bench is answered with 2 and the option's name") {
  const std::vector<std::vector<std::string>> cases{
      {"--sizes", "3"},    {"--sizes", ""},         {"--sizes", "1K,"},     {"--sizes", "1Q"},
      {"--sizes", "0.1K"}, {"--sizes", "-1K"},      {"--sizes", "9999M"},   {"--versions", "gpu,cuda"},
      {"--versions", ""},  {"--precision", "half"}, {"--seconds", "0"},     {"--seconds", "nan"},
      {"--seed", "-1"},    {"--threads", "-1"},     {"--backend", "metal"}, {"--report", "b.txt"}};
  for (const auto& words : cases) {
    CAPTURE(words);
    const Outcome outcome = bench(words);
    CHECK(outcome.code == 2);
    CHECK(outcome.says(words.front()));
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("with a device bench measures every version on it") {
  const fakes::FakeBackend backend;
  const Outcome outcome = bench({}, cuda_with(backend));
  CHECK(outcome.code == 0);
  CHECK(backend.smoothed == 3 * 14 * 2);
  CHECK(outcome.shows("resident"));
  CHECK_FALSE(outcome.shows("Not measured"));
}

TEST_CASE("the backend cpu leaves the device alone, cuda insists on one, auto takes what there is") {
  const fakes::FakeBackend backend;
  const Outcome cpu = bench({"--backend", "cpu"}, cuda_with(backend));
  CHECK(cpu.code == 0);
  CHECK(backend.smoothed == 0);
  CHECK(cpu.shows("left out by --backend cpu"));
  const Outcome no_device = bench({"--backend", "cuda"}, cuda_with(backend, "cudaErrorNoDevice (from a test)"));
  CHECK(no_device.code == 5);
  CHECK(no_device.says("cudaErrorNoDevice (from a test)"));
  CHECK(no_device.out.empty());
  CHECK(bench({"--backend", "cuda"}).code == 5);
  CHECK(bench({"--backend", "cuda"}, cuda_with(backend)).code == 0);
  const Outcome automatic = bench({}, cuda_with(backend, "cudaErrorNoDevice (from a test)"));
  CHECK(automatic.code == 0);
  CHECK(automatic.shows("cudaErrorNoDevice"));
}

TEST_CASE("a device that fails on the way ends in 5, with all that was measured printed") {
  const fakes::FakeBackend backend(fakes::Failure::smooth);
  const Outcome outcome = bench({}, cuda_with(backend));
  CHECK(outcome.code == 5);
  CHECK(outcome.says("the device failed"));
  CHECK(outcome.shows("optimised CPU"));
  CHECK(outcome.shows("cudaErrorMemoryAllocation"));
}

TEST_CASE("other bits than the CPU's end in 1, with all that was measured printed") {
  const fakes::FakeBackend backend(fakes::Failure::bits);
  const Outcome outcome = bench({}, cuda_with(backend));
  CHECK(outcome.code == 1);
  CHECK(outcome.says("must give the same bits"));
  CHECK(outcome.shows("OTHER BITS THAN THEY MUST: 60 GPU-AoS, Form A, 60 GPU-SoA, Form A"));
}

TEST_CASE("a bar is drawn on a terminal, and nowhere else") {
  CHECK(bench({}).err.empty());
  const Outcome outcome = bench({}, {}, true);
  CHECK(outcome.says("\r\x1b[K[-"));
  CHECK(outcome.err.substr(outcome.err.size() - 4) == "\r\x1b[K");
  CHECK_FALSE(outcome.shows("\x1b"));
}

TEST_CASE("a report that cannot be written is told by its name") {
  const ScratchFolder folder;
  const Outcome outcome = bench({"--report", (folder.path() / "none" / "b.json").string()});
  CHECK(outcome.code == 4);
  CHECK(outcome.says("none/b.json"));
}

TEST_CASE("a report that cannot be written in the end keeps no other from being written") {
  const ScratchFolder folder;
  const auto bad = folder.path() / "gone" / "a.json";
  const auto worse = folder.path() / "gone" / "c.html";
  const auto good = folder.path() / "b.json";
  std::filesystem::create_directories(bad.parent_path());
  fakes::FakeBackend backend;
  CudaSupport cuda = cuda_with(backend);
  // The folder goes away while the experiment runs.
  cuda.lines = [&] {
    std::filesystem::remove_all(bad.parent_path());
    return std::string("CUDA: lines of a test\n");
  };
  const Outcome outcome =
      bench({"--report", bad.string(), "--report", good.string(), "--report", worse.string()}, cuda);
  CHECK(outcome.code == 4);
  CHECK(outcome.says("gone/a.json"));
  CHECK(outcome.says("gone/c.html"));
  CHECK(outcome.shows("Table 1"));
  CHECK(std::filesystem::exists(good));
}

TEST_CASE("a lack of memory on the way ends in 3, with all that was measured printed") {
  const fakes::FakeBackend backend(fakes::Failure::host_memory);
  const Outcome outcome = bench({}, cuda_with(backend));
  CHECK(outcome.code == 3);
  CHECK(outcome.says("not enough memory"));
  CHECK(outcome.shows("optimised CPU"));
}

}  // namespace trismooth::bench_command_test
