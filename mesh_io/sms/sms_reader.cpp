// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/sms/sms_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/sms/sms_elements.h"
#include "trismooth/mesh_io/sms/sms_line.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

class SmsReader {
 public:
  SmsReader(std::string_view bytes, const std::filesystem::path& path)
      : scanner_(bytes, path, TextScanner::Comments::hash, begin_of_text(bytes)) {
    sites_.columns = {{.component = 0}, {.component = 1}, {.array = "elevation"}};
  }

  std::pair<MeshDocument, NumberSites> read() {
    if (scanner_.at_end() || scanner_.peek_token() != "MESH2D") {
      scanner_.fail_at(scanner_.offset(),
                       "is not a 2dm mesh: expected MESH2D, got " +
                           (scanner_.at_end() ? "the end of the file" : quoted(scanner_.peek_token())));
    }
    while (!scanner_.at_end()) {
      SmsLine line(scanner_);
      read_card(line, line.next_word().value_or(""));
    }
    if (in_nodestring_) {
      scanner_.fail_at(nodestring_offsets_.back(), "the nodestring has no last node: its number would be negative");
    }
    resolve_nodes();
    add_materials();
    add_notes();
    document_.point_arrays.push_back(make_data_array("elevation", 1, std::move(elevations_)));
    document_.arrays_of_places.emplace_back("elevation");
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void read_card(SmsLine& line, std::string_view card) {
    if (in_nodestring_ && card != "NS") {
      line.fail("expected more of the nodestring, whose last node has a negative number, got " + quoted(card));
    }
    const auto* const element = std::ranges::find(sms_elements, card, &SmsElement::card);
    if (is_in_kept_card_ && !line.is_quoted() && parse_fortran_number<double>(card)) {
      return;  // a row of its table, as those of time curves
    }
    is_in_kept_card_ = false;
    if (card == "ND") {
      read_node(line);
    } else if (element != sms_elements.end()) {
      read_element(line, *element);
    } else if (card == "NS") {
      read_nodestring(line);
    } else if (card == "MAT") {
      read_material(line);
    } else if (card.empty() || card[0] < 'A' || card[0] > 'Z' ||
               card.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") != std::string_view::npos) {
      line.fail("expected a card, got " + quoted(card));
    } else if (card.size() > 1 && card[0] == 'E' && '0' <= card[1] && card[1] <= '9') {
      line.fail("expected an element of two dimensions (E2L, E3L, E3T, E4Q, E6T, E8Q, E9Q), got " + quoted(card));
    } else if (card != "MESH2D" && card != "NUM_MATERIALS_PER_ELEM" && card != "MESHNAME") {
      other_cards_.emplace(card);
      is_in_kept_card_ = true;
    }
  }

  void read_node(SmsLine& line) {
    if (ids_.size() == std::numeric_limits<std::int32_t>::max()) {
      line.fail("has more nodes than 32-bit indices can tell apart");
    }
    ids_.push_back(line.next_integer("the number of a node"));
    for (const char* const what : {"x", "y"}) {
      document_.points.push_back(line.next_number(what));
      sites_.offsets.push_back(line.word_offset());
    }
    document_.points.push_back(0);
    elevations_.push_back(line.next_number_or_none("z"));
    sites_.offsets.push_back(line.word_offset());
  }

  void read_element(SmsLine& line, const SmsElement& element) {
    line.next_integer("the number of an element");
    std::array<std::int64_t, most_sms_nodes> nodes{};
    for (std::size_t i = 0; i < element.nodes; ++i) {
      nodes.at(i) = line.next_integer("a node");
    }
    for (std::size_t i = 0; i < element.nodes; ++i) {
      references_.push_back(nodes.at(element.order.at(i)));
    }
    element_offsets_.push_back(line.offset());
    document_.cells.types.push_back(element.type);
    document_.cells.offsets.push_back(static_cast<std::int64_t>(references_.size()));
    const auto word = line.next_word();
    const auto material = word ? parse_integer(*word) : std::nullopt;
    if (word && !material && !parse_number<double>(*word)) {
      line.fail("expected the number of a material, got " + quoted(*word));
    }
    has_other_materials_ = has_other_materials_ || (word && !material) || line.next_word();
    materials_.push_back(material.value_or(0));
  }

  void read_nodestring(SmsLine& line) {
    if (!in_nodestring_) {
      nodestrings_.emplace_back();
      nodestring_offsets_.push_back(line.offset());
      document_.point_sets.push_back({"nodestring " + std::to_string(nodestrings_.size()), {}});
      in_nodestring_ = true;
    }
    std::vector<std::int64_t>& nodes = nodestrings_.back();
    for (std::optional<std::string_view> word = line.next_word(); word; word = line.next_word()) {
      const auto node = parse_integer(*word);
      if (!node || *node == std::numeric_limits<std::int64_t>::min()) {
        line.fail("expected a node of a nodestring, got " + quoted(*word));
      }
      nodes.push_back(*node < 0 ? -*node : *node);
      if (*node < 0) {
        in_nodestring_ = false;
        if (const auto name = line.next_word(); name && !name->empty()) {
          document_.point_sets.back().name = (parse_integer(*name) ? "nodestring " : "") + std::string(*name);
        }
        return;
      }
    }
  }

  void read_material(SmsLine& line) {
    const std::int64_t number = line.next_integer("the number of a material");
    const auto name = line.next_word();
    if (!name) {
      line.fail("expected the name of a material, got the end of the line");
    }
    material_names_[number] = std::string(*name);
  }

  void resolve_nodes() {
    const PointIds ids(ids_);
    if (const auto repeated = ids.first_repeated()) {
      scanner_.fail_at(sites_.offsets[3 * *repeated],
                       "node " + std::to_string(ids_[*repeated]) + " stands in the file twice");
    }
    set_point_labels(document_, ids_);
    CellList& cells = document_.cells;
    cells.connectivity.reserve(references_.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      for (auto i = cells.offsets[cell]; i < cells.offsets[cell + 1]; ++i) {
        cells.connectivity.push_back(
            point_of(ids, references_[static_cast<std::size_t>(i)], element_offsets_[cell], "the element"));
      }
    }
    for (std::size_t i = 0; i < nodestrings_.size(); ++i) {
      for (const std::int64_t node : nodestrings_[i]) {
        document_.point_sets[i].members.push_back(point_of(ids, node, nodestring_offsets_[i], "the nodestring"));
      }
    }
  }

  std::int32_t point_of(const PointIds& ids, std::int64_t id, std::size_t offset, const char* what) const {
    const auto point = ids.find(id);
    if (!point) {
      scanner_.fail_at(offset, std::string(what) + " names node " + std::to_string(id) + ", which is none of the file");
    }
    return *point;
  }

  void add_materials() {
    if (materials_.empty()) {
      return;
    }
    std::set<std::pair<int, std::int64_t>> used;
    for (std::size_t cell = 0; cell < materials_.size(); ++cell) {
      used.emplace(cell_type::dimension(document_.cells.types[cell]), materials_[cell]);
    }
    ArrayDescription description;
    for (const auto& [dimension, material] : used) {
      if (const auto named = material_names_.find(material); named != material_names_.end()) {
        description.value_names.push_back({material, dimension, named->second});
      }
    }
    DataArray array = make_data_array("2dm:material", 1, std::move(materials_));
    if (!description.empty()) {
      array.description = std::make_shared<const ArrayDescription>(std::move(description));
    }
    document_.cell_arrays.push_back(std::move(array));
  }

  void add_notes() {
    if (has_other_materials_) {
      document_.notes.emplace_back(
          "What stands behind the first whole number of an element's materials is kept in 2dm output only.");
    }
    if (!other_cards_.empty()) {
      constexpr std::size_t most_named = 8;
      document_.notes.push_back("Cards that are kept in 2dm output only: " +
                                first_of_list(other_cards_, most_named, trismooth::quoted) + ".");
    }
  }

  TextScanner scanner_;
  MeshDocument document_;
  NumberSites sites_;
  std::vector<std::int64_t> ids_;
  std::vector<double> elevations_;
  std::vector<std::int64_t> references_;  ///< the ids of the vertices of all cells
  std::vector<std::size_t> element_offsets_;
  std::vector<std::int64_t> materials_;
  std::map<std::int64_t, std::string> material_names_;
  std::vector<std::vector<std::int64_t>> nodestrings_;
  std::vector<std::size_t> nodestring_offsets_;
  std::set<std::string, std::less<>> other_cards_;
  bool in_nodestring_ = false;
  bool is_in_kept_card_ = false;  ///< the last card is one that is kept, with what it says
  bool has_other_materials_ = false;
};

}  // namespace

MeshDocument read_sms(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& /*workers*/) {
  auto [document, sites] = SmsReader(bytes, path).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth
