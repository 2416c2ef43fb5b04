// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_reader.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_data.h"
#include "trismooth/mesh_io/msh/msh_elements.h"
#include "trismooth/mesh_io/msh/msh_periodic.h"
#include "trismooth/mesh_io/ranges/msh_range.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

namespace {

bool has_msh_label(const std::vector<std::int32_t>& values) {
  return std::ranges::any_of(values, [](std::int32_t value) { return value != 0; });
}

constexpr int any_dimension = -1;  // of a name in files of version 2.0

class MshReader {
 public:
  MshReader(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers, MshLayout& layout)
      : input_(bytes, path), rows_(input_, workers), layout_(layout) {}

  MeshDocument read() {
    while (find_section()) {
      read_section();
    }
    if (!has_nodes_) {
      throw ReadError(input_.path(), "is not an MSH file, or is cut off: it has no section $Nodes");
    }
    if (!has_elements_) {
      throw ReadError(input_.path(), "is cut off: it has no section $Elements");
    }
    layout_.header = input_.header();
    add_cell_arrays();
    add_cell_sets();
    add_implied_sets();
    for (const MshDataSection& section : data_) {
      read_msh_data(input_, rows_, section, nodes_, elements_, section.of_nodes ? point_names_ : cell_names_, document_,
                    layout_.data);
    }
    add_notes();
    layout_.nodes = std::move(nodes_.lists);
    layout_.cell_count = document_.cells.size();
    layout_.node_tags = std::move(nodes_.tags);
    layout_.node_tags.drop_table();
    layout_.element_tags = std::move(elements_.tags);
    layout_.element_tags.drop_table();
    layout_.element_cells = std::move(elements_.cells);
    return std::move(document_);
  }

 private:
  /// Goes to the next line that names a section. Lines between sections are nobody's.
  bool find_section() {
    TextScanner& text = input_.text();
    while (!text.at_end()) {
      const std::size_t begin = text.offset();
      const std::string_view line = trimmed(text.next_line());
      if (line.starts_with('$')) {
        section_begin_ = begin;
        section_ = std::string(trimmed(line.substr(1)));
        return true;
      }
      if (!has_header_ && !has_nodes_) {
        input_.fail_at(begin, "is not an MSH file: expected $MeshFormat, got " + quoted(line));
      }
    }
    return false;
  }

  void read_section() {
    if (section_ == "MeshFormat") {
      read_header();
    } else if (section_ == "Comments") {
      skip_section();
      return;
    } else if (!read_known_section()) {
      if (section_ == "Periodic" && has_nodes_) {
        read_periodic();
      }
      kept_sections_.push_back(section_);
      skip_section();
      return;
    }
    require_end();
    if (annotation_begin_) {
      layout_.annotations.push_back({*annotation_begin_, input_.offset()});
      annotation_begin_.reset();
    }
  }

  /// Gmsh appends views with a header of their own.
  void read_header() {
    const MshHeader first = input_.header();
    input_.read_header();
    const MshHeader& again = input_.header();
    if (has_header_ && (again.version != first.version || again.binary != first.binary ||
                        again.swapped != first.swapped || again.size_bytes != first.size_bytes)) {
      input_.fail_at(section_begin_, "a second section $MeshFormat that says something else than the first one");
    }
    has_header_ = true;
  }

  /// False for a section that nobody here reads.
  bool read_known_section() {
    const bool is_version_1 = section_ == "NOD" || section_ == "ELM";
    const bool is_nodes = section_ == "Nodes" || section_ == "NOD" || section_ == "ParametricNodes";
    const bool is_elements = section_ == "Elements" || section_ == "ELM";
    const bool is_data = section_ == "NodeData" || section_ == "ElementData";
    const bool is_entities = section_ == "Entities" || section_ == "PartitionedEntities";
    if (!is_nodes && !is_elements && !is_data && !is_entities && section_ != "PhysicalNames") {
      return false;
    }
    if (has_header_ == is_version_1) {
      input_.fail_at(section_begin_, is_version_1 ? "a section of version 1 in a file of another version"
                                                  : "expected the section $MeshFormat before $" + section_);
    }
    if (is_nodes) {
      require_first(has_nodes_);
      layout_.nodes_begin = section_begin_;
      read_msh_nodes(input_, rows_, section_ == "ParametricNodes", document_, nodes_);
      has_nodes_ = true;
    } else if (is_elements) {
      require_first(has_elements_);
      if (!has_nodes_) {
        input_.fail_at(section_begin_, "expected the nodes before the section $" + section_);
      }
      read_msh_elements(input_, rows_, nodes_.tags, entities_, document_, elements_);
      has_elements_ = true;
    } else if (is_entities && input_.header().version >= 40) {
      entities_.read(input_, section_ == "PartitionedEntities");
    } else if (section_ == "PhysicalNames") {
      read_physical_names();
    } else if (is_data) {
      read_data();
    } else {
      return false;
    }
    return true;
  }

  void require_first(bool has_one) const {
    if (has_one) {
      input_.fail_at(section_begin_, "a second section $" + section_ + "; expected one in a file");
    }
  }

  void require_end() {
    TextScanner& text = input_.text();
    const bool is_version_1 = section_ == "NOD" || section_ == "ELM";
    const std::string end = (is_version_1 ? "$END" : "$End") + section_;
    const std::string_view token = text.next_token(end);
    if (token != end) {
      input_.fail("expected " + end + ", got " + quoted(token));
    }
    if (section_ == "Nodes" || section_ == "ParametricNodes") {
      layout_.nodes_end = text.offset();
    }
    text.next_line();
  }

  /// To behind the line that ends the section, whatever stands there.
  void skip_section() {
    const std::string_view bytes = input_.bytes();
    for (std::size_t at = input_.offset(); (at = bytes.find("$E", at)) != std::string_view::npos; ++at) {
      const bool begins_line = at > 0 && (bytes[at - 1] == '\n' || bytes[at - 1] == '\r' || input_.header().binary);
      const std::string_view rest = bytes.substr(at, section_.size() + 5);
      const bool ends_word =
          rest.size() < section_.size() + 5 || is_white_space(rest.back()) || without_end_mark(rest) != rest;
      if (begins_line && ends_word && (rest.starts_with("$End") || rest.starts_with("$END")) &&
          rest.substr(4, section_.size()) == section_) {
        input_.seek(at);
        input_.text().next_line();
        return;
      }
    }
    input_.fail_at(section_begin_, "expected the end of the section " + trismooth::quoted("$" + section_) +
                                       ", got the end of the file");
  }

  void read_physical_names() {
    TextScanner& text = input_.text();
    const std::int64_t count = text.next_integer("the number of names", 0, largest_msh_int);
    std::map<std::pair<int, std::int64_t>, bool> named;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::size_t begin = text.offset();
      auto dimension = static_cast<int>(text.next_integer("the dimension of a group", any_dimension, largest_msh_int));
      if (text.peek_token().starts_with('"')) {
        text.seek(begin);  // of version 2.0: the number is the group's
        dimension = any_dimension;
      } else if (dimension < 0 || dimension > 3) {
        text.fail("expected the dimension of a group from 0 to 3, got " + std::to_string(dimension));
      }
      const std::int64_t tag = text.next_integer("the tag of a group", -largest_msh_int, largest_msh_int);
      std::string_view name = trimmed(text.next_line());
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = name.substr(1, name.size() - 2);
      }
      if (named.try_emplace({dimension, tag}, true).second) {
        value_names_.push_back({tag, dimension, std::string(name)});
      }
    }
  }

  /// A name without a dimension is one of every dimension in which its group has elements.
  void give_names_dimensions() {
    if (std::ranges::find(value_names_, any_dimension, &ValueName::dimension) == value_names_.end()) {
      return;
    }
    std::set<std::pair<std::int64_t, int>> used;
    for (std::size_t cell = 0; cell < elements_.physical.size(); ++cell) {
      used.emplace(elements_.physical[cell], cell_type::dimension(document_.cells.types[cell]));
    }
    for (const auto& [group, members] : elements_.further_groups) {
      used.emplace(group.second, group.first);
    }
    std::vector<ValueName> names;
    for (const ValueName& name : value_names_) {
      if (name.dimension != any_dimension) {
        names.push_back(name);
        continue;
      }
      const auto first = used.lower_bound({name.value, 0});
      const auto behind = used.lower_bound({name.value + 1, 0});
      std::transform(first, behind, std::back_inserter(names), [&name](const auto& group) {
        return ValueName{group.first, group.second, name.name};
      });
      if (first == behind) {
        names.push_back({name.value, 2, name.name});
      }
    }
    value_names_ = std::move(names);
  }

  /// The section is kept whatever it holds, and the input stands at its beginning again.
  void read_periodic() {
    const std::size_t begin = input_.offset();
    try {
      for (const auto& pair : read_msh_periodic(input_, nodes_.tags)) {
        std::ranges::copy_if(pair, std::back_inserter(periodic_), [](std::int32_t node) { return node >= 0; });
        if (std::ranges::min(pair) >= 0) {
          document_.periodic_pairs.push_back(pair);
        }
      }
    } catch (const ReadError&) {
      document_.notes.emplace_back("The section $Periodic is not understood, so it holds no nodes.");
    }
    input_.seek(begin);
  }

  void read_data() {
    MshDataSection section{.of_nodes = section_ == "NodeData"};
    const bool is_clear = read_msh_data_header(input_, section);
    layout_.field_names.push_back(section.name);
    if (is_annotation(section.name)) {
      annotation_begin_ = section_begin_;
    }
    if (is_clear) {
      data_.push_back(section);
    } else {
      kept_sections_.push_back(section_);
    }
    if (is_clear && input_.header().binary) {
      input_.seek(section.begin + section.rows * (sizeof(std::int32_t) + section.components * sizeof(double)));
      return;
    }
    const std::size_t begin = input_.offset();
    skip_section();
    // require_end() reads the last line again.
    input_.seek(std::max(begin, input_.bytes().rfind("$End", input_.offset())));
  }

  void add_cell_arrays() {
    const auto add = [this](const char* name, std::vector<std::int32_t>& values,
                            std::shared_ptr<const ArrayDescription> description = nullptr) {
      if (has_msh_label(values)) {
        values.resize(document_.cells.size());
        DataArray array = make_data_array(name, 1, std::move(values));
        array.description = std::move(description);
        cell_names_.take(name);
        document_.cell_arrays.push_back(std::move(array));
      }
    };
    give_names_dimensions();
    if (!elements_.further_groups.empty()) {
      all_physical_ = elements_.physical;
      all_physical_.resize(document_.cells.size());
    }
    ArrayDescription description;
    description.value_names = value_names_;
    if (!has_msh_label(elements_.physical)) {
      for (const ValueName& name : value_names_) {
        document_.cell_sets.push_back({name.name, {}});
      }
    }
    add("gmsh:physical", elements_.physical,
        value_names_.empty() ? nullptr : std::make_shared<const ArrayDescription>(std::move(description)));
    add("gmsh:geometrical", elements_.geometrical);
    add("gmsh:partition", elements_.partition);
  }

  /// Groups of which some cells are in another one first: sets of all their cells.
  void add_cell_sets() {
    if (elements_.further_groups.empty()) {
      return;
    }
    for (std::size_t cell = 0; cell < all_physical_.size(); ++cell) {
      const auto found =
          elements_.further_groups.find({cell_type::dimension(document_.cells.types[cell]), all_physical_[cell]});
      if (found != elements_.further_groups.end()) {
        found->second.push_back(static_cast<std::int32_t>(cell));
      }
    }
    for (auto& [group, members] : elements_.further_groups) {
      const auto name = std::ranges::find_if(value_names_, [&group = group](const ValueName& known) {
        return known.dimension == group.first && known.value == group.second;
      });
      std::ranges::sort(members);
      members.erase(std::unique(members.begin(), members.end()), members.end());
      document_.cell_sets.push_back(
          {name == value_names_.end() ? name_of_unnamed_group(group.second) : name->name, std::move(members)});
    }
  }

  /// A file whose nodes are all of points and curves says nothing by that.
  void add_implied_sets() {
    const auto add = [this](std::string_view name, std::vector<std::int32_t>& members) {
      if (!members.empty()) {
        document_.implied_sets.push_back({std::string(name), std::move(members)});
      }
    };
    if (nodes_.any_on_surfaces) {
      add(points_of_geometry, nodes_.on_points);
      add(curves_of_geometry, nodes_.on_curves);
    }
    std::ranges::sort(periodic_);
    periodic_.erase(std::unique(periodic_.begin(), periodic_.end()), periodic_.end());
    add("gmsh:periodic", periodic_);
  }

  void add_notes() {
    if (elements_.repeated > 0) {
      document_.notes.push_back(std::to_string(elements_.repeated) +
                                " elements are listed again for another physical group; each counts once.");
    }
    if (!kept_sections_.empty()) {
      std::ranges::sort(kept_sections_);
      kept_sections_.erase(std::unique(kept_sections_.begin(), kept_sections_.end()), kept_sections_.end());
      const std::string names =
          list_text(kept_sections_, [](const std::string& name) { return trismooth::quoted("$" + name); });
      document_.notes.push_back("What the sections " + names + " say is kept in MSH output only.");
    }
  }

  MshInput input_;
  MshRows rows_;
  MshLayout& layout_;
  MeshDocument document_;
  MshNodes nodes_;
  MshEntities entities_;
  MshElements elements_;
  std::vector<std::int32_t> all_physical_;
  std::vector<ValueName> value_names_;
  std::vector<std::int32_t> periodic_;  ///< nodes
  std::vector<MshDataSection> data_;
  std::vector<std::string> kept_sections_;
  FreeNames point_names_;
  FreeNames cell_names_;
  std::string section_;
  std::size_t section_begin_ = 0;
  std::optional<std::size_t> annotation_begin_;  ///< of the section that is read, where it holds an annotation
  bool has_header_ = false;
  bool has_nodes_ = false;
  bool has_elements_ = false;
};

}  // namespace

MeshDocument read_msh(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers,
                      MshLayout& layout) {
  return MshReader(path, bytes, workers, layout).read();
}

}  // namespace trismooth
