// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_grids.h"

#include <algorithm>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

class GridFinder {
 public:
  GridFinder(const std::filesystem::path& file, XdmfPaths& paths) : file_(file), paths_(paths) {}

  void add(const XmlElement& given, std::vector<XdmfGrid>& grids, XdmfGrids& all, int depth) {
    // References may lead in circles.
    if (depth == 64) {
      throw ReadError(file_, given.line, "grids are nested too deeply");
    }
    const XmlElement& grid = referred(given);
    const std::string type = xdmf_word(xdmf_attribute(grid, "GridType", "Type"));
    if (type.empty() || type == "UNIFORM") {
      grids.push_back(uniform(grid));
    } else if (type != "COLLECTION" && type != "TREE") {
      throw ReadError(file_, grid.line, "a grid of the type " + quoted(std::string_view(type)) + " is not read");
    } else if (type == "COLLECTION" && xdmf_word(xdmf_attribute(grid, "CollectionType")) == "TEMPORAL") {
      add_steps(grid, grids, all, depth);
    } else {
      for (const XmlElement* const child : grids_of(grid)) {
        add(*child, grids, all, depth + 1);
      }
    }
  }

  XmlElements grids_of(const XmlElement& element) {
    XmlElements children = paths_.children_of(element);
    std::erase_if(children, [](const XmlElement* child) { return child->name != "Grid"; });
    return children;
  }

 private:
  const XmlElement& referred(const XmlElement& element) {
    const std::string reference = xdmf_attribute(element, "Reference");
    if (reference.empty()) {
      return element;
    }
    if (xdmf_word(reference) == "XML") {
      throw ReadError(file_, element.line, "<" + element.name + " Reference=\"XML\"> is not read: xi:include is");
    }
    const XmlElements& found = paths_.find(reference, element.line);
    if (found.size() != 1 || found[0]->name != element.name || found[0]->attribute("Reference") != nullptr) {
      throw ReadError(
          file_, element.line,
          "the reference " + quoted(std::string_view(reference)) + " leads to no single <" + element.name + ">");
    }
    return *found[0];
  }

  XdmfGrid uniform(const XmlElement& element) {
    XdmfGrid grid{.element = &element};
    for (const XmlElement* const child : paths_.children_of(element)) {
      if (child->name == "Topology" || child->name == "Geometry") {
        const XmlElement*& place = child->name == "Topology" ? grid.topology : grid.geometry;
        if (place != nullptr) {
          throw ReadError(file_, child->line, "a grid has a second <" + child->name + ">");
        }
        place = &referred(*child);
      } else if (child->name == "Attribute") {
        grid.attributes.push_back(child);
      } else if (child->name == "Set") {
        grid.sets.push_back(child);
      } else if (child->name == "Information") {
        grid.information.push_back(child);
      }
    }
    if (grid.topology == nullptr || grid.geometry == nullptr) {
      throw ReadError(file_, element.line,
                      std::string("a grid has no <") + (grid.topology == nullptr ? "Topology" : "Geometry") + ">");
    }
    return grid;
  }

  std::optional<double> time_of(const XmlElement& step) {
    for (const XmlElement* const child : paths_.children_of(step)) {
      if (child->name == "Time") {
        return parse_number<double>(xdmf_attribute(*child, "Value"));
      }
    }
    return std::nullopt;
  }

  void add_steps(const XmlElement& collection, std::vector<XdmfGrid>& grids, XdmfGrids& all, int depth) {
    const XmlElements steps = grids_of(collection);
    if (steps.size() > all.steps) {
      all.steps = steps.size();
      all.time = time_of(referred(*steps.back()));
    }
    const std::size_t begin = grids.size();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (i == 0) {
        add(*steps[i], grids, all, depth + 1);
        continue;
      }
      std::vector<XdmfGrid> later;
      add(*steps[i], later, all, depth + 1);
      if (later.size() != grids.size() - begin) {
        throw ReadError(file_, steps[i]->line,
                        "a time step has other grids than the first one: " + std::string(advice));
      }
      // Collections in time inside of others are compared with the grids of the innermost alone.
      if (&grids == &all.first) {
        for (std::size_t j = 0; j < later.size(); ++j) {
          all.later.emplace_back(begin + j, std::move(later[j]));
        }
      }
    }
  }

  static constexpr std::string_view advice = "write one step to a file of its own";

  const std::filesystem::path& file_;
  XdmfPaths& paths_;
};

}  // namespace

XdmfGrids find_xdmf_grids(const std::filesystem::path& file, const XmlElement& root, XdmfPaths& paths) {
  const XmlElement* const domain = root.child("Domain");
  if (domain == nullptr) {
    throw ReadError(file, root.line, "has no <Domain>");
  }
  XdmfGrids grids;
  grids.domains =
      static_cast<std::size_t>(std::ranges::count(root.children, std::string_view("Domain"), &XmlElement::name));
  GridFinder finder(file, paths);
  for (const XmlElement* const grid : finder.grids_of(*domain)) {
    finder.add(*grid, grids.first, grids, 0);
  }
  if (grids.first.empty()) {
    throw ReadError(file, domain->line, "has no <Grid>");
  }
  return grids;
}

}  // namespace trismooth
