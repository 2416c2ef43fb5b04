// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace trismooth {

/// How a legacy file writes the value of an information key.
enum class InformationKind : std::uint8_t { number, numbers, text, texts };

/// That of the key with that name and location; nothing for keys that VTK 9.1 does not know or does not write to files.
/// From a table, so that reading these files needs no VTK.
std::optional<InformationKind> vtk_legacy_information_kind(std::string_view name, std::string_view location);

}  // namespace trismooth
