#include "trismooth/pipeline/bench/report.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "trismooth/smoothing/processor_name.h"

namespace trismooth::bench {

namespace {

/// What `text` says of the rows of which this is true, each once: "GPU-AoS, GPU-SoA". Empty where there are none.
template <class Predicate, class Text>
std::string list_of(const ExperimentResult& result, const Predicate& is_meant, const Text& text) {
  std::vector<std::string> seen;
  std::string list;
  for (const Row& row : result.rows) {
    if (!is_meant(row)) {
      continue;
    }
    std::string item = text(row);
    if (std::ranges::find(seen, item) == seen.end()) {
      list += (list.empty() ? "" : ", ") + item;
      seen.push_back(std::move(item));
    }
  }
  return list;
}

std::string case_text(const Row& row) {
  return fmt::format("{} {}", size_text(row.vertices), full_name(row.what));
}

std::vector<std::string> missing_remarks(const ExperimentResult& result) {
  std::vector<std::string> remarks;
  std::vector<std::string> reasons;
  for (const Row& row : result.rows) {
    if (!row.missing.empty() && std::ranges::find(reasons, row.missing) == reasons.end()) {
      reasons.push_back(row.missing);
      const std::string names = list_of(
          result, [&](const Row& other) { return other.missing == row.missing; },
          [](const Row& other) { return name_of(other.what); });
      remarks.push_back(fmt::format("Not measured: {}. They need a CUDA device: {}.", names, row.missing));
    }
  }
  return remarks;
}

std::vector<std::string> run_remarks(const ExperimentResult& result) {
  std::vector<std::string> remarks;
  const std::string unsettled = list_of(
      result, [](const Row& row) { return row.measured && row.measured->stop_reason == StopReason::sweep_limit; },
      &case_text);
  if (!unsettled.empty()) {
    remarks.push_back(
        fmt::format("Never settled, {} sweeps are the limit: {}.", SmoothingOptions{}.max_sweeps, unsettled));
  }
  const std::string hurried = list_of(
      result, [&](const Row& row) { return row.measured && row.measured->runs < result.options.runs; },
      [](const Row& row) { return fmt::format("{} ({})", case_text(row), row.measured->runs); });
  if (!hurried.empty()) {
    remarks.push_back(fmt::format("Fewer runs than {}, for want of time: {}.", result.options.runs, hurried));
  }
  return remarks;
}

}  // namespace

Report make_report(ExperimentResult result, std::string command, std::string date, std::string cuda) {
  Report report;
  report.setting = {std::move(command), std::move(date), processor_name(), 0, {}, std::move(cuda)};
  for (const Row& row : result.rows) {
    if (row.measured && runs_on_device(row.what.version)) {
      report.setting.gpu = row.measured->device;
    } else if (row.measured && row.what.version == Version::cpu) {
      report.setting.threads = row.measured->threads;
    }
  }
  report.tables = tables_of(result);
  report.conclusions = conclusions_of(result);
  report.result = std::move(result);
  return report;
}

std::vector<std::string> remarks_on(const Report& report) {
  const ExperimentResult& result = report.result;
  std::vector<std::string> remarks = missing_remarks(result);
  std::ranges::move(run_remarks(result), std::back_inserter(remarks));
  for (const MeshCounts& mesh : result.meshes) {
    if (mesh.vertices != mesh.asked) {
      remarks.push_back(fmt::format("The mesh of {} vertices is made of mirrored tiles and has {}.",
                                    size_text(mesh.asked), mesh.vertices));
    }
  }
  remarks.emplace_back(result.same_bits()
                           ? "All runs of a mesh in the same form gave the same coordinates bit for bit, whichever the "
                             "version and the layout."
                           : "RUNS THAT MUST GIVE THE SAME BITS DID NOT. Please report this.");
  if (std::ranges::any_of(result.rows,
                          [](const Row& row) { return row.measured && row.what.order == Order::unordered; })) {
    remarks.emplace_back(
        "Form B unordered is the exception, and the paper to the letter: threads see each other's moves as they "
        "happen, so every run gives another result.");
  }
  return remarks;
}

std::vector<std::string> how_it_is_measured() {
  return {
      "Meshes: uniformly random points in the unit square, Delaunay triangulation, numbered at random; the boundary is "
      "fixed. Smoothing runs to its stop: no vertex moves by more than 1e-6 of its edge length.",
      "Smoothing is the sweeps and the never-worse check, which the paper does not have. On a device its own clock "
      "measures it.",
      "Transfer is that of the coordinates to the device and back. Topology is all that comes before the coordinates: "
      "neighbours, constraints, orientation, order in memory, memory itself, the copy of the triangles. On a device it "
      "is found there, in the GPU version by one thread as in the paper, in the others in parallel.",
      "Together is the whole call, by the host's clock. Every run starts from the triangles anew; a first one is not "
      "counted.",
      "The serial CPU version is one thread that evaluates every vertex in every sweep, as the paper's. It is "
      "trismooth's own CPU code, in an order that is good for caches: a plainer one is slower, and speedups over it "
      "are "
      "larger. In Form B it visits vertices colour by colour.",
      "Spreads are the least and the most of all runs. A speedup's spread is what both spreads allow.",
  };
}

}  // namespace trismooth::bench
