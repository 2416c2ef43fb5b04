// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include <nanobind/nanobind.h>

#include "trismooth/base/errors.h"

namespace trismooth::python {

/// Makes the exception classes of the module and has the library's exceptions raise them.
void bind_errors(nanobind::module_& module);

/// Says that an exception class is one of the package, and what it is for.
void make_public(nanobind::handle exception, const char* description);

/// Raises ValueError, or TypeError: "points: ...", of the argument that is to blame.
[[noreturn]] void raise_value_error(const std::string& argument, const std::string& what);
[[noreturn]] void raise_type_error(const std::string& argument, const std::string& what);

/// The library's message with the name of Python's argument that it is about in front:
/// "triangles: triangle 3 repeats a vertex".
std::string with_argument(const std::string& message);

/// Calls `function`, and has its exceptions say so.
template <class Function>
auto naming_arguments(const Function& function) {
  try {
    return function();
  } catch (const MeshError& error) {
    throw MeshError(with_argument(error.what()));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(with_argument(error.what()));
  }
}

}  // namespace trismooth::python
