// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// The file formats.
enum class FileFormat : std::uint8_t {
  off,
  obj,
  ply,
  stl,
  vtk,
  vtu,
  vtp,
  msh,
  medit,
  su2,
  inp,
  adcirc,
  sms,
  freefem,
  mfem,
  triangle,
  nastran,
  unv,
  xdmf,
  exodus,
  ugrid,
  med,
  cgns,
  selafin
};

/// The format's short name in options, reports and JSON: "off", "obj", ...
std::string_view to_string(FileFormat format);

/// The format's name for people: "OFF", "legacy VTK", ...
std::string_view title_of(FileFormat format);

/// The extensions of the format's files, with the dot and in lower case, the usual one first. Formats may share one.
std::span<const std::string_view> extensions_of(FileFormat format);

/// The path's extension in lower case, with the dot: the one in front of it where the last is ".gz" ("mesh.off.gz").
std::string extension_of(const std::filesystem::path& path);

/// Whether the path's last extension is ".gz" (any case).
bool names_gzip(const std::filesystem::path& path);

/// The first format that the path's extension names (any case), or nothing.
std::optional<FileFormat> format_of(const std::filesystem::path& path);

/// All formats that the path's extension names (any case), in the order of the enumeration; the content of a file tells
/// which it is.
std::vector<FileFormat> formats_of(const std::filesystem::path& path);

/// The format of that short name, or nothing.
std::optional<FileFormat> format_named(std::string_view name);

/// Whether this build reads and writes the format. All but these always are available: vtu and vtp need a build with
/// VTK, med and cgns one with HDF5, xdmf one with either.
bool is_available(FileFormat format);

/// Every format, available or not, in the order of the enumeration.
std::span<const FileFormat> all_formats();

/// ".off, .obj, ...": the extensions of the available formats, each once, for messages.
std::string format_list();

/// "OFF (.off), OBJ (.obj), ...": the available formats with their extensions, for messages.
std::string titled_format_list();

/// "off, obj, ...": the short names of the available formats, for messages about options.
std::string format_names();

/// True for the formats that hold arrays of points and cells by name, and take annotations: vtk, vtu, vtp, msh, xdmf,
/// med, cgns, exodus as variables, and ply as properties.
bool has_arrays(FileFormat format);

/// True for the formats that hold names of values and sets, or say themselves what they cannot hold of these.
bool has_names(FileFormat format);

}  // namespace trismooth
