// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/held_html.h"

#include <utility>

#include <fmt/format.h>

#include "trismooth/pipeline/report/held_text.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

std::string row(std::string_view name, std::string_view detail, std::int64_t vertices) {
  const std::string small = detail.empty() ? std::string{} : fmt::format("<small>{}</small>", escape_html(detail));
  return "<tr>" + html_cell(escape_html(name) + small) + html_cell(count_text(vertices)) + "</tr>\n";
}

}  // namespace

std::string held_html(const InputSummary& input) {
  const HeldVertices& held = input.held;
  std::string rows;
  for (const auto& [name, count] : {std::pair<const char*, std::int64_t>{"on the boundary", held.boundary},
                                    {"between two regions", held.interface},
                                    {"on edges of three elements or more", held.non_manifold},
                                    {"where elements meet in a point only", held.bow_tie},
                                    {"of cells that are not smoothed", held.other_cells},
                                    {"of no cell", held.unused},
                                    {"named", held.named},
                                    {"in layers that are flat on purpose", held.layers},
                                    {"for several of these reasons", held.several}}) {
    if (count > 0) {
      rows += row(name, "", count);
    }
  }
  for (const RegionArray& array : input.region_arrays) {
    rows += row(fmt::format("by the cell array '{}'", array.name),
                fmt::format("{} value{}; {}", array.values, array.values == 1 ? "" : "s", describe(array.reason)),
                array.held_vertices);
  }
  if (!input.fixed_array.empty()) {
    rows += row(fmt::format("by the point array '{}'", input.fixed_array), "", input.fixed_array_vertices);
  }
  for (const FilePointSet& set : input.point_sets) {
    rows += row(fmt::format("{} the point set '{}'", set.holds ? "by" : "not by", set.name),
                set.is_area         ? "covers an area"
                : set.vertices == 0 ? "has no points"
                                    : "",
                set.vertices);
  }
  for (const FileLineGroup& group : input.line_groups) {
    rows += row(fmt::format("by the lines '{}'", group.name), "", group.vertices);
  }
  if (!input.fixed_ids.empty()) {
    rows += row(fmt::format("by the file {}", input.fixed_ids.string()), "", input.fixed_ids_vertices);
  }
  const std::string middles = input.middle_nodes > 0
                                  ? row("not held: middles of sides", "move with their sides", input.middle_nodes)
                                  : std::string{};
  return "<table>\n<thead><tr><th>held fixed</th><th>vertices</th></tr></thead>\n<tbody>\n" +
         row("all", "", input.fixed_vertices) + rows + middles + "</tbody>\n</table>\n";
}

}  // namespace trismooth
