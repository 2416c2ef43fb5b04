// SPDX-License-Identifier: BSD-3-Clause
// What every method makes of the shapes and sizes of elements, on meshes of many kinds: random ones with a boundary as
// fine as the inside and without (the paper's data), distorted grids, and mesh files. Of each mesh and method two rows:
// the elements with a vertex that may move, which are all that a method can change, and all elements.
//
//     element_quality --sizes 10K 100K 1M --seeds 1 2 3 --json figures.json examples/data/coast.vtu
//     element_quality --kinds wave --methods smart --form a

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/report/spread.h"
#include "trismooth/quality/size_change.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "run_reporting.h"
#include "support/distorted_meshes.h"

namespace {

using namespace trismooth;
using Json = nlohmann::ordered_json;

enum class Kind : std::uint8_t { resolved, random, hexagonal, displaced, wave };

}  // namespace

template <>
struct trismooth::EnumText<Kind> {
  static constexpr std::string_view what = "kind of mesh";
  static constexpr std::array<std::pair<Kind, std::string_view>, 5> texts{{{Kind::resolved, "resolved"},
                                                                           {Kind::random, "random"},
                                                                           {Kind::hexagonal, "hexagonal"},
                                                                           {Kind::displaced, "displaced"},
                                                                           {Kind::wave, "wave"}}};
};

namespace {

struct Settings {
  std::vector<std::string> sizes{"10K", "100K"};
  std::vector<std::uint64_t> seeds{1};
  std::vector<std::string> kinds;    // empty: all
  std::vector<std::string> methods;  // empty: all
  std::optional<std::string> form;
  std::optional<std::string> precision;
  std::optional<std::int64_t> max_sweeps;
  int threads = 0;
  int runs = 1;
  std::string json;
  std::vector<std::string> files;
};

/// A mesh and what holds its vertices beside its boundary.
struct Input {
  std::string name;
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> fixed;
  std::vector<std::uint8_t> other_cells;
  std::vector<std::int32_t> regions;

  Constraints constraints() const { return {.fixed = fixed, .other_cells = other_cells, .regions = regions}; }
};

/// Shapes of some elements.
struct Shapes {
  std::int64_t elements = 0;
  double smallest = 0;
  double p1 = 0;  ///< the 1st percentile: the smallest shape that 1 % do not exceed
  double mean = 0;
  std::int64_t inverted = 0;
};

/// A row of the results: a mesh before, or after a method.
struct Row {
  std::string mesh;
  std::string method;  ///< "before" for the input
  std::int64_t vertices = 0;
  std::int64_t free_vertices = 0;
  Shapes free;  ///< of the elements with a free vertex
  Shapes all;
  std::optional<SizeChange> sizes;
  std::optional<SmoothingResult> smoothing;
  double milliseconds = 0;  ///< sweeps and guard: the median of the runs
};

Shapes shapes_of(std::vector<double> values) {
  if (values.empty()) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {0, nan, nan, nan, 0};
  }
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  const auto count = values.size();
  const auto first_not_inverted = std::lower_bound(values.begin(), values.end(), 0.0);
  return {static_cast<std::int64_t>(count), values.front(), values[(count + 99) / 100 - 1],
          sum / static_cast<double>(count), first_not_inverted - values.begin()};
}

void measure(const TriangleView& view, std::span<const std::uint8_t> fixed, Row& row) {
  std::vector<double> of_free;
  std::vector<double> of_all;
  for (std::size_t t = 0; t < view.elements.size(); ++t) {
    const auto [a, b, c] = canonical_corners(view, t);
    of_all.push_back(shape(view.points[a], view.points[b], view.points[c]));
    if (fixed[a] == 0 || fixed[b] == 0 || fixed[c] == 0) {
      of_free.push_back(of_all.back());
    }
  }
  row.free = shapes_of(std::move(of_free));
  row.all = shapes_of(std::move(of_all));
}

SmoothingOptions options_of(const Settings& settings, Method method) {
  SmoothingOptions options;
  options.method = method;
  options.threads = settings.threads;
  if (settings.form) {
    options.form = parse_enum<Form>(*settings.form);
  }
  if (settings.precision) {
    options.precision = parse_enum<Precision>(*settings.precision);
  }
  options.max_sweeps = settings.max_sweeps.value_or(options.max_sweeps);
  return options;
}

/// The mesh before and after every method.
std::vector<Row> rows_of(const Input& input, const Settings& settings, const std::vector<Method>& methods) {
  Workers workers(settings.threads);
  const LocalFrame frame = local_frame(input.points, [](std::size_t) { return true; });
  const LocalPoints local = entered(frame, input.points);
  const MeshRings found = find_mesh_rings(local.points, input.triangles, input.constraints(), workers);
  const TriangleView before{local.points, input.triangles, found.reversed, frame.exponent};

  Row row;
  row.mesh = input.name;
  row.method = "before";
  row.vertices = static_cast<std::int64_t>(input.points.size());
  row.free_vertices = std::count(found.fixed.begin(), found.fixed.end(), 0);
  measure(before, found.fixed, row);
  std::vector<Row> rows{row};
  for (const Method method : methods) {
    std::vector<double> times;
    std::vector<double> xy;
    SmoothingResult result;
    for (int run = 0; run < settings.runs; ++run) {
      xy.clear();
      for (const Point2<double> p : input.points) {
        xy.insert(xy.end(), {p.x, p.y});
      }
      result = smooth(xy_points(xy), input.triangles, input.constraints(), options_of(settings, method));
      times.push_back(result.timings.smooth + result.timings.commit);
    }
    std::vector<Point2<double>> moved(input.points.size());
    for (std::size_t v = 0; v < moved.size(); ++v) {
      moved[v] = {xy[2 * v], xy[2 * v + 1]};
    }
    const LocalPoints after = entered(frame, moved);
    const TriangleView view{after.points, input.triangles, found.reversed, frame.exponent};
    row.method = to_string(method);
    row.sizes = size_change(before, view, settings.threads);
    row.smoothing = std::move(result);
    row.milliseconds = Spread(times).median;
    measure(view, found.fixed, row);
    rows.push_back(row);
  }
  return rows;
}

std::string figures(const Shapes& shapes) {
  return fmt::format("{:>10} {:>9.3g} {:>7.3f} {:>7.3f}", shapes.elements, shapes.smallest, shapes.p1, shapes.mean);
}

void print(const std::vector<Row>& rows) {
  fmt::print("{}: {} vertices, {} free\n", rows.front().mesh, rows.front().vertices, rows.front().free_vertices);
  fmt::print("{:<12} {:>10} {:>9} {:>7} {:>7} {:>9} {:>16} {:>7} {:>9}  {}\n", "", "elements", "smallest", "1 %",
             "mean", "rms ln A", "A/A0, 1 to 99 %", "sweeps", "ms", "");
  for (const Row& row : rows) {
    fmt::print("{:<12} {}", row.method, figures(row.free));
    if (row.smoothing) {
      const SmoothingResult& smoothing = *row.smoothing;
      fmt::print(" {:>9.4f} {:>16} {:>7} {:>9.2f}  {}", row.sizes->rms_log_ratio,
                 fmt::format("{:.3g} {:.3g}", row.sizes->ratio_p1, row.sizes->ratio_p99), smoothing.sweeps,
                 row.milliseconds, to_string(smoothing.stop_reason));
      if (smoothing.reverted_vertices > 0) {
        fmt::print(", {} put back", smoothing.reverted_vertices);
      }
    }
    if (row.all.inverted > 0) {
      fmt::print("  {} inverted", row.all.inverted);
    }
    fmt::print("\n{:<12} {}\n", "  all", figures(row.all));
  }
  fmt::print("\n");
}

Json json_of(const Shapes& shapes) {
  return {{"elements", shapes.elements},
          {"smallest", shapes.smallest},
          {"p1", shapes.p1},
          {"mean", shapes.mean},
          {"inverted", shapes.inverted}};
}

Json json_of(const Row& row) {
  Json json{{"mesh", row.mesh},
            {"vertices", row.vertices},
            {"free_vertices", row.free_vertices},
            {"method", row.method},
            {"with_free_vertex", json_of(row.free)},
            {"all", json_of(row.all)}};
  if (row.smoothing) {
    json["size_change"] = {{"rms_log_ratio", row.sizes->rms_log_ratio},
                           {"ratio_p1", row.sizes->ratio_p1},
                           {"ratio_p99", row.sizes->ratio_p99},
                           {"left_out", row.sizes->left_out}};
    json["sweeps"] = row.smoothing->sweeps;
    json["stop_reason"] = std::string(to_string(row.smoothing->stop_reason));
    json["reverted_vertices"] = row.smoothing->reverted_vertices;
    json["milliseconds"] = row.milliseconds;
  }
  return json;
}

Input generated(Kind kind, std::int64_t vertices, std::uint64_t seed) {
  const auto side = static_cast<std::int32_t>(std::lround(std::sqrt(static_cast<double>(vertices))));
  Input input;
  input.name = fmt::format("{}, seed {}", to_string(kind), seed);
  const auto take = [&](auto mesh) {
    input.points.assign(mesh.points.begin(), mesh.points.end());
    input.triangles = std::move(mesh.triangles);
  };
  switch (kind) {
    case Kind::resolved:
      take(random_delaunay_mesh(vertices, seed, {.boundary = GeneratedBoundary::resolved}));
      break;
    case Kind::random:
      take(random_delaunay_mesh(vertices, seed));
      break;
    case Kind::hexagonal:
      take(distorted_meshes::hexagonal(side, 0.4, seed));
      break;
    case Kind::displaced:
      take(distorted_meshes::displaced(side, 0.45, seed));
      break;
    case Kind::wave:
      input.name = to_string(kind);
      take(distorted_meshes::wave(side));
      break;
  }
  return input;
}

/// The mesh of a file, with what `trismooth smooth` would hold fixed in it.
Input read(const std::filesystem::path& path) {
  const MeshDocument document = read_mesh(path);
  PlanarMesh mesh = planar_mesh(document, path, Quads::hold);
  Input input;
  input.name = path.filename().string();
  input.fixed = find_fixed_array(document, std::nullopt).flags;
  input.regions = find_regions(document, mesh).of_triangle;
  input.other_cells = std::move(mesh.in_other_cell);
  input.points.assign(mesh.points.begin(), mesh.points.end());
  input.triangles.assign(mesh.elements.triangles().begin(), mesh.elements.triangles().end());
  return input;
}

/// The values that texts name; all where there is no text.
template <class Enum>
std::vector<Enum> chosen(const std::vector<std::string>& texts) {
  std::vector<Enum> values;
  for (const std::string& text : texts) {
    values.push_back(parse_enum<Enum>(text));
  }
  if (texts.empty()) {
    for (const auto& [value, text] : EnumText<Enum>::texts) {
      values.push_back(value);
    }
  }
  return values;
}

int run(int argc, char** argv) {
  CLI::App app("What every method makes of the shapes and sizes of elements");
  Settings settings;
  app.add_option("--sizes", settings.sizes, "vertices of generated meshes; none where files are named")
      ->capture_default_str();
  app.add_option("--seeds", settings.seeds, "of generated meshes")->capture_default_str();
  app.add_option("--kinds", settings.kinds, "of generated meshes [" + alternatives<Kind>() + "]");
  app.add_option("--methods", settings.methods, "[" + alternatives<Method>() + "]");
  app.add_option("--form", settings.form);
  app.add_option("--precision", settings.precision);
  app.add_option("--max-sweeps", settings.max_sweeps);
  app.add_option("--threads", settings.threads, "0: one a core")->capture_default_str();
  app.add_option("--runs", settings.runs, "of which times are the median")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--json", settings.json, "file for all figures");
  app.add_option("files", settings.files, "meshes, in place of generated ones");
  CLI11_PARSE(app, argc, argv);

  const std::vector<Method> methods = chosen<Method>(settings.methods);
  Json json = Json::array();
  const auto show = [&](const Input& input) {
    const std::vector<Row> rows = rows_of(input, settings, methods);
    print(rows);
    for (const Row& row : rows) {
      json.push_back(json_of(row));
    }
  };
  for (const std::string& file : settings.files) {
    show(read(file));
  }
  if (settings.files.empty() || app.count("--kinds") > 0) {
    for (const Kind kind : chosen<Kind>(settings.kinds)) {
      for (const std::string& size : settings.sizes) {
        const std::int64_t vertices = parse_count(size, 9, max_random_mesh_vertices);
        for (std::size_t i = 0; i < (kind == Kind::wave ? 1 : settings.seeds.size()); ++i) {
          show(generated(kind, vertices, settings.seeds[i]));
        }
      }
    }
  }
  if (!settings.json.empty()) {
    std::ofstream stream(settings.json);
    stream << json.dump(2) << '\n';
    if (!stream.flush()) {
      throw std::runtime_error(settings.json + ": cannot be written");
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("element_quality", run, argc, argv);
}
