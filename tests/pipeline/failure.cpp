// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/failure.h"

#include <filesystem>
#include <iomanip>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/cuda_or_cpu.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"

namespace trismooth::failure_test {

using fakes::Failure;

constexpr const char* old_output = "what was there before";

/// A folder with a mesh and an old output, in which the command line smooths one to the other.
class Files {
 public:
  Files() {
    const test_meshes::Mesh mesh = test_meshes::jittered_grid(12, 12, 0.45, 3);
    std::ostringstream text;
    text << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n" << std::setprecision(17);
    for (const auto& [x, y] : mesh.points) {
      text << x << ' ' << y << " 0\n";
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      text << "3 " << a << ' ' << b << ' ' << c << '\n';
    }
    folder_.write("in.off", text.str());
    folder_.write("out.off", old_output);
  }

  struct Outcome {
    int code = 0;
    std::string out;
    std::string err;
    std::string output;
  };

  /// Smooths on this device; where `automatic`, as --backend auto does with a mesh that is large enough.
  Outcome smooth(const fakes::FakeBackend& backend, bool automatic, const std::vector<std::string>& more = {}) const {
    const CudaSupport cuda{&backend, true, [] { return std::string(); }, {}};
    const trismooth::CudaOrCpu from_one_vertex_on(cuda, trismooth::cpu_backend(), 1);
    const std::string input = (folder_ / "in.off").string();
    const std::string output = (folder_ / "out.off").string();
    std::vector<const char*> arguments{"trismooth",    "smooth",    input.c_str(),
                                       output.c_str(), "--backend", automatic ? "auto" : "cuda"};
    for (const std::string& word : more) {
      arguments.push_back(word.c_str());
    }
    const auto run = [&](PipelineOptions options) {
      if (automatic) {
        options.smoothing.backend = &from_one_vertex_on;
      }
      return trismooth::run_pipeline(options);
    };
    std::ostringstream out;
    std::ostringstream err;
    Outcome outcome;
    outcome.code = trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(),
                                               {out, err, {}, run, [&] { return cuda; }});
    outcome.out = out.str();
    outcome.err = err.str();
    outcome.output = bytes_of(output);
    CHECK(folder_.size() == 2);  // no temporary file
    return outcome;
  }

  std::string input() const { return (folder_ / "in.off").string(); }

 private:
  ScratchFolder folder_;
};

constexpr const char* of_device = "CUDA: cudaErrorMemoryAllocation (out of memory) from a test";

TEST_CASE("each exception is one line and an exit code") {
  const auto check = [](const auto& exception, int code, const std::string& message) {
    std::ostringstream err;
    try {
      throw exception;  // NOLINT(bugprone-exception-copy-constructor-throws): there is memory
    } catch (...) {
      CHECK(static_cast<int>(trismooth::report_failure(err)) == code);
    }
    CHECK(err.str() == "trismooth: error: " + message + "\n");
  };
  check(std::invalid_argument("no such option"), 2, "no such option");
  check(trismooth::ReadError("a.off", 3, "bad"), 3, "a.off:3: bad");
  check(trismooth::MeshError("bad"), 3, "bad");
  check(trismooth::WriteError("a.off", "full"), 4, "a.off: full");
  check(trismooth::DeviceError(of_device), 5, of_device);
  check(trismooth::Cancelled(), 130, "cancelled; nothing was written");
  check(std::bad_alloc(), 3, "not enough memory; use a machine with more, or a smaller mesh");
  check(std::runtime_error("what nobody foresaw"), 3, "unexpected failure: what nobody foresaw");
}

TEST_CASE("a device without memory, where CUDA was asked for, is answered with 5, and the old output stays") {
  const Files files;
  for (const Failure failure : {Failure::rings, Failure::prepare, Failure::smooth}) {
    const fakes::FakeBackend backend(failure);
    const Files::Outcome outcome = files.smooth(backend, false, {"--topology", "device"});
    CHECK(outcome.code == 5);
    CHECK(outcome.err == "trismooth: error: " + std::string(of_device) + "\n");
    CHECK(outcome.output == old_output);
  }
}

TEST_CASE("a device without memory, where nobody asked for CUDA, costs a note: the file is the CPU's") {
  const std::string expected = Files().smooth(fakes::FakeBackend(), false).output;
  CHECK(expected != old_output);
  for (const Failure failure : {Failure::rings, Failure::prepare, Failure::smooth}) {
    for (const char* const topology : {"auto", "host", "device"}) {
      CAPTURE(static_cast<int>(failure), topology);
      const Files files;
      const fakes::FakeBackend backend(failure);
      const Files::Outcome outcome = files.smooth(backend, true, {"--topology", topology});
      CHECK(outcome.code == 0);
      CHECK(outcome.output == expected);
      CHECK(outcome.err.find("error: ") == std::string::npos);
      const bool failed = failure != Failure::rings || std::string(topology) != "host";
      CHECK((outcome.out.find("cudaErrorMemoryAllocation") != std::string::npos) == failed);
    }
  }
}

TEST_CASE("a host without memory names the mesh and is answered with 3, whoever smooths, and the old output stays") {
  for (const bool automatic : {false, true}) {
    const Files files;
    const fakes::FakeBackend backend(Failure::host_memory);
    const Files::Outcome outcome = files.smooth(backend, automatic);
    CHECK(outcome.code == 3);
    CHECK(outcome.err ==
          "trismooth: error: " + files.input() +
              ": not enough memory for this mesh; use a machine with more, fewer threads (--threads 1), or a smaller "
              "mesh\n");
    CHECK(outcome.output == old_output);
  }
}

}  // namespace trismooth::failure_test
