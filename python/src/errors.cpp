// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/errors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "trismooth/smoothing/errors.h"

namespace nb = nanobind;

namespace trismooth::python {

namespace {

[[noreturn]] void raise(PyObject* type, const std::string& argument, const std::string& what) {
  PyErr_SetString(type, (argument + ": " + what).c_str());
  throw nb::python_error();
}

}  // namespace

void raise_value_error(const std::string& argument, const std::string& what) {
  raise(PyExc_ValueError, argument, what);
}

void raise_type_error(const std::string& argument, const std::string& what) {
  raise(PyExc_TypeError, argument, what);
}

std::string with_argument(const std::string& message) {
  constexpr std::string_view sizes = "MeanRatioOptions::target_lengths";
  if (message.starts_with(sizes)) {
    return "size" + message.substr(sizes.size());
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> arguments{{
      {"the paper's executions", "execution: "},
      {"vertices slide", "slide: "},
      {"backend '", ""},
  }};
  for (const auto& [begin, argument] : arguments) {
    if (message.starts_with(begin)) {
      return std::string(argument) + message;
    }
  }
  if (message.starts_with("points: ") || message.starts_with("triangles: ")) {
    return message;
  }
  const std::size_t element = std::min(message.find("triangle"), message.find("element"));
  const std::size_t vertex = message.find("vert");
  return (element == vertex ? "" : element < vertex ? "triangles: " : "points: ") + message;
}

void make_public(nb::handle exception, const char* description) {
  nb::setattr(exception, "__module__", nb::str("trismooth"));
  nb::setattr(exception, "__doc__", nb::str(description));
}

void bind_errors(nb::module_& module) {
  make_public(nb::exception<MeshError>(module, "MeshError", PyExc_ValueError),
              "Triangles that are no mesh, a coordinate that is not finite, heights that differ.");
  make_public(nb::exception<DeviceError>(module, "DeviceError", PyExc_RuntimeError),
              "A GPU that is not there, has too little memory, or failed.");
}

}  // namespace trismooth::python
