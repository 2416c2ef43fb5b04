// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "support/format_sample.h"
#include "support/small_selafin.h"

namespace accepted_files {

namespace {

using test_support::SmallSelafin;

/// How a Selafin file has the mesh.
struct SelafinSpelling {
  bool is_big = true;
  std::size_t real_size = 4;
  std::vector<std::string> variables = {};
  std::size_t steps = 0;
  bool has_date = false;
  bool is_piece = false;
};

std::string selafin_file(const SelafinSpelling& spelling) {
  const Mesh plate = mesh(false);
  SmallSelafin file(spelling.is_big, spelling.real_size);
  std::vector<std::int32_t> parameters{1, 0, 100, 200, 0, 0, 0, 0, 0, spelling.has_date ? 1 : 0};
  if (spelling.is_piece) {
    parameters[7] = 4;
    parameters[8] = 2;
  }
  file.head(spelling.variables, parameters);
  std::vector<std::int32_t> nodes;
  for (const auto& face : plate.faces) {
    for (const int vertex : face) {
      nodes.push_back(vertex + 1);
    }
  }
  file.integers({static_cast<std::int32_t>(plate.faces.size()), static_cast<std::int32_t>(plate.points.size()), 3, 1});
  file.integers(nodes);
  file.integers(spelling.is_piece ? std::vector<std::int32_t>{7, 9, 2, 4, 5}
                                  : std::vector<std::int32_t>{1, 2, 3, 4, 0});
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (const auto& point : plate.points) {
      values.push_back(point.at(axis));
    }
    file.reals(values);
  }
  for (std::size_t step = 0; step < spelling.steps; ++step) {
    file.reals({0.5 * static_cast<double>(step)});
    for (std::size_t i = 0; i < spelling.variables.size(); ++i) {
      const double first = static_cast<double>(10 * i + step);
      file.reals({first, first + 1, first + 2, first + 3, first + 4.5});
    }
  }
  return file.bytes();
}

void add_selafin(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, const SelafinSpelling& spelling) {
    files.push_back({"selafin_" + name, ".slf", selafin_file(spelling)});
  };
  add("big_endian", {});
  add("double_big_endian", {.real_size = 8});
  add("little_endian", {.is_big = false});
  add("bottom", {.variables = {"BOTTOM          M"}, .steps = 1});
  add("steps",
      {.real_size = 8, .variables = {"VELOCITY U      M/S", "WATER DEPTH     M"}, .steps = 2, .has_date = true});
  add("piece", {.is_piece = true});
}

/// A file may end behind y, and behind each time step.
bool is_whole_selafin(const AcceptedFile& file, std::size_t cut) {
  const std::vector<std::size_t> ends = SmallSelafin::ends_of_records(file.bytes);
  const bool has_steps = file.name == "selafin_steps";
  const std::size_t variables = has_steps ? 2 : file.name == "selafin_bottom" ? 1 : 0;
  const std::size_t head = 8 + variables + (has_steps ? 1 : 0);
  for (std::size_t i = head - 1; i < ends.size(); i += 1 + variables) {
    if (ends[i] == cut) {
      return true;
    }
  }
  return false;
}

}  // namespace

FormatSample selafin_sample() {
  return {
      .format = trismooth::FileFormat::selafin,
      .add_files = &add_selafin,
      .is_whole = &is_whole_selafin,
      // Values are those of the last step that is whole.
      .rest_of =
          [](const AcceptedFile& file) { return file.name == "selafin_steps" ? Rest::another_mesh : Rest::all_cells; },
      .cells = {{cell_type::triangle}},
      .written_point =
          [](const std::array<double, 3>& point) {
            return std::array<double, 3>{point[0], point[1], 0};
          }};
}

}  // namespace accepted_files
