// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <optional>

#include <fmt/format.h>

#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/topology/device_topology.h"

#include "gpu_smoothing_experiments.h"

namespace benchmarks {

using namespace trismooth;

namespace {

void measure_rings(Session& session, const RandomMesh& mesh) {
  cuda::Context context;
  const double upload = milliseconds_of([&] {
    const cuda::DeviceBuffer<std::int32_t> copy(context, flat_triangles(mesh));
    context.synchronize();
  });
  const cuda::DeviceBuffer<std::int32_t> triangles(context, flat_triangles(mesh));
  // The unit square is a local frame.
  const cuda::DeviceBuffer<Point2<double>> points(context, mesh.points);
  context.synchronize();
  const std::size_t there = context.bytes_in_use();
  std::vector<double> topology_ms;
  std::vector<double> orient_ms;
  std::vector<double> layers_ms;
  std::vector<double> rings_ms;
  std::vector<double> total;
  for (int run = -1; run < session.settings().runs; ++run) {
    std::optional<cuda::DeviceTopology> topology;
    cuda::DeviceRings rings;
    const double connect = milliseconds_of([&] {
      topology.emplace(context, vertex_count_of(mesh), static_cast<std::int32_t>(mesh.triangles.size()),
                       triangles.data(), cuda::DeviceConstraints{}, cuda::NeighbourSearch::parallel);
      context.synchronize();
    });
    const double orient = milliseconds_of([&] {
      topology->orient(points.data());
      context.synchronize();
    });
    const double layers = milliseconds_of([&] {
      std::vector<std::int32_t> held;
      topology->hold_layers(points.data(), Layers::automatic, false, held);
      context.synchronize();
    });
    const double build = milliseconds_of([&] {
      rings = topology->rings();
      context.synchronize();
    });
    if (run >= 0) {  // the first warms up
      topology_ms.push_back(connect);
      orient_ms.push_back(orient);
      layers_ms.push_back(layers);
      rings_ms.push_back(build);
      total.push_back(connect + orient + layers + build);
    }
  }
  const double bytes = static_cast<double>(context.peak_bytes() - there) / vertex_count_of(mesh);
  fmt::print(" {:>9} {:>9} {:>24} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>7.1f}\n", vertex_count_of(mesh),
             mesh.triangles.size(), Spread(total).text(), Spread(topology_ms).median, Spread(orient_ms).median,
             Spread(layers_ms).median, Spread(rings_ms).median, upload, bytes);
  std::fflush(stdout);
  session.report()["rings"].push_back({{"vertices", vertex_count_of(mesh)},
                                       {"triangles", mesh.triangles.size()},
                                       {"runs", session.settings().runs},
                                       {"total_ms", json_of(Spread(total))},
                                       {"topology_ms", json_of(Spread(topology_ms))},
                                       {"orient_ms", json_of(Spread(orient_ms))},
                                       {"layers_ms", json_of(Spread(layers_ms))},
                                       {"rings_ms", json_of(Spread(rings_ms))},
                                       {"upload_of_triangles_ms", upload},
                                       {"device_bytes_per_vertex", bytes}});
}

void measure_plan(Session& session, const RandomMesh& mesh, const std::string& form, const std::string& precision) {
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, flat_triangles(mesh));
  const cuda::DeviceBuffer<double> original(context, flat_points(mesh));
  cuda::DeviceBuffer<double> xy(context, original.size());
  cuda::Plan plan({vertex_count_of(mesh), static_cast<std::int32_t>(mesh.triangles.size()), triangles.data(), {}},
                  session.options("resident", "-", form, precision, mesh), context.stream());
  SameBits bits(session);
  std::vector<double> calls;
  std::vector<double> prepare;
  std::vector<double> sweeps;
  std::vector<double> commit;
  SmoothingResult result;
  double first = 0;
  for (int run = -1; run < session.settings().runs; ++run) {
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(xy.data(), original.data(), original.size() * sizeof(double),
                                         cudaMemcpyDeviceToDevice, context.stream()));
    context.synchronize();
    const double call = milliseconds_of([&] {
      result = plan.smooth(xy.data());
      context.synchronize();
    });
    std::vector<double> found(xy.size());
    xy.download(found);
    bits.compare(found);
    if (run < 0) {  // it also finds and packs the rings
      first = call;
      continue;
    }
    calls.push_back(call);
    prepare.push_back(result.timings.prepare);
    sweeps.push_back(result.timings.smooth);
    commit.push_back(result.timings.commit);
  }
  fmt::print(" {:>9} {:<4} {:<6} {:>24} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>6}\n", vertex_count_of(mesh), form,
             precision, Spread(calls).text(), Spread(prepare).median, Spread(sweeps).median, Spread(commit).median,
             first, result.sweeps);
  std::fflush(stdout);
  session.report()["plan"].push_back({{"vertices", vertex_count_of(mesh)},
                                      {"form", form},
                                      {"precision", precision},
                                      {"method", session.settings().method},
                                      {"runs", session.settings().runs},
                                      {"sweeps", result.sweeps},
                                      {"call_ms", json_of(Spread(calls))},
                                      {"prepare_ms", json_of(Spread(prepare))},
                                      {"sweeps_ms", json_of(Spread(sweeps))},
                                      {"commit_ms", json_of(Spread(commit))},
                                      {"first_call_ms", first},
                                      {"coordinates_hash", bits.hash()}});
}

}  // namespace

void find_rings(Session& session) {
  session.require_device();
  fmt::print(
      "\none-rings from triangles on the device: milliseconds by the host's clock, median (least-most)\n"
      " {:>9} {:>9} {:>24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}\n",
      "vertices", "triangles", "all", "topology", "orient", "layers", "rings", "upload", "B/vtx");
  for (const std::int64_t vertices : session.sizes({1'000'000, 10'000'000})) {
    measure_rings(session, session.mesh(vertices));
  }
}

void call_plan_again(Session& session) {
  session.require_device();
  fmt::print(
      "\na plan called again, coordinates on the device: milliseconds by the host's clock, median (least-most)\n"
      " {:>9} {:<4} {:<6} {:>24} {:>9} {:>9} {:>9} {:>9} {:>6}\n",
      "vertices", "form", "prec.", "a call", "prepare", "sweeps", "commit", "first", "sweeps");
  for (const std::int64_t vertices : session.sizes({100'000})) {
    for (const std::string& precision : session.settings().precisions) {
      for (const std::string& form : session.settings().forms) {
        measure_plan(session, session.mesh(vertices), form, precision);
      }
    }
  }
}

}  // namespace benchmarks
