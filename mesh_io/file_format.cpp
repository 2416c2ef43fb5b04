#include "trismooth/mesh_io/file_format.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "trismooth/mesh_io/vtk_support.h"

namespace trismooth {

namespace {

constexpr std::size_t most_extensions = 4;

struct FormatNames {
  FileFormat format;
  std::string_view name;
  std::string_view title;
  std::array<std::string_view, most_extensions> extensions;  ///< empty behind the last
};

/// In the order of the enumeration.
constexpr auto names_of_formats = std::to_array<FormatNames>({
    {FileFormat::off, "off", "OFF", {".off"}},
    {FileFormat::obj, "obj", "OBJ", {".obj"}},
    {FileFormat::ply, "ply", "PLY", {".ply"}},
    {FileFormat::stl, "stl", "STL", {".stl"}},
    {FileFormat::vtk, "vtk", "legacy VTK", {".vtk"}},
    {FileFormat::vtu, "vtu", "VTK XML (unstructured grid)", {".vtu"}},
    {FileFormat::vtp, "vtp", "VTK XML (polygonal data)", {".vtp"}},
    {FileFormat::msh, "msh", "Gmsh MSH", {".msh"}},
    {FileFormat::medit, "medit", "Medit", {".mesh", ".meshb"}},
    {FileFormat::su2, "su2", "SU2", {".su2"}},
    {FileFormat::inp, "inp", "Abaqus", {".inp"}},
    {FileFormat::adcirc, "adcirc", "ADCIRC", {".14", ".grd", ".gr3", ".ll"}},
    {FileFormat::sms, "2dm", "SMS 2dm", {".2dm"}},
    {FileFormat::freefem, "freefem", "FreeFem", {".msh"}},
    {FileFormat::mfem, "mfem", "MFEM", {".mesh"}},
    {FileFormat::triangle, "triangle", "Triangle", {".node", ".ele"}},
    {FileFormat::nastran, "nastran", "Nastran", {".bdf", ".nas"}},
    {FileFormat::unv, "unv", "I-DEAS UNV", {".unv"}},
});

constexpr auto ordered_formats = [] {
  std::array<FileFormat, names_of_formats.size()> all{};
  std::ranges::transform(names_of_formats, all.begin(), &FormatNames::format);
  return all;
}();

static_assert(std::ranges::all_of(ordered_formats, [](FileFormat format) {
  return ordered_formats[static_cast<std::size_t>(format)] == format;
}));

const FormatNames& names_of(FileFormat format) {
  return names_of_formats[static_cast<std::size_t>(format)];
}

std::string last_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::string_view to_string(FileFormat format) {
  return names_of(format).name;
}

std::string_view title_of(FileFormat format) {
  return names_of(format).title;
}

std::span<const std::string_view> extensions_of(FileFormat format) {
  const auto& extensions = names_of(format).extensions;
  return std::span(extensions)
      .first(static_cast<std::size_t>(std::ranges::find(extensions, std::string_view()) - extensions.begin()));
}

std::span<const FileFormat> all_formats() {
  return ordered_formats;
}

std::string extension_of(const std::filesystem::path& path) {
  return last_extension(names_gzip(path) ? path.stem() : path);
}

bool names_gzip(const std::filesystem::path& path) {
  return last_extension(path) == ".gz";
}

std::vector<FileFormat> formats_of(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  std::vector<FileFormat> found;
  std::ranges::copy_if(ordered_formats, std::back_inserter(found), [&extension](FileFormat format) {
    const auto extensions = extensions_of(format);
    return std::ranges::find(extensions, extension) != extensions.end();
  });
  return found;
}

std::optional<FileFormat> format_of(const std::filesystem::path& path) {
  const std::vector<FileFormat> found = formats_of(path);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<FileFormat> format_named(std::string_view name) {
  const auto* const found = std::ranges::find(names_of_formats, name, &FormatNames::name);
  return found == names_of_formats.end() ? std::nullopt : std::optional(found->format);
}

bool is_available(FileFormat format) {
  return has_vtk() || (format != FileFormat::vtu && format != FileFormat::vtp);
}

std::string format_list() {
  std::vector<std::string_view> listed;
  std::string list;
  for (const FileFormat format : ordered_formats) {
    for (const std::string_view extension : extensions_of(format)) {
      if (is_available(format) && std::ranges::find(listed, extension) == listed.end()) {
        listed.push_back(extension);
        list.append(list.empty() ? "" : ", ").append(extension);
      }
    }
  }
  return list;
}

std::string format_names() {
  std::string list;
  for (const FileFormat format : ordered_formats) {
    if (is_available(format)) {
      list.append(list.empty() ? "" : ", ").append(to_string(format));
    }
  }
  return list;
}

std::string titled_format_list() {
  std::string list;
  for (const FileFormat format : ordered_formats) {
    if (is_available(format)) {
      std::string extensions;
      for (const std::string_view extension : extensions_of(format)) {
        extensions.append(extensions.empty() ? "" : ", ").append(extension);
      }
      list.append(list.empty() ? "" : ", ").append(title_of(format)).append(" (" + extensions + ")");
    }
  }
  return list;
}

bool has_arrays(FileFormat format) {
  return format == FileFormat::vtk || format == FileFormat::vtu || format == FileFormat::vtp ||
         format == FileFormat::msh;
}

bool has_names(FileFormat format) {
  return format > FileFormat::vtp;
}

}  // namespace trismooth
