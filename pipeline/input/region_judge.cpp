#include "trismooth/pipeline/input/region_judge.h"

#include <algorithm>

#include <fmt/format.h>

#include "trismooth/base/shell_words.h"
#include "trismooth/mesh_io/document/region_names.h"

namespace trismooth {

namespace {

constexpr double most_edges_of_known_names = 1.0 / 2;
constexpr double most_edges_of_others = 1.0 / 3;

bool is_few(std::int64_t values, std::int64_t triangles) {
  constexpr std::int64_t always_few = 10;
  constexpr std::int64_t triangles_a_value = 8;
  return values <= std::max(always_few, triangles / triangles_a_value);
}

/// The fraction of the inner edges across which the value changes, where it is above `most`, which is 1/3 or more.
std::optional<double> edges_above(double most, const TriangleValues& values) {
  // Few vertices have few edges between them: Euler's formula bounds these by three a vertex, and connected triangles
  // have about as many inner edges as triangles, at least. So the edges need not be found where interfaces are thin.
  if (9 * values.vertices_between() <= values.triangles) {
    return std::nullopt;
  }
  const double fraction = values.fraction_between();
  return fraction > most ? std::optional(fraction) : std::nullopt;
}

std::optional<RegionReason> judge_known(const TriangleValues& values, std::vector<std::string>& notes) {
  const std::optional<double> edges = edges_above(most_edges_of_known_names, values);
  if (!edges) {
    return RegionReason::known_name;
  }
  notes.push_back(fmt::format(
      "the cell array '{0}' changes across {1:.0f} % of the edges between triangles: it is not taken for regions, "
      "what is between its values may move; --region-array {2} holds it",
      values.name, 100 * *edges, shell_word(values.name)));
  return std::nullopt;
}

std::optional<RegionReason> judge_unknown(const TriangleValues& values, std::vector<std::string>& notes) {
  const std::string& name = values.name;
  const auto left_out = [&](const std::string& why) {
    notes.push_back(
        fmt::format("the cell array '{0}' ({1} values) is not taken for regions, {2}: what is between its values may "
                    "move; --region-array {3} holds it",
                    name, values.count(), why, shell_word(name)));
  };
  if (const std::optional<double> edges = edges_above(most_edges_of_others, values)) {
    if (*edges <= most_edges_of_known_names && !is_bookkeeping_name(name)) {
      left_out(fmt::format("it changes across {:.0f} % of the edges between triangles", 100 * *edges));
    }
  } else if (is_bookkeeping_name(name)) {
    left_out("by its name it is for another purpose");
  } else if (!values.are_whole()) {
    left_out("it does not hold whole numbers");
  } else if (!is_few(values.count(), values.triangles)) {
    left_out("its values are many for so few triangles");
  } else {
    notes.push_back(
        fmt::format("the cell array '{0}' ({1} values) looks like regions: the {2} vertices between them are held. If "
                    "that is right, --region-array {3} says so; if not, --region-array none frees them",
                    name, values.count(), values.vertices_between(), shell_word(name)));
    return RegionReason::looks_like_regions;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RegionReason> judge_regions(const TriangleValues& values, std::vector<std::string>& notes) {
  const bool known = is_region_name(values.name);
  if (values.components != 1) {
    if (known) {
      notes.push_back(fmt::format("the cell array '{}' has {} components: it is not taken for regions", values.name,
                                  values.components));
    }
    return std::nullopt;
  }
  if (!values.differ()) {
    return std::nullopt;
  }
  return known ? judge_known(values, notes) : judge_unknown(values, notes);
}

bool is_constant_region(const TriangleValues& values) {
  return is_region_name(values.name) && values.components == 1 && values.count() == 1;
}

}  // namespace trismooth
