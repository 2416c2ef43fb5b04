// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/versions.h"

namespace trismooth::experiments {

namespace {

Execution execution_of(Version version) {
  switch (version) {
    case Version::gpu:
      return Execution::single_block;
    case Version::cdp:
      return Execution::cdp;
    default:
      return Execution::resident;
  }
}

bool has_unordered(Version version) {
  return version == Version::gpu || version == Version::cdp;
}

}  // namespace

bool runs_on_device(Version version) {
  return version == Version::gpu || version == Version::cdp || version == Version::resident;
}

bool has_layouts(Version version) {
  return version == Version::gpu || version == Version::cdp;
}

bool is_of_paper(const Case& what) {
  return what.version != Version::cpu && what.version != Version::resident &&
         what.order == order_of_paper(what.version, what.form);
}

Order order_of_paper(Version version, Form form) {
  return has_unordered(version) && form == Form::in_place ? Order::unordered : Order::colour;
}

Case case_of_paper(Version version, Form form, Layout layout) {
  return {version, form, order_of_paper(version, form), has_layouts(version) ? layout : Layout::aos};
}

std::vector<Case> cases_of(std::span<const Version> versions) {
  std::vector<Case> cases;
  for (const Version version : versions) {
    const auto add = [&](Form form, Order order) {
      cases.push_back({version, form, order, Layout::aos});
      if (has_layouts(version)) {
        cases.push_back({version, form, order, Layout::soa});
      }
    };
    add(Form::swap, Order::colour);
    if (has_unordered(version)) {
      add(Form::in_place, Order::unordered);
    }
    add(Form::in_place, Order::colour);
  }
  return cases;
}

std::string name_of(const Case& what) {
  const std::string layout = what.layout == Layout::aos ? "-AoS" : "-SoA";
  switch (what.version) {
    case Version::serial:
      return "serial CPU";
    case Version::cpu:
      return "optimised CPU";
    case Version::gpu:
      return "GPU" + layout;
    case Version::cdp:
      return "CDP" + layout;
    case Version::resident:
      break;
  }
  return "resident";
}

std::string name_of(Version version) {
  switch (version) {
    case Version::serial:
      return "serial CPU";
    case Version::cpu:
      return "optimised CPU";
    case Version::gpu:
      return "GPU version";
    case Version::cdp:
      return "CDP version";
    case Version::resident:
      break;
  }
  return "resident version";
}

std::string_view letter_of(Form form) {
  return form == Form::swap ? "A" : "B";
}

std::string form_of(const Case& what) {
  return std::string(letter_of(what.form)) + (what.order == Order::unordered ? " unordered" : "");
}

std::string full_name(const Case& what) {
  return name_of(what) + ", Form " + form_of(what);
}

SmoothingOptions options_of(const Case& what, Precision precision, int threads, const CudaSupport& cuda) {
  SmoothingOptions options;
  options.form = what.form;
  options.order = what.order;
  options.layout = what.layout;
  options.precision = precision;
  options.threads = threads;
  if (runs_on_device(what.version)) {
    options.backend = cuda.backend;
    options.execution = execution_of(what.version);
    options.topology = Topology::device;  // as in the paper: everything happens there
  } else if (what.version == Version::serial) {
    options.evaluation = Evaluation::all;
    options.threads = 1;
  }
  return options;
}

}  // namespace trismooth::experiments
