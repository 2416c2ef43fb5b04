// SPDX-License-Identifier: BSD-3-Clause
// Selafin (Serafin) as TELEMAC writes it: a title, names of variables, ten parameters and a date, the elements, numbers
// of boundary nodes, x, y, then the variables of each time step.
#include "trismooth/mesh_io/selafin/selafin_reader.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/text/digits.h"
#include "trismooth/base/text/plain_name.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/cells/uniform_cells.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/document/last_step.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/selafin/selafin_names.h"
#include "trismooth/mesh_io/selafin/selafin_records.h"

namespace trismooth {

namespace {

class SelafinReader {
 public:
  SelafinReader(const std::filesystem::path& path, std::string_view bytes, std::endian order,
                const FileWorkers& workers)
      : records_(path, bytes, order == std::endian::big), is_big_(order == std::endian::big), workers_(workers) {}

  MeshDocument read(FileBytes bytes) {
    document_.format = FileFormat::selafin;
    document_.first_point_label = 1;
    read_head();
    read_elements();
    read_numbers_of_nodes();
    read_axis(0);
    read_axis(1);
    read_steps();
    document_.original = make_patched_original(std::move(bytes), std::move(sites_));
    return std::move(document_);
  }

 private:
  void read_head() {
    records_.next("title");
    const std::vector<std::int32_t> counts = records_.integers("numbers of variables", 2);
    if (counts[0] < 0 || counts[1] < 0) {
      records_.fail("has no numbers of variables");
    }
    const std::int64_t variables = std::int64_t{counts[0]} + counts[1];
    FreeNames taken;
    for (std::int64_t i = 0; i < variables; ++i) {
      const std::string_view text = records_.next("names of variables", selafin_name_size + selafin_unit_size, 1);
      const std::string name = without_blanks(text.substr(0, selafin_name_size));
      names_.push_back(taken.claim(name.empty() ? "variable " + std::to_string(i + 1) : name));
      units_.push_back(without_blanks(text.substr(selafin_name_size)));
    }
    constexpr std::size_t parameters = 10;
    const std::vector<std::int32_t> parameter = records_.integers("parameters", parameters);
    if (parameter[6] > 1) {
      fail_in_space(std::to_string(parameter[6]) + " planes");
    }
    is_piece_ = parameter[7] != 0 || parameter[8] != 0;
    if (parameter[2] != 0 || parameter[3] != 0) {
      document_.losses.push_back("The origin of the coordinates, (" + std::to_string(parameter[2]) + ", " +
                                 std::to_string(parameter[3]) + "), is kept in SELAFIN output and not added to them");
    }
    if (parameter[9] == 1) {
      records_.next("date");
    }
  }

  [[noreturn]] void fail_in_space(const std::string& what) const {
    records_.fail(
        "is a mesh of " + what +
        " (3D), which is not read: smooth the plane mesh that it was made from, the geometry file of the run");
  }

  static std::string without_blanks(std::string_view text) {
    std::string plain(text.substr(0, text.find('\0')));
    plain.erase(plain.find_last_not_of(' ') + 1);
    return plain.substr(std::min(plain.find_first_not_of(' '), plain.size()));
  }

  void read_elements() {
    constexpr std::size_t sizes = 4;
    const std::vector<std::int32_t> size = records_.integers("sizes", sizes);
    if (size[0] < 0 || size[1] < 0) {
      records_.fail("has no numbers of elements and nodes");
    }
    constexpr std::int32_t prism = 6;
    if (size[2] == prism) {
      fail_in_space("prisms");
    }
    if (size[2] != 3 && size[2] != 4) {
      records_.fail("has elements of " + std::to_string(size[2]) + " nodes; triangles and quadrilaterals are read");
    }
    points_ = static_cast<std::size_t>(size[1]);
    const auto count = static_cast<std::size_t>(size[0]);
    const auto nodes = static_cast<std::size_t>(size[2]);
    // The record is there before memory is asked for.
    const std::vector<std::int32_t> all = records_.integers("elements", static_cast<std::uint64_t>(count) * nodes);
    append_uniform_cells(document_.cells, nodes == 3 ? cell_type::triangle : cell_type::quad, nodes, count, workers_);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] < 1 || all[i] > size[1]) {
        records_.fail("element " + std::to_string(i / nodes + 1) + " names node " + std::to_string(all[i]) +
                      "; the file has " + std::to_string(points_) + ", counted from 1");
      }
      document_.cells.connectivity[i] = all[i] - 1;
    }
  }

  /// Along the boundary, which the mesh itself tells; of a piece, in the whole mesh.
  void read_numbers_of_nodes() {
    const std::vector<std::int32_t> numbers = records_.integers("numbers of boundary nodes", points_);
    if (!is_piece_) {
      return;
    }
    document_.notes.emplace_back(
        "The file is a piece of a mesh for a parallel run: nodes that other pieces have are on its border, and held.");
    std::vector<std::int64_t> labels(numbers.begin(), numbers.end());
    if (!PointIds(labels).first_repeated()) {
      set_point_labels(document_, std::move(labels));
    }
  }

  /// The type of real numbers: the title says it, too, but not of all files rightly.
  ScalarType type_of(std::string_view record, const std::string& what) const {
    if (record.size() != points_ * sizeof(float) && record.size() != points_ * sizeof(double)) {
      records_.fail("has " + std::to_string(record.size()) + " bytes of " + what + ", expected 4 or 8 for each of " +
                    std::to_string(points_) + " nodes");
    }
    return record.size() == points_ * sizeof(float) ? ScalarType::float32 : ScalarType::float64;
  }

  template <class Function>
  void for_each_number(std::string_view record, ScalarType type, const Function& function) const {
    for (std::size_t i = 0; i < points_; ++i) {
      function(i, type == ScalarType::float32
                      ? static_cast<double>(records_.load_number<float>(record.substr(i * sizeof(float))))
                      : records_.load_number<double>(record.substr(i * sizeof(double))));
    }
  }

  void add_sites(std::string_view record, ScalarType type, SiteColumn column) {
    sites_.push_back(
        binary_sites(binary_encoding(is_big_), type, records_.offset_of(record), points_, {std::move(column)}));
  }

  void read_axis(std::size_t axis) {
    const std::string what = axis == 0 ? "x" : "y";
    const std::string_view record = records_.next(what);
    const ScalarType type = type_of(record, what);
    if (axis == 0) {
      document_.points.resize(3 * points_);
      document_.point_type = type;
    } else if (type != document_.point_type) {
      records_.fail("has x and y of different sizes");
    }
    for_each_number(record, type, [&](std::size_t i, double value) {
      if (!std::isfinite(value)) {
        records_.fail("node " + std::to_string(i + 1) + " has a coordinate that is no finite number");
      }
      document_.points[3 * i + axis] = value;
    });
    add_sites(record, type, {.component = static_cast<std::uint8_t>(axis)});
  }

  void read_steps() {
    std::size_t steps = 0;
    double time = 0;
    std::vector<std::string_view> values(names_.size());
    while (!records_.at_end()) {
      const std::string step = "time step " + std::to_string(++steps);
      const std::string_view record = records_.next("time of " + step);
      if (record.size() != sizeof(float) && record.size() != sizeof(double)) {
        records_.fail("has no time of " + step + ": it is damaged");
      }
      time = record.size() == sizeof(float) ? static_cast<double>(records_.load_number<float>(record))
                                            : records_.load_number<double>(record);
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = records_.next(names_[i] + " in " + step);
        type_of(values[i], names_[i] + " in " + step);
      }
    }
    if (steps == 0) {
      return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      add_array(i, values[i], steps == 1);
    }
    if (steps > 1 && !values.empty()) {
      document_.notes.push_back(note_of_last_step("Values at nodes", steps, time, "SELAFIN"));
    }
  }

  void add_array(std::size_t variable, std::string_view record, bool is_only_step) {
    const ScalarType type = type_of(record, names_[variable]);
    visit_scalar_type(type, [&](auto zero) {
      std::vector<decltype(zero)> numbers(points_);
      for_each_number(record, type,
                      [&](std::size_t i, double value) { numbers[i] = static_cast<decltype(zero)>(value); });
      document_.point_arrays.push_back(make_data_array(names_[variable], 1, std::move(numbers)));
    });
    set_unit(document_.point_arrays.back(), units_[variable]);
    if (is_only_step) {
      add_sites(record, type, {names_[variable], 0});
    }
    if (is_selafin_place_value(names_[variable])) {
      document_.arrays_of_places.push_back(names_[variable]);
    }
  }

  SelafinRecords records_;
  bool is_big_;
  const FileWorkers& workers_;
  MeshDocument document_;
  std::vector<std::string> names_;
  std::vector<std::string> units_;
  std::size_t points_ = 0;
  bool is_piece_ = false;
  std::vector<NumberSites> sites_;
};

}  // namespace

std::optional<std::endian> selafin_byte_order(std::string_view bytes) {
  constexpr std::size_t title = 80;
  constexpr std::size_t marker = 4;
  constexpr std::size_t looked_at = title + 3 * marker;
  if (bytes.size() < looked_at) {
    return std::nullopt;
  }
  const auto begins = [bytes](auto load_at) {
    return load_at(bytes.data()) == title && load_at(bytes.data() + marker + title) == title &&
           load_at(bytes.data() + title + 2 * marker) == 2 * marker;
  };
  if (begins(&load<std::endian::big, std::uint32_t>)) {
    return std::endian::big;
  }
  return begins(&load<std::endian::little, std::uint32_t>) ? std::optional(std::endian::little) : std::nullopt;
}

MeshDocument read_selafin(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const std::string_view view = bytes;
  const auto order = selafin_byte_order(view);
  if (!order) {
    throw ReadError(path, "does not begin as SELAFIN does, with a title of 80 characters and numbers of variables");
  }
  return SelafinReader(path, view, *order, workers).read(std::move(bytes));
}

}  // namespace trismooth
