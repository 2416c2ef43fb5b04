// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/point_sets.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/plain_name.h"
#include "trismooth/pipeline/input/marked_points.h"
#include "trismooth/pipeline/input/set_labels.h"
#include "trismooth/pipeline/input/value_numbers.h"
#include "trismooth/pipeline/shell_words.h"

namespace trismooth {

namespace {

/// The members, each once.
std::vector<std::int32_t> different_members(const NamedSet& set) {
  std::vector<std::int32_t> members = set.members;
  if (!std::ranges::is_sorted(members)) {
    std::ranges::sort(members);
  }
  members.erase(std::unique(members.begin(), members.end()), members.end());
  return members;
}

void add_quoted(std::string& list, const std::string& name) {
  list.append(list.empty() ? "'" : ", '").append(name).append("'");
}

std::vector<const DataArray*> marker_arrays(const MeshDocument& document) {
  std::vector<const DataArray*> arrays;
  for (const DataArray& array : document.point_arrays) {
    if (may_be_markers(array.name, array.type, array.components)) {
      arrays.push_back(&array);
    }
  }
  return arrays;
}

/// The number of the value 0 of an array whose rows were numbered, or -1.
std::int32_t number_of_zero(const DataArray& array, const ValueNumbers& numbers) {
  const auto zero = std::ranges::find_if(
      numbers.example, [&](std::int32_t row) { return array.value(static_cast<std::size_t>(row)) == 0; });
  return zero == numbers.example.end() ? -1 : static_cast<std::int32_t>(zero - numbers.example.begin());
}

/// The neighbours of the vertices that are asked for.
class InnerNeighbours {
 public:
  /// Of the vertices whose flag in `wanted` is 1.
  InnerNeighbours(const ElementList& elements, std::span<const std::uint8_t> wanted)
      : starts_(wanted.size() + 1, 0), ends_(wanted.size(), 0) {
    const auto is_wanted = [wanted](std::int32_t v) { return wanted[v] != 0; };
    for (const auto corners : elements) {
      for (const std::int32_t v : corners) {
        starts_[static_cast<std::size_t>(v) + 1] += is_wanted(v) ? 2 : 0;
      }
    }
    for (std::size_t v = 0; v < wanted.size(); ++v) {
      starts_[v + 1] += starts_[v];
      ends_[v] = starts_[v];
    }
    neighbours_.resize(starts_.back());
    for (const auto corners : elements) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (is_wanted(corners[i])) {
          std::int64_t& end = ends_[corners[i]];
          neighbours_[static_cast<std::size_t>(end++)] = next_corner(corners, i);
          neighbours_[static_cast<std::size_t>(end++)] = previous_corner(corners, i);
        }
      }
    }
    for (std::size_t v = 0; v < wanted.size(); ++v) {
      keep_inner(v);
    }
  }

  /// The neighbours of a wanted vertex, each once; none where it is not inside the mesh.
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(neighbours_)
        .subspan(static_cast<std::size_t>(starts_[v]), static_cast<std::size_t>(ends_[v] - starts_[v]));
  }

 private:
  /// Keeps one of the two times that each neighbour is there; nothing where one is there another number of times.
  void keep_inner(std::size_t v) {
    const auto begin = neighbours_.begin() + starts_[v];
    const auto end = neighbours_.begin() + ends_[v];
    std::sort(begin, end);
    auto kept = begin;
    ends_[v] = starts_[v];
    for (auto next = begin; next != end; next += 2) {
      if (*next != *(next + 1) || (kept != begin && *(kept - 1) == *next)) {
        return;
      }
      *kept++ = *next;
    }
    ends_[v] += kept - begin;
  }

  std::vector<std::int64_t> starts_;
  std::vector<std::int64_t> ends_;
  std::vector<std::int32_t> neighbours_;
};

class SetFinder {
 public:
  SetFinder(const MeshDocument& document, const ElementList& elements, std::span<const std::int32_t> regions,
            bool slides)
      : document_(document), slides_(slides) {
    for (const auto& sets : {std::span(document.point_sets), std::span(document.implied_sets)}) {
      for (const NamedSet& set : sets) {
        members_.push_back(different_members(set));
        names_.push_back(set.name);
      }
    }
    const std::vector<std::int32_t> regions_inside = find_marked_sets(elements, regions);
    std::vector<std::uint8_t> in_set(document.point_count(), 0);
    for (const std::vector<std::int32_t>& members : members_) {
      for (const std::int32_t v : members) {
        in_set[v] = 1;
      }
    }
    const InnerNeighbours neighbours(elements, in_set);
    keep_inner_points(neighbours, regions_inside);
    // Which set was the last to have the vertex: no set clears what the one before it has marked.
    std::vector<std::int32_t> last_set(document.point_count(), -1);
    for (std::size_t s = 0; s < document.point_sets.size(); ++s) {
      const auto number = static_cast<std::int32_t>(s);
      for (const std::int32_t v : members_[s]) {
        last_set[v] = number;
      }
      const bool is_area = std::ranges::any_of(members_[s], [&](std::int32_t v) {
        const auto around = neighbours[v];
        return !around.empty() &&
               std::ranges::all_of(around, [&](std::int32_t neighbour) { return last_set[neighbour] == number; });
      });
      found_.sets.push_back({names_[s], std::ssize(members_[s]), is_area, false});
    }
    for (std::size_t s = document.point_sets.size(); s < members_.size(); ++s) {
      found_.sets.push_back({names_[s], std::ssize(members_[s])});
    }
  }

  HeldSets by_names(std::span<const std::string> names) {
    const std::size_t implied_end = members_.size();  // what is named may be a set of its own, behind these
    for (const std::string& name : names) {
      for (const std::size_t set : named(name)) {
        hold(set);
      }
    }
    if (!names.empty()) {
      tell_of_points_let_go(implied_end);
    }
    return finished();
  }

  HeldSets by_document() {
    std::string areas;
    std::string first_area;
    for (std::size_t s = 0; s < found_.sets.size(); ++s) {
      const FilePointSet& set = found_.sets[s];
      if (!set.is_area) {
        hold(s);
        continue;
      }
      add_quoted(areas, set.name);
      first_area = first_area.empty() ? set.name : first_area;
    }
    if (!areas.empty()) {
      found_.notes.push_back("point sets that cover an area hold nothing: " + areas + "; --fixed-set " +
                             shell_word(first_area) + " holds the vertices of one");
    }
    std::ranges::move(marker_notes_, std::back_inserter(found_.notes));
    return finished();
  }

 private:
  /// Adds what arrays of markers mark. The region of each vertex that nothing else of the mesh holds, where there are
  /// implied sets or such arrays.
  std::vector<std::int32_t> find_marked_sets(const ElementList& elements, std::span<const std::int32_t> regions) {
    const std::vector<const DataArray*> arrays = marker_arrays(document_);
    if (document_.implied_sets.empty() && arrays.empty()) {
      return {};
    }
    std::vector<std::uint8_t> is_held(document_.point_count(), 0);
    for (std::size_t cell = 0; cell < document_.cells.size(); ++cell) {
      if (cell_type::dimension(document_.cells.types[cell]) < 2) {
        for (const std::int32_t v : document_.cells[cell]) {
          is_held[v] = 1;
        }
      }
    }
    const std::string ids =
        document_.first_point_label ? "a file of --fixed-ids or --fixed-labels" : "a file of --fixed-ids";
    std::vector<std::int32_t> inside = find_regions_inside(elements, regions, is_held);
    for (const DataArray* const array : arrays) {
      std::vector<std::int32_t> rows(document_.point_count());
      std::iota(rows.begin(), rows.end(), 0);
      const ValueNumbers markers = number_values(*array, rows);
      MarkedPoints marked = find_marked_points(elements, markers.of_item, number_of_zero(*array, markers), inside);
      std::ranges::move(notes_of_marked_points(array->name, marked, ids), std::back_inserter(marker_notes_));
      members_.push_back(std::move(marked.vertices));
      names_.push_back(array->name);
    }
    return inside;
  }

  /// Tells of points of implied sets, which end before `implied_end`, that would be held if no set were named.
  void tell_of_points_let_go(std::size_t implied_end) {
    for (std::size_t s = document_.point_sets.size(); s < implied_end; ++s) {
      const auto free = std::ranges::count_if(
          members_[s], [this](std::int32_t v) { return found_.flags.empty() || found_.flags[v] == 0; });
      if (free > 0) {
        found_.notes.push_back(counted(free, "point", "points") + " of '" + names_[s] +
                               "' may move, since other sets are named; --fixed-set " + shell_word(names_[s]) +
                               " beside these holds " + (free == 1 ? "it" : "them"));
      }
    }
  }

  /// Leaves the implied sets what nothing else of the mesh holds.
  void keep_inner_points(const InnerNeighbours& neighbours, std::span<const std::int32_t> regions_inside) {
    for (std::size_t s = document_.point_sets.size(); s < members_.size(); ++s) {
      // (Who slides may be held by nothing else. On curves and at periodic sides they slide.)
      if (slides_ && names_[s] == points_of_geometry) {
        continue;
      }
      std::erase_if(members_[s], [&](std::int32_t v) { return neighbours[v].empty() || regions_inside[v] < 0; });
    }
  }

  /// Tells of sets of the file without points, and has no implied ones.
  HeldSets finished() {
    std::string names;
    for (std::size_t s = 0; s < document_.point_sets.size(); ++s) {
      if (members_[s].empty()) {
        add_quoted(names, found_.sets[s].name);
      }
    }
    if (!names.empty()) {
      found_.notes.push_back("point sets without points hold nothing: " + names);
    }
    const auto first_implied = found_.sets.begin() + std::ssize(document_.point_sets);
    found_.sets.erase(
        std::remove_if(first_implied, found_.sets.end(), [](const FilePointSet& set) { return set.vertices == 0; }),
        found_.sets.end());
    return std::move(found_);
  }

  /// All sets of that name, or else the points of that label, or sets of names that differ in case, blanks and the
  /// like, or the points of the value that alone has that name.
  std::vector<std::size_t> named(const std::string& name) {
    std::vector<std::size_t> found;
    const auto find = [&](const auto& same) {
      for (std::size_t s = 0; s < found_.sets.size(); ++s) {
        if (same(found_.sets[s].name)) {
          found.push_back(s);
        }
      }
    };
    find([&](const std::string& other) { return other == name; });
    const std::vector<std::string> arrays = label_arrays(document_);
    if (const auto label = found.empty() ? find_label(arrays, name) : std::nullopt) {
      return {labelled(*label)};
    }
    if (found.empty()) {
      find([plain = plain_name(name)](const std::string& other) { return plain_name(other) == plain; });
    }
    if (found.empty()) {
      const std::vector<SetLabel> meant = meant_by(arrays, name);
      if (is_bare_label(name, meant)) {
        return {labelled(meant.front())};
      }
      std::vector<std::string> names = names_;
      std::ranges::move(names_of_values(document_), std::back_inserter(names));
      throw complain_of_set(name, names, arrays, meant);
    }
    return found;
  }

  /// The values of that name, of all arrays.
  std::vector<SetLabel> meant_by(std::span<const std::string> arrays, const std::string& name) const {
    std::vector<SetLabel> meant;
    for (const std::string& array : arrays) {
      const std::vector<std::uint8_t> flags = points_of_label(document_, {array, name});
      if (std::ranges::find(flags, 1) != flags.end()) {
        meant.push_back({array, name});
      }
    }
    return meant;
  }

  /// The set of the points of a label, which is a new one where it has not been asked for before.
  std::size_t labelled(const SetLabel& label) {
    const auto known = std::ranges::find(names_, label.name());
    if (known != names_.end()) {
      return static_cast<std::size_t>(known - names_.begin());
    }
    const std::vector<std::uint8_t> flags = points_of_label(document_, label);
    std::vector<std::int32_t> members;
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (flags[v] != 0) {
        members.push_back(static_cast<std::int32_t>(v));
      }
    }
    if (members.empty()) {
      throw complain_of_value(label, label_values(document_, label.array));
    }
    found_.sets.push_back({label.name(), std::ssize(members)});
    names_.push_back(label.name());
    members_.push_back(std::move(members));
    return names_.size() - 1;
  }

  void hold(std::size_t set) {
    found_.sets[set].holds = !members_[set].empty();
    if (!members_[set].empty()) {
      found_.flags.resize(document_.point_count(), 0);
    }
    for (const std::int32_t v : members_[set]) {
      found_.flags[v] = 1;
    }
  }

  const MeshDocument& document_;
  bool slides_;
  /// Of each set of the document, then of each implied one, of each array of markers and each label, each once.
  std::vector<std::vector<std::int32_t>> members_;
  std::vector<std::string> names_;         ///< of each of these
  std::vector<std::string> marker_notes_;  ///< what the user should know where markers count
  HeldSets found_;
};

}  // namespace

bool holds_no_sets(std::span<const std::string> names) {
  const bool holds_none = std::ranges::find(names, no_sets) != names.end();
  if (holds_none && names.size() > 1) {
    throw std::invalid_argument("--fixed-set none holds no sets; it cannot be given with other sets");
  }
  return holds_none;
}

HeldSets find_held_sets(const MeshDocument& document, const ElementList& elements, std::span<const std::string> names,
                        std::span<const std::int32_t> regions, bool slides) {
  const bool holds_none = holds_no_sets(names);
  if (document.point_sets.empty() && document.implied_sets.empty() && marker_arrays(document).empty() &&
      (names.empty() || holds_none)) {
    return {};
  }
  SetFinder finder(document, elements, regions, slides);
  if (holds_none) {
    return finder.by_names({});
  }
  return names.empty() ? finder.by_document() : finder.by_names(names);
}

std::vector<FileCellSet> summarise_cell_sets(const MeshDocument& document) {
  std::vector<FileCellSet> sets;
  for (const NamedSet& set : document.cell_sets) {
    sets.push_back({set.name, std::ssize(different_members(set))});
  }
  return sets;
}

}  // namespace trismooth
