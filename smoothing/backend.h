#pragma once

#include <memory>
#include <span>
#include <string>

#include "trismooth/quality/point2.h"
#include "trismooth/smoothing/one_rings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// A mesh that a backend has made ready for smoothing, as often as the caller likes. Owns all it needs.
class PreparedSmoother {
 public:
  PreparedSmoother() = default;
  PreparedSmoother(const PreparedSmoother&) = delete;
  PreparedSmoother& operator=(const PreparedSmoother&) = delete;
  virtual ~PreparedSmoother() = default;

  /// Smooths the vertices' stored coordinates in place: local frame, sweeps, and unless options.guard is off the
  /// never-worse commit. Results are rounded to `storage`; vertices that do not move keep their bits. Coordinates are
  /// finite (the caller has checked). `fixed_quotient` is smallest_fixed_quotient() of the mesh.
  virtual SmoothingResult smooth(std::span<Point2<double>> points, Storage storage, double fixed_quotient) = 0;
};

/// Whoever runs the sweeps: the CPU, a GPU. Given the same rings, points and options, every backend gives the same
/// bits.
class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  /// "cpu", "cuda".
  virtual std::string name() const = 0;

  /// Makes a mesh ready: renumbering, colouring, whatever the backend needs. `points` are where the vertices are, in
  /// the local frame; they steer the order in memory and no result. Throws std::invalid_argument for options that the
  /// backend does not have.
  virtual std::unique_ptr<PreparedSmoother> prepare(const OneRings& rings, std::span<const Point2<double>> points,
                                                    const SmoothingOptions& options) const = 0;
};

/// The CPU backend. Layout and execution mean nothing to it; Order::unordered is refused.
const Backend& cpu_backend();

}  // namespace trismooth
