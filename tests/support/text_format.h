// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "support/scratch_folder.h"

/// The text files of one format, told by their extension, read and written through the library's own calls.
class TextFormat {
 public:
  /// `extension` begins with its dot.
  explicit TextFormat(std::string extension) : extension_(std::move(extension)) {}

  trismooth::MeshDocument read(const std::string& text) const {
    const ScratchFolder folder;
    return trismooth::read_mesh(folder.write("mesh" + extension_, text));
  }

  std::string written(const trismooth::MeshDocument& document) const {
    const ScratchFolder folder;
    const auto file = folder / ("out" + extension_);
    trismooth::write_mesh(file, document);
    return bytes_of(file);
  }

  /// What is said of a text that is refused, from the file's name on and without its folder; empty where it is read.
  std::string failure_of(const std::string& text) const {
    const std::string message = message_of<trismooth::ReadError>([&] { read(text); });
    const std::size_t name = message.find("mesh" + extension_);
    return name == std::string::npos ? message : message.substr(name);
  }

 private:
  std::string extension_;
};

/// The numbers of the array with this name; none where there is no such array.
template <class T>
std::vector<T> values_of(const std::vector<trismooth::DataArray>& arrays, const std::string& name) {
  const trismooth::DataArray* const array = trismooth::find_array(arrays, name);
  if (array == nullptr) {
    return {};
  }
  const auto values = array->as<T>();
  return {values.begin(), values.end()};
}
