#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// One file format: how to read it and how to write a document that came from elsewhere. A document that came from
/// the same format is written by its OriginalFile instead.
struct Codec {
  /// Reads the file at `path`, whose bytes are `bytes`. Throws ReadError.
  MeshDocument (*read_shared)(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);
  /// Writes the document from scratch to the plain path `path`: the same bytes for all workers. Throws WriteError.
  void (*write_shared)(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);
  /// What the format cannot hold of the document, one sentence each.
  std::vector<std::string> (*what_is_lost)(const MeshDocument& document);

  /// read_shared() on this thread alone.
  MeshDocument read(const std::filesystem::path& path, FileBytes bytes) const {
    Workers alone(1);
    return read_shared(path, std::move(bytes), FileWorkers(alone));
  }

  /// write_shared() on this thread alone.
  void write(const std::filesystem::path& path, const MeshDocument& document) const {
    Workers alone(1);
    write_shared(path, document, FileWorkers(alone));
  }
};

/// One codec a format, each in a source file of its name.
extern const Codec off_codec;
extern const Codec obj_codec;
extern const Codec ply_codec;
extern const Codec stl_codec;
extern const Codec vtk_legacy_codec;
extern const Codec vtu_codec;
extern const Codec vtp_codec;

}  // namespace trismooth
