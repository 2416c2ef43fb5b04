// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/paper/published.h"
#include "trismooth/paper/versions.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/pipeline/report/spread.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::experiments {

/// How far an experiment is.
struct ExperimentProgress {
  double part = 0;            ///< of the whole, 0 to 1: an estimate
  std::int64_t vertices = 0;  ///< of the mesh
  std::string what;           ///< what runs on it now
  int run = 0;                ///< from 1; 0: it warms up
};

struct ExperimentOptions {
  std::vector<std::int64_t> sizes{published_sizes.begin(), published_sizes.end()};  ///< vertices of the meshes
  std::vector<Version> versions{Version::serial, Version::cpu, Version::gpu, Version::cdp, Version::resident};
  Precision precision = Precision::single_precision;  ///< the paper's
  std::uint64_t seed = 1;                             ///< of the meshes
  int runs = 7;                                       ///< of a case, a first one to warm up apart
  /// A case is not run again once its runs on a mesh have taken this long together; it is run once at least.
  double seconds = 20;
  int threads = 0;  ///< of Version::cpu; 0: one for each core
  /// Why the versions that run on a device are left out although they are asked for; empty: they are run.
  std::string no_device_reason{};
  std::function<void(const ExperimentProgress&)> progress{};  ///< called before every run
};

/// What the runs of a case on a mesh have shown. Times in milliseconds.
struct Measurement {
  int runs = 0;
  Spread topology;   ///< all that comes before the coordinates: neighbours, constraints, orientation, order, memory
  Spread transfer;   ///< of the coordinates to the device and back; 0 on the CPU
  Spread smoothing;  ///< the sweeps and the never-worse check
  Spread together;   ///< all three, by the host's clock
  Spread sweeps;     ///< differ between runs in Order::unordered only
  StopReason stop_reason = StopReason::fixed_point;  ///< of the last run
  std::int64_t vertex_updates = 0;                   ///< of the last run
  std::int64_t free_vertices = 0;
  int threads = 0;                 ///< of the CPU
  std::string device;              ///< processor or GPU
  std::string coordinates_hash;    ///< of the first run's result, as in reports
  bool same_bits_again = true;     ///< every run gave the first one's bits
  bool same_bits_as_first = true;  ///< and those are the bits of the first case of the form; true in Order::unordered
};

/// Why a case was not measured.
enum class Lack : std::uint8_t {
  nothing,  ///< it was
  device,   ///< it runs on a device, and there is none for it
  working_device,
  memory,  ///< of the host
};

/// A case on a mesh.
struct Row {
  std::int64_t vertices = 0;  ///< as asked for
  Case what;
  std::optional<Measurement> measured{};
  Lack lack = Lack::nothing;
  std::string missing_reason{};  ///< empty where it was measured
};

/// A mesh of the experiment.
struct MeshCounts {
  std::int64_t asked = 0;     ///< vertices
  std::int64_t vertices = 0;  ///< mirrored tiles do not meet every number: see random_mesh.h
  std::int64_t triangles = 0;
};

struct ExperimentResult {
  ExperimentOptions options;
  std::vector<MeshCounts> meshes;
  std::vector<Row> rows;  ///< mesh by mesh, in the order of cases_of()

  /// The measurement of a case; null where there is none.
  const Measurement* find(std::int64_t vertices, const Case& what) const;
  /// The milliseconds of its smoothing; nothing where it was not measured.
  std::optional<Spread> smoothing_ms(std::int64_t vertices, const Case& what) const;
  /// How many times faster than the serial CPU version of the same form it smooths, or does everything. Nothing where
  /// one of both was not measured, or took no time that could be measured.
  std::optional<Spread> speedup(std::int64_t vertices, const Case& what) const;
  std::optional<Spread> speedup_together(std::int64_t vertices, const Case& what) const;
  /// Every run gave the bits that it must give. Order::unordered may give any.
  bool same_bits() const;
  /// Whether a case is missing for want of this.
  bool any_lack_of(Lack what) const;
};

/// Generates the meshes (random_delaunay_mesh()), smooths each in every case several times, and compares the results'
/// bits by their hash. Cases that run on a device are missing where there is none, and say why; so is a case on which
/// the device or the memory fails. Throws std::invalid_argument for options out of range.
ExperimentResult run_experiment(const ExperimentOptions& options, const CudaSupport& cuda);

}  // namespace trismooth::experiments
