#pragma once

#include <filesystem>
#include <string>
#include <string_view>
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
  /// Whether a file with these bytes is one of the format and of no other, from its first lines or bytes: linear in
  /// them. Null for formats whose files do not show what they are.
  bool (*recognises)(std::string_view bytes) = nullptr;

  /// Of formats whose meshes are two files: the other file of the one at `path`, for which readers look beside it.
  /// Writers, and the original, write the one that the extension of their path names. Throws WriteError for a path that
  /// names neither. Null for other formats.
  std::filesystem::path (*partner_of)(const std::filesystem::path& path) = nullptr;

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

/// The codec of an available format.
const Codec& codec_of(FileFormat format);

/// One codec a format, each in a source file of its name.
extern const Codec off_codec;
extern const Codec obj_codec;
extern const Codec ply_codec;
extern const Codec stl_codec;
extern const Codec vtk_legacy_codec;
extern const Codec vtu_codec;
extern const Codec vtp_codec;
extern const Codec medit_codec;
extern const Codec su2_codec;
extern const Codec inp_codec;
extern const Codec adcirc_codec;
extern const Codec freefem_codec;
extern const Codec sms_codec;
extern const Codec mfem_codec;
extern const Codec triangle_codec;
extern const Codec msh_codec;
extern const Codec nastran_codec;
extern const Codec unv_codec;

}  // namespace trismooth
