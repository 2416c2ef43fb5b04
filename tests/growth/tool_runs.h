// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases.h"
#include "support/test_meshes.h"

/// Smooths a file as the program does once it has understood its arguments, which takes longer than a small mesh does,
/// and shortly; says all there is to say where there are reports. Ends this program where it fails.
void run_tool(const std::string& from, const std::string& to, const std::vector<std::filesystem::path>& reports = {});

/// Smooths a file with the bytes make(size), named `input`, to one named `output`.
GrowthCase file_case(const std::string& name, int size, const std::string& input, const std::string& output,
                     std::string (*make)(int));

/// The mesh as an OFF file with comments.
std::string off_text(const test_meshes::Mesh& mesh);

/// The same of hostile_meshes::chain().
std::string chain_off_text(int length);

/// A chain of vertices in a format, as this program writes it, to the same format.
GrowthCase chain_in(const std::string& format, const std::string& extension);

/// What part(number) makes of each number below `count`, as text.
template <class Part>
std::string repeated(int count, Part part) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part(std::to_string(i));
  }
  return text;
}
