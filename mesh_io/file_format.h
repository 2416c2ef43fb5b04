#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trismooth {

/// The file formats, chosen by extension.
enum class FileFormat : std::uint8_t { off, obj, ply, stl, vtk, vtu, vtp };

/// "off", "obj", ...: the format's extension without the dot.
std::string_view to_string(FileFormat format);

/// The format that the path's extension names (any case), or nothing.
std::optional<FileFormat> format_of(const std::filesystem::path& path);

/// Whether this build reads and writes the format. All but vtu and vtp always are available; these need a build with
/// VTK.
bool is_available(FileFormat format);

/// Every format, available or not, in the order of the enumeration.
std::span<const FileFormat> all_formats();

/// ".off, .obj, ...": the available formats, for messages.
std::string format_list();

/// True for the formats that hold named arrays (vtk, vtu, vtp), false for those that do not.
bool has_arrays(FileFormat format);

}  // namespace trismooth
