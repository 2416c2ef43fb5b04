// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/backend_choice.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"

namespace trismooth::backend_choice_test {

const char* const no_device = "cudaErrorNoDevice (no CUDA-capable device is detected)";

/// What choosing comes to: a backend, or the kind of the error and its message.
struct Choice {
  const trismooth::Backend* backend = nullptr;
  bool usage_error = false;
  bool device_error = false;
  std::string message;

  bool says(const std::string& words) const { return message.find(words) != std::string::npos; }
};

Choice choose(BackendChoice wanted, const CudaSupport& cuda, const CudaOrCpu& automatic, SmoothingOptions options) {
  Choice choice;
  try {
    choose_backend(wanted, cuda, automatic, options);
    choice.backend = options.backend;
  } catch (const std::invalid_argument& error) {
    choice.usage_error = true;
    choice.message = error.what();
  } catch (const trismooth::DeviceError& error) {
    choice.device_error = true;
    choice.message = error.what();
  }
  return choice;
}

SmoothingOptions unordered() {
  SmoothingOptions options;
  options.order = trismooth::Order::unordered;
  options.execution = Execution::single_block;
  return options;
}

TEST_CASE("where --devices asks for CUDA that is not there, it is what is to be left out") {
  const auto message = [](const CudaSupport& cuda, BackendChoice choice) {
    SmoothingOptions options;
    return message_of<trismooth::DeviceError>(
        [&] { trismooth::choose_devices(std::vector<int>{0}, choice, cuda, options); });
  };
  CHECK(
      message({}, BackendChoice::automatic) ==
      "this build has no CUDA backend; leave out '--devices' to smooth on the CPU, or build with -DTRISMOOTH_CUDA=ON");
  CHECK(message({}, BackendChoice::cuda).find("leave out '--backend cuda'") != std::string::npos);
}

TEST_CASE("in a build without CUDA, cpu and auto are the CPU and everything else is refused with what to do") {
  const CudaSupport cuda;
  const CudaOrCpu automatic(cuda);
  CHECK(choose(BackendChoice::cpu, cuda, automatic, {}).backend == nullptr);
  CHECK(choose(BackendChoice::automatic, cuda, automatic, {}).backend == nullptr);
  const Choice asked = choose(BackendChoice::cuda, cuda, automatic, {});
  CHECK(asked.device_error);
  CHECK(asked.says("this build has no CUDA backend"));
  CHECK(asked.says("-DTRISMOOTH_CUDA=ON"));
  for (const BackendChoice choice : {BackendChoice::cpu, BackendChoice::automatic}) {
    const Choice refused = choose(choice, cuda, automatic, unordered());
    CHECK(refused.usage_error);
    CHECK(refused.says("'--order unordered' needs the CUDA backend"));
  }
}

TEST_CASE("with a device, each choice is what its name says, and unordered leaves auto no choice") {
  const fakes::FakeBackend backend;
  const CudaSupport cuda{&backend, true, [] { return std::string(); }, {}};
  const CudaOrCpu automatic(cuda);
  CHECK(choose(BackendChoice::cpu, cuda, automatic, {}).backend == nullptr);
  CHECK(choose(BackendChoice::automatic, cuda, automatic, {}).backend == &automatic);
  CHECK(choose(BackendChoice::cuda, cuda, automatic, {}).backend == &backend);
  CHECK(choose(BackendChoice::cuda, cuda, automatic, unordered()).backend == &backend);
  CHECK(choose(BackendChoice::automatic, cuda, automatic, unordered()).backend == &backend);
  CHECK(choose(BackendChoice::cpu, cuda, automatic, unordered()).usage_error);
}

TEST_CASE("without a device, what needs one is told the CUDA error and what to do, and auto goes on") {
  const fakes::FakeBackend backend;
  const CudaSupport cuda{&backend, true, [] { return std::string(no_device); }, {}};
  const CudaOrCpu automatic(cuda);
  CHECK(choose(BackendChoice::cpu, cuda, automatic, {}).backend == nullptr);
  CHECK(choose(BackendChoice::automatic, cuda, automatic, {}).backend == &automatic);
  const Choice asked = choose(BackendChoice::cuda, cuda, automatic, {});
  CHECK(asked.device_error);
  CHECK(asked.says(no_device));
  CHECK(asked.says("use '--backend cpu'"));
  const Choice needed = choose(BackendChoice::automatic, cuda, automatic, unordered());
  CHECK(needed.device_error);
  CHECK(needed.says(no_device));
  CHECK(needed.says("use '--backend cpu --order colour'"));
}

TEST_CASE("a build without dynamic parallelism refuses cdp where CUDA was asked for, and auto may ignore it") {
  const fakes::FakeBackend backend;
  const CudaSupport cuda{&backend, false, [] { return std::string(); }, {}};
  const CudaOrCpu automatic(cuda);
  SmoothingOptions options;
  options.execution = Execution::cdp;
  const Choice asked = choose(BackendChoice::cuda, cuda, automatic, options);
  CHECK(asked.device_error);
  CHECK(asked.says("--execution resident"));
  CHECK(choose(BackendChoice::automatic, cuda, automatic, options).backend == &automatic);
  options.order = trismooth::Order::unordered;
  CHECK(choose(BackendChoice::automatic, cuda, automatic, options).device_error);
  options.execution = Execution::single_block;
  CHECK(choose(BackendChoice::cuda, cuda, automatic, options).backend == &backend);
}

}  // namespace trismooth::backend_choice_test
