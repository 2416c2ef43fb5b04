// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/format_description.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// One file format: what it is, how to read it and how to write a document that came from elsewhere. A document that
/// came from the same format is written by its OriginalFile instead.
struct Codec {
  FormatDescription description;

  /// Reads the file at `path`, whose bytes are `bytes`. Throws ReadError.
  MeshDocument (*read_shared)(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) = nullptr;
  /// Writes the document from scratch to the plain path `path`: the same bytes for all workers. Throws WriteError.
  void (*write_shared)(const std::filesystem::path& path, const MeshDocument& document,
                       const FileWorkers& workers) = nullptr;
  /// What the format cannot hold of the document, one sentence each.
  std::vector<std::string> (*what_is_lost)(const MeshDocument& document) = nullptr;
  /// Whether a file with these bytes is one of the format and of no other, from its first lines or bytes: linear in
  /// them. Null for formats whose files do not show what they are.
  bool (*recognises)(std::string_view bytes) = nullptr;

  /// Of formats whose meshes are two files: the other file of the one at `path`, for which readers look beside it.
  /// Writers, and the original, write the one that the extension of their path names. Throws WriteError for a path that
  /// names neither. Null for other formats.
  std::filesystem::path (*partner_of)(const std::filesystem::path& path) = nullptr;

  /// Of formats whose meshes may be several files: those that write() writes besides the one that is to be called
  /// `path`, to where OutputFile::place_of() says. Null for other formats. (OriginalFile::other_files() is the same of
  /// what is written back.)
  std::vector<std::filesystem::path> (*other_files_of)(const std::filesystem::path& path) = nullptr;

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

/// One codec a format, each in the folder of its format. Those of a format that this build cannot read (VTK's without
/// VTK, MED and CGNS without HDF5) have a description and no functions.
extern const Codec off_codec, obj_codec, ply_codec, stl_codec, vtk_legacy_codec, vtu_codec, vtp_codec, msh_codec,
    medit_codec, su2_codec, inp_codec, adcirc_codec, sms_codec, freefem_codec, mfem_codec, triangle_codec,
    nastran_codec, unv_codec, xdmf_codec, exodus_codec, ugrid_codec, med_codec, cgns_codec, selafin_codec;

/// In the order of FileFormat.
inline constexpr std::array all_codecs{&off_codec,      &obj_codec,     &ply_codec,  &stl_codec,     &vtk_legacy_codec,
                                       &vtu_codec,      &vtp_codec,     &msh_codec,  &medit_codec,   &su2_codec,
                                       &inp_codec,      &adcirc_codec,  &sms_codec,  &freefem_codec, &mfem_codec,
                                       &triangle_codec, &nastran_codec, &unv_codec,  &xdmf_codec,    &exodus_codec,
                                       &ugrid_codec,    &med_codec,     &cgns_codec, &selafin_codec};

constexpr const Codec& codec_of(FileFormat format) {
  return *all_codecs[static_cast<std::size_t>(format)];
}

}  // namespace trismooth
