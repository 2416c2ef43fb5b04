// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/label_array.h"
#include "trismooth/mesh_io/number_form.h"

namespace trismooth {

struct MeshDocument;
class Workers;

/// The file that a document was read from, as its codec keeps it to write it back with nothing lost.
class OriginalFile {
 public:
  OriginalFile() = default;
  OriginalFile(const OriginalFile&) = delete;
  OriginalFile& operator=(const OriginalFile&) = delete;
  virtual ~OriginalFile() = default;

  /// Writes the file that was read to `path`, with the coordinates of `document` in place of those that differ and
  /// with the arrays of `added_point_arrays` and `added_cell_arrays` added (where it takes_added_arrays() only). Where
  /// any is added, or the document has_stale_annotations, those of an earlier run (see annotation_names.h) are left out
  /// (where it takes_added_arrays(), likewise). All else is as it was read.
  /// Throws WriteError. The path is plain: no temporary, no renaming. The bytes are the same for every number of
  /// `workers`.
  virtual void write(const std::filesystem::path& path, const MeshDocument& document,
                     std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
                     Workers& workers) const = 0;

  /// Whether write() takes the values of that point array from the document, where they differ from those that were
  /// read; else it writes those that were read. Only arrays of floating point.
  virtual bool keeps_values_of(std::string_view point_array) const;

  /// The files that write() writes besides the one that is to be called `path`, to where OutputFile::place_of() says.
  virtual std::vector<std::filesystem::path> other_files(const std::filesystem::path& path) const;

  /// Whether write() can add arrays.
  virtual bool takes_added_arrays() const { return false; }

  /// write() on this thread alone.
  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays) const;
};

/// Points or cells that a file names together.
struct NamedSet {
  std::string name;
  std::vector<std::int32_t> members;  ///< from 0; a file may name one more than once

  bool operator==(const NamedSet&) const = default;
};

/// The one of MeshDocument::implied_sets that has the nodes of points of the geometry.
inline constexpr std::string_view points_of_geometry = "gmsh:points";

/// A mesh as its file states it: every point, cell and array in the file's order, nothing interpreted. Readers
/// guarantee what require_sound() asks for.
struct MeshDocument {
  FileFormat format = FileFormat::off;
  std::vector<double> points;                   ///< x, y, z of every point; exact, also where the file holds float32
  ScalarType point_type = ScalarType::float64;  ///< float32 or float64: holds every coordinate as the file stores it
  bool has_float32_axis = false;                ///< some of x, y, z are stored as float32, though point_type is float64
  bool is_geographic = false;                   ///< the file says that x and y are longitude and latitude, in degrees
  std::shared_ptr<const ArrayDescription> points_description;  ///< of the coordinates as an array; may be null
  CellList cells;
  std::vector<DataArray> point_arrays;  ///< a row for every point
  std::vector<DataArray> cell_arrays;   ///< a row for every cell
  std::vector<LabelArray> cell_labels;  ///< arrays of a text for every cell; the original alone keeps them
  std::vector<DataArray> field_arrays;  ///< of any length, of the whole mesh
  /// The original has annotations of an earlier run that show the mesh no more, and are not among the arrays here.
  bool has_stale_annotations = false;
  std::vector<NamedSet> point_sets;  ///< in the file's order: corners of Medit, NSETs of Abaqus, open boundaries
  /// The number that the file itself gives its first point: its label. Absent where points have no numbers in the file.
  std::optional<std::int64_t> first_point_label;
  /// The labels of all points; empty where they count on from the first.
  std::vector<std::int64_t> point_labels;
  /// Points that the file tells to be bound though no set of it names them: nodes of points and curves of the geometry,
  /// periodic ones. They hold where they are inside the mesh. Files of other formats do not get these sets.
  std::vector<NamedSet> implied_sets;
  /// Pairs of points that the file says are the same place of something that repeats itself, as the file lists them.
  std::vector<std::array<std::int32_t, 2>> periodic_pairs;
  std::vector<NamedSet> cell_sets;  ///< in the file's order; they may overlap
  /// Point arrays that say something of a place, not of a vertex (depths): where vertices move, values follow the mesh.
  std::vector<std::string> arrays_of_places;
  /// Characters that the file gives a coordinate at most; 0: any number. What is stored of one that moves is the
  /// nearest number that fits.
  std::size_t most_coordinate_characters = 0;
  NumberForm coordinate_form = NumberForm::usual;  ///< of those characters
  std::vector<std::string> notes;   ///< what the reader has to say about the file, one sentence each: among them
                                    ///< what only a file of the same format keeps
  std::vector<std::string> losses;  ///< what no file that is written from it gets, one sentence each
  std::shared_ptr<const OriginalFile> original;  ///< null for a document that was not read from a file

  /// Points.
  std::size_t point_count() const { return points.size() / 3; }
  /// What the coordinates of a point that is moved must be numbers of, so that the file can hold each: float32 where it
  /// stores any of x, y, z so.
  ScalarType moved_point_type() const { return has_float32_axis ? ScalarType::float32 : point_type; }
};

/// Throws MeshError, with what breaks it, unless the document keeps the rules that readers keep: three finite
/// coordinates a point, cells as CellList says, numbers of points and cells within range, and of every array, label
/// array and point label one a point or cell. For documents that a program has made or changed. Complexity: linear.
void require_sound(const MeshDocument& document);

}  // namespace trismooth
