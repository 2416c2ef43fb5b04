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
  }
}

/// All that a codec makes of the bytes, as text to compare: the document with every bit, or the error.
inline std::string reading_of(const trismooth::Codec& codec, const std::string& bytes,
                              const trismooth::FileWorkers& workers) {
  try {
    const trismooth::MeshDocument document = codec.read_shared("mesh", bytes, workers);
    std::string text;
    append_values(text, "points", document.points);
    append_values(text, "offsets", document.cells.offsets);
    append_values(text, "connectivity", document.cells.connectivity);
    append_values(text, "types", document.cells.types);
    append_arrays(text, "point array", document.point_arrays);
    append_arrays(text, "cell array", document.cell_arrays);
    append_arrays(text, "field array", document.field_arrays);
    for (const auto& sentences : {document.notes, document.losses}) {
      for (const std::string& sentence : sentences) {
        text.append(sentence).append("\n");
      }
    }
    return text;
  } catch (const trismooth::ReadError& error) {
    return std::string("error: ") + error.what();
  }
}

}  // namespace test_support
