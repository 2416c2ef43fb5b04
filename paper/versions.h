// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::experiments {

/// The programs that are compared.
enum class Version : std::uint8_t {
  serial,    ///< the paper's serial program: one thread of the CPU, every vertex in every sweep
  cpu,       ///< the CPU backend as users run it: all threads, only vertices around which something changed
  gpu,       ///< the paper's "GPU version": one block of threads, Execution::single_block
  cdp,       ///< the paper's "CDP version": Execution::cdp
  resident,  ///< the CUDA backend as users run it
};

/// Both, in the order of tables.
inline constexpr std::array forms{Form::swap, Form::in_place};

/// A version in one iteration form and layout.
struct Case {
  Version version = Version::serial;
  Form form = Form::swap;
  /// Order::unordered is the paper's literal Form B on a device.
  Order order = Order::colour;
  Layout layout = Layout::aos;  ///< see has_layouts()

  bool operator==(const Case&) const = default;
};

bool runs_on_device(Version version);

/// Whether it comes in both layouts: the paper's versions on a device do. The others have Layout::aos in a Case.
bool has_layouts(Version version);

/// Whether the paper measured it. Its Form B on a device is unordered.
bool is_of_paper(const Case& what);

/// The order in which the paper runs this form of a version.
Order order_of_paper(Version version, Form form);

/// A version in one form and layout as the paper runs it; always AoS where there are no layouts.
Case case_of_paper(Version version, Form form, Layout layout);

/// All cases of these versions, in the order of `versions`. Form B of `gpu` and `cdp` comes in both orders.
std::vector<Case> cases_of(std::span<const Version> versions);

/// "serial CPU", "optimised CPU", "GPU-AoS", "resident".
std::string name_of(const Case& what);
/// The name of a version without its layout: "GPU version".
std::string name_of(Version version);
/// "A", "B".
std::string_view letter_of(Form form);
/// "A", "B", "B unordered".
std::string form_of(const Case& what);
/// "GPU-AoS, Form A".
std::string full_name(const Case& what);

/// The options that make a smoothing run as this case. `threads` are those of Version::cpu, and of the copies to a
/// device. `cuda.backend` must be there for versions that run on a device.
SmoothingOptions options_of(const Case& what, Precision precision, int threads, const CudaSupport& cuda);

}  // namespace trismooth::experiments

template <>
struct trismooth::EnumText<trismooth::experiments::Version> {
  using Version = trismooth::experiments::Version;
  static constexpr std::string_view what = "version";
  static constexpr std::array<std::pair<Version, std::string_view>, 5> texts{{{Version::serial, "serial"},
                                                                              {Version::cpu, "cpu"},
                                                                              {Version::gpu, "gpu"},
                                                                              {Version::cdp, "cdp"},
                                                                              {Version::resident, "resident"}}};
};
