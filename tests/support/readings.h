// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"

#include "support/memory_file.h"

namespace test_support {

template <class T>
void append_values(std::string& text, std::string_view name, const std::vector<T>& values) {
  text.append(name).append(" ").append(std::to_string(values.size())).append(":");
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)).append("\n");
}

inline void append_arrays(std::string& text, std::string_view name, const std::vector<trismooth::DataArray>& arrays) {
  for (const trismooth::DataArray& array : arrays) {
    text.append(name).append(" ").append(array.name).append(" ").append(to_string(array.type));
    text.append(" ").append(std::to_string(array.components)).append(":");
    text.append(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size()).append("\n");
    if (array.description != nullptr) {
      for (const trismooth::ValueName& value : array.description->value_names) {
        text.append(std::to_string(value.value)).append(" of dimension ").append(std::to_string(value.dimension));
        text.append(" is ").append(value.name).append("\n");
      }
    }
  }
}

inline void append_sets(std::string& text, std::string_view name, const std::vector<trismooth::NamedSet>& sets) {
  for (const trismooth::NamedSet& set : sets) {
    append_values(text, std::string(name).append(" ").append(set.name), set.members);
  }
}

/// The document with every bit, as text to compare.
inline std::string all_of(const trismooth::MeshDocument& document) {
  std::string text(to_string(document.point_type));
  text.append(document.has_float32_axis ? " and float32\n" : "\n");
  append_values(text, "points", document.points);
  append_values(text, "offsets", document.cells.offsets);
  append_values(text, "connectivity", document.cells.connectivity);
  append_values(text, "types", document.cells.types);
  append_arrays(text, "point array", document.point_arrays);
  append_arrays(text, "cell array", document.cell_arrays);
  append_arrays(text, "field array", document.field_arrays);
  append_sets(text, "point set", document.point_sets);
  append_sets(text, "cell set", document.cell_sets);
  for (const auto& sentences : {document.notes, document.losses}) {
    for (const std::string& sentence : sentences) {
      text.append(sentence).append("\n");
    }
  }
  return text;
}

/// What is written where every coordinate has moved: shows where the reader found each of them.
inline std::string moved(trismooth::MeshDocument document) {
  const bool is_float = document.moved_point_type() == trismooth::ScalarType::float32;
  for (std::size_t i = 0; i < document.points.size(); ++i) {
    const double value = -document.points[i] - 1 - static_cast<double>(i);
    document.points[i] = is_float ? static_cast<double>(static_cast<float>(value)) : value;
  }
  const MemoryFile file;
  document.original->write(file.path(), document, {}, {});
  return file.bytes();
}

template <class Describe>
std::string reading_as(const trismooth::Codec& codec, const std::string& bytes, const trismooth::FileWorkers& workers,
                       const Describe& describe) {
  try {
    return describe(codec.read_shared("mesh", bytes, workers));
  } catch (const trismooth::ReadError& error) {
    return std::string("error: ") + error.what();
  }
}

/// All that a codec makes of the bytes, as text to compare: the document with every bit, or the error.
inline std::string reading_of(const trismooth::Codec& codec, const std::string& bytes,
                              const trismooth::FileWorkers& workers) {
  return reading_as(codec, bytes, workers, &all_of);
}

/// The same, and where in the bytes the coordinates were found, of a format that is written back byte by byte.
inline std::string reading_and_sites_of(const trismooth::Codec& codec, const std::string& bytes,
                                        const trismooth::FileWorkers& workers) {
  return reading_as(codec, bytes, workers,
                    [](const trismooth::MeshDocument& document) { return all_of(document) + moved(document); });
}

}  // namespace test_support
