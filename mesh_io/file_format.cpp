// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/file_format.h"

#include <algorithm>
#include <array>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"

namespace trismooth {

namespace {

constexpr auto ordered_formats = [] {
  std::array<FileFormat, all_codecs.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<FileFormat>(i);
  }
  return all;
}();

const FormatDescription& described(FileFormat format) {
  return codec_of(format).description;
}

std::string last_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace

std::string_view to_string(FileFormat format) {
  return described(format).name;
}

std::string_view title_of(FileFormat format) {
  return described(format).title;
}

std::span<const std::string_view> extensions_of(FileFormat format) {
  const auto& extensions = described(format).extensions;
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
  const auto* const found =
      std::ranges::find(ordered_formats, name, [](FileFormat format) { return to_string(format); });
  return found == ordered_formats.end() ? std::nullopt : std::optional(*found);
}

bool is_available(FileFormat format) {
  return codec_of(format).read_shared != nullptr;
}

std::string format_list() {
  std::vector<std::string_view> listed;
  std::string list;
  for (const FileFormat format : ordered_formats) {
    for (const std::string_view extension : extensions_of(format)) {
      if (is_available(format) && std::ranges::find(listed, extension) == listed.end()) {
        listed.push_back(extension);
        add_to_list(list, extension);
      }
    }
  }
  return list;
}

std::string format_names() {
  std::string list;
  for (const FileFormat format : ordered_formats) {
    if (is_available(format)) {
      add_to_list(list, to_string(format));
    }
  }
  return list;
}

std::string titled_format_list() {
  std::string list;
  for (const FileFormat format : ordered_formats) {
    if (is_available(format)) {
      add_to_list(list, std::string(title_of(format)) + " (" + list_text(extensions_of(format)) + ")");
    }
  }
  return list;
}

bool has_arrays(FileFormat format) {
  return described(format).holds.arrays;
}

bool has_names(FileFormat format) {
  return described(format).holds.names;
}

}  // namespace trismooth
