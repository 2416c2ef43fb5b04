// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/included_sources.h"

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::size_t most_included_files = 10000;
constexpr std::size_t most_nested_files = 64;

bool is_included_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

std::filesystem::path canonical_path(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path canonical = std::filesystem::weakly_canonical(path, error);
  return error ? path : canonical;
}

std::filesystem::path included_path(const std::filesystem::path& name, std::span<const std::filesystem::path> open) {
  std::string with_slashes = name.string();
  std::ranges::replace(with_slashes, '\\', '/');
  for (const std::filesystem::path& spelling : {name, std::filesystem::path(with_slashes)}) {
    for (const std::filesystem::path& includer : {open.back(), open.front()}) {
      std::filesystem::path path = includer.parent_path() / spelling;
      if (is_included_file(path)) {
        return path;
      }
    }
  }
  return name;
}

}  // namespace

IncludedFile find_included(const std::filesystem::path& name, std::span<const std::filesystem::path> open,
                           std::size_t sources) {
  const std::filesystem::path path = included_path(name, open);
  const std::string file = "the file " + trismooth::quoted(name.string()) + " ";
  if (!is_included_file(path)) {
    return {path, file + "that is included here cannot be read"};
  }
  if (std::ranges::find(open, canonical_path(path), canonical_path) != open.end()) {
    return {path, file + "is included in itself"};
  }
  if (open.size() > most_nested_files || sources > most_included_files) {
    return {path, "too many files are included"};
  }
  return {path, {}};
}

std::string note_of_included(const std::set<std::string>& names) {
  constexpr std::size_t most_listed = 12;
  return "includes " + first_of_list(names, most_listed, trismooth::quoted) +
         ": a file whose nodes move, or that is not found from the output's folder, is written in the place of the "
         "line that includes it; the file itself stays as it is";
}

}  // namespace trismooth
