// SPDX-License-Identifier: BSD-3-Clause
// What the mean-ratio method aims at is the host's, bit for bit, whatever kind of rings it is found from.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/host_targets.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"

#include "catch.h"
#include "support/hostile_meshes.h"
#include "support/test_meshes.h"

using namespace trismooth;
using test_meshes::Mesh;

namespace {

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class Value>
std::vector<Value> copied(const Value* from_device, std::size_t count) {
  std::vector<Value> values(count);
  REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
  REQUIRE(cudaMemcpy(values.data(), from_device, count * sizeof(Value), cudaMemcpyDeviceToHost) == cudaSuccess);
  return values;
}

/// What is aimed at, by the input's vertex numbers.
template <class T>
struct Aims {
  MeanRatioScales<T> scales;
  std::vector<T> inverse_areas;
  std::vector<T> largest_shares;  ///< of fixed vertices: 0
  std::vector<EdgeTensor<T>> edges;
};

/// `own(pointer, count)` copies to the host.
template <class T, class Own>
Aims<T> by_input(const MeanRatioTargets<T>& targets, std::span<const std::int32_t> input_index, std::int32_t free_count,
                 const Own& own) {
  const std::size_t size = input_index.size();
  Aims<T> aims{own(targets.scales, 1).front(), std::vector<T>(size), std::vector<T>(size), {}};
  const auto areas = own(targets.inverse_areas, size);
  const auto shares = own(targets.largest_shares, static_cast<std::size_t>(free_count));
  for (std::size_t v = 0; v < size; ++v) {
    aims.inverse_areas[input_index[v]] = areas[v];
    if (v < shares.size()) {
      aims.largest_shares[input_index[v]] = shares[v];
    }
  }
  if (targets.edges != nullptr) {
    const auto edges = own(targets.edges, size);
    aims.edges.resize(size);
    for (std::size_t v = 0; v < size; ++v) {
      aims.edges[input_index[v]] = edges[v];
    }
  }
  return aims;
}

template <class T>
void require_same(const Aims<T>& found, const Aims<T>& expected) {
  REQUIRE(same_bits(found.scales.size_weight, expected.scales.size_weight));
  REQUIRE(found.scales.power == expected.scales.power);
  REQUIRE(same_bits(found.scales.least_quotient, expected.scales.least_quotient));
  REQUIRE(found.edges.size() == expected.edges.size());
  for (std::size_t v = 0; v < expected.inverse_areas.size(); ++v) {
    CAPTURE(v);
    REQUIRE(same_bits(found.inverse_areas[v], expected.inverse_areas[v]));
    REQUIRE(same_bits(found.largest_shares[v], expected.largest_shares[v]));
  }
  for (std::size_t v = 0; v < expected.edges.size(); ++v) {
    REQUIRE(same_bits(found.edges[v], expected.edges[v]));
  }
}

template <class T>
void check_aims(const Mesh& mesh, SmoothingOptions options, bool has_sizes) {
  options.method = Method::mean_ratio;
  Workers workers(2);
  const LocalFrame frame = local_frame(mesh.points);
  std::vector<Point2<double>> local;
  for (const auto p : mesh.points) {
    local.push_back(frame.enter(p));
  }
  const MeshRings found_rings = find_mesh_rings(local, mesh.triangles, {}, workers);
  const OneRings& rings = found_rings.rings;
  const PackedRings host_rings = pack_rings(rings, local, options.form, workers);
  if (host_rings.free_count() == 0) {
    return;
  }
  std::vector<Point2<T>> host_points;
  for (const std::int32_t v : host_rings.input_index) {
    host_points.push_back({static_cast<T>(local[v].x), static_cast<T>(local[v].y)});
  }
  std::vector<double> lengths;
  if (has_sizes) {
    for (const auto p : local) {
      lengths.push_back(1 + 20 * p.x * p.x);
    }
    options.mean_ratio.target_lengths = lengths;
  }
  const std::vector<double> sizes = inverse_sizes(options, found_rings.fixed);
  std::optional<HostTargets<T>> host;
  workers.run([&] { host.emplace(host_points, host_rings, options.mean_ratio, workers, sizes); });
  const Aims<T> expected =
      by_input(host->view(), host_rings.input_index, host_rings.free_count(),
               [](const auto* from, std::size_t count) { return std::vector(from, from + count); });

  cuda::Context context;
  const std::vector<std::uint32_t> offsets(rings.offsets.begin(), rings.offsets.end());
  const cuda::PackedMesh packed =
      cuda::pack(context, {{context, offsets}, {context, rings.neighbours}}, {context, local}, options);
  std::vector<std::int32_t> input_index(mesh.points.size());
  packed.order.input_index.download(input_index);
  std::vector<cuda::PointRecord<T>> positions;
  for (const std::int32_t v : input_index) {
    positions.push_back({static_cast<T>(local[v].x), static_cast<T>(local[v].y)});
  }
  cuda::DeviceBuffer<cuda::PointRecord<T>> memory(context, positions);
  cuda::DeviceTargets<T> device(context, packed.order.vertex_count(), packed.order.free_count(), options);
  if (has_sizes) {
    device.set_sizes(packed.order, sizes);
  }
  // Twice: what it found before must not be added to.
  for (int times = 0; times < 2; ++times) {
    std::visit([&](const auto& kind) { device.find(kind.view(), cuda::PointArray<T>{memory.data()}, nullptr); },
               packed.rings);
    require_same(by_input(device.view(), input_index, packed.order.free_count(),
                          [](const auto* from, std::size_t count) { return copied(from, count); }),
                 expected);
  }
}

/// From every kind of rings.
template <class T>
void check_everywhere(const Mesh& mesh, const MeanRatioOptions& mean_ratio) {
  for (const Form form : {Form::swap, Form::in_place}) {
    CAPTURE(form);
    SmoothingOptions options;
    options.mean_ratio = mean_ratio;
    options.form = form;
    check_aims<T>(mesh, options, false);
    check_aims<T>(mesh, options, true);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("areas, bounds and scales that the method aims at are the host's", "", float, double) {
  std::vector<test_meshes::NamedMesh> meshes = test_meshes::zoo();
  meshes.push_back({"large", test_meshes::shuffled(test_meshes::jittered_grid(300, 300, 0.5, 9), 10)});
  meshes.push_back({"hub", hostile_meshes::wheel(3000)});
  for (const auto& [name, mesh] : meshes) {
    CAPTURE(name);
    check_everywhere<TestType>(mesh, {});
    check_everywhere<TestType>(mesh, {2.5, 5, TargetShape::input});
  }
}

TEST_CASE("no memory is taken for them where the method is another one") {
  SmoothingOptions options;
  CHECK(cuda::DeviceTargets<double>::bytes(1000, 900, options) == 0);
  options.method = Method::mean_ratio;
  const std::size_t uniform = cuda::DeviceTargets<double>::bytes(1000, 900, options);
  CHECK(uniform >= 1900 * sizeof(double));
  options.mean_ratio.target = TargetShape::input;
  CHECK(cuda::DeviceTargets<double>::bytes(1000, 900, options) == uniform + 6000 * sizeof(double));
  const std::vector<double> lengths(1000, 1);
  options.mean_ratio = {};
  options.mean_ratio.target_lengths = lengths;
  CHECK(cuda::DeviceTargets<double>::bytes(1000, 900, options) == 3900 * sizeof(double));
}
