// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/failure.h"

#include <new>
#include <stdexcept>
#include <string>

#include "trismooth/base/machine/out_of_memory.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/messages.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

ExitCode report_failure(std::ostream& err, const std::string& whose) {
  const auto print = [&](const std::string& message) { print_error(err, whose + message); };
  try {
    throw;
  } catch (const std::invalid_argument& error) {
    print(error.what());
    return ExitCode::wrong_usage;
  } catch (const Cancelled& error) {
    print(error.what());
    return ExitCode::cancelled;
  } catch (const ReadError& error) {
    print(error.what());
    return ExitCode::bad_input;
  } catch (const MeshError& error) {
    print(error.what());
    return ExitCode::bad_input;
  } catch (const WriteError& error) {
    print(error.what());
    return ExitCode::not_written;
  } catch (const DeviceError& error) {
    print(error.what());
    return ExitCode::device_error;
  } catch (const std::bad_alloc& error) {
    print(whose_memory(error) + "not enough memory; use a machine with more, or a smaller mesh");
    return ExitCode::bad_input;
  } catch (const std::exception& error) {
    print(std::string("unexpected failure: ") + error.what());
    return ExitCode::bad_input;
  }
}

}  // namespace trismooth
