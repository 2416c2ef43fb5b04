// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/standard_streams.h"

namespace trismooth {

bool is_standard_stream(const std::filesystem::path& path) {
  return path == "-";
}

std::filesystem::path shown_input(const std::filesystem::path& path) {
  return is_standard_stream(path) ? "standard input" : path;
}

std::filesystem::path shown_output(const std::filesystem::path& path) {
  return is_standard_stream(path) ? "standard output" : path;
}

}  // namespace trismooth
