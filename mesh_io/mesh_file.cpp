#include "trismooth/mesh_io/mesh_file.h"

#include <algorithm>
#include <string>

#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/file_bytes.h"
#include "trismooth/mesh_io/output_file.h"

namespace trismooth {

namespace {

const Codec& codec_of(FileFormat format) {
  switch (format) {
    case FileFormat::off:
      return off_codec;
    case FileFormat::obj:
      return obj_codec;
    case FileFormat::ply:
      return ply_codec;
    case FileFormat::stl:
      return stl_codec;
    case FileFormat::vtk:
      return vtk_legacy_codec;
    case FileFormat::vtu:
      return vtu_codec;
    case FileFormat::vtp:
      break;
  }
  return vtp_codec;
}

std::string unknown_extension(const std::filesystem::path& path) {
  return "the extension '" + path.extension().string() + "' names no format; known are " + format_list();
}

bool is_written_back(const MeshDocument& document, FileFormat target) {
  return document.original != nullptr && document.format == target;
}

void replace_annotations(std::vector<DataArray>& arrays, std::span<const DataArray> added) {
  std::erase_if(arrays, [](const DataArray& array) { return is_annotation(array.name); });
  arrays.insert(arrays.end(), added.begin(), added.end());
}

void write_plain(const std::filesystem::path& path, FileFormat format, const MeshDocument& document,
                 const AddedArrays& added) {
  if (is_written_back(document, format)) {
    document.original->write(path, document, added.point_arrays, added.cell_arrays);
    return;
  }
  if (!has_arrays(format) || (added.point_arrays.empty() && added.cell_arrays.empty())) {
    codec_of(format).write(path, document);
    return;
  }
  MeshDocument extended = document;
  replace_annotations(extended.point_arrays, added.point_arrays);
  replace_annotations(extended.cell_arrays, added.cell_arrays);
  codec_of(format).write(path, extended);
}

}  // namespace

MeshDocument read_mesh(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!format) {
    throw ReadError(path, unknown_extension(path));
  }
  MeshDocument document = codec_of(*format).read(path, read_file_bytes(path));
  document.format = *format;
  return document;
}

FileFormat output_format(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!format) {
    throw WriteError(path, unknown_extension(path));
  }
  return *format;
}

void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added) {
  const FileFormat format = output_format(path);
  OutputFile output(path);
  try {
    write_plain(output.path(), format, document, added);
  } catch (const WriteError& error) {
    // Codecs know the temporary file only.
    throw WriteError(path, error.reason);
  }
  output.commit();
}

std::vector<std::string> what_is_lost(const MeshDocument& document, FileFormat target) {
  return is_written_back(document, target) ? std::vector<std::string>{} : codec_of(target).what_is_lost(document);
}

}  // namespace trismooth
