// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trismooth {

/// A format of meshes that is known and neither read nor written.
struct UnreadFormat {
  std::string_view title;      ///< "Exodus II"
  std::string_view converter;  ///< a command that makes a file from "in.exo" that is read; empty where none is known
};

/// The one that the path's extension names (any case), or nothing. An extension that a format has which is read names
/// no other.
std::optional<UnreadFormat> unread_format_of(const std::filesystem::path& path);

/// The one that the bytes begin as, or nothing.
std::optional<UnreadFormat> recognise_unread_format(std::string_view bytes);

/// "Exodus II is not read; 'meshio convert in.exo out.vtu' makes a file that is; known are off, obj, ...".
std::string describe_unread(const UnreadFormat& format);

/// "Exodus II is not written; known are off, obj, ...".
std::string describe_unwritten(const UnreadFormat& format);

}  // namespace trismooth
