// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/options.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "trismooth/base/machine/worker_threads.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::Execution;
using trismooth::Form;
using trismooth::Layout;
using trismooth::Method;
using trismooth::Order;
using trismooth::SmoothingOptions;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What validate() says of the defaults with a change; empty where it says nothing.
std::string complaint(const std::function<void(SmoothingOptions&)>& change) {
  SmoothingOptions options;
  change(options);
  return message_of<std::invalid_argument>([&] { options.validate(); });
}

void check_tolerance(double value, bool valid) {
  CAPTURE(value);
  CHECK(complaint([&](auto& o) { o.tolerance = value; }).empty() == valid);
}

void check_target(double value, bool valid) {
  CAPTURE(value);
  CHECK(complaint([&](auto& o) { o.target_quality = value; }).empty() == valid);
}

void check_order(Form form, Execution execution, bool valid) {
  CAPTURE(form, execution);
  const std::string said = complaint([&](auto& o) {
    o.order = Order::unordered;
    o.form = form;
    o.execution = execution;
  });
  CHECK(said.empty() == valid);
}

void check_layout(Layout layout, Execution execution, bool valid) {
  CAPTURE(layout, execution);
  const std::string said = complaint([&](auto& o) {
    o.layout = layout;
    o.execution = execution;
  });
  CHECK(said == (valid ? "" : "layout 'soa' goes with execution single-block or cdp only"));
}

void check_method(Method method, Execution execution, bool valid) {
  CAPTURE(method, execution);
  const std::string said = complaint([&](auto& o) {
    o.method = method;
    o.execution = execution;
  });
  CHECK(said == (valid ? ""
                       : "execution single-block or cdp goes with methods smart and laplacian only; execution resident "
                         "goes with all"));
}

}  // namespace

TEST_CASE("the defaults are those of the contract and valid") {
  const SmoothingOptions options;
  CHECK_NOTHROW(options.validate());
  CHECK(options.method == Method::smart);
  CHECK(options.form == Form::in_place);
  CHECK(options.layout == trismooth::Layout::aos);
  CHECK(options.execution == Execution::resident);
  CHECK(options.order == Order::colour);
  CHECK(options.precision == trismooth::Precision::double_precision);
  CHECK(options.guard);
  CHECK(options.max_sweeps == 1000);
  CHECK(options.tolerance == 1e-6);
  CHECK_FALSE(options.target_quality.has_value());
  CHECK_FALSE(options.untangles());
}

TEST_CASE("untangling is for mean-ratio alone where it is not asked for nor ruled out") {
  for (const auto& [method, name] : trismooth::EnumText<Method>::texts) {
    CAPTURE(name);
    SmoothingOptions options;
    options.method = method;
    CHECK(options.untangles() == (method == Method::mean_ratio));
    options.untangle = trismooth::Untangle::on;
    CHECK(options.untangles());
    options.untangle = trismooth::Untangle::off;
    CHECK_FALSE(options.untangles());
  }
}

TEST_CASE("numbers out of range are refused, and the message names the option") {
  CHECK(complaint([](auto& o) { o.max_sweeps = -1; }).find("sweep limit") != std::string::npos);
  CHECK(complaint([](auto& o) { o.max_sweeps = 0; }).empty());
  CHECK(complaint([](auto& o) { o.max_sweeps = std::numeric_limits<std::int64_t>::max(); }).empty());
  CHECK(complaint([](auto& o) { o.threads = -1; }).find("threads") != std::string::npos);
  CHECK(complaint([](auto& o) { o.threads = 5; }).empty());
  CHECK(complaint([](auto& o) { o.threads = trismooth::most_threads(); }).empty());
  CHECK(complaint([](auto& o) { o.threads = trismooth::most_threads() + 1; }).find("threads") != std::string::npos);
  CHECK(complaint([](auto& o) { o.threads = std::numeric_limits<int>::max(); }).find("threads") != std::string::npos);
  CHECK(complaint([](auto& o) { o.tolerance = -1e-9; }).find("tolerance") != std::string::npos);
  CHECK(complaint([](auto& o) { o.time_limit_seconds = -1; }).find("time limit") != std::string::npos);
  CHECK(complaint([](auto& o) { o.time_limit_seconds = not_a_number; }).find("time limit") != std::string::npos);
  CHECK(complaint([](auto& o) { o.method = static_cast<Method>(77); }) == "method: there is none of the number 77");
  CHECK(complaint([](auto& o) { o.layers = static_cast<trismooth::Layers>(9); }).find("number 9") != std::string::npos);
  CHECK(complaint([](auto& o) { o.proposal.energy = [](const auto&) { return 0.0; }; }).find("energy") !=
        std::string::npos);
  CHECK(complaint([](auto& o) { o.time_limit_seconds = 0; }).empty());
  CHECK(complaint([](auto& o) { o.target_quality = 1.5; }).find("quality target") != std::string::npos);
}

TEST_CASE("tolerances are numbers from 0, targets from -1 to 1") {
  check_tolerance(0, true);
  check_tolerance(5, true);
  check_tolerance(not_a_number, false);
  check_tolerance(infinity, false);
  check_tolerance(-infinity, false);
  check_target(-1, true);
  check_target(1, true);
  check_target(not_a_number, false);
  check_target(-1.001, false);
  check_target(infinity, false);
}

TEST_CASE("the paper's executions go with the paper's methods alone") {
  for (const Execution execution : {Execution::single_block, Execution::cdp}) {
    check_method(Method::smart, execution, true);
    check_method(Method::laplacian, execution, true);
    check_method(Method::weighted, execution, false);
    check_method(Method::mean_ratio, execution, false);
  }
  check_method(Method::weighted, Execution::resident, true);
  check_method(Method::mean_ratio, Execution::resident, true);
}

TEST_CASE("the structure of arrays goes with a single block or CDP alone") {
  check_layout(Layout::soa, Execution::single_block, true);
  check_layout(Layout::soa, Execution::cdp, true);
  check_layout(Layout::soa, Execution::resident, false);
  check_layout(Layout::aos, Execution::resident, true);
}

TEST_CASE("the unordered order goes with form b in a single block or CDP alone") {
  check_order(Form::in_place, Execution::single_block, true);
  check_order(Form::in_place, Execution::cdp, true);
  check_order(Form::in_place, Execution::resident, false);
  check_order(Form::swap, Execution::single_block, false);
  check_order(Form::swap, Execution::cdp, false);
  check_order(Form::swap, Execution::resident, false);
}
