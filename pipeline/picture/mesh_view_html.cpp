// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/mesh_view_html.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trismooth/pipeline/picture/colours.h"
#include "trismooth/pipeline/picture/packed_picture.h"
#include "trismooth/pipeline/picture/viewer_text.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

namespace {

using Json = nlohmann::ordered_json;

/// What the bits of namespace hold mean to people, from the lowest.
constexpr std::array<std::string_view, 8> held_reasons{"boundary",
                                                       "edge of three elements or more",
                                                       "elements that meet in a point",
                                                       "of no element",
                                                       "interface",
                                                       "another cell",
                                                       "named or of a layer",
                                                       "line"};

Json json_of(Colour colour) {
  return {colour.red, colour.green, colour.blue};
}

template <std::size_t count>
Json json_of(const std::array<ColourStop, count>& stops) {
  Json json = Json::array();
  for (const ColourStop& stop : stops) {
    json.push_back({stop.at, json_of(stop.colour)});
  }
  return json;
}

Json colours_json() {
  Json regions = Json::array();
  for (const Colour colour : region_colours) {
    regions.push_back(json_of(colour));
  }
  return {{"quality", json_of(quality_colours)},
          {"amount", json_of(amount_colours)},
          {"inverted", json_of(inverted_colour)},
          {"regions", std::move(regions)}};
}

Json scales_json(ElementKind kind) {
  Json json = Json::object();
  for (const MetricInfo& metric : all_metrics(kind)) {
    if (metric.metric != Metric::area) {
      const QualityScale scale = quality_scale(metric.metric, kind);
      json[std::string(metric.name)] = {
          {"worst", scale.worst}, {"ideal", scale.ideal}, {"reciprocal", scale.is_reciprocal}};
    }
  }
  return json;
}

/// Those that the mesh's elements have.
std::vector<const MetricInfo*> metrics_shown(const PackedPicture& packed) {
  std::vector<const MetricInfo*> shown;
  for (const MetricInfo* const metric : metrics_of_any_kind()) {
    if ((packed.triangles > 0 && metric_named(metric->name, ElementKind::triangle)) ||
        (packed.quadrilaterals > 0 && metric_named(metric->name, ElementKind::quadrilateral))) {
      shown.push_back(metric);
    }
  }
  return shown;
}

/// What the script is to know. As the text of a script element, which ends at no name: `<`, `>` and `&` are escaped.
std::string about_json(const MeshPicture& picture, const PackedPicture& packed) {
  Json streams = Json::array();
  for (const PackedStream& stream : packed.streams) {
    streams.push_back({stream.name, stream.count, stream.planes, stream.bytes});
  }
  Json metrics = Json::array();
  for (const MetricInfo* const metric : metrics_shown(packed)) {
    metrics.push_back({{"name", metric->name}, {"unit", metric->unit}});
  }
  const Json about{
      {"vertices", packed.vertices},
      {"triangles", packed.triangles},
      {"quadrilaterals", packed.quadrilaterals},
      {"origin", {packed.origin.x, packed.origin.y}},
      {"step", packed.step},
      {"moved", !picture.after.empty()},
      {"geographic", static_cast<bool>(picture.shown_place)},
      {"regions", picture.region_names},
      {"held", held_reasons},
      {"worst", {{"before", picture.worst_before}, {"after", picture.worst_after}}},
      {"metrics", std::move(metrics)},
      {"scales",
       {{"triangle", scales_json(ElementKind::triangle)}, {"quadrilateral", scales_json(ElementKind::quadrilateral)}}},
      {"colours", colours_json()},
      {"streams", std::move(streams)}};
  std::string escaped;
  for (const char c : about.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&') {
      escaped += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string metric_options(const MeshPicture& picture, const PackedPicture& packed) {
  std::string html;
  for (const MetricInfo* const metric : metrics_shown(packed)) {
    html += fmt::format("<option value=\"{0}\">{0}</option>", metric->name);
  }
  if (!picture.regions.empty()) {
    html += "<option value=\"region\">region</option>";
  }
  if (!picture.after.empty()) {
    html += "<option value=\"moved\">distance moved</option>";
  }
  return html;
}

std::string check_box(std::string_view name, std::string_view label) {
  return fmt::format("<label><input type=\"checkbox\" class=\"view-{}\"/>{}</label>", name, label);
}

std::string tools(const MeshPicture& picture, const PackedPicture& packed) {
  const bool has_moved = !picture.after.empty();
  std::string html = "<div class=\"view-bar\">\n<label>colour <select class=\"view-metric\">" +
                     metric_options(picture, packed) + "</select></label>\n";
  html += fmt::format(
      "<label{}>before <input type=\"range\" class=\"view-slider\" min=\"0\" max=\"1\" step=\"any\" "
      "aria-label=\"from before to after\"/> after</label><span class=\"view-state\"{}></span>\n",
      has_moved ? "" : " hidden=\"hidden\"", has_moved ? " aria-live=\"polite\"" : " hidden=\"hidden\"");
  html += check_box("lines", "boundary and interfaces") + check_box("held", "held vertices");
  html += fmt::format("<span{}>{}</span>\n", has_moved ? "" : " hidden=\"hidden\"", check_box("moves", "moves"));
  for (const auto& [name, label, title] : {std::array<std::string_view, 3>{"in", "+", "closer"},
                                           {"out", "−", "further away"},
                                           {"fit", "all", "the whole mesh"},
                                           {"worst", "next worst", "the next of the worst elements"},
                                           {"full", "full screen", "on the whole screen"}}) {
    html += fmt::format("<button type=\"button\" class=\"view-{}\" title=\"{}\">{}</button>", name, title, label);
  }
  return html + "\n</div>\n";
}

}  // namespace

std::string mesh_view_html(const MeshPicture& picture, Workers& workers) {
  std::vector<std::int32_t> shown(picture.elements.list().size());
  std::iota(shown.begin(), shown.end(), 0);
  const PackedPicture packed = pack_picture(picture, shown, workers);
  std::string html = "<div id=\"mesh-view\">\n" + tools(picture, packed);
  html +=
      "<div class=\"view-stage\" tabindex=\"0\" role=\"application\" aria-label=\"The mesh. Arrows move it, + and - "
      "zoom, "
      "0 shows all of it, space changes between before and after, n and p lead to the worst elements.\">\n"
      "<canvas class=\"view-canvas\"></canvas>\n<div class=\"view-marks\"></div>\n</div>\n"
      "<div class=\"view-legend\"></div>\n<div class=\"view-note\"></div>\n"
      "<div class=\"view-info\" aria-live=\"polite\"><p class=\"soft\">Click an element to see its number, region and "
      "metrics. Drag to move, turn the wheel or pinch to zoom.</p></div>\n</div>\n";
  html += "<script type=\"application/json\" id=\"mesh-about\">" + about_json(picture, packed) + "</script>\n";
  html += "<script type=\"text/plain\" id=\"mesh-data\">" + packed.data + "</script>\n";
  html += fmt::format("<script>//<![CDATA[\n{}{}//]]></script>\n", viewer_metrics, viewer_script);
  return html;
}

std::string_view mesh_view_style() {
  return viewer_style;
}

}  // namespace trismooth
