#pragma once

#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/errors.h"

/// A device that a test can count the calls of and make fail, on any machine.
namespace fakes {

/// Where the device fails.
enum class Failure : std::uint8_t {
  none,
  rings,
  prepare,
  smooth,
  host_memory,
  bits,     ///< silently: a coordinate is not the one that it must be
  no_time,  ///< not at all, but its clock stands still
};

/// Does the CPU's work under the name "cuda".
class FakeBackend final : public trismooth::Backend {
 public:
  explicit FakeBackend(Failure failure = Failure::none) : failure_(failure) {}

  std::string name() const override { return "cuda"; }

  std::unique_ptr<trismooth::PreparedSmoother> prepare(const trismooth::OneRings& rings,
                                                       std::span<const trismooth::Point2<double>> points,
                                                       const trismooth::SmoothingOptions& options) const override {
    ++prepared;
    fail_at(Failure::prepare);
    trismooth::SmoothingOptions on_cpu = options;
    on_cpu.order = trismooth::Order::colour;  // the CPU has no other
    return std::make_unique<Smoother>(*this, trismooth::cpu_backend().prepare(rings, points, on_cpu));
  }

  std::optional<trismooth::MeshRings> find_rings(std::span<const trismooth::Point2<double>> points,
                                                 std::span<const trismooth::Triangle> triangles,
                                                 const trismooth::Constraints& constraints,
                                                 const trismooth::SmoothingOptions& options) const override {
    ++rings_found;
    fail_at(Failure::rings);
    trismooth::Workers workers(options.threads);
    return trismooth::find_mesh_rings(points, triangles, constraints, workers);
  }

  /// From now on it fails there.
  void fail_next_at(Failure failure) { failure_ = failure; }

  mutable int prepared = 0;     ///< calls of prepare()
  mutable int smoothed = 0;     ///< of smooth()
  mutable int rings_found = 0;  ///< of find_rings()

 private:
  class Smoother final : public trismooth::PreparedSmoother {
   public:
    Smoother(const FakeBackend& backend, std::unique_ptr<PreparedSmoother> cpu)
        : backend_(backend), cpu_(std::move(cpu)) {}

    trismooth::SmoothingResult smooth(std::span<trismooth::Point2<double>> points, const trismooth::LocalFrame& frame,
                                      trismooth::Storage storage, double fixed_quotient) override {
      ++backend_.smoothed;
      trismooth::SmoothingResult result = cpu_->smooth(points, frame, storage, fixed_quotient);
      backend_.fail_at(Failure::smooth);  // with the points written already
      if (backend_.failure_ == Failure::bits) {
        points.front().x = std::nextafter(points.front().x, 2.0);
      }
      if (backend_.failure_ == Failure::host_memory) {
        throw std::bad_alloc();
      }
      if (backend_.failure_ == Failure::no_time) {
        result.timings = {};
      }
      result.backend = "cuda";
      return result;
    }

   private:
    const FakeBackend& backend_;
    std::unique_ptr<PreparedSmoother> cpu_;
  };

  void fail_at(Failure place) const {
    if (failure_ == place) {
      throw trismooth::DeviceError("CUDA: cudaErrorMemoryAllocation (out of memory) from a test");
    }
  }

  Failure failure_;
};

}  // namespace fakes
