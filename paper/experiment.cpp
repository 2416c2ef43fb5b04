// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/experiment.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <stdexcept>
#include <utility>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth::experiments {

namespace {

/// What is kept of one run of a case.
struct Run {
  double transfer = 0;
  double smoothing = 0;
  double together = 0;
  std::int64_t sweeps = 0;
};

/// The hash of what every case of a form must give: that of the first.
using References = std::map<Form, std::uint64_t>;

/// Smooths the mesh once; the result goes to `result`, the coordinates to `xy`.
Run run_once(const RandomMesh& mesh, const SmoothingOptions& options, std::vector<double>& xy,
             SmoothingResult& result) {
  const auto points = flat_points(mesh);
  xy.assign(points.begin(), points.end());
  const Stopwatch watch;
  result = smooth(xy_points(xy), flat_triangles(mesh), options);
  const double together = watch.milliseconds();
  return {result.timings.transfer_in + result.timings.transfer_out, result.timings.smooth + result.timings.commit,
          together, result.sweeps};
}

template <class Value>
Spread spread_over(const std::vector<Run>& runs, const Value& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  std::ranges::transform(runs, std::back_inserter(values), value);
  return Spread(std::move(values));
}

Measurement summary_of(const std::vector<Run>& runs, const SmoothingResult& last) {
  Measurement measured;
  measured.runs = static_cast<int>(runs.size());
  measured.transfer = spread_over(runs, [](const Run& run) { return run.transfer; });
  measured.smoothing = spread_over(runs, [](const Run& run) { return run.smoothing; });
  measured.together = spread_over(runs, [](const Run& run) { return run.together; });
  // The device's clock measures the other two, the host's the whole: what is left must not become negative by rounding.
  measured.topology =
      spread_over(runs, [](const Run& run) { return std::max(0.0, run.together - run.transfer - run.smoothing); });
  measured.sweeps = spread_over(runs, [](const Run& run) { return static_cast<double>(run.sweeps); });
  measured.stop_reason = last.stop_reason;
  measured.vertex_updates = last.vertex_updates;
  measured.free_vertices = last.free_vertices;
  measured.threads = last.threads;
  measured.device = last.device;
  return measured;
}

/// One experiment at work.
class Experiment {
 public:
  Experiment(const ExperimentOptions& options, const CudaSupport& cuda)
      : cuda_(cuda), progress_(options.progress), cases_(cases_of(options.versions)) {
    result_.options = options;
    result_.options.progress = {};  // it may not live as long as the result
    for (const std::int64_t size : options.sizes) {
      for (const Case& what : cases_) {
        work_ += missing_reason(what.version).empty() ? work_of(size, what) : 0;
      }
    }
  }

  ExperimentResult run() && {
    for (const std::int64_t size : result_.options.sizes) {
      run_on(size);
    }
    return std::move(result_);
  }

 private:
  /// For the progress: a serial sweep takes longer.
  static double work_of(std::int64_t size, const Case& what) {
    constexpr double serial_factor = 4;
    return static_cast<double>(size) * (what.version == Version::serial ? serial_factor : 1);
  }

  /// Why cases of this version cannot be measured, known beforehand; empty where they can.
  std::string missing_reason(Version version) const {
    if (!runs_on_device(version)) {
      return {};
    }
    if (!result_.options.no_device_reason.empty()) {
      return result_.options.no_device_reason;
    }
    if (cuda_.backend == nullptr) {
      return "this build has no CUDA";
    }
    return version == Version::cdp && !cuda_.has_cdp ? "this build has no dynamic parallelism" : "";
  }

  void report(std::int64_t size, const std::string& what, int run, double part_of_case = 0, double work = 0) const {
    if (progress_) {
      progress_({work_ > 0 ? (done_ + part_of_case * work) / work_ : 0, size, what, run});
    }
  }

  void run_on(std::int64_t size) {
    std::optional<RandomMesh> mesh;
    if (work_ > 0) {
      report(size, "generating the mesh", 0);
      try {
        mesh = random_delaunay_mesh(size, result_.options.seed);
        result_.meshes.push_back({size, std::ssize(mesh->points), std::ssize(mesh->triangles)});
      } catch (const std::bad_alloc&) {
        mesh.reset();
      }
    }
    References references;
    for (const Case& what : cases_) {
      result_.rows.push_back(row_of(size, mesh ? &*mesh : nullptr, what, references));
    }
  }

  Row row_of(std::int64_t size, const RandomMesh* mesh, const Case& what, References& references) {
    Row row{size, what, std::nullopt, Lack::nothing, missing_reason(what.version)};
    if (!row.missing_reason.empty()) {
      row.lack = Lack::device;
      return row;
    }
    const auto fail = [&row](Lack lack, std::string reason) {
      row.lack = lack;
      row.missing_reason = std::move(reason);
    };
    try {
      if (mesh == nullptr) {
        throw std::bad_alloc();
      }
      row.measured = measure(size, *mesh, what, references);
    } catch (const DeviceError& error) {
      fail(Lack::working_device, error.what());
    } catch (const std::bad_alloc&) {
      fail(Lack::memory, "not enough memory");
    }
    done_ += work_of(size, what);
    return row;
  }

  Measurement measure(std::int64_t size, const RandomMesh& mesh, const Case& what, References& references) const {
    const ExperimentOptions& options = result_.options;
    const SmoothingOptions smoothing = options_of(what, options.precision, options.threads, cuda_);
    std::vector<Run> runs;
    std::vector<double> xy;
    SmoothingResult last;
    std::optional<std::uint64_t> first;
    bool same_again = true;
    double spent_ms = 0;
    for (int run = 0; run <= options.runs; ++run) {
      if (spent_ms >= options.seconds * 1000 && !runs.empty()) {
        break;
      }
      report(size, full_name(what), run, static_cast<double>(run) / (options.runs + 1), work_of(size, what));
      const Run done = run_once(mesh, smoothing, xy, last);
      spent_ms += done.together;
      const std::uint64_t hash = planar_coordinates_hash(xy);
      same_again = same_again && hash == first.value_or(hash);
      first = first.value_or(hash);
      const bool warmed_up_only = run == 0 && spent_ms < options.seconds * 1000;
      if (!warmed_up_only) {
        runs.push_back(done);
      }
    }
    Measurement measured = summary_of(runs, last);
    measured.coordinates_hash = hash_text(*first);
    measured.same_bits_again = same_again;
    measured.same_bits_as_first =
        what.order == Order::unordered || references.try_emplace(what.form, *first).first->second == *first;
    return measured;
  }

  const CudaSupport& cuda_;
  std::function<void(const ExperimentProgress&)> progress_;
  std::vector<Case> cases_;
  ExperimentResult result_;
  double work_ = 0;
  double done_ = 0;
};

std::optional<Spread> times_faster(const ExperimentResult& result, std::int64_t vertices, const Case& what,
                                   Spread Measurement::*time) {
  const Measurement* const serial = result.find(vertices, {Version::serial, what.form});
  const Measurement* const measured = result.find(vertices, what);
  if (serial == nullptr || measured == nullptr || !((serial->*time).least > 0) || !((measured->*time).least > 0)) {
    return std::nullopt;
  }
  return serial == measured ? Spread(1, 1, 1) : ratio(serial->*time, measured->*time);
}

void validate(const ExperimentOptions& options) {
  if (options.sizes.empty() || options.versions.empty()) {
    throw std::invalid_argument("a bench needs a size and a version");
  }
  if (options.runs < 1 || !(options.seconds > 0)) {
    throw std::invalid_argument("a bench needs one run at least, and time for it");
  }
}

}  // namespace

const Measurement* ExperimentResult::find(std::int64_t vertices, const Case& what) const {
  const auto row = std::ranges::find_if(
      rows, [&](const Row& candidate) { return candidate.vertices == vertices && candidate.what == what; });
  return row != rows.end() && row->measured ? &*row->measured : nullptr;
}

std::optional<Spread> ExperimentResult::smoothing_ms(std::int64_t vertices, const Case& what) const {
  const Measurement* const measured = find(vertices, what);
  return measured == nullptr ? std::nullopt : std::optional(measured->smoothing);
}

std::optional<Spread> ExperimentResult::speedup(std::int64_t vertices, const Case& what) const {
  return times_faster(*this, vertices, what, &Measurement::smoothing);
}

std::optional<Spread> ExperimentResult::speedup_together(std::int64_t vertices, const Case& what) const {
  return times_faster(*this, vertices, what, &Measurement::together);
}

bool ExperimentResult::same_bits() const {
  return std::ranges::all_of(rows, [](const Row& row) {
    return !row.measured || row.what.order == Order::unordered ||
           (row.measured->same_bits_again && row.measured->same_bits_as_first);
  });
}

bool ExperimentResult::any_lack_of(Lack what) const {
  return std::ranges::find(rows, what, &Row::lack) != rows.end();
}

ExperimentResult run_experiment(const ExperimentOptions& options, const CudaSupport& cuda) {
  validate(options);
  return Experiment(options, cuda).run();
}

}  // namespace trismooth::experiments
