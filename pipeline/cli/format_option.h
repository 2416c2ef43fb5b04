// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>

#include <CLI/CLI.hpp>

#include "trismooth/mesh_io/file_format.h"

namespace trismooth {

/// Adds --format, the format of `-` and of files whose extension names none. `format` must outlive the parsing.
CLI::Option* add_format_option(CLI::App& command, std::optional<FileFormat>& format);

/// Throws std::invalid_argument where a format is given and the names of all these files say theirs.
void require_use_of_format(std::optional<FileFormat> format,
                           std::initializer_list<std::optional<std::filesystem::path>> files);

}  // namespace trismooth
