#include "trismooth/mesh_io/mesh_file.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/bytes/compressed_file.h"
#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/strip_triangles.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_support.h"

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
    case FileFormat::vtp:
      break;
  }
  return vtk_xml_codec(format);
}

std::string unknown_extension(const std::filesystem::path& path) {
  return "the extension '" + path.extension().string() + "' names no format; known are " + format_list();
}

std::string describe_unavailable(FileFormat format) {
  return "this program was built without VTK, which ." + std::string(to_string(format)) + " needs; available are " +
         format_list();
}

/// Formats state the rows of arrays by the counts of points and cells.
void require_rows(const std::filesystem::path& path, std::span<const DataArray> arrays, std::size_t rows,
                  std::string_view of) {
  for (const DataArray& array : arrays) {
    if (array.bytes.size() != rows * array.components * size_of(array.type)) {
      throw WriteError(path, "the array " + trismooth::quoted(array.name) + " has " + std::to_string(array.rows()) +
                                 " rows, the mesh to write has " + std::to_string(rows) + " " + std::string(of));
    }
  }
}

bool is_written_back(const MeshDocument& document, FileFormat target) {
  return document.original != nullptr && document.format == target;
}

void replace_annotations(std::vector<DataArray>& arrays, std::span<const DataArray> added) {
  std::erase_if(arrays, [](const DataArray& array) { return is_annotation(array.name); });
  arrays.insert(arrays.end(), added.begin(), added.end());
}

bool holds_strips(FileFormat format) {
  return format == FileFormat::vtk || format == FileFormat::vtu || format == FileFormat::vtp;
}

/// What has_strips() as a format holds it that has no strips.
std::string describe_strips(const MeshDocument& document, const MeshDocument& expanded, FileFormat target) {
  std::string name(to_string(target));
  std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  const auto strips = std::ranges::count(document.cells.types, cell_type::triangle_strip);
  const std::size_t triangles = expanded.cells.size() + static_cast<std::size_t>(strips) - document.cells.size();
  return name + " holds no triangle strips: " + std::to_string(strips) + (strips == 1 ? " is" : " are") +
         " written as " + std::to_string(triangles) + (triangles == 1 ? " triangle" : " triangles");
}

void write_plain(const std::filesystem::path& path, FileFormat format, const MeshDocument& document,
                 const AddedArrays& added, Workers& workers) {
  if (is_written_back(document, format)) {
    document.original->write(path, document, added.point_arrays, added.cell_arrays, workers);
    return;
  }
  const bool adds = takes_added_arrays(document, format) && !(added.point_arrays.empty() && added.cell_arrays.empty());
  const bool expands = !holds_strips(format) && has_strips(document);
  if (!adds && !expands) {
    codec_of(format).write_shared(path, document, FileWorkers(workers));
    return;
  }
  MeshDocument changed = document;
  if (adds) {
    replace_annotations(changed.point_arrays, added.point_arrays);
    replace_annotations(changed.cell_arrays, added.cell_arrays);
  }
  codec_of(format).write_shared(path, expands ? with_strips_as_triangles(changed) : changed, FileWorkers(workers));
}

}  // namespace

FileFormat input_format(const std::filesystem::path& path) {
  if (const auto format = format_of(path)) {
    if (!is_available(*format)) {
      throw ReadError(path, describe_unavailable(*format));
    }
    return *format;
  }
  if (const auto compression = compression_named(path)) {
    throw ReadError(path, describe(*compression));
  }
  throw ReadError(path, unknown_extension(path));
}

MeshDocument read_mesh(const std::filesystem::path& path, int threads) {
  const FileFormat format = input_format(path);
  Workers workers(threads);
  const FileWorkers file_workers(workers);
  FileBytes bytes = read_file_bytes(path, file_workers);
  if (const auto compression = compression_of(bytes)) {
    throw ReadError(path, describe(*compression));
  }
  MeshDocument document = codec_of(format).read_shared(path, std::move(bytes), file_workers);
  document.format = format;
  return document;
}

FileFormat output_format(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!format && compression_named(path)) {
    throw WriteError(path, "nothing is written compressed; leave out '" + path.extension().string() +
                               "' and compress the file then");
  }
  if (!format) {
    throw WriteError(path, unknown_extension(path));
  }
  if (!is_available(*format)) {
    throw WriteError(path, describe_unavailable(*format));
  }
  return *format;
}

void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                int threads) {
  const FileFormat format = output_format(path);
  Workers workers(threads);
  for (const auto& arrays : {std::span(document.point_arrays), std::span(added.point_arrays)}) {
    require_rows(path, arrays, document.point_count(), "points");
  }
  for (const auto& arrays : {std::span(document.cell_arrays), std::span(added.cell_arrays)}) {
    require_rows(path, arrays, document.cells.size(), "cells");
  }
  OutputFile output(path);
  try {
    write_plain(output.path(), format, document, added, workers);
  } catch (const WriteError& error) {
    // Codecs know the temporary file only.
    throw WriteError(path, error.reason);
  }
  output.commit();
}

std::vector<std::string> what_is_lost(const MeshDocument& document, FileFormat target) {
  if (is_written_back(document, target)) {
    return {};
  }
  if (holds_strips(target) || !has_strips(document)) {
    return codec_of(target).what_is_lost(document);
  }
  const MeshDocument expanded = with_strips_as_triangles(document);
  std::vector<std::string> lost{describe_strips(document, expanded, target)};
  std::ranges::move(codec_of(target).what_is_lost(expanded), std::back_inserter(lost));
  return lost;
}

bool takes_added_arrays(const MeshDocument& document, FileFormat target) {
  return has_arrays(target) || (target == FileFormat::ply && !is_written_back(document, target));
}

}  // namespace trismooth
