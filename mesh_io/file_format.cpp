#include "trismooth/mesh_io/file_format.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "trismooth/mesh_io/vtk_support.h"

namespace trismooth {

namespace {

constexpr std::array<std::string_view, 7> format_names{"off", "obj", "ply", "stl", "vtk", "vtu", "vtp"};
constexpr std::array<FileFormat, 7> formats{FileFormat::off, FileFormat::obj, FileFormat::ply, FileFormat::stl,
                                            FileFormat::vtk, FileFormat::vtu, FileFormat::vtp};

}  // namespace

std::string_view to_string(FileFormat format) {
  return format_names[static_cast<std::size_t>(format)];
}

std::span<const FileFormat> all_formats() {
  return formats;
}

std::optional<FileFormat> format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const FileFormat format : formats) {
    if (extension.size() > 1 && extension.substr(1) == to_string(format)) {
      return format;
    }
  }
  return std::nullopt;
}

bool is_available(FileFormat format) {
  return has_vtk() || (format != FileFormat::vtu && format != FileFormat::vtp);
}

std::string format_list() {
  std::string list;
  for (const FileFormat format : formats) {
    if (is_available(format)) {
      list.append(list.empty() ? "." : ", .").append(to_string(format));
    }
  }
  return list;
}

bool has_arrays(FileFormat format) {
  return format == FileFormat::vtk || format == FileFormat::vtu || format == FileFormat::vtp;
}

}  // namespace trismooth
