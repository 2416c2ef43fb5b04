// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/paper/bench_command.h"
#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/picture/mesh_picture.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/json_report.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/interruption.h"
#include "trismooth/python/new_array.h"
#include "trismooth/python/options.h"
#include "trismooth/python/results.h"
#include "trismooth/python/text.h"
#include "trismooth/python/turns.h"
#include "trismooth/python/view.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

nb::object array_of(const DataArray& array) {
  return visit_scalar_type(array.type, [&]<class T>(T) {
    const std::span<const T> numbers = array.as<T>();
    std::vector<T> copy(numbers.begin(), numbers.end());
    return array.components == 1 ? new_array<T, 1>(std::move(copy), {array.rows()})
                                 : new_array<T, 2>(std::move(copy), {array.rows(), array.components});
  });
}

nb::dict arrays_of(const std::vector<DataArray>& arrays) {
  nb::dict by_name;
  for (const DataArray& array : arrays) {
    by_name[text_of_file(array.name)] = array_of(array);
  }
  return by_name;
}

std::vector<std::string> names_of(nb::handle value, const char* name) {
  if (value.is_none()) {
    return {};
  }
  if (PyUnicode_Check(value.ptr())) {
    return {bytes_of_text(value)};
  }
  std::vector<std::string> names;
  if (PyList_Check(value.ptr()) || PyTuple_Check(value.ptr())) {
    for (const nb::handle element : value) {
      if (PyUnicode_Check(element.ptr())) {
        names.push_back(bytes_of_text(element));
      }
    }
  }
  if (names.empty() || names.size() != nb::len(value)) {
    raise_type_error(name, "a name or a list of names is needed");
  }
  return names;
}

std::optional<std::string> text_or_none(nb::handle value, const char* name) {
  if (value.is_none()) {
    return std::nullopt;
  }
  if (!PyUnicode_Check(value.ptr())) {
    raise_type_error(name, "a str is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  return bytes_of_text(value);
}

std::optional<double> distance_or_none(nb::handle value, const char* name) {
  if (value.is_none()) {
    return std::nullopt;
  }
  double distance = 0;
  if (PyBool_Check(value.ptr()) || !nb::try_cast(value, distance)) {
    raise_type_error(name, "a number is needed, not " + nb::cast<std::string>(nb::repr(value)));
  }
  if (!std::isfinite(distance) || distance < 0) {
    raise_value_error(name, "a distance is 0 or more, and finite, not " + nb::cast<std::string>(nb::repr(value)));
  }
  return distance;
}

template <class Enum>
std::optional<Enum> choice_or_none(nb::handle value, const char* name) {
  const std::optional<std::string> text = text_or_none(value, name);
  try {
    return text ? std::optional(parse_enum<Enum>(*text)) : std::nullopt;
  } catch (const std::invalid_argument& error) {
    raise_value_error(name, error.what());
  }
}

Quads quads_of(nb::handle value) {
  const std::optional<Quads> quads = choice_or_none<Quads>(value, "quads");
  return quads.value_or(Quads::smooth);
}

/// What the program tells of a run beside its figures.
struct FileOutcome {
  Outcome outcome;
  std::string json;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  std::vector<std::string> losses;
  std::shared_ptr<const MeshPicture> picture;  ///< of the mesh before and after a smoothing; else null

  std::string page(const std::string& title, nb::handle threads_object) const {
    const int threads = threads_of(threads_object);
    const nb::gil_scoped_release no_gil;
    return page_of(title, *picture, threads);
  }
};

std::optional<FileFormat> format_or_none(nb::handle value) {
  const std::optional<std::string> name = text_or_none(value, "format");
  if (!name) {
    return std::nullopt;
  }
  const std::optional<FileFormat> format = format_named(*name);
  if (!format) {
    raise_value_error("format", "unknown format '" + *name + "'; valid are " + format_names());
  }
  return format;
}

/// A mesh that was read from a file, with all that the file holds. One thread at a time works on it.
class FileMesh {
  template <class Function>
  auto with_document(const Function& function) {
    const Turn turn(turns_, "the mesh");
    return function(document_);
  }

 public:
  FileMesh(std::filesystem::path path, nb::handle format, nb::handle threads_object) : path_(std::move(path)) {
    const std::optional<FileFormat> told = format_or_none(format);
    const int threads = threads_of(threads_object);
    const nb::gil_scoped_release no_gil;
    document_ = read_mesh(path_, FileOptions{threads, told});
  }

  nb::object points() {
    return with_document([](MeshDocument& document) {
      return new_array<double, 2>(document.points, {document.point_count(), 3});
    });
  }

  void set_points(nb::handle object) {
    const HostArray array(object, "points");
    const PointArray points(array);
    with_document([&](MeshDocument& document) {
      if (points.size() != document.point_count() || points.components() != 3 || points.storage() != Storage::float64) {
        array.raise_value("shape " + array.shape_text() + " of " + array.type_text() + "; the mesh has (" +
                          std::to_string(document.point_count()) + ", 3) of float64");
      }
      std::vector<double> numbers(document.points.size());
      Workers this_thread(1);
      points.copy_to(reinterpret_cast<std::byte*>(numbers.data()), this_thread);
      for (double& number : numbers) {
        number = rounded_to(document.moved_point_type() == ScalarType::float32 ? Storage::float32 : Storage::float64,
                            number);
        if (!std::isfinite(number)) {
          array.raise_value("a coordinate is not finite, or too large for the file's numbers");
        }
      }
      document.points = std::move(numbers);
    });
  }

  /// The cells of that type, and VTK's Lagrange cells that are the same: (M, nodes).
  nb::object cells(std::uint8_t type, std::size_t nodes) {
    return with_document([&](MeshDocument& document) {
      std::vector<std::int32_t> numbers;
      for (std::size_t c = 0; c < document.cells.size(); ++c) {
        const auto vertices = document.cells[c];
        if (vertices.size() == nodes && type_of_fixed_order(document.cells.types[c], nodes) == type) {
          numbers.insert(numbers.end(), vertices.begin(), vertices.end());
        }
      }
      const std::size_t count = numbers.size() / nodes;
      return new_array<std::int32_t, 2>(std::move(numbers), {count, nodes});
    });
  }

  nb::object cell_types() {
    return with_document([](MeshDocument& document) {
      return new_array<std::uint8_t, 1>(document.cells.types, {document.cells.types.size()});
    });
  }

  nb::dict point_data() {
    return with_document([](MeshDocument& document) { return arrays_of(document.point_arrays); });
  }
  nb::dict cell_data() {
    return with_document([](MeshDocument& document) { return arrays_of(document.cell_arrays); });
  }
  nb::list notes() {
    return with_document([](MeshDocument& document) { return texts(document.notes); });
  }
  std::string format() {
    return with_document([](MeshDocument& document) { return std::string(to_string(document.format)); });
  }
  nb::object path() const {
    const std::string& name = path_.native();
    return nb::steal(PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<Py_ssize_t>(name.size())));
  }

  /// `accept` is called with the outcome before the mesh is changed, and may raise: it has the warnings.
  FileOutcome smooth(const nb::dict& arguments, const nb::dict& file_arguments, const nb::object& progress,
                     const nb::callable& accept) {
    PipelineOptions options = pipeline_options(file_arguments);
    CallOptions call = parse_options(arguments);
    if (options.geographic && call.slide.along != Slide::off) {
      raise_value_error("slide", "is for lines in a plane, which geographic makes curves of; leave out one of them");
    }
    options.smoothing = std::move(call.smoothing);
    options.slide = call.slide;
    options.picture = true;
    Interruption interruption(progress);
    Interruption* const current = &interruption;
    Interruption::watch(options.smoothing, current);
    FileOutcome outcome;
    options.beside.prepare = [&](const PipelineResult& result) {
      outcome = outcome_of(options, result);
      const nb::gil_scoped_acquire gil;
      accept(outcome);
    };
    const PipelineResult result = run(options, smooth_document);
    if (result.smoothing && result.smoothing->moved_vertices > 0) {
      remember_what_stays(result);
    }
    return outcome;
  }

  FileOutcome check(const nb::dict& file_arguments, nb::handle threads) {
    PipelineOptions options = pipeline_options(file_arguments);
    options.smoothing.threads = threads_of(threads);
    return outcome_of(options, run(options, check_document));
  }

  /// Answers what the file does not hold of the mesh.
  nb::list write(const std::filesystem::path& path, nb::handle format, nb::handle threads_object) {
    const std::optional<FileFormat> told = format_or_none(format);
    const int threads = threads_of(threads_object);
    return with_document([&](MeshDocument& document) {
      std::vector<std::string> losses;
      {
        const nb::gil_scoped_release no_gil;
        const FileFormat target = output_format(path, document.format, told);
        losses = what_is_lost(document, target);
        if (target != document.format) {
          losses.insert(losses.end(), document.notes.begin(), document.notes.end());
        }
        for (const std::string& name : written_place_arrays(document, target)) {
          if (stays_.contains(name)) {
            losses.push_back(fmt::format(
                "'{0}' is what {1} files say of places, and its values are as they were read though vertices moved; "
                "smooth(fields='interpolate', field_arrays=['{0}']) has it follow",
                name, title_of(target)));
          }
        }
        write_mesh(path, document, {}, FileOptions{threads, told});
      }
      return texts(losses);
    });
  }

 private:
  /// A smoothing knows of no format to write to, and so not which array becomes its depths.
  void remember_what_stays(const PipelineResult& result) {
    for (const DataArray& array : document_.point_arrays) {
      if (std::ranges::find(result.fields, array.name, &InterpolatedField::name) == result.fields.end()) {
        stays_.insert(array.name);
      }
    }
  }

  PipelineOptions pipeline_options(const nb::dict& arguments) const {
    PipelineOptions options;
    options.input = path_;
    for (const auto& [key, value] : arguments) {
      const auto name = nb::cast<std::string>(key);
      if (name == "regions") {
        options.region_arrays = names_of(value, "regions");
      } else if (name == "fixed_array") {
        options.fixed_array = text_or_none(value, "fixed_array");
      } else if (name == "fixed_sets") {
        options.fixed_sets = names_of(value, "fixed_sets");
      } else if (name == "fixed") {
        const std::vector<std::uint8_t> flags = vertex_flags(value, "fixed", document_.point_count());
        for (std::size_t v = 0; v < flags.size(); ++v) {
          if (flags[v] != 0) {
            options.fixed_vertices.push_back(static_cast<std::int32_t>(v));
          }
        }
      } else if (name == "fixed_labels") {
        if (!value.is_none()) {
          const auto labels = nb::cast<std::vector<std::int64_t>>(value);
          std::ranges::copy(vertices_of_labels(labels, document_, "fixed_labels", "fixed"),
                            std::back_inserter(options.fixed_vertices));
        }
      } else if (name == "merge") {
        options.merge = distance_or_none(value, "merge");
      } else if (name == "quads") {
        options.quads = quads_of(value);
      } else if (name == "size") {
        options.size_array = text_or_none(value, "size");
      } else if (name == "fields") {
        options.fields = choice_or_none<Fields>(value, "fields");
      } else if (name == "field_arrays") {
        options.field_arrays = names_of(value, "field_arrays");
      } else if (name == "project") {
        options.project = choice_or_none<Projection>(value, "project");
      } else {
        options.geographic = flag_of(value, "geographic");
      }
    }
    return options;
  }

  static FileOutcome outcome_of(const PipelineOptions& options, const PipelineResult& result) {
    FileOutcome outcome;
    outcome.json = json_report(options, result);
    outcome.notes = result.notes;
    outcome.warnings = result.warnings;
    outcome.losses = result.losses;
    outcome.picture = result.picture;
    outcome.outcome.before = result.before;
    outcome.outcome.after = result.after;
    outcome.outcome.smoothing = result.smoothing.value_or(SmoothingResult{});
    return outcome;
  }

  PipelineResult run(const PipelineOptions& options,
                     PipelineResult (*stages)(MeshDocument& document, const PipelineOptions& options)) {
    return with_document([&](MeshDocument& document) {
      const nb::gil_scoped_release no_gil;
      return stages(document, options);
    });
  }

  std::filesystem::path path_;
  MeshDocument document_;
  std::set<std::string> stays_;  ///< point arrays whose values are as they were read though vertices moved
  Turns turns_;
};

int run_program(const std::vector<nb::bytes>& arguments) {
  std::vector<const char*> pointers;
  pointers.reserve(arguments.size());
  for (const nb::bytes& argument : arguments) {
    pointers.push_back(argument.c_str());
  }
  const nb::gil_scoped_release no_gil;
  return trismooth::run_program(static_cast<int>(pointers.size()), pointers.data(), {&add_bench_command});
}

}  // namespace

void bind_files(nb::module_& module) {
  module.attr("has_files") = true;
  make_public(nb::exception<ReadError>(module, "ReadError", PyExc_OSError),
              "A mesh file that cannot be read, or that is no planar mesh of triangles and quadrilaterals.");
  make_public(nb::exception<WriteError>(module, "WriteError", PyExc_OSError),
              "A file that cannot be written. What stood there before is untouched.");
  make_public(nb::exception<Cancelled>(module, "Cancelled", PyExc_RuntimeError),
              "The progress callable said stop; the mesh is as it was.");
  nb::class_<FileOutcome>(module, "FileOutcome")
      .def_ro("outcome", &FileOutcome::outcome)
      .def_ro("json", &FileOutcome::json)
      .def_prop_ro("notes", [](const FileOutcome& outcome) { return texts(outcome.notes); })
      .def_prop_ro("warnings", [](const FileOutcome& outcome) { return texts(outcome.warnings); })
      .def_prop_ro("losses", [](const FileOutcome& outcome) { return texts(outcome.losses); })
      .def("page", &FileOutcome::page, "title"_a, "threads"_a);
  nb::class_<FileMesh>(module, "FileMesh")
      .def(nb::init<std::filesystem::path, nb::handle, nb::handle>(), "path"_a, "format"_a.none(), "threads"_a.none())
      .def_prop_rw("points", &FileMesh::points, &FileMesh::set_points)
      .def("cells", &FileMesh::cells, "type"_a, "nodes"_a)
      .def_prop_ro("cell_types", &FileMesh::cell_types)
      .def_prop_ro("point_data", &FileMesh::point_data)
      .def_prop_ro("cell_data", &FileMesh::cell_data)
      .def_prop_ro("notes", &FileMesh::notes)
      .def_prop_ro("format", &FileMesh::format)
      .def_prop_ro("path", &FileMesh::path)
      .def("smooth", &FileMesh::smooth, "options"_a, "file_options"_a, "progress"_a.none(), "accept"_a)
      .def("check", &FileMesh::check, "file_options"_a, "threads"_a.none())
      .def("write", &FileMesh::write, "path"_a, "format"_a.none(), "threads"_a.none());
  module.def("run_program", &run_program, "arguments"_a);
  module.def("format_list", [] { return titled_format_list(); });
}

}  // namespace trismooth::python
