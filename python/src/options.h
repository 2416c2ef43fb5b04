// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth::python {

/// The options of a call.
struct CallOptions {
  SmoothingOptions smoothing;
  Sliding slide;  ///< without lines and links: these are arrays of the call
};

/// The options of a call: keyword arguments as the command line calls them, with '_' in place of '-'. Raises TypeError
/// for an unknown name or a value of the wrong type, ValueError for a value that is none of the valid ones, each with
/// the name. `backend` is chosen here as the program chooses it; DeviceError where it is asked for and not there.
/// `otherwise`: what holds for options that are not among them.
CallOptions parse_options(const nanobind::dict& arguments, const SmoothingOptions& otherwise = {});

/// A number of threads, 0 to most_threads(); the exception names `threads`.
int threads_of(nanobind::handle value);

/// True or False, also NumPy's; raises TypeError for anything else.
bool flag_of(nanobind::handle value, const char* name);

/// The names of all options, for messages and tests.
std::vector<std::string> option_names();

}  // namespace trismooth::python
