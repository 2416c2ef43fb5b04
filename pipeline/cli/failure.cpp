#include "trismooth/pipeline/cli/failure.h"

#include <new>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/messages.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

ExitCode report_failure(std::ostream& err) {
  try {
    throw;
  } catch (const std::invalid_argument& error) {
    print_error(err, error.what());
    return ExitCode::wrong_usage;
  } catch (const Cancelled& error) {
    print_error(err, error.what());
    return ExitCode::cancelled;
  } catch (const ReadError& error) {
    print_error(err, error.what());
    return ExitCode::bad_input;
  } catch (const MeshError& error) {
    print_error(err, error.what());
    return ExitCode::bad_input;
  } catch (const WriteError& error) {
    print_error(err, error.what());
    return ExitCode::not_written;
  } catch (const DeviceError& error) {
    print_error(err, error.what());
    return ExitCode::device_error;
  } catch (const std::bad_alloc&) {
    print_error(err, "not enough memory; use a machine with more, or a smaller mesh");
    return ExitCode::bad_input;
  } catch (const std::exception& error) {
    print_error(err, std::string("unexpected failure: ") + error.what());
    return ExitCode::bad_input;
  }
}

}  // namespace trismooth
