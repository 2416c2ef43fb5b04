#pragma once

#include <cstdint>

#include "trismooth/smoothing/enum_text.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// Which backend the user wants.
enum class BackendChoice : std::uint8_t { automatic, cpu, cuda };

template <>
struct EnumText<BackendChoice> {
  static constexpr std::string_view what = "backend";
  static constexpr std::array<std::pair<BackendChoice, std::string_view>, 3> texts{
      {{BackendChoice::automatic, "auto"}, {BackendChoice::cpu, "cpu"}, {BackendChoice::cuda, "cuda"}}};
};

/// Sets `options.backend` to the one that was chosen and checks that it can do what the options ask for. Throws
/// DeviceError where the backend is not in this build, std::invalid_argument for options that only another has.
void choose_backend(BackendChoice choice, SmoothingOptions& options);

}  // namespace trismooth
