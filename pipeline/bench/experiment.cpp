#include "trismooth/pipeline/bench/experiment.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/random_mesh.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth::bench {

namespace {

using Coordinates = std::vector<double>;

/// One run of a case.
struct Run {
  SmoothingResult result;
  double together = 0;
};

/// Results that must be the same bit for bit: those of the first case of each form.
struct References {
  std::array<Coordinates, 2> of_form;

  Coordinates& of(Form form) { return of_form[form == Form::swap ? 0 : 1]; }
};

bool same_bits(const Coordinates& one, const Coordinates& other) {
  return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0;
}

Run run_once(const RandomMesh& mesh, const SmoothingOptions& options, Coordinates& xy) {
  const auto coordinates = flat_points(mesh);
  xy.assign(coordinates.begin(), coordinates.end());
  const auto start = std::chrono::steady_clock::now();
  Run run{smooth(xy, flat_triangles(mesh), {}, options)};
  run.together = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return run;
}

Spread spread_over(const std::vector<Run>& runs, double (*value)(const Run&)) {
  std::vector<double> values;
  values.reserve(runs.size());
  std::ranges::transform(runs, std::back_inserter(values), value);
  return Spread(std::move(values));
}

double transfer_of(const Run& run) {
  return run.result.timings.transfer_in + run.result.timings.transfer_out;
}

double smoothing_of(const Run& run) {
  return run.result.timings.smooth + run.result.timings.commit;
}

Measurement summary_of(const std::vector<Run>& runs) {
  const SmoothingResult& last = runs.back().result;
  Measurement measured;
  measured.runs = static_cast<int>(runs.size());
  measured.transfer = spread_over(runs, &transfer_of);
  measured.smoothing = spread_over(runs, &smoothing_of);
  measured.together = spread_over(runs, [](const Run& run) { return run.together; });
  // The device's clock measures the other two, the host's the whole: what is left must not become negative by rounding.
  measured.topology = spread_over(
      runs, [](const Run& run) { return std::max(0.0, run.together - transfer_of(run) - smoothing_of(run)); });
  measured.sweeps = spread_over(runs, [](const Run& run) { return static_cast<double>(run.result.sweeps); });
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
      : cuda_(cuda), cases_(cases_of(options.versions)) {
    result_.options = options;
    for (const std::int64_t size : options.sizes) {
      for (const Case& what : cases_) {
        work_ += missing_reason(what.version).empty() ? work_of(size, what) : 0;
      }
    }
  }

  ExperimentResult run() && {
    for (const std::int64_t size : result_.options.sizes) {
      report(size, "generating the mesh", 0);
      run_on(size, random_delaunay_mesh(size, result_.options.seed));
    }
    return std::move(result_);
  }

 private:
  /// For the progress: a serial sweep takes longer.
  static double work_of(std::int64_t size, const Case& what) {
    constexpr double serial_factor = 4;
    return static_cast<double>(size) * (what.version == Version::serial ? serial_factor : 1);
  }

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
    if (result_.options.progress) {
      result_.options.progress({work_ > 0 ? (done_ + part_of_case * work) / work_ : 1, size, what, run});
    }
  }

  void run_on(std::int64_t size, const RandomMesh& mesh) {
    result_.meshes.push_back({size, std::ssize(mesh.points), std::ssize(mesh.triangles)});
    References references;
    for (const Case& what : cases_) {
      Row row{size, what, std::nullopt, missing_reason(what.version)};
      if (row.missing.empty()) {
        try {
          row.measured = measure(size, mesh, what, references);
        } catch (const DeviceError& error) {
          row.missing = error.what();
          row.device_failed = true;
        }
        done_ += work_of(size, what);
      }
      result_.rows.push_back(std::move(row));
    }
  }

  Measurement measure(std::int64_t size, const RandomMesh& mesh, const Case& what, References& references) const {
    const ExperimentOptions& options = result_.options;
    const SmoothingOptions smoothing = options_of(what, options.precision, options.threads, cuda_);
    std::vector<Run> runs;
    Coordinates first;
    Coordinates xy;
    bool same_again = true;
    double spent_ms = 0;
    for (int run = 0; run <= options.runs; ++run) {
      if (spent_ms >= options.seconds * 1000 && !runs.empty()) {
        break;
      }
      report(size, name_of(what) + ", Form " + form_of(what), run, static_cast<double>(run) / (options.runs + 1),
             work_of(size, what));
      Run done = run_once(mesh, smoothing, xy);
      spent_ms += done.together;
      if (first.empty()) {
        first = xy;
      }
      same_again = same_again && same_bits(first, xy);
      const bool warmed_up_only = run == 0 && spent_ms < options.seconds * 1000;
      if (!warmed_up_only) {
        runs.push_back(std::move(done));
      }
    }
    Measurement measured = summary_of(runs);
    measured.coordinates_hash = hash_text(planar_coordinates_hash(first));
    measured.same_bits_again = same_again;
    if (what.order == Order::colour) {
      Coordinates& reference = references.of(what.form);
      if (reference.empty()) {
        reference = std::move(first);
      } else {
        measured.same_bits_as_rest = same_bits(reference, first);
      }
    }
    return measured;
  }

  const CudaSupport& cuda_;
  std::vector<Case> cases_;
  ExperimentResult result_;
  double work_ = 0;
  double done_ = 0;
};

std::optional<Spread> times_faster(const ExperimentResult& result, std::int64_t vertices, const Case& what,
                                   Spread Measurement::*time) {
  const Measurement* const serial = result.find(vertices, {Version::serial, what.form});
  const Measurement* const measured = result.find(vertices, what);
  if (serial == nullptr || measured == nullptr) {
    return std::nullopt;
  }
  return ratio(serial->*time, measured->*time);
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

std::optional<Spread> ExperimentResult::speedup(std::int64_t vertices, const Case& what) const {
  return times_faster(*this, vertices, what, &Measurement::smoothing);
}

std::optional<Spread> ExperimentResult::speedup_together(std::int64_t vertices, const Case& what) const {
  return times_faster(*this, vertices, what, &Measurement::together);
}

bool ExperimentResult::same_bits() const {
  return std::ranges::all_of(rows, [](const Row& row) {
    return !row.measured || row.what.order == Order::unordered ||
           (row.measured->same_bits_again && row.measured->same_bits_as_rest);
  });
}

bool ExperimentResult::device_failed() const {
  return std::ranges::any_of(rows, &Row::device_failed);
}

ExperimentResult run_experiment(const ExperimentOptions& options, const CudaSupport& cuda) {
  validate(options);
  return Experiment(options, cuda).run();
}

}  // namespace trismooth::bench
