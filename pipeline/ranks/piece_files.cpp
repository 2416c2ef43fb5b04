// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/piece_files.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/new_parallel_file.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

std::vector<PieceArray> arrays_of_piece(const MeshDocument& document) {
  std::vector<PieceArray> arrays{{PieceArray::Of::coordinates, document.point_type, 3, {}}};
  const auto add = [&](PieceArray::Of of, std::span<const DataArray> listed) {
    for (const DataArray& array : listed) {
      arrays.push_back({of, array.type, array.components, array.name});
    }
  };
  add(PieceArray::Of::points, document.point_arrays);
  add(PieceArray::Of::cells, document.cell_arrays);
  return arrays;
}

namespace {

std::string text_of_array(const PieceArray& array) {
  if (array.of == PieceArray::Of::coordinates) {
    return "coordinates of type " + std::string(to_string(array.type));
  }
  return std::string("the ") + (array.of == PieceArray::Of::points ? "point" : "cell") + " array '" + array.name +
         "' of type " + std::string(to_string(array.type)) + " and " +
         counted(array.components, "component", "components");
}

/// As bytes for other ranks, names ending in zeros.
std::vector<char> packed(const std::vector<PieceArray>& arrays) {
  std::vector<char> bytes;
  for (const PieceArray& array : arrays) {
    bytes.push_back(static_cast<char>(array.of));
    bytes.push_back(static_cast<char>(array.type));
    const auto* const components = reinterpret_cast<const char*>(&array.components);
    bytes.insert(bytes.end(), components, components + sizeof(array.components));
    bytes.insert(bytes.end(), array.name.begin(), array.name.end());
    bytes.push_back('\0');
  }
  return bytes;
}

std::vector<PieceArray> unpacked(const std::vector<char>& bytes) {
  std::vector<PieceArray> arrays;
  for (auto at = bytes.begin(); at != bytes.end();) {
    PieceArray array{static_cast<PieceArray::Of>(at[0]), static_cast<ScalarType>(at[1]), 0, {}};
    std::memcpy(&array.components, &at[2], sizeof(array.components));
    const auto name = at + 2 + sizeof(array.components);
    const auto end = std::find(name, bytes.end(), '\0');
    array.name.assign(name, end);
    arrays.push_back(std::move(array));
    at = end + 1;
  }
  return arrays;
}

/// Finds the arrays, and throws ReadError where a piece has not those of the first that has anything: empty pieces have
/// nothing to give an array values for, and some programs leave arrays out of them.
void find_arrays(PieceFiles& files, const mpi::Communicator& ranks) {
  const auto own = std::ranges::find_if(files.pieces, &holds_something);
  const bool has_any = own != files.pieces.end();
  const std::string own_path = has_any ? own->path.string() : std::string();
  files.arrays = unpacked(first_bytes(has_any ? packed(arrays_of_piece(own->document)) : std::vector<char>{}, ranks));
  const std::vector<char> path = first_bytes({own_path.begin(), own_path.end()}, ranks);
  agree(ranks, [&] {
    const auto require_all = [](const std::vector<PieceArray>& some, const std::vector<PieceArray>& others,
                                const std::string& lacking, const std::string& having) {
      for (const PieceArray& array : some) {
        if (std::ranges::find(others, array) == others.end()) {
          throw ReadError(lacking, "has not " + text_of_array(array) + ", which " + having +
                                       " has; all pieces of a mesh must have the same arrays");
        }
      }
    };
    const std::string first_path(path.begin(), path.end());
    for (const Piece& piece : files.pieces) {
      if (holds_something(piece)) {
        const std::vector<PieceArray> arrays = arrays_of_piece(piece.document);
        require_all(files.arrays, arrays, piece.path.string(), first_path);
        require_all(arrays, files.arrays, first_path, piece.path.string());
      }
    }
  });
}

Piece read_piece(const PieceFiles& files, std::size_t number, Quads quads, Workers& workers) {
  Piece piece;
  piece.number = number;
  piece.path = files.path_of(number);
  piece.document = read_mesh(piece.path, workers.count());
  if (piece.document.format != files.file.piece_format) {
    throw ReadError(piece.path, "is a file of " + std::string(title_of(piece.document.format)) + "; the pieces of " +
                                    files.path.string() + " are " + std::string(title_of(files.file.piece_format)));
  }
  if (!piece.document.cell_labels.empty()) {
    throw ReadError(piece.path, "holds texts at cells ('" + piece.document.cell_labels.front().name +
                                    "'), which a mesh in pieces may not have yet");
  }
  piece.mesh = mesh_of_piece(piece.document, piece.path, quads, workers);
  piece.ghost_cells = ghost_cells_of(piece.document);
  return piece;
}

/// The first piece of a rank. The lowest ranks have one where there are fewer pieces than ranks.
std::size_t block_begin(std::size_t pieces, int rank, const mpi::Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  return (pieces * static_cast<std::size_t>(rank) + size - 1) / size;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code is_absent;  // what does not exist is no other's file
  return std::filesystem::equivalent(a, b, is_absent) || a.lexically_normal() == b.lexically_normal();
}

void write_text(OutputFile& file, const std::filesystem::path& target, const std::string& text) {
  std::ofstream stream(file.path(), std::ios::binary);
  stream << text << std::flush;
  if (!stream) {
    throw WriteError(target, "cannot be written");
  }
}

/// The text of a parallel file without what it says of annotations that are none of these arrays.
std::string without_annotations(const std::string& text, const std::vector<PieceArray>& arrays) {
  constexpr std::string_view element = "<PDataArray";
  constexpr std::string_view end_tag = "</PDataArray>";
  std::string kept;
  std::size_t done = 0;
  for (std::size_t at = text.find(element); at != std::string::npos; at = text.find(element, at + 1)) {
    std::size_t end = std::min(text.find('>', at), text.size() - 1) + 1;
    const std::string_view tag = std::string_view(text).substr(at, end - at);
    const auto names = [&tag](const std::string& name) {
      return tag.find("Name=\"" + name) != std::string_view::npos ||
             tag.find("Name='" + name) != std::string_view::npos;
    };
    const bool is_there = std::ranges::any_of(
        arrays, [&](const PieceArray& array) { return is_annotation(array.name) && names(array.name); });
    if (is_there || !names(std::string(annotation_prefix))) {
      continue;
    }
    if (!tag.ends_with("/>")) {
      const std::size_t closed = text.find(end_tag, end);
      end = closed == std::string::npos ? end : closed + end_tag.size();
    }
    const std::size_t line = text.find_last_not_of(" \t", at - 1);
    const bool is_line = line != std::string::npos && text[line] == '\n' && end < text.size() && text[end] == '\n';
    kept.append(text, done, (is_line ? line : at) - done);
    done = end;
  }
  return kept.append(text, done);
}

}  // namespace

PieceFiles read_pieces(const std::filesystem::path& path, Quads quads, const mpi::Communicator& ranks,
                       Workers& workers) {
  PieceFiles files;
  files.path = path;
  std::vector<char> bytes;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      const FileBytes read = read_file_bytes(path);
      bytes.assign(read.view().begin(), read.view().end());
    }
  });
  ranks.broadcast(bytes);
  files.bytes.assign(bytes.begin(), bytes.end());
  agree(ranks, [&] {
    files.file = read_parallel_file(path, files.bytes);
    const std::size_t count = files.file.pieces.size();
    for (std::size_t i = block_begin(count, ranks.rank(), ranks); i < block_begin(count, ranks.rank() + 1, ranks);
         ++i) {
      files.pieces.push_back(read_piece(files, i, quads, workers));
    }
  });
  find_arrays(files, ranks);
  return files;
}

std::vector<std::string> output_sources(const PieceFiles& files, const std::filesystem::path& output) {
  std::vector<std::string> sources;
  for (const PieceName& piece : files.file.pieces) {
    sources.push_back(piece.source);
  }
  if (is_same_file(files.path, output)) {
    return sources;
  }
  const std::string extension(extensions_of(files.file.piece_format).front());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    sources[i] = output.stem().string() + "_" + std::to_string(i) + extension;
  }
  return sources;
}

std::vector<std::filesystem::path> output_pieces(const PieceFiles& files, const std::filesystem::path& output) {
  std::vector<std::filesystem::path> pieces;
  for (const std::string& source : output_sources(files, output)) {
    pieces.push_back(piece_path(output, source));
  }
  return pieces;
}

void require_own_pieces(const PieceFiles& files, const std::filesystem::path& output, bool single) {
  if (is_same_file(files.path, output)) {
    return;
  }
  std::set<std::filesystem::path> read;
  for (std::size_t i = 0; i < files.file.pieces.size(); ++i) {
    read.insert(std::filesystem::weakly_canonical(files.path_of(i)));
  }
  if (single && read.contains(std::filesystem::weakly_canonical(output))) {
    throw std::invalid_argument(output.string() + " is a piece of the input; choose another name for the output");
  }
  if (single) {
    return;
  }
  for (const std::filesystem::path& target : output_pieces(files, output)) {
    if (read.contains(std::filesystem::weakly_canonical(target))) {
      throw std::invalid_argument(target.string() + " would be a piece of " + output.string() +
                                  " and is one of the input; choose another name for the output");
    }
  }
}

std::vector<std::string> drop_annotations(PieceFiles& files) {
  std::vector<std::string> names;
  for (const PieceArray::Of of : {PieceArray::Of::cells, PieceArray::Of::points}) {
    for (const PieceArray& array : files.arrays) {
      if (array.of == of && is_annotation(array.name)) {
        names.push_back(array.name);
      }
    }
  }
  std::erase_if(files.arrays, [](const PieceArray& array) { return is_annotation(array.name); });
  for (Piece& piece : files.pieces) {
    drop_annotations(piece.document);
  }
  return names;
}

void prepare_beside(const BesideOutput& beside, const PipelineResult& result, const mpi::Communicator& ranks) {
  agree(ranks, [&] {
    if (ranks.rank() == 0 && beside.prepare) {
      beside.prepare(result);
    }
  });
}

void write_pieces(PieceFiles& files, const std::filesystem::path& output, const mpi::Communicator& ranks,
                  Workers& workers, const std::function<const PipelineResult&()>& completed,
                  const BesideOutput& beside) {
  std::vector<std::unique_ptr<OutputFile>> written;
  agree(ranks, [&] {
    const std::vector<std::string> sources = output_sources(files, output);
    for (const Piece& piece : files.pieces) {
      const std::filesystem::path target = piece_path(output, sources[piece.number]);
      written.push_back(std::make_unique<OutputFile>(target));
      try {
        piece.document.original->write(written.back()->path(), piece.document, piece.added.point_arrays,
                                       piece.added.cell_arrays, workers);
      } catch (const WriteError& error) {
        throw WriteError(target, error.reason);  // which names the temporary file
      }
      written.back()->prepare();
    }
    if (ranks.rank() == 0) {
      written.push_back(std::make_unique<OutputFile>(output));
      write_text(*written.back(), output,
                 with_arrays(without_annotations(with_sources(files.bytes, files.file, sources), files.arrays),
                             files.pieces.front().added));
      written.back()->prepare();
    }
  });
  prepare_beside(beside, completed(), ranks);
  agree(ranks, [] { OutputFile::begin_commits(); });
  agree(ranks, [&] {
    if (ranks.rank() == 0 && beside.place) {
      beside.place();
    }
  });
  const std::size_t pieces = files.pieces.size();
  try {
    agree(ranks, [&] {
      for (std::size_t i = 0; i < pieces; ++i) {
        written[i]->commit();
      }
    });
    agree(ranks, [&] {
      if (ranks.rank() == 0) {
        written.back()->commit();
      }
    });
  } catch (...) {
    for (const std::unique_ptr<OutputFile>& file : written) {
      file->take_back();
    }
    throw;
  }
}

}  // namespace trismooth
