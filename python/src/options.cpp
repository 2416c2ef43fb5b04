// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nanobind/stl/string.h>

#include "trismooth/base/machine/worker_threads.h"
#include "trismooth/base/text/suggestion.h"
#include "trismooth/python/backends.h"
#include "trismooth/python/errors.h"

namespace nb = nanobind;

namespace trismooth::python {

namespace {

/// An option as it is parsed: the backend's name has to wait for all others.
struct Parsed {
  SmoothingOptions options{};
  Sliding slide{};
  std::string backend = "auto";
  std::vector<int> devices{};
  const char* of_lines = nullptr;  ///< an option that says how vertices slide, if one is given
};

/// Throws std::invalid_argument for options that do not fit.
void check(const Parsed& parsed) {
  parsed.options.validate();
  parsed.slide.validate();
}

/// Whether it is a bool, of Python's or NumPy's.
bool is_flag(nb::handle value) {
  if (PyBool_Check(value.ptr())) {
    return true;
  }
  const auto module = nb::cast<std::string>(value.type().attr("__module__"));
  const auto name = nb::cast<std::string>(value.type().attr("__name__"));
  return module == "numpy" && (name == "bool" || name == "bool_");
}

double real_of(nb::handle value, const char* name) {
  const bool is_text = PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr());
  const nb::object number = nb::steal(is_text ? nullptr : PyNumber_Float(value.ptr()));
  if (!number.is_valid()) {
    PyErr_Clear();
    raise_type_error(name, "a number is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  return nb::cast<double>(number);
}

template <class T>
T integer_of(nb::handle value, const char* name) {
  const nb::object number = nb::steal(PyNumber_Index(value.ptr()));
  if (!number.is_valid()) {
    const nb::python_error error;
    raise_type_error(name, "an integer is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  T result{};
  if (!nb::try_cast(number, result)) {
    raise_value_error(name, nb::cast<std::string>(nb::repr(value)) + " is out of range");
  }
  return result;
}

std::string text_of(nb::handle value, const char* name) {
  std::string text;
  if (!nb::try_cast(value, text)) {
    raise_type_error(name, "a str is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  return text;
}

template <class Enum>
Enum choice_of(nb::handle value, const char* name) {
  const std::string text = text_of(value, name);
  try {
    return parse_enum<Enum>(text);
  } catch (const std::invalid_argument& error) {
    raise_value_error(name, error.what());
  }
}

struct Option {
  const char* name;
  void (*parse)(nb::handle value, const char* name, Parsed& parsed);
};

template <auto member>
void parse_choice(nb::handle value, const char* name, Parsed& parsed) {
  auto& place = parsed.options.*member;
  place = choice_of<std::remove_reference_t<decltype(place)>>(value, name);
}

template <auto member>
void parse_flag(nb::handle value, const char* name, Parsed& parsed) {
  parsed.options.*member = flag_of(value, name);
}

/// None: the default. One number, or several.
void parse_devices(nb::handle value, const char* name, Parsed& parsed) {
  parsed.devices.clear();
  if (value.is_none()) {
    return;
  }
  if (PyIndex_Check(value.ptr()) != 0) {
    parsed.devices.push_back(integer_of<int>(value, name));
    return;
  }
  if (PyUnicode_Check(value.ptr()) || !nb::isinstance<nb::iterable>(value)) {
    raise_type_error(name, "numbers of CUDA devices are needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  for (const nb::handle device : nb::iter(value)) {
    parsed.devices.push_back(integer_of<int>(device, name));
  }
  if (parsed.devices.empty()) {
    raise_value_error(name, "name one CUDA device at least");
  }
}

void parse_untangle(nb::handle value, const char* name, Parsed& parsed) {
  if (is_flag(value)) {
    parsed.options.untangle = flag_of(value, name) ? Untangle::on : Untangle::off;
  } else {
    parse_choice<&SmoothingOptions::untangle>(value, name, parsed);
  }
}

void parse_time_limit(nb::handle value, const char* name, Parsed& parsed) {
  parsed.options.time_limit_seconds = value.is_none() ? std::numeric_limits<double>::infinity() : real_of(value, name);
}

void parse_target_quality(nb::handle value, const char* name, Parsed& parsed) {
  if (!value.is_none()) {
    parsed.options.target_quality = real_of(value, name);
  }
}

/// None: the default.
template <auto member>
void parse_slide_number(nb::handle value, const char* name, Parsed& parsed) {
  if (!value.is_none()) {
    parsed.slide.*member = real_of(value, name);
    parsed.of_lines = name;
  }
}

void parse_curve(nb::handle value, const char* name, Parsed& parsed) {
  parsed.slide.curve = choice_of<SlideCurve>(value, name);
  if (parsed.slide.curve != Sliding{}.curve) {
    parsed.of_lines = name;
  }
}

void parse_coincident(nb::handle value, const char* name, Parsed& parsed) {
  parsed.slide.coincident = flag_of(value, name);
  if (parsed.slide.coincident) {
    parsed.of_lines = name;
  }
}

constexpr auto known_options = std::to_array<Option>({
    {"method", parse_choice<&SmoothingOptions::method>},
    {"form", parse_choice<&SmoothingOptions::form>},
    {"backend", [](nb::handle value, const char* name, Parsed& parsed) { parsed.backend = text_of(value, name); }},
    {"devices", parse_devices},
    {"layout", parse_choice<&SmoothingOptions::layout>},
    {"execution", parse_choice<&SmoothingOptions::execution>},
    {"order", parse_choice<&SmoothingOptions::order>},
    {"topology", parse_choice<&SmoothingOptions::topology>},
    {"precision", parse_choice<&SmoothingOptions::precision>},
    {"evaluation", parse_choice<&SmoothingOptions::evaluation>},
    {"guard", parse_flag<&SmoothingOptions::guard>},
    {"untangle", parse_untangle},
    {"layers", parse_choice<&SmoothingOptions::layers>},
    {"max_sweeps", [](nb::handle value, const char* name,
                      Parsed& parsed) { parsed.options.max_sweeps = integer_of<std::int64_t>(value, name); }},
    {"tolerance",
     [](nb::handle value, const char* name, Parsed& parsed) { parsed.options.tolerance = real_of(value, name); }},
    {"time_limit", parse_time_limit},
    {"target_quality", parse_target_quality},
    {"threads",
     [](nb::handle value, const char* name, Parsed& parsed) { parsed.options.threads = integer_of<int>(value, name); }},
    {"size_weight", [](nb::handle value, const char* name,
                       Parsed& parsed) { parsed.options.mean_ratio.size_weight = real_of(value, name); }},
    {"power",
     [](nb::handle value, const char* name, Parsed& parsed) {
       parsed.options.mean_ratio.power = value.is_none() ? 0 : integer_of<int>(value, name);
     }},
    {"target", [](nb::handle value, const char* name,
                  Parsed& parsed) { parsed.options.mean_ratio.target = choice_of<TargetShape>(value, name); }},
    {"steady", [](nb::handle value, const char* name,
                  Parsed& parsed) { parsed.options.mean_ratio.steady = flag_of(value, name); }},
    {"record_min_shape", parse_flag<&SmoothingOptions::record_min_shape>},
    {"slide",
     [](nb::handle value, const char* name, Parsed& parsed) { parsed.slide.along = choice_of<Slide>(value, name); }},
    {"corner_angle", parse_slide_number<&Sliding::corner_angle>},
    {"deviation", parse_slide_number<&Sliding::deviation>},
    {"curve", parse_curve},
    {"slide_coincident", parse_coincident},
});

const Option* find_option(std::string_view name) {
  const auto* const option =
      std::ranges::find(known_options, name, [](const Option& known) { return std::string_view(known.name); });
  return option == known_options.end() ? nullptr : option;
}

/// The key of an option; empty where it is none that an option could have.
std::string_view text_view(nb::handle key) {
  Py_ssize_t size = 0;
  const char* const text = PyUnicode_Check(key.ptr()) ? PyUnicode_AsUTF8AndSize(key.ptr(), &size) : nullptr;
  PyErr_Clear();
  return text == nullptr ? std::string_view() : std::string_view(text, static_cast<std::size_t>(size));
}

/// Raises ValueError for options that do not fit. It begins with the name of the one that by itself is to blame, if one
/// is.
void validate(const Parsed& all, const nb::dict& arguments) {
  try {
    check(all);
  } catch (const std::invalid_argument& error) {
    for (const auto& [key, value] : arguments) {
      const Option& option = *find_option(text_view(key));
      Parsed alone;
      option.parse(value, option.name, alone);
      try {
        check(alone);
      } catch (const std::invalid_argument& of_option) {
        raise_value_error(option.name, of_option.what());
      }
    }
    throw;
  }
}

}  // namespace

bool flag_of(nb::handle value, const char* name) {
  if (!is_flag(value)) {
    raise_type_error(name, "True or False is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  return PyObject_IsTrue(value.ptr()) == 1;
}

int threads_of(nb::handle value) {
  try {
    return checked_threads(integer_of<int>(value, "threads"));
  } catch (const std::invalid_argument& error) {
    raise_value_error("threads", error.what());
  }
}

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const Option& option : known_options) {
    names.emplace_back(option.name);
  }
  return names;
}

CallOptions parse_options(const nb::dict& arguments, const SmoothingOptions& otherwise) {
  Parsed parsed{otherwise};
  for (const auto& [key, value] : arguments) {
    const Option* const option = find_option(text_view(key));
    if (option == nullptr) {
      const std::vector<std::string> names = option_names();
      throw nb::type_error((nb::cast<std::string>(nb::repr(key)) + " is no option" +
                            did_you_mean(text_view(key), names) + "; help(trismooth.smooth) lists them")
                               .c_str());
    }
    option->parse(value, option->name, parsed);
  }
  validate(parsed, arguments);
  if (parsed.of_lines != nullptr && parsed.slide.along == Slide::off) {
    raise_value_error(parsed.of_lines, "is for vertices that slide; slide='straight' or slide='curves' has them do so");
  }
  choose_backend(parsed.backend, parsed.devices, parsed.options);
  return {std::move(parsed.options), parsed.slide};
}

}  // namespace trismooth::python
