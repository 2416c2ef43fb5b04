#include "trismooth/python/regions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/input/inner_edges.h"
#include "trismooth/pipeline/input/marked_points.h"
#include "trismooth/pipeline/input/region_judge.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/text.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

/// A cell array as Python tells of it.
struct Candidate {
  std::string name;
  std::size_t components = 1;
  std::vector<std::int32_t> labels;  ///< a number from 0 for each triangle; none where it has several components
  bool are_whole = false;
};

/// The arguments of smooth(), names as Python writes them.
RegionWords python_words() {
  return {[](const std::string& array) { return "regions=" + nb::cast<std::string>(nb::repr(text_of_file(array))); },
          "regions=False"};
}

std::vector<Candidate> candidates_of(nb::handle arrays, std::size_t triangle_count) {
  std::vector<Candidate> candidates;
  for (const nb::handle array : arrays) {
    const auto [name, components, labels, are_whole] =
        nb::cast<std::tuple<nb::object, std::size_t, nb::object, bool>>(array);
    candidates.push_back(
        {bytes_of_text(name), components, integers(labels, "labels", triangle_count, "triangle"), are_whole});
  }
  return candidates;
}

/// The places of the arrays that give regions, and what the user should know.
nb::tuple judge_arrays(nb::handle triangles_object, std::size_t vertex_count, nb::handle arrays) {
  const HostArray numbers(triangles_object, "triangles");
  const TriangleArray triangle_array(numbers);
  const std::vector<Candidate> candidates = candidates_of(arrays, triangle_array.size());
  std::vector<Triangle> kept;
  const IndexView corners = triangle_array.corners();
  InnerEdges edges(naming_arguments([&] { return corners.triangles(static_cast<std::int64_t>(vertex_count), kept); }),
                   vertex_count);
  const RegionWords words = python_words();
  nb::list places;
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const auto count = [&labels = candidate.labels] {
      const auto highest = std::ranges::max_element(labels);
      return highest == labels.end() ? std::int64_t{0} : std::int64_t{*highest} + 1;
    };
    const TriangleValues values{candidate.name,
                                candidate.components,
                                static_cast<std::int64_t>(triangle_array.size()),
                                [&] { return count() > 1; },
                                count,
                                [&] { return candidate.are_whole; },
                                [&] { return edges.vertices_between(candidate.labels); },
                                [&] { return edges.fraction_between(candidate.labels); }};
    if (!is_annotation(candidate.name) && judge_regions(values, notes, words)) {
      places.append(i);
    }
  }
  nb::list sentences;
  for (const std::string& note : notes) {
    sentences.append(text_of_file(note));
  }
  return nb::make_tuple(places, sentences);
}

/// The vertices that arrays of markers mark, and what the user should know.
nb::tuple judge_marker_arrays(nb::handle triangles_object, std::size_t vertex_count, nb::handle arrays,
                              nb::handle regions_object, nb::handle held_object) {
  const HostArray numbers(triangles_object, "triangles");
  const TriangleArray triangle_array(numbers);
  std::vector<Triangle> kept;
  const IndexView corners = triangle_array.corners();
  const auto triangles =
      naming_arguments([&] { return corners.triangles(static_cast<std::int64_t>(vertex_count), kept); });
  const std::vector<std::int32_t> regions = integers(regions_object, "regions", triangle_array.size(), "triangle");
  std::vector<std::uint8_t> is_held = vertex_flags(held_object, "fixed", vertex_count);
  is_held.resize(vertex_count, 0);
  const std::vector<std::int32_t> inside = find_regions_inside(triangles, regions, is_held);
  nb::list vertices;
  nb::list sentences;
  for (const nb::handle array : arrays) {
    const auto [name, markers, zero] = nb::cast<std::tuple<nb::object, nb::object, std::int32_t>>(array);
    const MarkedPoints marked =
        find_marked_points(triangles, integers(markers, "markers", vertex_count, "vertex"), zero, inside);
    for (const std::int32_t v : marked.vertices) {
      vertices.append(v);
    }
    for (const std::string& note : notes_of_marked_points(bytes_of_text(name), marked, {"fixed=False", "fixed="})) {
      sentences.append(text_of_file(note));
    }
  }
  return nb::make_tuple(vertices, sentences);
}

}  // namespace

void bind_regions(nb::module_& module) {
  module.def("judge_regions", &judge_arrays, "triangles"_a, "vertex_count"_a, "arrays"_a);
  module.def("judge_markers", &judge_marker_arrays, "triangles"_a, "vertex_count"_a, "arrays"_a, "regions"_a.none(),
             "held"_a.none());
  module.def(
      "is_marker_name", [](nb::handle name) { return is_marker_name(bytes_of_text(name)); }, "name"_a);
  module.def(
      "is_region_name", [](nb::handle name) { return is_region_name(bytes_of_text(name)); }, "name"_a);
  module.def(
      "is_side_name", [](nb::handle name) { return is_side_name(bytes_of_text(name)); }, "name"_a);
}

}  // namespace trismooth::python
