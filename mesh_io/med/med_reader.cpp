// SPDX-License-Identifier: BSD-3-Clause
// MED files: /ENS_MAA/<mesh>/<step> has the nodes (NOE) and, by type, the elements (MAI), whose numbers stand axis by
// axis and node by node; /FAS/<mesh> the families and what groups each is in; /CHA the fields. Files before MED 3 have
// no steps.
#include "trismooth/mesh_io/med/med_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/cells/listed_groups.h"
#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/med/med_elements.h"
#include "trismooth/mesh_io/med/med_families.h"
#include "trismooth/mesh_io/med/med_fields.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// A family of nodes or of elements: what groups its members are in.
using FamilyGroups = std::map<std::int64_t, std::vector<std::string>>;

/// Groups in the order in which families name them first, with their members.
class GroupMembers {
 public:
  explicit GroupMembers(const FamilyGroups& families) {
    // From 0 on: the families of elements have numbers below it.
    std::vector<std::int64_t> numbers;
    for (const auto& [number, names] : families) {
      numbers.push_back(number);
    }
    std::ranges::sort(numbers, {}, [](std::int64_t number) {
      return std::pair(
          number < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(number) : static_cast<std::uint64_t>(number),
          number);
    });
    std::map<std::string_view, std::size_t> places;
    for (const std::int64_t number : numbers) {
      std::vector<std::size_t>& of_family = of_families_[number];
      for (const std::string& name : families.at(number)) {
        const auto [place, is_new] = places.try_emplace(name, groups.size());
        if (is_new) {
          groups.push_back({name, {}});
        }
        of_family.push_back(place->second);
      }
      std::ranges::sort(of_family);
      of_family.erase(std::unique(of_family.begin(), of_family.end()), of_family.end());
    }
  }

  std::vector<NamedSet> groups;

  /// Members from `first` on are of these families. Whether all of these are known; 0 always is.
  bool add(const std::vector<std::int64_t>& families, std::size_t first, MemberBudget& budget) {
    bool all_known = true;
    const std::vector<std::size_t>* of_family = nullptr;
    std::optional<std::int64_t> last;
    for (std::size_t i = 0; i < families.size(); ++i) {
      if (families[i] != last) {
        const auto found = of_families_.find(families[i]);
        of_family = found == of_families_.end() ? nullptr : &found->second;
        last = families[i];
        all_known = all_known && (of_family != nullptr || families[i] == 0);
      }
      if (of_family != nullptr) {
        budget.spend(of_family->size());
        for (const std::size_t group : *of_family) {
          groups[group].members.push_back(static_cast<std::int32_t>(first + i));
        }
      }
    }
    return all_known;
  }

 private:
  std::map<std::int64_t, std::vector<std::size_t>> of_families_;
};

class MedReader {
 public:
  MedReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), file_(path, bytes), budget_(path, bytes.size()) {}

  std::pair<MeshDocument, std::vector<Hdf5Column>> read() {
    choose_mesh();
    choose_step();
    read_nodes();
    read_elements();
    read_groups();
    MedFields fields = read_med_fields(file_, mesh_name_, blocks_, document_, budget_);
    std::ranges::move(fields.point_arrays, std::back_inserter(document_.point_arrays));
    std::ranges::move(fields.cell_arrays, std::back_inserter(document_.cell_arrays));
    std::ranges::move(fields.columns, std::back_inserter(columns_));
    std::ranges::move(fields.notes, std::back_inserter(document_.notes));
    return {std::move(document_), std::move(columns_)};
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(path_, message); }

  /// Of a group or a dataset, whose path is shown from the step on.
  [[noreturn]] void fail_at(std::string_view object, const std::string& message) const {
    object.remove_prefix(!step_.empty() && object.starts_with(step_) ? step_.size() + 1 : 0);
    fail(trismooth::quoted(object) + " " + message);
  }

  bool has(const std::string& object, Hdf5Kind kind) const { return file_.kind_of(object) == kind; }

  std::vector<std::string> groups_in(const std::string& group) const {
    std::vector<std::string> names;
    if (has(group, Hdf5Kind::group)) {
      for (Hdf5Member& member : file_.members(group)) {
        if (member.kind == Hdf5Kind::group) {
          names.push_back(std::move(member.name));
        }
      }
    }
    return names;
  }

  std::optional<std::int64_t> integer_attribute(const std::string& object, const std::string& name) const {
    if (!file_.has_attribute(object, name)) {
      return std::nullopt;
    }
    const std::vector<std::int64_t> values = file_.read_attribute<std::int64_t>(object, name);
    return values.size() == 1 ? std::optional(values[0]) : std::nullopt;
  }

  std::vector<std::int64_t> integers(const std::string& dataset) {
    budget_.spend(static_cast<std::size_t>(file_.shape_of(dataset).count()));
    return file_.read<std::int64_t>(dataset);
  }

  void choose_mesh() {
    std::vector<std::string> names = groups_in("/ENS_MAA");
    if (names.empty()) {
      fail("has no mesh (/ENS_MAA)");
    }
    mesh_name_ = names.front();
    mesh_ = "/ENS_MAA/" + mesh_name_;
    if (names.size() > 1) {
      names.erase(names.begin());
      document_.notes.push_back("The file has several meshes: " + mesh_name_ +
                                " is read, the others are kept in MED output only (" + list_text(names) + ").");
    }
    constexpr std::int64_t structured = 1;
    if (integer_attribute(mesh_, "TYP") == structured) {
      fail("the mesh " + trismooth::quoted(mesh_name_) + " is a structured grid, which is not read");
    }
    if (integer_attribute(mesh_, "REP").value_or(0) != 0) {
      fail("the coordinates of the mesh " + trismooth::quoted(mesh_name_) +
           " are cylindrical or spherical; write them in a rectangular system");
    }
  }

  /// Where the nodes are; other steps may have other elements, or fields alone.
  void choose_step() {
    if (has(mesh_ + "/NOE", Hdf5Kind::group)) {
      step_ = mesh_;
      return;
    }
    std::vector<std::string> steps;
    std::vector<std::string> others;
    for (const std::string& name : groups_in(mesh_)) {
      (has(mesh_ + "/" + name + "/NOE/COO", Hdf5Kind::dataset) ? steps : others).push_back(name);
    }
    if (steps.empty()) {
      fail("the mesh " + trismooth::quoted(mesh_name_) + " has no coordinates of nodes (NOE/COO)");
    }
    if (steps.size() > 1) {
      fail("the mesh " + trismooth::quoted(mesh_name_) + " has other coordinates at each of " +
           std::to_string(steps.size()) + " steps; one mesh that does not move in time is read");
    }
    step_ = mesh_ + "/" + steps.front();
    if (!others.empty()) {
      document_.notes.push_back(
          "Steps of the mesh without coordinates are kept in MED output only: " + list_text(others) + ".");
    }
  }

  void read_nodes() {
    const std::string coordinates = step_ + "/NOE/COO";
    if (!has(coordinates, Hdf5Kind::dataset)) {
      fail("the mesh " + trismooth::quoted(mesh_name_) + " has no coordinates of nodes (NOE/COO)");
    }
    const std::int64_t axes = integer_attribute(mesh_, "ESP").value_or(integer_attribute(mesh_, "DIM").value_or(0));
    if (axes != 2 && axes != 3) {
      fail("the mesh " + trismooth::quoted(mesh_name_) + " is in a space of " + std::to_string(axes) +
           " dimensions, expected 2 or 3");
    }
    const Hdf5Shape shape = file_.shape_of(coordinates);
    if (shape.type != ScalarType::float32 && shape.type != ScalarType::float64) {
      fail_at(coordinates, "expected numbers of 32 or 64 bits with a fraction");
    }
    budget_.spend(static_cast<std::size_t>(shape.count()));
    const std::vector<double> values = file_.read<double>(coordinates);
    const auto count_of_axes = static_cast<std::size_t>(axes);
    const std::size_t count = values.size() / count_of_axes;
    if (values.size() % count_of_axes != 0 || has_other_count(coordinates, count)) {
      fail_at(coordinates,
              std::to_string(values.size()) + " numbers are no " + std::to_string(axes) + " for each node");
    }
    require_room_for_indices(count, "nodes");
    document_.point_type = *shape.type;
    document_.points.resize(3 * count);
    for (std::size_t axis = 0; axis < count_of_axes; ++axis) {
      for (std::size_t i = 0; i < count; ++i) {
        document_.points[3 * i + axis] = values[axis * count + i];
      }
      columns_.push_back(
          hdf5_column(file_, coordinates, axis * count, count, {{.component = static_cast<std::uint8_t>(axis)}}));
    }
    const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
    if (bad != values.end()) {
      fail_at(coordinates, "node " + std::to_string(static_cast<std::size_t>(bad - values.begin()) % count + 1) +
                               " has a coordinate that is not a finite number");
    }
    if (const std::string numbers = step_ + "/NOE/NUM"; has(numbers, Hdf5Kind::dataset)) {
      std::vector<std::int64_t> labels = integers(numbers);
      if (labels.size() == count && !PointIds(labels).first_repeated()) {
        set_point_labels(document_, std::move(labels));
      }
    }
  }

  bool has_other_count(const std::string& dataset, std::size_t count) const {
    const auto stated = integer_attribute(dataset, "NBR");
    return stated && *stated != static_cast<std::int64_t>(count);
  }

  void require_room_for_indices(std::size_t count, const std::string& what) const {
    if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      fail("has more " + what + " than 32-bit indices can tell apart");
    }
  }

  void read_elements() {
    const std::vector<std::string> names = groups_in(step_ + "/MAI");
    for (const std::string& name : names) {
      if (find_med_element(name) == nullptr) {
        fail("has elements of the type " + trismooth::quoted(name) + ", which is not known");
      }
    }
    // In MED's order, whatever the one of the names is.
    for (const MedElement& element : med_elements()) {
      if (std::ranges::find(names, element.name) == names.end()) {
        continue;
      }
      const std::string group = step_ + "/MAI/" + std::string(element.name);
      const std::size_t first = document_.cells.size();
      if (!has(group + "/NOD", Hdf5Kind::dataset)) {
        fail_at(group, "has no nodes of its elements (NOD)");
      }
      element.nodes == 0 ? read_polygons(group) : read_elements_of(element, group);
      blocks_.push_back({std::string(element.name), group, first, document_.cells.size() - first});
    }
  }

  void read_elements_of(const MedElement& element, const std::string& group) {
    const std::string dataset = group + "/NOD";
    const std::vector<std::int64_t> nodes = integers(dataset);
    const std::size_t count = nodes.size() / element.nodes;
    if (nodes.size() % element.nodes != 0 || has_other_count(dataset, count)) {
      fail_at(dataset,
              std::to_string(nodes.size()) + " numbers are no " + std::to_string(element.nodes) + " for each element");
    }
    CellList& cells = document_.cells;
    require_room_for_indices(cells.size() + count, "elements");
    cells.connectivity.reserve(cells.connectivity.size() + nodes.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < element.nodes; ++k) {
        cells.connectivity.push_back(point_of(nodes[element.place(k) * count + i], dataset, i));
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
    }
    cells.types.insert(cells.types.end(), count, element.type);
  }

  void read_polygons(const std::string& group) {
    const std::string dataset = group + "/NOD";
    if (!has(group + "/INN", Hdf5Kind::dataset)) {
      fail_at(group, "has no list of where its polygons begin (INN)");
    }
    const std::vector<std::int64_t> nodes = integers(dataset);
    const std::vector<std::int64_t> begins = integers(group + "/INN");
    if (begins.empty() || begins.front() != 1 || begins.back() != std::ssize(nodes) + 1 ||
        !std::ranges::is_sorted(begins)) {
      fail_at(group + "/INN", "expected numbers that go from 1 up to one more than NOD has");
    }
    CellList& cells = document_.cells;
    require_room_for_indices(cells.size() + begins.size() - 1, "elements");
    for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
      const auto count = static_cast<std::size_t>(begins[i + 1] - begins[i]);
      if (count < 3) {
        fail_at(group + "/INN", "polygon " + std::to_string(i + 1) + " has fewer than 3 nodes");
      }
      for (std::int64_t k = begins[i]; k < begins[i + 1]; ++k) {
        cells.connectivity.push_back(point_of(nodes[static_cast<std::size_t>(k - 1)], dataset, i));
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
      cells.types.push_back(cell_type::polygon);
    }
  }

  std::int32_t point_of(std::int64_t node, const std::string& dataset, std::size_t element) const {
    const std::size_t count = document_.point_count();
    if (node < 1 || node > static_cast<std::int64_t>(count)) {
      fail_at(dataset, "element " + std::to_string(element + 1) + " names node " + std::to_string(node) +
                           "; the file has " + std::to_string(count) + " nodes, counted from 1");
    }
    return static_cast<std::int32_t>(node - 1);
  }

  /// The numbers of the families of `count` nodes or elements; empty where the file has none.
  std::vector<std::int64_t> families_in(const std::string& group, std::size_t count) {
    const std::string dataset = group + "/FAM";
    if (!has(dataset, Hdf5Kind::dataset)) {
      return {};
    }
    std::vector<std::int64_t> families = integers(dataset);
    if (families.size() != count) {
      fail_at(dataset, "has " + std::to_string(families.size()) + " families, expected one for each of " +
                           std::to_string(count));
    }
    return families;
  }

  FamilyGroups read_families(const std::string& all) {
    FamilyGroups families;
    for (const std::string& name : groups_in(all)) {
      std::string family = all + "/";
      family += name;
      const auto number = integer_attribute(family, "NUM");
      if (!number) {
        fail_at(family, "has no number (NUM)");
      }
      std::vector<std::string>& names = families[*number];
      if (const std::string groups = family + "/GRO/NOM"; has(groups, Hdf5Kind::dataset)) {
        const std::string texts = file_.read_bytes(groups);
        budget_.spend(texts.size() / med_group_name_size);
        if (texts.size() % med_group_name_size != 0) {
          fail_at(groups, "expected names of " + std::to_string(med_group_name_size) + " characters");
        }
        for (std::size_t at = 0; at < texts.size(); at += med_group_name_size) {
          std::string text = texts.substr(at, med_group_name_size);
          text.resize(std::min(text.find('\0'), text.size()));
          text.erase(text.find_last_not_of(' ') + 1);
          names.push_back(std::move(text));
        }
      }
    }
    return families;
  }

  void read_groups() {
    const std::string all = has(mesh_ + "/FAS", Hdf5Kind::group) ? mesh_ + "/FAS" : "/FAS/" + mesh_name_;
    bool all_known = true;
    GroupMembers of_nodes(read_families(all + "/NOEUD"));
    all_known &= of_nodes.add(families_in(step_ + "/NOE", document_.point_count()), 0, budget_);
    document_.point_sets = std::move(of_nodes.groups);
    GroupMembers of_elements(read_families(all + "/ELEME"));
    std::vector<std::int64_t> numbers(document_.cells.size());
    for (const MedBlock& block : blocks_) {
      const std::vector<std::int64_t> families = families_in(block.group, block.count);
      all_known &= of_elements.add(families, block.first, budget_);
      std::ranges::copy(families, numbers.begin() + static_cast<std::ptrdiff_t>(block.first));
    }
    std::vector<ListedGroup> listed;
    for (NamedSet& set : of_elements.groups) {
      listed.push_back({0, std::move(set.name), std::move(set.members)});
    }
    if (!add_listed_groups("med:group", std::move(listed), document_) &&
        std::ranges::any_of(numbers, [](std::int64_t number) { return number != 0; })) {
      // Families tell elements apart where no groups do.
      document_.cell_arrays.push_back(make_data_array("med:family", 1, std::move(numbers)));
    }
    read_numbers();
    if (!all_known) {
      document_.notes.emplace_back("Nodes or elements are of families that the file does not describe.");
    }
  }

  /// The numbers of elements where they do not count on from 1; 0 where there are none.
  void read_numbers() {
    std::vector<std::int64_t> numbers(document_.cells.size());
    bool count_on = true;
    for (const MedBlock& block : blocks_) {
      const std::string dataset = block.group + "/NUM";
      if (!has(dataset, Hdf5Kind::dataset)) {
        continue;
      }
      const std::vector<std::int64_t> own = integers(dataset);
      if (own.size() != block.count) {
        continue;
      }
      for (std::size_t i = 0; i < block.count; ++i) {
        numbers[block.first + i] = own[i];
        count_on = count_on && own[i] == static_cast<std::int64_t>(block.first + i) + 1;
      }
    }
    if (!count_on) {
      document_.cell_arrays.push_back(make_data_array("med:element_number", 1, std::move(numbers)));
    }
  }

  const std::filesystem::path& path_;
  Hdf5Reader file_;
  MemberBudget budget_;
  std::string mesh_name_;
  std::string mesh_;
  std::string step_;
  std::vector<MedBlock> blocks_;
  MeshDocument document_;
  std::vector<Hdf5Column> columns_;
};

}  // namespace

MeshDocument read_med(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& /*workers*/) {
  auto [document, columns] = MedReader(path, bytes).read();
  document.original = make_hdf5_original(std::move(bytes), document.point_count(), std::move(columns));
  return std::move(document);
}

}  // namespace trismooth
