// SPDX-License-Identifier: BSD-3-Clause
// The CUDA backend on random meshes of every kind: the CPU's bits, in every combination of execution, layout, topology,
// form, method and precision, each mesh in a few of them; from device memory and in plans; and where no order is fixed,
// the contract.

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/rounding.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/uploaded_constraints.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "device_ways.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "properties/with_unused.h"
#include "support/used_frame.h"

using namespace device_ways;
using namespace properties;
using test_meshes::Random;
using trismooth::Evaluation;
using trismooth::Execution;
using trismooth::Order;
using trismooth::Progress;
using trismooth::SweepRecord;
using trismooth::Topology;

namespace cuda = trismooth::cuda;

namespace {

void choose_any(const std::vector<DeviceWay>& ways, SmoothingOptions& options, Random& random) {
  ways[static_cast<std::size_t>(random.below(static_cast<std::int32_t>(ways.size())))].choose_in(options);
}

/// What every backend has to do alike beside method, form, precision, sweep limit and tolerance.
void draw_the_rest(SmoothingOptions& options, Random& random) {
  if (random.below(4) != 0) {
    options.untangle = trismooth::Untangle::off;  // tangled meshes go to the host
  }
  options.guard = random.below(5) != 0;
  options.record_min_shape = random.below(4) == 0;
  options.evaluation = random.below(4) == 0 ? Evaluation::all : Evaluation::changed;
  if (random.below(6) == 0) {
    options.target_quality = random.between(-0.2, 0.8);
  }
  if (random.below(8) == 0) {
    const std::int64_t last = 1 + random.below(8);
    options.progress = [last](const SweepRecord& record) {
      return record.sweep == last ? Progress::stop : Progress::proceed;
    };
  }
}

std::string text_of_device(const SmoothingOptions& options) {
  return fmt::format("{}, {}, topology {}{}{}{}", to_string(options.execution), to_string(options.layout),
                     to_string(options.topology), options.guard ? "" : ", no guard",
                     options.record_min_shape || options.target_quality ? ", measured" : "",
                     options.progress ? ", watched" : "");
}

/// A mesh in device memory, smoothed there by a plan as often as asked.
class OnDevice {
 public:
  OnDevice(const RandomMesh& mesh, const SmoothingOptions& options)
      : triangles_(context_, mesh.mesh.indices()),
        constraints_(context_, mesh.constraints()),
        plan_({mesh.mesh.vertex_count(), static_cast<std::int32_t>(mesh.mesh.triangles.size()), triangles_.data(),
               constraints_.view()},
              options, context_.stream()) {}

  Run smooth(const std::vector<double>& xy, Storage storage) {
    cuda::DeviceBuffer<double> device(context_, xy);
    Run run{xy, {}};
    run.result = plan_.smooth(device.data(), storage);
    device.download(run.xy);
    return run;
  }

  /// Coordinates as float32, there as here.
  Run smooth_floats(const std::vector<double>& xy) {
    std::vector<float> floats;
    std::ranges::transform(xy, std::back_inserter(floats), [](double x) { return static_cast<float>(x); });
    cuda::DeviceBuffer<float> device(context_, floats);
    Run run;
    run.result = plan_.smooth(device.data());
    device.download(floats);
    run.xy.assign(floats.begin(), floats.end());
    return run;
  }

 private:
  cuda::Context context_;
  cuda::DeviceBuffer<std::int32_t> triangles_;
  cuda::UploadedConstraints constraints_;
  cuda::Plan plan_;
};

/// Its coordinates as a file of float32 would hold them.
RandomMesh in_floats(RandomMesh mesh) {
  for (auto& p : mesh.mesh.points) {
    p = {trismooth::rounded_to_float32(p.x), trismooth::rounded_to_float32(p.y)};
  }
  return mesh;
}

}  // namespace

TEST_CASE("random meshes have the CPU's bits, history and guard in every execution, layout and topology") {
  for_random_meshes(2400, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, Random& random) -> std::string {
      draw_the_rest(options, random);
      const Storage storage = fits_float32(mesh) && random.below(4) == 0 ? Storage::float32 : Storage::float64;
      const Run expected = run(mesh, options, storage);
      options.backend = &cuda::backend();
      for (int times = 0; times < 2; ++times) {
        choose_any(every_way(options.method), options, random);
        options.topology = static_cast<Topology>(random.below(2));
        const Run found = run(mesh, options, storage);
        if (const std::string wrong = difference(found, expected); !wrong.empty()) {
          return fmt::format("{}: {}", text_of_device(options), wrong);
        }
      }
      return {};
    });
  });
}

TEST_CASE("random meshes in device memory have the CPU's bits, in plans used again and in float") {
  for_random_meshes(1200, [](const RandomMesh& any) {
    const RandomMesh mesh = fits_float32(any) && any.seed % 3 == 0 ? in_floats(any) : any;
    const bool is_float = mesh.seed % 3 == 0 && fits_float32(any);
    return for_some_options(mesh, 1, [&](SmoothingOptions options, Random& random) -> std::string {
      draw_the_rest(options, random);
      const Run expected = run(mesh, options, is_float ? Storage::float32 : Storage::float64);
      choose_any(every_way(options.method), options, random);
      OnDevice device(mesh, options);
      for (int times = 0; times < 2; ++times) {
        const Run found =
            is_float ? device.smooth_floats(mesh.mesh.xy()) : device.smooth(mesh.mesh.xy(), Storage::float64);
        if (const std::string wrong = difference(found, expected); !wrong.empty()) {
          return fmt::format("{}, call {}: {}", text_of_device(options), times + 1, wrong);
        }
        // What a plan has seen in between does not matter, mirrored as it may be.
        std::vector<double> other = mesh.mesh.xy();
        for (std::size_t i = 0; i < other.size(); i += 2) {
          other[i] = -other[i];
        }
        device.smooth(other, Storage::float64);
      }
      return {};
    });
  });
}

TEST_CASE("random meshes with sizes asked for have the CPU's bits, in host memory, in device memory and in plans") {
  for_random_meshes(1200, [](const RandomMesh& mesh) {
    std::vector<double> lengths;
    return for_some_options(mesh, 1, [&](SmoothingOptions options, Random& random) -> std::string {
      draw_the_rest(options, random);
      options.method = trismooth::Method::mean_ratio;
      for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
        lengths.push_back(random.between(0.5, 4));
      }
      options.mean_ratio.target_lengths = lengths;
      if (random.below(4) == 0) {
        options.untangle = trismooth::Untangle::on;
      }
      const Run expected = run(mesh, options);
      choose_any(every_way(options.method), options, random);
      options.backend = &cuda::backend();
      options.topology = static_cast<Topology>(random.below(2));
      if (const std::string wrong = difference(run(mesh, options), expected); !wrong.empty()) {
        return fmt::format("{}: {}", text_of_device(options), wrong);
      }
      OnDevice device(mesh, options);
      for (int times = 0; times < 2; ++times) {
        if (const std::string wrong = difference(device.smooth(mesh.mesh.xy(), Storage::float64), expected);
            !wrong.empty()) {
          return fmt::format("{}, in device memory, call {}: {}", text_of_device(options), times + 1, wrong);
        }
      }
      return {};
    });
  });
}

TEST_CASE("random meshes have the host's orientation, constraints and rings") {
  for_random_meshes(2000, [](const RandomMesh& mesh) -> std::string {
    const trismooth::LocalFrame frame =
        test_meshes::used_frame(mesh.mesh.points, mesh.mesh.triangles, mesh.other_cells);
    std::vector<Point2<double>> local;
    std::ranges::transform(mesh.mesh.points, std::back_inserter(local), [&](auto p) { return frame.enter(p); });
    trismooth::Workers workers(1);
    SmoothingOptions options;
    const auto expected =
        trismooth::find_mesh_rings(local, mesh.mesh.triangles, mesh.constraints(), workers, options.used_layers());
    options.execution = mesh.seed % 2 == 0 ? Execution::single_block : Execution::resident;
    const auto found = cuda::backend().find_rings(local, mesh.mesh.triangles, mesh.constraints(), options);
    if (!found) {
      return "the backend finds no rings";
    }
    if (found->reversed != expected.reversed || found->components != expected.components ||
        found->reoriented_triangles != expected.reoriented_triangles) {
      return "another orientation";
    }
    if (found->fixed != expected.fixed) {
      return "other constraints";
    }
    const bool same_rings =
        found->rings.offsets == expected.rings.offsets && found->rings.neighbours == expected.rings.neighbours;
    return same_rings ? "" : "other rings";
  });
}

TEST_CASE("unused vertices, however far, change no bit, by every way to the device, and keep theirs") {
  for_random_meshes(1200, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, Random& random) -> std::string {
      draw_the_rest(options, random);
      const WithUnused more = with_unused_vertices(mesh, true, random);
      const Run expected = run(mesh, options);
      const auto verdict = [&](const Run& found, const std::string& way) -> std::string {
        const std::vector<double> before = more.mesh.mesh.xy();
        const std::string wrong = difference(more.without(found), expected);
        const std::string moved =
            difference(std::span(found.xy).subspan(expected.xy.size()), std::span(before).subspan(expected.xy.size()));
        return wrong.empty() && moved.empty() ? "" : fmt::format("{}: {}{}", way, wrong, moved);
      };
      choose_any(every_way(options.method), options, random);
      OnDevice device(more.mesh, options);
      if (const auto wrong = verdict(device.smooth(more.mesh.mesh.xy(), Storage::float64), "a plan on the device");
          !wrong.empty()) {
        return fmt::format("{}: {}", text_of_device(options), wrong);
      }
      options.backend = &cuda::backend();
      options.topology = static_cast<Topology>(random.below(2));
      const std::string wrong = verdict(run(more.mesh, options), "from the host");
      return wrong.empty() ? wrong : fmt::format("{}: {}", text_of_device(options), wrong);
    });
  });
}

TEST_CASE("in no fixed order random meshes are smoothed by the contract all the same") {
  for_random_meshes(600, [](const RandomMesh& mesh) {
    const Connectivity connectivity = connectivity_of(mesh);
    return for_some_options(mesh, 2, [&](SmoothingOptions options, Random& random) -> std::string {
      options.backend = &cuda::backend();
      options.form = Form::in_place;
      options.untangle = trismooth::Untangle::off;  // tangled meshes would go to the host
      options.order = Order::unordered;
      options.method = is_of_paper(options.method) ? options.method : trismooth::Method::smart;
      choose_any(paper_ways(), options, random);
      const std::string wrong = breach(mesh, connectivity, run(mesh, options), true);
      return wrong.empty() ? wrong : fmt::format("{}: {}", text_of_device(options), wrong);
    });
  });
}
