// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "trismooth/pipeline/cli/command_line.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/fake_backend.h"

namespace trismooth::info_command_test {

using namespace command_line_calls;

TEST_CASE("info names version, formats, instructions and devices") {
  const Outcome outcome = call({"info"});
  CHECK(outcome.code == 0);
  for (const char* words : {"trismooth ", "off (.off), obj (.obj), ply (.ply), stl (.stl), vtk (.vtk),", "compressed",
                            "SIMD:", "threads:", "MPI:", "CUDA:       not in this build"}) {
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

}  // namespace trismooth::info_command_test
