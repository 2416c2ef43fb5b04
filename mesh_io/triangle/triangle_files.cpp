// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/triangle/triangle_files.h"

#include <algorithm>
#include <string>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

bool is_upper(char c) {
  return 'A' <= c && c <= 'Z';
}

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace

bool is_triangle_elements(const std::filesystem::path& path) {
  return lower_extension(path) == ".ele";
}

std::filesystem::path triangle_partner(const std::filesystem::path& path) {
  const bool upper = std::ranges::any_of(path.extension().string(), &is_upper);
  std::filesystem::path partner = path;
  if (is_triangle_elements(path)) {
    return partner.replace_extension(upper ? ".NODE" : ".node");
  }
  return partner.replace_extension(upper ? ".ELE" : ".ele");
}

std::filesystem::path triangle_output_partner(const std::filesystem::path& path) {
  if (lower_extension(path) != ".node" && !is_triangle_elements(path)) {
    throw WriteError(path, "a mesh of Triangle is two files, of names that end with .node and .ele: name one of them");
  }
  return triangle_partner(path);
}

}  // namespace trismooth
