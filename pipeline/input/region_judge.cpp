// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/region_judge.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/plain_name.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/shell_words.h"

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

/// How the user says that the array gives regions: the notes name it as the way out.
std::string option_for(const std::string& array) {
  return "--region-array " + shell_word(array);
}

/// Of one array that has different values.
class Judge {
 public:
  Judge(const TriangleValues& values, std::vector<std::string>& notes) : values_(values), notes_(notes) {}

  std::optional<RegionReason> known() {
    const std::optional<double> edges = edges_above(most_edges_of_known_names, values_);
    if (!edges) {
      return RegionReason::known_name;
    }
    notes_.push_back("the cell array '" + values_.name + "' changes across " + in_hundred(*edges) +
                     " of the edges between triangles: it is not taken for regions, what is between its values may "
                     "move; " +
                     option_for(values_.name) + " holds it");
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
    } else if (values_.count() == values_.triangles) {
      // Numbers of triangles that share no side.
    } else if (!values_.are_whole()) {
      leave_out("it does not hold whole numbers");
    } else if (!is_few(values_.count(), values_.triangles)) {
      leave_out("its values are many for so few triangles");
    } else {
      notes_.push_back(array_with_count() + " looks like regions: the " + std::to_string(values_.vertices_between()) +
                       " vertices between them are held. If that is right, " + option_for(name) +
                       " says so; if not, --region-array none frees them");
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
                     ": what is between its values may move; " + option_for(values_.name) + " holds it");
  }

  const TriangleValues& values_;
  std::vector<std::string>& notes_;
};

/// Why the array counts as one that gives regions; nothing where it does not.
std::optional<RegionReason> judge(const TriangleValues& values, std::vector<std::string>& notes) {
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
  Judge judge(values, notes);
  return known ? judge.known() : judge.unknown();
}

/// Whether the array has a region's name and the same value everywhere: for where no other counts.
bool is_constant_region(const TriangleValues& values) {
  return is_region_name(values.name) && values.components == 1 && values.count() == 1;
}

/// The places of all arrays of that name, or else of names that differ from it in case, blanks and the like.
std::vector<std::size_t> places_of(const std::string& name, std::span<const TriangleValues> arrays,
                                   const ArrayOwner& owner) {
  std::vector<std::size_t> places;
  const auto find = [&](const auto& same) {
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (same(arrays[i].name)) {
        places.push_back(i);
      }
    }
  };
  find([&](const std::string& other) { return other == name; });
  if (places.empty()) {
    find([plain = plain_name(name)](const std::string& other) { return plain_name(other) == plain; });
  }
  if (places.empty()) {
    const std::string known = list_text(arrays, &TriangleValues::name);
    throw std::invalid_argument(std::string(owner.has) + " no cell array '" + name + "' to take regions from; " +
                                std::string(owner.it_has) + ": " + (known.empty() ? "none" : known));
  }
  return places;
}

std::vector<std::size_t> places_of_all(std::span<const std::string> names, std::span<const TriangleValues> arrays,
                                       const ArrayOwner& owner) {
  std::vector<std::size_t> all;
  for (const std::string& name : names) {
    for (const std::size_t place : places_of(name, arrays, owner)) {
      if (arrays[place].components != 1) {
        throw std::invalid_argument("the cell array '" + arrays[place].name + "' has " +
                                    std::to_string(arrays[place].components) + " components; regions need one");
      }
      if (std::ranges::find(all, place) == all.end()) {
        all.push_back(place);
      }
    }
  }
  return all;
}

}  // namespace

void choose_regions(std::span<const TriangleValues> arrays, std::span<const std::string> names, std::string_view sizes,
                    const std::function<void(std::size_t, RegionReason)>& obey, std::vector<std::string>& notes,
                    const ArrayOwner& owner) {
  if (std::ranges::find(names, no_region_arrays) != names.end()) {
    if (names.size() > 1) {
      throw std::invalid_argument("--region-array none switches regions off; it cannot be given with other arrays");
    }
    return;
  }
  if (!names.empty()) {
    for (const std::size_t place : places_of_all(names, arrays, owner)) {
      obey(place, RegionReason::named);
    }
    return;
  }
  bool obeys_any = false;
  std::optional<std::size_t> constant;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const TriangleValues& array = arrays[i];
    if (is_annotation(array.name)) {
      continue;
    }
    if (!sizes.empty() && array.name == sizes) {
      if (std::vector<std::string> unsaid; judge(array, unsaid)) {
        notes.push_back("the cell array '" + array.name +
                        "' has sizes (--size-array), so it is not taken for regions: what is between its values may "
                        "move; " +
                        option_for(array.name) + " holds it");
      }
      continue;
    }
    if (const auto reason = judge(array, notes)) {
      obey(i, *reason);
      obeys_any = true;
    } else if (!constant && is_constant_region(array)) {
      constant = i;
    }
  }
  if (!obeys_any && constant) {
    obey(*constant, RegionReason::known_name);
  }
}

std::vector<std::string> tell_apart(std::vector<RegionName> names) {
  std::unordered_map<std::string, int> uses;
  for (const RegionName& name : names) {
    ++uses[name.plain];
  }
  std::vector<std::string> told;
  told.reserve(names.size());
  for (RegionName& name : names) {
    told.push_back(uses[name.plain] > 1 ? std::move(name.with_value) : std::move(name.plain));
  }
  return told;
}

}  // namespace trismooth
