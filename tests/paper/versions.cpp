// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/versions.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "catch.h"
#include "support/fake_backend.h"

using trismooth::CudaSupport;
using trismooth::Evaluation;
using trismooth::Execution;
using trismooth::Form;
using trismooth::Layout;
using trismooth::Order;
using trismooth::Precision;
using trismooth::SmoothingOptions;
using trismooth::Topology;
using trismooth::experiments::Case;
using trismooth::experiments::cases_of;
using trismooth::experiments::options_of;
using trismooth::experiments::Version;

namespace {

constexpr std::array all{Version::serial, Version::cpu, Version::gpu, Version::cdp, Version::resident};

}  // namespace

TEST_CASE("every version comes in both forms, the paper's on a device in both layouts and both orders of Form B") {
  const std::vector<Case> cases = cases_of(all);
  const auto count = [&](auto predicate) { return std::ranges::count_if(cases, predicate); };
  CHECK(cases.size() == 18);
  for (const Version version : all) {
    const bool of_paper = version == Version::gpu || version == Version::cdp;
    CHECK(has_layouts(version) == of_paper);
    CHECK(count([&](const Case& c) { return c.version == version; }) == (of_paper ? 6 : 2));
  }
  CHECK(count([](const Case& c) { return c.order == Order::unordered; }) == 4);
  CHECK(count([](const Case& c) { return c.form == Form::swap && c.order == Order::unordered; }) == 0);
}

TEST_CASE("cases keep the order of the versions that were asked for") {
  const std::vector<Case> cases = cases_of(std::array{Version::resident, Version::serial});
  CHECK(cases.front().version == Version::resident);
  CHECK(cases.back().version == Version::serial);
}

TEST_CASE("no two cases have the same name and form") {
  std::set<std::string> names;
  for (const Case& what : cases_of(all)) {
    names.insert(name_of(what) + form_of(what));
  }
  CHECK(names.size() == 18);
}

TEST_CASE("the paper's cases are its two versions in Form A and unordered Form B, and the serial one") {
  for (const Case& what : cases_of(all)) {
    CAPTURE(name_of(what), form_of(what));
    const bool paper_on_device = what.version == Version::gpu || what.version == Version::cdp;
    const bool literal = what.form == Form::swap || what.order == Order::unordered;
    CHECK(is_of_paper(what) == (what.version == Version::serial || (paper_on_device && literal)));
  }
}

TEST_CASE("the serial version is one thread that evaluates every vertex") {
  const SmoothingOptions options = options_of({Version::serial, Form::in_place}, Precision::single_precision, 8, {});
  CHECK(options.threads == 1);
  CHECK(options.evaluation == Evaluation::all);
  CHECK(options.backend == nullptr);
  CHECK(options.form == Form::in_place);
  CHECK(options.precision == Precision::single_precision);
}

TEST_CASE("the optimised version is the CPU backend as it comes") {
  const SmoothingOptions options = options_of({Version::cpu}, Precision::double_precision, 3, {});
  CHECK(options.threads == 3);
  CHECK(options.evaluation == Evaluation::changed);
  CHECK(options.backend == nullptr);
  CHECK(options.precision == Precision::double_precision);
}

TEST_CASE("versions on a device run there from the triangles on, each in its execution") {
  const fakes::FakeBackend backend;
  const CudaSupport cuda{&backend, true, {}, {}};
  const auto options = [&](Version version, Order order, Layout layout) {
    return options_of({version, Form::in_place, order, layout}, Precision::single_precision, 0, cuda);
  };
  const SmoothingOptions gpu = options(Version::gpu, Order::unordered, Layout::soa);
  CHECK(gpu.execution == Execution::single_block);
  CHECK(gpu.order == Order::unordered);
  CHECK(gpu.layout == Layout::soa);
  CHECK(options(Version::cdp, Order::colour, Layout::aos).execution == Execution::cdp);
  CHECK(options(Version::resident, Order::colour, Layout::aos).execution == Execution::resident);
  for (const Version version : {Version::gpu, Version::cdp, Version::resident}) {
    CHECK(options(version, Order::colour, Layout::aos).backend == &backend);
    CHECK(options(version, Order::colour, Layout::aos).topology == Topology::device);
  }
}

TEST_CASE("every case has options that are valid together") {
  const fakes::FakeBackend backend;
  for (const Case& what : cases_of(all)) {
    CHECK_NOTHROW(options_of(what, Precision::single_precision, 0, {&backend, true, {}, {}}).validate());
  }
}
