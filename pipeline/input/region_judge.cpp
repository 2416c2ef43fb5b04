#include "trismooth/pipeline/input/region_judge.h"

#include <algorithm>
#include <cmath>

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

/// "40 %"
std::string in_hundred(double fraction) {
  return std::to_string(std::llround(100 * fraction)) + " %";
}

class Judge {
 public:
  Judge(const TriangleValues& values, std::vector<std::string>& notes, const RegionWords& words)
      : values_(values), notes_(notes), words_(words) {}

  std::optional<RegionReason> known() {
    const std::optional<double> edges = edges_above(most_edges_of_known_names, values_);
    if (!edges) {
      return RegionReason::known_name;
    }
    notes_.push_back("the cell array '" + values_.name + "' changes across " + in_hundred(*edges) +
                     " of the edges between triangles: it is not taken for regions, what is between its values may "
                     "move; " +
                     words_.takes(values_.name) + " holds it");
    return std::nullopt;
  }

  std::optional<RegionReason> unknown() {
    const std::string& name = values_.name;
    if (const std::optional<double> edges = edges_above(most_edges_of_others, values_)) {
      if (*edges <= most_edges_of_known_names && !is_bookkeeping_name(name)) {
        leave_out("it changes across " + in_hundred(*edges) + " of the edges between triangles");
      }
    } else if (is_bookkeeping_name(name)) {
      leave_out("by its name it is for another purpose");
    } else if (!values_.are_whole()) {
      leave_out("it does not hold whole numbers");
    } else if (!is_few(values_.count(), values_.triangles)) {
      leave_out("its values are many for so few triangles");
    } else {
      notes_.push_back(array_with_count() + " looks like regions: the " + std::to_string(values_.vertices_between()) +
                       " vertices between them are held. If that is right, " + words_.takes(name) +
                       " says so; if not, " + words_.none + " frees them");
      return RegionReason::looks_like_regions;
    }
    return std::nullopt;
  }

 private:
  std::string array_with_count() const {
    return "the cell array '" + values_.name + "' (" + std::to_string(values_.count()) + " values)";
  }

  void leave_out(const std::string& why) {
    notes_.push_back(array_with_count() + " is not taken for regions, " + why +
                     ": what is between its values may move; " + words_.takes(values_.name) + " holds it");
  }

  const TriangleValues& values_;
  std::vector<std::string>& notes_;
  const RegionWords& words_;
};

}  // namespace

RegionWords program_words() {
  return {[](const std::string& array) { return "--region-array " + shell_word(array); }, "--region-array none"};
}

std::optional<RegionReason> judge_regions(const TriangleValues& values, std::vector<std::string>& notes,
                                          const RegionWords& words) {
  if (is_side_name(values.name)) {
    return std::nullopt;
  }
  const bool known = is_region_name(values.name);
  if (values.components != 1) {
    if (known) {
      notes.push_back("the cell array '" + values.name + "' has " + std::to_string(values.components) +
                      " components: it is not taken for regions");
    }
    return std::nullopt;
  }
  if (!values.differ()) {
    return std::nullopt;
  }
  Judge judge(values, notes, words);
  return known ? judge.known() : judge.unknown();
}

bool is_constant_region(const TriangleValues& values) {
  return is_region_name(values.name) && values.components == 1 && values.count() == 1;
}

}  // namespace trismooth
