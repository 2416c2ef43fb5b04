// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/rounding.h"
#include "trismooth/smoothing/smooth.h"

#include "broken.h"
#include "choices.h"
#include "contract.h"
#include "smoothing_checks.h"
#include "support/test_meshes.h"
#include "targets.h"

/// Arrays, constraints and options of every kind, good and bad, as the bytes of the input say. What is wrong is refused
/// and leaves the coordinates alone; what is right is accepted, made no worse, and gives the same bits however it is
/// asked for.
namespace fuzz {

using trismooth::Constraints;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Storage;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Arrays {
  std::vector<double> xy;
  std::vector<std::int32_t> triangles;
};

struct Holds {
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> fixed_ids;
  std::vector<std::uint8_t> other_cells;
  std::vector<std::int32_t> regions;

  Constraints view() const { return {fixed, fixed_ids, other_cells, regions}; }
};

double choose_coordinate(InputBytes& input) {
  switch (input.below(8)) {
    case 0:
      return input.raw<double>();
    case 1:
      return static_cast<double>(input.raw<float>());
    case 2:
      return input.one_of({0.0, -0.0, 5e-324, -5e-324, 2.3e-308, 1e-300, 1e300, -1e300, 1.7976931348623157e308,
                           -1.7976931348623157e308, not_a_number, infinity, -infinity, 4e7, 1e-9});
    case 3:
      return 1 + input.byte() * 0x1p-52;
    default:
      return (input.byte() - 128) / 16.0;
  }
}

Arrays arrays_of(const test_meshes::Mesh& mesh) {
  const std::span<const std::int32_t> indices = mesh.indices();
  return {mesh.xy(), {indices.begin(), indices.end()}};
}

Arrays choose_soup(InputBytes& input) {
  Arrays arrays;
  const int vertices = 1 + input.below(24);
  for (int i = 0; i < 2 * vertices; ++i) {
    arrays.xy.push_back((input.byte() - 128) / 16.0);
  }
  const int triangles = input.below(48);
  for (int t = 0; t < triangles; ++t) {
    const int a = input.below(vertices);
    const int b = input.below(vertices);
    arrays.triangles.insert(arrays.triangles.end(), {a, b, input.below(vertices)});
  }
  return arrays;
}

Arrays choose_grid(InputBytes& input) {
  const int columns = 2 + input.below(7);
  const int rows = 2 + input.below(7);
  const double jitter = input.below(64) / 32.0;
  const test_meshes::Mesh grid = test_meshes::jittered_grid(columns, rows, jitter, input.byte());
  const test_meshes::Mesh mesh = input.flag() ? test_meshes::shuffled(grid, input.byte()) : grid;
  return arrays_of(mesh);
}

Arrays choose_strip(InputBytes& input) {
  const int size = 3 + input.below(20);
  const test_meshes::Mesh mesh = input.flag() ? test_meshes::moebius_band(size) : test_meshes::star(size, input.byte());
  return arrays_of(mesh);
}

/// Damages the arrays here and there.
void edit(InputBytes& input, Arrays& arrays) {
  for (int edits = input.below(8); edits > 0 && arrays.xy.size() > 1 && !arrays.triangles.empty(); --edits) {
    const std::size_t number = input.raw<std::uint16_t>() % arrays.xy.size();
    const std::size_t index = input.raw<std::uint16_t>() % arrays.triangles.size();
    const auto triangle = static_cast<std::ptrdiff_t>(index / 3 * 3);
    const auto corners = arrays.triangles.begin() + triangle;
    const auto vertices = static_cast<std::int32_t>(arrays.xy.size() / 2);
    switch (input.below(10)) {
      case 0:
        arrays.xy[number] = choose_coordinate(input);
        break;
      case 1:
        arrays.triangles[index] = input.byte() % vertices;
        break;
      case 2:
        arrays.triangles[index] = input.one_of({-1, vertices, vertices - 1, std::numeric_limits<std::int32_t>::max(),
                                                std::numeric_limits<std::int32_t>::min()});
        break;
      case 3:
        std::swap(corners[0], corners[1]);
        break;
      case 4:
        std::rotate(corners, corners + 1, corners + 3);
        break;
      case 5:
        if (arrays.triangles.size() % 3 == 0) {
          arrays.triangles.erase(corners, corners + 3);
        }
        break;
      case 6:
        if (arrays.triangles.size() % 3 == 0) {
          const std::vector<std::int32_t> copy(corners, corners + 3);
          arrays.triangles.insert(arrays.triangles.end(), copy.begin(), copy.end());
        }
        break;
      case 7:
        arrays.xy[number / 2 * 2] = arrays.xy[0];
        arrays.xy[number / 2 * 2 + 1] = arrays.xy[1];
        break;
      case 8:
        arrays.xy.insert(arrays.xy.end(), {choose_coordinate(input), choose_coordinate(input)});
        break;
      default:
        // Seldom: an array of the wrong length is refused at once.
        (input.flag() ? arrays.triangles.resize(arrays.triangles.size() - static_cast<std::size_t>(input.below(2)))
                      : arrays.xy.resize(arrays.xy.size() - static_cast<std::size_t>(input.below(2))));
    }
  }
}

void transform(InputBytes& input, std::vector<double>& xy) {
  const double factor = input.one_of({1.0, 1.0, 1.0, 1e-9, 1e9, 0x1p-1060, 0x1p1015, 1e-160, 1e160, 1e-308, 0.0, -1.0});
  const double offset = input.one_of({0.0, 0.0, 0.0, 4e7, -1e12, 1e15, 1e-3});
  const bool one_axis = input.flag();
  const bool to_float = input.flag();
  for (std::size_t i = 0; i < xy.size(); ++i) {
    xy[i] = xy[i] * factor + (one_axis && i % 2 == 1 ? 0 : offset);
    if (to_float && std::abs(xy[i]) <= static_cast<double>(std::numeric_limits<float>::max())) {
      xy[i] = static_cast<double>(static_cast<float>(xy[i]));
    }
  }
}

Arrays choose_arrays(InputBytes& input) {
  const int kind = input.below(8);
  Arrays arrays = kind == 0 ? choose_soup(input) : kind == 1 ? choose_strip(input) : choose_grid(input);
  if (kind < 5) {
    edit(input, arrays);
  }
  if (kind % 2 == 0) {
    transform(input, arrays.xy);
  }
  return arrays;
}

template <class T>
std::vector<T> choose_numbers(InputBytes& input, std::size_t count, int bound) {
  const std::size_t length = input.below(32) == 0 ? count + 1 : count;
  const int sparse = 1 + input.below(16);
  std::vector<T> numbers(length);
  for (std::size_t i = 0; i < length && !input.at_end(); i += static_cast<std::size_t>(1 + input.below(sparse))) {
    numbers[i] = static_cast<T>(input.below(bound));
  }
  return numbers;
}

Holds choose_holds(InputBytes& input, std::size_t vertices, std::size_t triangles) {
  Holds holds;
  const std::uint8_t kinds = input.byte();
  if (kinds % 4 == 1) {
    holds.fixed = choose_numbers<std::uint8_t>(input, vertices, 3);
  }
  if (kinds / 4 % 4 == 1) {
    for (int i = input.below(8); i > 0; --i) {
      const auto any = static_cast<std::int32_t>(vertices) + (input.below(64) == 0 ? 1 : 0);
      holds.fixed_ids.push_back(input.below(64) == 0 ? -1 : input.byte() % std::max(any, 1));
    }
  }
  if (kinds / 16 % 4 == 1) {
    holds.other_cells = choose_numbers<std::uint8_t>(input, vertices, 2);
  }
  if (kinds / 64 % 4 == 1) {
    holds.regions = choose_numbers<std::int32_t>(input, triangles, 4);
  }
  return holds;
}

SmoothingOptions choose_options(InputBytes& input) {
  SmoothingOptions options;
  using trismooth::Method;
  options.method = input.one_of(all_methods());
  options.form = input.one_of({trismooth::Form::swap, trismooth::Form::in_place});
  options.precision = input.one_of({trismooth::Precision::double_precision, trismooth::Precision::single_precision});
  options.evaluation = input.one_of({trismooth::Evaluation::changed, trismooth::Evaluation::all});
  const bool is_of_paper = options.method == Method::smart || options.method == Method::laplacian;
  if (input.flag() && is_of_paper) {
    options.layout = trismooth::Layout::soa;
    options.execution = trismooth::Execution::single_block;
  }
  options.topology = input.one_of({trismooth::Topology::host, trismooth::Topology::device});
  const int guard = input.below(256);
  options.guard = guard % 4 != 0;
  options.untangle = guard / 4 % 4 == 1 ? trismooth::Untangle::on : trismooth::Untangle::off;
  options.record_min_shape = input.flag();
  options.threads = 1 + input.below(3);
  options.max_sweeps = 1 + input.below(12);
  // Bad values seldom: they end the run at once.
  if (input.below(8) == 0) {
    options.tolerance = input.one_of({0.0, 0.5, 1e-3, 5e-324, 1e300, not_a_number, infinity, -1.0});
    options.time_limit_seconds = input.one_of({infinity, infinity, infinity, 0.0, not_a_number, -1.0});
    options.target_quality = input.one_of({0.5, -1.0, 1.0, 0.0, 2.0, not_a_number});
    if (input.flag()) {
      options.target_quality.reset();
    }
    options.max_sweeps -= input.below(16) == 0 ? 14 : 0;
    options.threads -= input.below(16) == 0 ? 5 : 0;
    options.order = input.one_of({trismooth::Order::colour, trismooth::Order::colour, trismooth::Order::unordered});
  }
  return options;
}

bool options_are_valid(const SmoothingOptions& options) {
  return options.max_sweeps >= 0 && options.threads >= 0 && options.tolerance >= 0 && options.tolerance < infinity &&
         options.time_limit_seconds >= 0 &&
         (!options.target_quality || (*options.target_quality >= -1 && *options.target_quality <= 1)) &&
         options.order == trismooth::Order::colour;
}

bool arrays_are_valid(const Arrays& arrays) {
  const auto vertices = static_cast<std::int32_t>(arrays.xy.size() / 2);
  if (arrays.xy.size() % 2 != 0 || arrays.triangles.size() % 3 != 0) {
    return false;
  }
  for (std::size_t i = 0; i < arrays.triangles.size(); i += 3) {
    const std::set<std::int32_t> corners(arrays.triangles.begin() + static_cast<std::ptrdiff_t>(i),
                                         arrays.triangles.begin() + static_cast<std::ptrdiff_t>(i + 3));
    if (corners.size() != 3 || *corners.begin() < 0 || *corners.rbegin() >= vertices) {
      return false;
    }
  }
  return std::ranges::all_of(arrays.xy, [](double x) { return std::isfinite(x); });
}

bool holds_are_valid(const Holds& holds, std::size_t vertices, std::size_t triangles) {
  return (holds.fixed.empty() || holds.fixed.size() == vertices) &&
         (holds.other_cells.empty() || holds.other_cells.size() == vertices) &&
         (holds.regions.empty() || holds.regions.size() == triangles) &&
         std::ranges::all_of(holds.fixed_ids,
                             [&](std::int32_t v) { return v >= 0 && v < static_cast<std::int32_t>(vertices); });
}

std::vector<Point2<double>> points_of(const std::vector<double>& xy) {
  std::vector<Point2<double>> points(xy.size() / 2);
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = {xy[2 * v], xy[2 * v + 1]};
  }
  return points;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(
      a, b, {}, [](double x) { return std::bit_cast<std::uint64_t>(x); },
      [](double x) { return std::bit_cast<std::uint64_t>(x); });
}

/// Thrown by a progress callback: somebody else's error.
struct Interruption : std::exception {};

struct Case {
  Arrays arrays;
  Holds holds;
  SmoothingOptions options;
  Storage storage = Storage::float64;
  std::int64_t stop_after = 0;   ///< sweeps; 0: never
  std::int64_t throw_after = 0;  ///< sweeps; 0: never

  SmoothingOptions with_callback() const {
    SmoothingOptions result = options;
    if (stop_after > 0 || throw_after > 0) {
      result.progress = [this, last = std::int64_t{0}](const trismooth::SweepRecord& record) mutable {
        require(record.sweep == last + 1 && record.moved <= record.evaluated, "a sweep is reported wrongly");
        last = record.sweep;
        if (record.sweep == throw_after) {
          throw Interruption();
        }
        return record.sweep == stop_after ? trismooth::Progress::stop : trismooth::Progress::proceed;
      };
    }
    return result;
  }
  trismooth::SmoothingPlan plan(const SmoothingOptions& with) const {
    return trismooth::plan(static_cast<std::int32_t>(arrays.xy.size() / 2), arrays.triangles, holds.view(), with);
  }
  std::span<const Triangle> triangles() const {
    return {reinterpret_cast<const Triangle*>(arrays.triangles.data()), arrays.triangles.size() / 3};
  }
};

Case choose_case(InputBytes& input) {
  Case chosen;
  chosen.options = choose_options(input);
  const bool asks_for_float32 = input.below(4) == 0;
  const int callback = input.below(16);
  chosen.stop_after = callback == 1 ? 1 + input.below(4) : 0;
  chosen.throw_after = callback == 2 ? 1 + input.below(4) : 0;
  chosen.arrays = choose_arrays(input);
  // Whoever stores coordinates as float32 has no others.
  const bool fits =
      std::ranges::all_of(chosen.arrays.xy, [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); });
  if (asks_for_float32 && fits) {
    chosen.storage = Storage::float32;
    std::ranges::transform(chosen.arrays.xy, chosen.arrays.xy.begin(), &trismooth::rounded_to_float32);
  }
  chosen.holds = choose_holds(input, chosen.arrays.xy.size() / 2, chosen.arrays.triangles.size() / 3);
  return chosen;
}

bool is_accepted(const Case& chosen) {
  if (!options_are_valid(chosen.options) || !arrays_are_valid(chosen.arrays) ||
      !holds_are_valid(chosen.holds, chosen.arrays.xy.size() / 2, chosen.arrays.triangles.size() / 3)) {
    return false;
  }
  return naive_topology(points_of(chosen.arrays.xy), chosen.triangles(), chosen.holds.view()).orientable;
}

/// The same work by other means: the bits must not tell.
void check_reproducible(const Case& chosen, const std::vector<double>& expected, const SmoothingResult& result) {
  SmoothingOptions options = chosen.options;
  options.threads = options.threads % 3 + 1;
  options.evaluation =
      options.evaluation == trismooth::Evaluation::all ? trismooth::Evaluation::changed : trismooth::Evaluation::all;
  options.record_min_shape = !options.record_min_shape;
  trismooth::SmoothingPlan plan = chosen.plan(options);
  for (int run = 0; run < 2; ++run) {
    std::vector<double> xy = chosen.arrays.xy;
    const SmoothingResult again = plan.smooth(xy, chosen.storage);
    require(same_bits(xy, expected), "the bits of the result depend on threads, skipping or an earlier run");
    require(again.sweeps == result.sweeps && again.stop_reason == result.stop_reason &&
                again.moved_vertices == result.moved_vertices && again.guard_rounds == result.guard_rounds,
            "what is reported depends on threads, skipping or an earlier run");
  }
}

/// The points in triples of double, or in pairs of float where that is what they are, the indices in 64 bits.
template <class T, std::size_t n>
void check_form(const Case& chosen, const std::vector<double>& expected) {
  std::vector<std::array<T, n>> points(expected.size() / 2);
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v].back() = T(3);
    points[v][0] = static_cast<T>(chosen.arrays.xy[2 * v]);
    points[v][1] = static_cast<T>(chosen.arrays.xy[2 * v + 1]);
  }
  const std::vector<std::uint64_t> triangles(chosen.arrays.triangles.begin(), chosen.arrays.triangles.end());
  trismooth::smooth(points, triangles, chosen.holds.view(), chosen.options);
  std::vector<double> found;
  for (const std::array<T, n>& point : points) {
    found.insert(found.end(), {static_cast<double>(point[0]), static_cast<double>(point[1])});
    require(n == 2 || point.back() == T(3), "a height has changed");
  }
  require(same_bits(found, expected), "the bits of the result depend on the form of the arrays");
}

/// What the contract gives, bit for bit.
void check_contract(const Case& chosen, const NaiveTopology& topology, std::span<const Point2<double>> before,
                    std::span<const Point2<double>> after, const SmoothingResult& result) {
  const ByContract expected = smooth_by_contract(before, chosen.triangles(), topology, chosen.options, chosen.storage);
  require(result.stop_reason == expected.outcome.reason && result.history.size() == expected.outcome.sweeps.size(),
          "stops elsewhere than the contract says");
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    require(result.history[i].moved == expected.outcome.sweeps[i].moved, "moves other vertices than the contract says");
    require(chosen.options.evaluation == trismooth::Evaluation::all ||
                result.history[i].evaluated == expected.outcome.sweeps[i].changed,
            "evaluates other vertices than those whose neighbourhood changed");
  }
  require(result.guard_rounds == expected.guarded.rounds, "the guard takes other rounds than the contract says");
  require(std::ranges::equal(result.reverted, expected.guarded.reverted, {}, &trismooth::RevertedVertex::vertex),
          "the guard takes back other vertices than the contract says");
  for (std::size_t v = 0; v < after.size(); ++v) {
    require(fuzz::same_bits(after[v], expected.points[v]),
            "vertex " + std::to_string(v) + " is elsewhere than the contract says");
  }
}

void check_accepted(const Case& chosen) {
  const SmoothingOptions options = chosen.with_callback();
  trismooth::SmoothingPlan plan = chosen.plan(options);
  std::vector<double> xy = chosen.arrays.xy;
  SmoothingResult result;
  try {
    result = plan.smooth(xy, chosen.storage);
  } catch (const Interruption&) {
    require(same_bits(xy, chosen.arrays.xy), "coordinates changed although the callback threw");
    return;
  }
  const std::vector<Point2<double>> before = points_of(chosen.arrays.xy);
  const std::vector<Point2<double>> after = points_of(xy);
  const NaiveTopology topology = naive_topology(before, chosen.triangles(), chosen.holds.view());
  require_never_worse({chosen.triangles(), topology, before, after, options, result});
  for (std::size_t i = 0; chosen.storage == Storage::float32 && i < xy.size(); ++i) {
    const auto rounded = static_cast<double>(static_cast<float>(xy[i]));
    require(
        rounded == xy[i] || std::bit_cast<std::uint64_t>(xy[i]) == std::bit_cast<std::uint64_t>(chosen.arrays.xy[i]),
        "a coordinate that was stored as float32 is not one");
  }
  if (chosen.stop_after == 0 && chosen.throw_after == 0 && chosen.options.time_limit_seconds == infinity) {
    // The contract's naive smoothing knows no untangling.
    if (!chosen.options.target_quality && !chosen.options.untangles()) {
      check_contract(chosen, topology, before, after, result);
    }
    check_reproducible(chosen, xy, result);
    chosen.storage == Storage::float64 ? check_form<double, 3>(chosen, xy) : check_form<float, 2>(chosen, xy);
  }
}

}  // namespace

void run_flat_arrays(std::span<const std::uint8_t> bytes) {
  InputBytes input(bytes);
  const Case chosen = choose_case(input);
  if (is_accepted(chosen)) {
    try {
      check_accepted(chosen);
    } catch (const std::runtime_error& error) {
      throw Broken(std::string("refuses what is right: ") + error.what());
    } catch (const std::invalid_argument& error) {
      throw Broken(std::string("refuses what is right: ") + error.what());
    }
    return;
  }
  std::vector<double> xy = chosen.arrays.xy;
  bool refused = false;
  try {
    const trismooth::SmoothingResult result = trismooth::smooth(trismooth::xy_points(xy), chosen.arrays.triangles,
                                                                chosen.holds.view(), chosen.with_callback());
    // Without time nobody has looked.
    refused = chosen.options.time_limit_seconds == 0 && result.inverted < 0 && xy == chosen.arrays.xy;
  } catch (const trismooth::MeshError&) {
    refused = true;
  } catch (const std::invalid_argument&) {
    refused = true;
  }
  require(refused, "accepts what is wrong");
  require(same_bits(xy, chosen.arrays.xy), "coordinates changed although the mesh was refused");
}

}  // namespace fuzz
