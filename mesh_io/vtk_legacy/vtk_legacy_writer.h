#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Builds the parts of a legacy VTK file, ASCII or BINARY (big-endian), and hands them on in blocks.
class VtkLegacyOutput {
 public:
  using Sink = std::function<void(std::string_view)>;

  VtkLegacyOutput(bool binary, Sink sink) : binary_(binary), sink_(std::move(sink)) {}

  /// Text as it is, in both encodings.
  void text(std::string_view text);
  /// One number: in ASCII the shortest text that reads back to the same value, and `separator` behind it.
  template <class T>
  void number(T value, char separator);
  /// The end of a list of numbers.
  void end_numbers();
  /// A FIELD of the arrays, if there are any. Names that are empty, among `taken_names` or there twice give way to free
  /// ones.
  void field(std::span<const DataArray> arrays, std::span<const std::string> taken_names);
  /// The numbers of the array, and what its description says of it.
  void values(const DataArray& array);
  /// Hands on what is left.
  void flush();

 private:
  bool binary_;
  Sink sink_;
  std::string block_;
};

/// Writes the document to the plain path `path` as an UNSTRUCTURED_GRID of version 3.0 with every point, cell and
/// array, those with a role (SCALARS, VECTORS, ...) under its keyword: in ASCII, or in BINARY if an array holds NaN or
/// an infinity, which VTK cannot read from text. VTK's own reader gives back the same values bit for bit. Throws
/// WriteError.
void write_vtk_legacy(const std::filesystem::path& path, const MeshDocument& document);

}  // namespace trismooth
