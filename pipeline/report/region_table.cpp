// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/region_table.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/text/printable_text.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/quality/text/text_columns.h"

namespace trismooth {

namespace {

const std::vector<RegionQuality>& final_regions(const PipelineResult& result) {
  return result.regions_after.empty() ? result.regions_before : result.regions_after;
}

/// The regions to show, ascending.
std::vector<std::size_t> worst_regions(const PipelineResult& result, std::size_t most) {
  const std::vector<RegionQuality>& regions = final_regions(result);
  std::vector<std::size_t> shown(regions.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  if (shown.size() > most) {
    std::ranges::sort(shown, {}, [&](std::size_t region) { return std::pair(regions[region].min_shape, region); });
    shown.resize(most);
    std::ranges::sort(shown);
  }
  return shown;
}

/// The numbers of a region as texts: elements, inverted, smallest shape, mean shape, smallest angle; all but the first
/// twice where the mesh was smoothed.
std::vector<std::string> cells_of(const PipelineResult& result, std::size_t region) {
  const RegionQuality& before = result.regions_before[region];
  const int shape_decimals = decimals(Metric::shape);
  const int angle_decimals = decimals(Metric::min_angle);
  if (result.regions_after.empty()) {
    return {count_text(before.elements()), count_text(before.inverted), number_text(before.min_shape, shape_decimals),
            number_text(before.mean_shape, shape_decimals), number_text(before.min_angle, angle_decimals)};
  }
  const RegionQuality& after = result.regions_after[region];
  const TextPair min_shape = distinct_texts(before.min_shape, after.min_shape, shape_decimals);
  const TextPair mean_shape = distinct_texts(before.mean_shape, after.mean_shape, shape_decimals);
  const TextPair min_angle = distinct_texts(before.min_angle, after.min_angle, angle_decimals);
  return {count_text(before.elements()),
          count_text(before.inverted),
          count_text(after.inverted),
          min_shape.before,
          min_shape.after,
          mean_shape.before,
          mean_shape.after,
          min_angle.before,
          min_angle.after};
}

std::string short_name(const std::string& name, std::size_t most) {
  std::string text;
  std::string cut;
  std::size_t columns = 0;
  for (std::string_view rest = name; !rest.empty();) {
    const TextPiece piece = first_piece(rest);
    const std::string shown = printable(piece.bytes);
    text += shown;
    columns += piece.is_harmless ? 1 : shown.size();
    if (columns + 2 <= most) {
      cut = text;
    }
    rest.remove_prefix(piece.bytes.size());
  }
  return columns > most ? cut + ".." : text;
}

std::string elements_of(const PipelineResult& result) {
  return std::string(element_words(result.before.triangles, result.before.quadrilaterals).several);
}

}  // namespace

std::vector<std::string> short_region_names(const PipelineResult& result) {
  constexpr std::size_t longest = 40;
  std::vector<std::string> names;
  if (result.region_names.size() > 1) {
    const std::set<std::string> all(result.region_names.begin(), result.region_names.end());
    // A table of two meshes has no room for more, unless it takes that to tell the regions apart.
    for (std::size_t most = result.regions_after.empty() ? 24 : 10; names.empty(); most += 6) {
      std::ranges::transform(result.region_names, std::back_inserter(names),
                             [most](const std::string& name) { return short_name(name, most); });
      if (most < longest && std::set<std::string>(names.begin(), names.end()).size() < all.size()) {
        names.clear();
      }
    }
  }
  return names;
}

std::string region_table(const PipelineResult& result, std::size_t most) {
  if (result.region_names.size() < 2) {
    return {};
  }
  using Align = TextColumns::Align;
  const bool smoothed = !result.regions_after.empty();
  std::vector<TextColumns::Column> columns{{0, Align::left}, {2}};
  std::vector<std::string> head{"region", elements_of(result)};
  std::vector<TextColumns::Title> titles;
  if (smoothed) {
    columns.insert(columns.end(), {{1}, {1}, {1}, {1}, {1}, {1}, {1}, {1}});
    for (int pair = 0; pair < 4; ++pair) {
      head.insert(head.end(), {"before", "after"});
    }
    titles = {{2, 3, "inverted"}, {4, 5, "min shape"}, {6, 7, "mean shape"}, {8, 9, "min angle"}};
  } else {
    columns.insert(columns.end(), {{2}, {2}, {2}, {2}});
    head.insert(head.end(), {"inverted", "min shape", "mean shape", "min angle"});
  }
  TextColumns table(columns);
  table.add_row(head);
  const std::vector<std::size_t> shown = worst_regions(result, most);
  const std::vector<std::string> names = short_region_names(result);
  for (const std::size_t region : shown) {
    std::vector<std::string> row = cells_of(result, region);
    row.insert(row.begin(), names[region]);
    table.add_row(std::move(row));
  }
  std::string text = table.text(titles);
  if (shown.size() < result.region_names.size()) {
    text +=
        fmt::format("the {} worst of {} regions; a report has them all\n", shown.size(), result.region_names.size());
  }
  return text;
}

std::string region_table_html(const PipelineResult& result) {
  const bool smoothed = !result.regions_after.empty();
  static constexpr std::array<const char*, 4> titles{"inverted", "min shape", "mean shape", "min angle"};
  const std::string elements = elements_of(result);
  std::string html = "<table class=\"stack wrap\">\n<thead><tr><th>region</th><th>" + elements + "</th>";
  for (const char* const title : titles) {
    html += smoothed ? fmt::format("<th class=\"start\">{0}, before</th><th>{0}, after</th>", title)
                     : fmt::format("<th>{}</th>", title);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t region = 0; region < result.region_names.size(); ++region) {
    html += "<tr>" + html_cell(escape_html(result.region_names[region]), "text");
    const std::vector<std::string> cells = cells_of(result, region);
    html += html_cell(cells.front(), "", elements);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const std::size_t title = smoothed ? (i - 1) / 2 : i - 1;
      const bool second = smoothed && i % 2 == 0;
      html += html_cell(cells[i], smoothed && !second ? "start" : "", second ? "" : titles[title]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

}  // namespace trismooth
