// SPDX-License-Identifier: BSD-3-Clause
// The program that compute-sanitizer is run on: every kernel of the CUDA part on meshes of 1K and 10K vertices, with
// the results compared with the CPU's. The tools do not see into kernels that a device launches and refuse programs
// that have any, so this one is linked without the CDP version; the kernels that version is made of, parent and
// children, are launched by the host instead, in the same order.
//
//     test_cuda_sanitizer                       runs everything
//     test_cuda_sanitizer --plant memcheck      has the bug that the named tool is to find
//
// Exit status 77: no device, skipped.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/paper/cdp_parent.cuh"
#include "trismooth/cuda/paper/paper_mesh.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "support/mixed_meshes.h"
#include "support/test_meshes.h"

namespace {

using namespace trismooth;

constexpr int skipped = 77;
int failures = 0;

void expect(bool holds, const std::string& what) {
  if (!holds) {
    std::printf("FAILED: %s\n", what.c_str());
    ++failures;
  }
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// The planted bugs: one for each tool.
namespace planted {

__global__ void write_out_of_bounds(int* values, int count) {
  values[count + static_cast<int>(threadIdx.x)] = 1;
}

__global__ void race_in_shared_memory(int* out) {
  __shared__ int values[64];
  values[threadIdx.x] = static_cast<int>(threadIdx.x);
  out[threadIdx.x] = values[63 - threadIdx.x];
}

__global__ void read_uninitialised(const int* values, int* out) {
  out[threadIdx.x] = values[threadIdx.x] + 1;
}

__global__ void diverge_at_barrier(int* out) {
  if (threadIdx.x < 16) {
    __syncthreads();
  }
  out[threadIdx.x] = 1;
}

int run(const std::string& tool) {
  constexpr int count = 64;
  int* values = nullptr;
  int* out = nullptr;
  TRISMOOTH_CUDA_CHECK(cudaMalloc(&values, count * sizeof(int)));
  TRISMOOTH_CUDA_CHECK(cudaMalloc(&out, count * sizeof(int)));
  if (tool == "memcheck") {
    write_out_of_bounds<<<1, count>>>(values, count);
  } else if (tool == "racecheck") {
    race_in_shared_memory<<<1, count>>>(out);
  } else if (tool == "initcheck") {
    read_uninitialised<<<1, count>>>(values, out);
  } else if (tool == "synccheck") {
    diverge_at_barrier<<<1, 32>>>(out);
  } else {
    std::fprintf(stderr, "no bug is planted for '%s'\n", tool.c_str());
    return 2;
  }
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  TRISMOOTH_CUDA_CHECK(cudaDeviceSynchronize());
  TRISMOOTH_CUDA_CHECK(cudaFree(values));
  TRISMOOTH_CUDA_CHECK(cudaFree(out));
  std::printf("the planted bug has run\n");
  return 0;
}

}  // namespace planted

constexpr std::int64_t most_sweeps = 4;

using Ways = std::vector<std::pair<Method, TargetShape>>;

/// Every method, and what the mean-ratio method may aim at.
Ways every_way() {
  Ways ways{{Method::mean_ratio, TargetShape::input}};
  for (const Method method : values_of<Method>()) {
    ways.emplace_back(method, TargetShape::uniform);
  }
  return ways;
}

/// All executions that this program has, on one mesh, against the CPU.
void compare_executions(const test_meshes::Mesh& mesh) {
  const auto triangles = mesh.indices();
  for (const auto& [method, target] : every_way()) {
    for (const Form form : {Form::swap, Form::in_place}) {
      for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        SmoothingOptions options;
        options.method = method;
        options.mean_ratio.target = target;
        options.form = form;
        options.precision = precision;
        options.max_sweeps = most_sweeps;
        options.untangle = Untangle::off;  // tangled meshes would go to the host
        std::vector<double> expected = mesh.xy();
        smooth(xy_points(expected), triangles, {}, options);
        options.backend = &cuda::backend();
        for (const auto& [execution, layout, topology] :
             {std::tuple(Execution::resident, Layout::aos, Topology::device),
              std::tuple(Execution::resident, Layout::aos, Topology::host),
              std::tuple(Execution::single_block, Layout::aos, Topology::device),
              std::tuple(Execution::single_block, Layout::soa, Topology::host)}) {
          if (execution != Execution::resident && method != Method::smart && method != Method::laplacian) {
            continue;  // not of the paper
          }
          options.execution = execution;
          options.layout = layout;
          options.topology = topology;
          // Where the smallest shape is measured the whole grid sweeps, else patches.
          options.record_min_shape = topology == Topology::host;
          std::vector<double> xy = mesh.xy();
          smooth(xy_points(xy), triangles, {}, options);
          expect(same_bits(xy, expected), std::string(to_string(execution)) + " " + std::string(to_string(layout)) +
                                              " " + std::string(to_string(method)) + " form " +
                                              std::string(to_string(form)) + " " + std::string(to_string(precision)) +
                                              " has other bits than the CPU");
        }
      }
    }
  }
}

template <class Update, class Mesh>
__global__ void __launch_bounds__(cuda::parent_block_size)
    parent_alone(Mesh mesh, cuda::LoopRules rules, cuda::LoopState* state, cuda::SweepSums* sums) {
  __shared__ cuda::SweepSums shared;
  cuda::parent_pass(Update{}, mesh, rules, state, sums, shared);
}

struct RunRecord {
  cuda::LoopState state;
  cuda::SweepSums sums[most_sweeps];
};

/// The CDP version with the host in the place of the launching device.
template <class T, Layout layout>
void compare_cdp_kernels(const test_meshes::Mesh& mesh, Form form) {
  SmoothingOptions options;
  options.form = form;
  options.precision = sizeof(T) == sizeof(float) ? Precision::single_precision : Precision::double_precision;
  options.max_sweeps = most_sweeps;
  options.guard = false;
  std::vector<double> expected = mesh.xy();
  const SmoothingResult reference = smooth(xy_points(expected), mesh.indices(), {}, options);

  cuda::Context context;
  Workers workers(1);
  const LocalFrame frame = local_frame(mesh.points);
  std::vector<Point2<double>> local;
  for (const Point2<double> p : mesh.points) {
    local.push_back(frame.enter(p));
  }
  const OneRings rings = find_mesh_rings(local, mesh.triangles, {}, workers).rings;
  const std::vector<std::uint32_t> offsets(rings.offsets.begin(), rings.offsets.end());
  options.execution = Execution::cdp;
  options.layout = layout;
  const cuda::PackedMesh packed =
      cuda::pack(context, {{context, offsets}, {context, rings.neighbours}}, {context, local}, options);
  const cuda::DeviceRings& packed_rings = std::get<cuda::PaperRings<layout>>(packed.rings).rings;
  const cuda::DeviceElements elements =
      cuda::find_elements(context, packed_rings.view(), packed_rings.neighbours.size());
  cuda::PaperMesh<T, layout> paper(context, packed_rings.view(), packed.order.vertex_count(), elements);

  std::vector<std::int32_t> input_index(mesh.points.size());
  packed.order.input_index.download(input_index);
  std::vector<cuda::PointRecord<T>> positions(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point2<double> p = local[static_cast<std::size_t>(input_index[v])];
    positions[v] = {static_cast<T>(p.x), static_cast<T>(p.y)};
  }
  cuda::DeviceBuffer<cuda::PointRecord<T>> memory(context, positions);
  const cuda::PointArray<T> points{memory.data()};
  paper.initiate(context, points);

  cuda::LoopRules rules{};
  rules.swaps = form == Form::swap;
  rules.tolerance = options.tolerance;
  rules.target = no_target;
  rules.fixed_quotient = std::numeric_limits<double>::infinity();
  rules.sweeps = most_sweeps;
  rules.batch_count = static_cast<std::int32_t>(packed.order.batches.size()) - 1;
  rules.batches = packed.order.batch_begins.data();
  RunRecord record{};
  cuda::DeviceBuffer<RunRecord> device_record(context, 1);
  device_record.upload({&record, 1});
  const auto& view = paper.view();
  do {
    parent_alone<SmartLaplacian><<<1, cuda::parent_block_size, 0, context.stream()>>>(
        view, rules, &device_record.data()->state, device_record.data()->sums);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    device_record.download({&record, 1});
    cuda::update_triangle_qualities<<<cuda::blocks_for(view.triangle_count), cuda::block_size, 0, context.stream()>>>(
        view, record.state.current);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    cuda::update_vertex_minima<<<cuda::blocks_for(view.vertex_count), cuda::block_size, 0, context.stream()>>>(view);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  } while (record.state.stop == cuda::LoopState::running && record.state.sweeps < most_sweeps);
  paper.read_positions(context, record.state.current, points);
  memory.download(positions);

  int different = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto input = static_cast<std::size_t>(input_index[v]);
    const auto [x, y] = positions[v];
    const Point2<double> left = frame.leave({static_cast<double>(x), static_cast<double>(y)});
    const bool stays = x == static_cast<T>(local[input].x) && y == static_cast<T>(local[input].y);
    const Point2<double> stored = stays ? mesh.points[input] : left;
    different += stored.x == expected[2 * input] && stored.y == expected[2 * input + 1] ? 0 : 1;
  }
  expect(different == 0 && record.state.sweeps == reference.sweeps,
         "the kernels of the CDP version differ from the CPU at " + std::to_string(different) + " vertices");
}

/// Caller's fixed vertices, regions, holes, other cells; device topology, guard with reverted vertices.
void compare_constraints() {
  const test_meshes::Mesh mesh = test_meshes::tangled(30, 7);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::vector<std::int32_t> regions(mesh.triangles.size());
  for (std::size_t v = 0; v < fixed.size(); v += 17) {
    fixed[v] = 1;
  }
  for (std::size_t t = 0; t < regions.size(); ++t) {
    regions[t] = t < regions.size() / 2 ? 1 : 2;
  }
  const std::vector<std::int32_t> ids{40, 41};
  const Constraints constraints{.fixed = fixed, .fixed_ids = ids, .other_cells = {}, .regions = regions};
  SmoothingOptions options;
  options.method = Method::laplacian;
  std::vector<double> expected = mesh.xy();
  const SmoothingResult reference = smooth(xy_points(expected), mesh.indices(), constraints, options);
  options.backend = &cuda::backend();
  options.topology = Topology::device;
  std::vector<double> xy = mesh.xy();
  const SmoothingResult result = smooth(xy_points(xy), mesh.indices(), constraints, options);
  expect(same_bits(xy, expected), "constraints and guard give other bits than the CPU");
  expect(reference.reverted_vertices > 0 && result.reverted_vertices == reference.reverted_vertices,
         "the guard takes back as many vertices as the CPU's");
}

/// Meshes with quadrilaterals: sweeps over all vertices and over marked ones, with and without the smallest shape.
void compare_quadrilaterals() {
  // Bent so that means of neighbours lie outside.
  mixed_meshes::MixedMesh mesh(40, 30, 0.3, 3);
  for (auto& [x, y] : mesh.points) {
    y = 0.3 * y + 2 * std::sin(x);
  }
  std::int64_t reverted = 0;
  for (const auto& [method, target] : every_way()) {
    for (const Form form : {Form::swap, Form::in_place}) {
      for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        for (const Evaluation evaluation : {Evaluation::changed, Evaluation::all}) {
          SmoothingOptions options;
          options.method = method;
          options.mean_ratio.target = target;
          options.form = form;
          options.precision = precision;
          options.evaluation = evaluation;
          options.layers = Layers::smooth;
          options.untangle = Untangle::off;  // tangled meshes would go to the host
          options.record_min_shape = evaluation == Evaluation::changed;
          options.max_sweeps = most_sweeps;
          std::vector<double> expected = mesh.xy();
          smooth(xy_points(expected), mesh.elements, {}, options);
          options.backend = &cuda::backend();
          std::vector<double> xy = mesh.xy();
          reverted += smooth(xy_points(xy), mesh.elements, {}, options).reverted_vertices;
          expect(same_bits(xy, expected), "quadrilaterals by " + std::string(to_string(method)) + " form " +
                                              std::string(to_string(form)) + " " + std::string(to_string(precision)) +
                                              " have other bits than the CPU");
        }
      }
    }
  }
  expect(reverted > 0, "the guard takes quadrilaterals back");
}

int run_all() {
  for (const std::int32_t side : {32, 100}) {
    const test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.45, 3);
    compare_executions(mesh);
    for (const Form form : {Form::swap, Form::in_place}) {
      compare_cdp_kernels<float, Layout::aos>(mesh, form);
      compare_cdp_kernels<float, Layout::soa>(mesh, form);
      compare_cdp_kernels<double, Layout::aos>(mesh, form);
      compare_cdp_kernels<double, Layout::soa>(mesh, form);
    }
    std::printf("%d vertices: done\n", side * side);
  }
  compare_constraints();
  compare_quadrilaterals();
  std::printf("%d failures\n", failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const cuda::DeviceSurvey survey = cuda::survey_devices();
    if (survey.devices.empty()) {
      std::printf("skipped: %s\n", survey.problem.c_str());
      return skipped;
    }
    return argc == 3 && std::strcmp(argv[1], "--plant") == 0 ? planted::run(argv[2]) : run_all();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "test_cuda_sanitizer: error: %s\n", error.what());
    return 1;
  }
}
