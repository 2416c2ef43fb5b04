// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace trismooth {

/// Whether `path` is `-`, which stands for standard input or standard output.
bool is_standard_stream(const std::filesystem::path& path);

/// The path for people: "standard input" for `-`.
std::filesystem::path shown_input(const std::filesystem::path& path);

/// The path for people: "standard output" for `-`.
std::filesystem::path shown_output(const std::filesystem::path& path);

}  // namespace trismooth
