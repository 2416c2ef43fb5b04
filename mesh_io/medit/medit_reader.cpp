// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_reader.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/medit/medit_binary_reader.h"
#include "trismooth/mesh_io/medit/medit_text_reader.h"
#include "trismooth/mesh_io/medit/medit_writer.h"

namespace trismooth {

namespace {

/// Written back byte by byte, unless the extension asks for the other encoding: it alone tells programs which it is.
class MeditOriginal : public OriginalFile {
 public:
  MeditOriginal(std::shared_ptr<const OriginalFile> same, bool was_binary)
      : same_(std::move(same)), was_binary_(was_binary) {}

  using OriginalFile::write;
  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    const std::optional<bool> binary = names_binary_medit(path);
    if (!binary || binary == was_binary_) {
      same_->write(path, document, added_point_arrays, added_cell_arrays, workers);
    } else {
      write_medit_in_other_encoding(path, document, FileWorkers(workers));
    }
  }

 private:
  std::shared_ptr<const OriginalFile> same_;
  bool was_binary_;  ///< by its name, or else by its content
};

}  // namespace

std::optional<bool> names_binary_medit(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  return extension == ".meshb" ? std::optional(true) : extension == ".mesh" ? std::optional(false) : std::nullopt;
}

MeshDocument read_medit(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const bool is_binary = medit_byte_order(bytes).has_value();
  MeditMesh mesh = is_binary ? read_medit_binary(path, bytes, workers) : read_medit_text(path, bytes, workers);
  mesh.document.original = std::make_shared<MeditOriginal>(
      make_patched_original(std::move(bytes), std::move(mesh.sites)), names_binary_medit(path).value_or(is_binary));
  return std::move(mesh.document);
}

}  // namespace trismooth
