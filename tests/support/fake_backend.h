// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/overwriting.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/smooth.h"

/// A device that a test can count the calls of and make fail, on any machine.
namespace fakes {

/// Where the device fails.
enum class Failure : std::uint8_t {
  none,
  rings,
  prepare,
  smooth,
  download,  ///< on the way back from a mesh that is on the device alone
  host_memory,
  bits,     ///< silently: a coordinate is not the one that it must be
  no_time,  ///< not at all, but its clock stands still
};

/// Does the CPU's work under the name "cuda".
class FakeBackend final : public trismooth::Backend {
 public:
  /// Fails there: with every mesh, or with those of so many vertices alone.
  explicit FakeBackend(Failure failure = Failure::none, std::size_t vertices = 0)
      : failure_(failure), failing_vertices_(vertices) {}

  std::string name() const override { return "cuda"; }

  std::unique_ptr<trismooth::PreparedSmoother> prepare(trismooth::MeshRings mesh,
                                                       const trismooth::ElementList& elements,
                                                       std::span<const trismooth::Point2<double>> local,
                                                       const trismooth::SmoothingOptions& options) const override {
    ++prepared;
    fail_at(Failure::prepare, local.size());
    trismooth::SmoothingOptions on_cpu = options;
    on_cpu.order = trismooth::Order::colour;  // the CPU has no other
    return std::make_unique<Smoother>(*this,
                                      trismooth::cpu_backend().prepare(std::move(mesh), elements, local, on_cpu));
  }

  bool takes_quadrilaterals() const override { return false; }

  std::optional<trismooth::MeshRings> find_rings(std::span<const trismooth::Point2<double>> points,
                                                 std::span<const trismooth::Triangle> triangles,
                                                 const trismooth::Constraints& constraints,
                                                 const trismooth::SmoothingOptions& options) const override {
    ++rings_found;
    fail_at(Failure::rings, points.size());
    trismooth::Workers workers(options.threads);
    return trismooth::find_mesh_rings(points, triangles, constraints, workers, options.used_layers());
  }

  /// Keeps the mesh "on the device", and brings results back in pieces.
  std::unique_ptr<trismooth::PreparedSmoother> prepare_mesh(std::int32_t vertex_count,
                                                            std::span<const trismooth::Triangle> triangles,
                                                            const trismooth::Constraints& constraints,
                                                            const trismooth::SmoothingOptions& options) const override {
    fail_at(Failure::rings, static_cast<std::size_t>(vertex_count));
    ++prepared;
    fail_at(Failure::prepare, static_cast<std::size_t>(vertex_count));
    return std::make_unique<Mesh>(*this, vertex_count, triangles, constraints, options);
  }

  void start(std::int64_t vertices) const override {
    started_for = vertices;
    if (when_started) {
      when_started();
    }
  }

  /// From now on it fails there.
  void fail_next_at(Failure failure) { failure_ = failure; }

  mutable std::atomic<int> prepared = 0;               ///< calls of prepare() and prepare_mesh()
  mutable std::atomic<int> smoothed = 0;               ///< of smooth()
  mutable std::atomic<int> rings_found = 0;            ///< of find_rings()
  mutable std::atomic<std::int64_t> started_for = -1;  ///< vertices; -1: it was not started
  std::function<void()> when_started;                  ///< what start() does, on the thread that calls it

 private:
  class Smoother final : public trismooth::PreparedSmoother {
   public:
    Smoother(const FakeBackend& backend, std::unique_ptr<PreparedSmoother> cpu)
        : backend_(backend), cpu_(std::move(cpu)) {}

    trismooth::SmoothingResult smooth(std::span<trismooth::Point2<double>> points, trismooth::Storage storage,
                                      const std::optional<trismooth::LocalFrame>& frame) override {
      ++backend_.smoothed;
      trismooth::SmoothingResult result = cpu_->smooth(points, storage, frame);
      backend_.spoil(points, result);  // with the points written already
      return result;
    }

    std::vector<std::uint8_t> fixed() const override { return cpu_->fixed(); }

   private:
    const FakeBackend& backend_;
    std::unique_ptr<PreparedSmoother> cpu_;
  };

  class Mesh final : public trismooth::PreparedSmoother {
   public:
    Mesh(const FakeBackend& backend, std::int32_t vertex_count, std::span<const trismooth::Triangle> triangles,
         const trismooth::Constraints& constraints, const trismooth::SmoothingOptions& options)
        : backend_(backend), workers_(1) {
      fixed_ = trismooth::fixed_vertices(trismooth::connect_triangles(vertex_count, triangles, workers_), triangles,
                                         constraints);
      trismooth::SmoothingOptions on_cpu = options;
      on_cpu.backend = nullptr;
      on_cpu.topology = trismooth::Topology::host;
      on_cpu.order = trismooth::Order::colour;  // the CPU has no other
      plan_ = std::make_unique<trismooth::SmoothingPlan>(vertex_count, triangles, constraints, on_cpu);
    }

    trismooth::SmoothingResult smooth(std::span<trismooth::Point2<double>> points, trismooth::Storage storage,
                                      const std::optional<trismooth::LocalFrame>& /*frame*/) override {
      ++backend_.smoothed;
      std::vector<trismooth::Point2<double>> on_device(points.begin(), points.end());
      trismooth::SmoothingResult result = plan_->smooth(on_device, storage);
      backend_.spoil(on_device, result);
      trismooth::Overwriting overwriting(std::as_writable_bytes(points), &kept_, workers_);
      const std::size_t pieces = 3;
      const auto bytes = std::as_bytes(std::span(on_device));
      for (std::size_t piece = 0, begin = 0; piece < pieces; ++piece) {
        const std::size_t end = bytes.size() * (piece + 1) / pieces;
        if (piece == pieces - 1) {
          backend_.fail_at(Failure::download, points.size());
        }
        overwriting.write(bytes.data() + begin, end - begin);
        begin = end;
      }
      overwriting.done();
      return result;
    }

    std::vector<std::uint8_t> fixed() const override { return fixed_; }

   private:
    const FakeBackend& backend_;
    trismooth::Workers workers_;
    std::vector<std::uint8_t> fixed_;
    std::unique_ptr<trismooth::SmoothingPlan> plan_;
    trismooth::ScratchBytes kept_;
  };

  /// What goes wrong when the sweeps are over.
  void spoil(std::span<trismooth::Point2<double>> points, trismooth::SmoothingResult& result) const {
    fail_at(Failure::smooth, points.size());
    if (failure_ == Failure::bits) {
      points.front().x = std::nextafter(points.front().x, 2.0);
    }
    if (failure_ == Failure::host_memory) {
      throw std::bad_alloc();
    }
    if (failure_ == Failure::no_time) {
      result.timings = {};
    }
    result.backend = "cuda";
  }

  void fail_at(Failure place, std::size_t vertices) const {
    if (failure_ == place && (failing_vertices_ == 0 || failing_vertices_ == vertices)) {
      throw trismooth::DeviceError("CUDA: cudaErrorMemoryAllocation (out of memory) from a test");
    }
  }

  Failure failure_;
  std::size_t failing_vertices_;
};

}  // namespace fakes
