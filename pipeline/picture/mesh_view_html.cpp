// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/mesh_view_html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <future>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trismooth/base/box.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/picture/along_curve.h"
#include "trismooth/pipeline/picture/base64.h"
#include "trismooth/pipeline/picture/colours.h"
#include "trismooth/pipeline/picture/element_shades.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/near_worst.h"
#include "trismooth/pipeline/picture/packed_picture.h"
#include "trismooth/pipeline/picture/png_text.h"
#include "trismooth/pipeline/picture/still_picture.h"
#include "trismooth/pipeline/picture/viewer_text.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/text/report_text.h"

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
          {"lacking", json_of(lacking_colour)},
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

/// What the script is to know. `backdrop`: where the picture behind a large mesh is, or null. As the text of a script
/// element, which ends at no name: `<`, `>` and `&` are escaped.
std::string about_json(const MeshPicture& picture, const PackedPicture& packed, Json backdrop) {
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
      {"base", {packed.base.x, packed.base.y}},
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
      {"backdrop", std::move(backdrop)},
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

/// How large a picture of that part of the plane is, at most so many pixels along either side.
std::pair<int, int> size_of(const Box& window, double most) {
  const double x = window.high.x / 2 - window.low.x / 2;
  const double y = window.high.y / 2 - window.low.y / 2;
  const double scale = most / std::max(x, y);
  return {std::max(static_cast<int>(std::lround(x * scale)), 1), std::max(static_cast<int>(std::lround(y * scale)), 1)};
}

/// The picture for windows that show no other, for paper, and for what lies behind the elements of a large mesh.
StillPicture still(const ElementShades& shades, const MeshLines& lines, bool is_large, Workers& workers) {
  StillOptions options;
  options.window = with_room(shades.box());
  // (Of a million elements a pixel has several, of which it shows the worst, at any such size.)
  constexpr std::size_t many = 1'000'000;
  const int most = is_large ? 2400 : shades.elements().size() > many ? 600 : 1000;
  std::tie(options.width, options.height) = size_of(*options.window, most);
  options.threads = workers.count();
  return draw_still(shades, &lines, options);
}

/// It on a page.
std::string image(std::string_view classes, std::string_view text, const StillPicture& still) {
  return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\"/>\n", classes, text,
                     base64(png_text(still)));
}

/// The part of the plane that the picture behind a large mesh shows.
Json window_in_steps(const Box& window, const PackedPicture& packed) {
  const auto steps = [&](double place, double origin) { return (place - origin) / packed.step; };
  return {{"lowX", steps(window.low.x, packed.origin.x)},
          {"lowY", steps(window.low.y, packed.origin.y)},
          {"highX", steps(window.high.x, packed.origin.x)},
          {"highY", steps(window.high.y, packed.origin.y)}};
}

/// Those of the lines that are between vertices of the page, as it counts them.
MeshLines among(const MeshLines& lines, std::span<const std::int32_t> place_of_vertex) {
  const auto found = [&](const std::vector<EdgeEnds>& edges) {
    std::vector<EdgeEnds> there;
    for (const auto& [from, to] : edges) {
      if (place_of_vertex[from] >= 0 && place_of_vertex[to] >= 0) {
        there.push_back({place_of_vertex[from], place_of_vertex[to]});
      }
    }
    return there;
  };
  return {found(lines.boundary), found(lines.interfaces)};
}

std::string check_box(std::string_view name, std::string_view label) {
  return fmt::format(R"(<label><input type="checkbox" class="view-{}"/>{}</label>)", name, label);
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
    html += fmt::format(R"(<button type="button" class="view-{}" title="{}">{}</button>)", name, title, label);
  }
  return html + "\n</div>\n";
}

}  // namespace

void add_mesh_view(std::string& html, const MeshPicture& picture, Workers& workers, std::int64_t most) {
  const ElementList elements = picture.elements.list();
  const bool is_large = std::ssize(elements) > most;
  std::vector<std::int32_t> shown;
  if (is_large) {
    shown = elements_near_worst(picture, workers);
  } else {
    shown.resize(elements.size());
    std::iota(shown.begin(), shown.end(), 0);
  }
  const OrderedPicture ordered = along_curve(picture, shown, workers);
  // (What is near each other is drawn sooner one after the other.)
  const MeshPicture& drawn = is_large ? picture : ordered.mesh;
  const MeshLines lines = mesh_lines(drawn, workers.count());
  const ElementShades shades(drawn, {}, workers.count());
  // Pictures are compressed by another thread, while the mesh is packed.
  std::vector<std::future<std::string>> images;
  const auto add_image = [&](const ElementShades& of, std::string_view classes, std::string_view text) {
    // (Or later by this one, where there can be no other.)
    images.push_back(
        std::async(std::launch::async | std::launch::deferred,
                   [classes, text, made = still(of, lines, is_large, workers)] { return image(classes, text, made); }));
  };
  add_image(shades, "view-still",
            picture.after.empty() ? "The mesh, coloured by shape" : "The mesh after smoothing, coloured by shape");
  if (is_large && !picture.after.empty()) {
    add_image(ElementShades(picture, {}, workers.count(), true), "view-still-before",
              "The mesh before smoothing, coloured by shape");
  }
  const PackedPicture packed = pack_picture(ordered, is_large ? among(lines, ordered.place_of_vertex) : lines, workers);

  html += "<div id=\"mesh-view\">\n" + tools(picture, packed);
  html +=
      "<div class=\"view-stage\" tabindex=\"0\" role=\"application\" aria-label=\"The mesh. Arrows move it, + and - "
      "zoom, "
      "0 shows all of it, space changes between before and after, n and p lead to the worst elements.\">\n";
  for (std::future<std::string>& made : images) {
    html += made.get();
  }
  html +=
      "<canvas class=\"view-canvas\"></canvas>\n<div class=\"view-marks\"></div>\n</div>\n"
      "<div class=\"view-legend\"></div>\n<div class=\"view-note\">";
  if (is_large) {
    html += fmt::format(
        "The mesh has {} elements, which are more than a page can show one by one ({}): this is a picture of all of "
        "them, in which the worst are in front, and the {} around the worst ones, which can be clicked.",
        count_text(std::ssize(elements)), count_text(most), count_text(std::ssize(shown)));
  }
  html +=
      "</div>\n<div class=\"view-info\" aria-live=\"polite\"><p class=\"soft\">Click an element to see its number, "
      "region and metrics. Drag to move, turn the wheel or pinch to zoom. Red circles are around the worst elements, "
      "held "
      "vertices are orange, moves lead from before to after.</p></div>\n</div>\n";
  html += R"(<script type="application/json" id="mesh-about">)";
  html += about_json(picture, packed, is_large ? window_in_steps(with_room(shades.box()), packed) : Json());
  html += "</script>\n<script type=\"text/plain\" id=\"mesh-data\">";
  std::size_t size = 0;
  for (const PackedStream& stream : packed.streams) {
    size += stream.text.size();
  }
  constexpr std::size_t room = 262'144;  // for what comes behind: the page is large, and is not to be copied
  html.reserve(html.size() + size + room);
  for (const PackedStream& stream : packed.streams) {
    html += stream.text;
  }
  html += "</script>\n";
  html += "<script>//<![CDATA[\n'use strict';\n(() => {\n";
  for (const std::string_view script : viewer_scripts) {
    html += script;
  }
  html += "})();\n//]]></script>\n";
}

std::string_view mesh_view_style() {
  return viewer_style;
}

}  // namespace trismooth
