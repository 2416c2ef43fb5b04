// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/experiment_report.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/machine/processor_name.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/paper/wording.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::experiments {

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
      add_to_list(list, item);
      seen.push_back(std::move(item));
    }
  }
  return list;
}

std::string case_text(const Row& row) {
  return fmt::format("{} {}", size_text(row.vertices), full_name(row.what));
}

std::string version_text(const Row& row) {
  return name_of(row.what);
}

/// What was not measured, a sentence for each reason.
std::vector<std::string> lack_remarks(const ExperimentResult& result) {
  std::vector<std::string> remarks;
  std::vector<std::string> reasons;
  for (const Row& row : result.rows) {
    if (row.lack == Lack::nothing || std::ranges::find(reasons, row.missing_reason) != reasons.end()) {
      continue;
    }
    reasons.push_back(row.missing_reason);
    const auto for_this_reason = [&](const Row& other) { return other.missing_reason == row.missing_reason; };
    remarks.push_back(
        row.lack == Lack::device
            ? fmt::format("Not measured, for they need a CUDA device: {} ({}).",
                          list_of(result, for_this_reason, &version_text), row.missing_reason)
            : fmt::format("Failed: {} ({}).", list_of(result, for_this_reason, &case_text), row.missing_reason));
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
  for (const MeshCounts& mesh : result.meshes) {
    if (mesh.vertices != mesh.asked) {
      remarks.push_back(fmt::format("The mesh of {} vertices is made of mirrored tiles and has {}.",
                                    size_text(mesh.asked), count_text(mesh.vertices)));
    }
  }
  return remarks;
}

std::vector<std::string> bit_remarks(const ExperimentResult& result) {
  const auto is_measured_in = [](Order order) {
    return [order](const Row& row) { return row.measured && row.what.order == order; };
  };
  std::vector<std::string> remarks;
  if (!result.same_bits()) {
    const std::string different = list_of(
        result,
        [](const Row& row) {
          return row.measured && row.what.order == Order::colour &&
                 !(row.measured->same_bits_again && row.measured->same_bits_as_first);
        },
        &case_text);
    remarks.push_back(fmt::format("THESE GAVE OTHER BITS THAN THEY MUST: {}. Please report it.", different));
  } else if (std::ranges::any_of(result.rows, is_measured_in(Order::colour))) {
    remarks.emplace_back(
        "All runs of a mesh in the same form gave the same coordinates bit for bit, whichever the version and the "
        "layout.");
  }
  if (std::ranges::any_of(result.rows, is_measured_in(Order::unordered))) {
    remarks.emplace_back(
        "Form B unordered is the exception, and the paper to the letter: threads see each other's moves as they "
        "happen, so every run gives another result.");
  }
  return remarks;
}

}  // namespace

ExperimentReport make_report(ExperimentResult result, std::string command, std::string date, std::string cuda) {
  ExperimentReport report;
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

std::vector<std::string> remarks_on(const ExperimentReport& report) {
  std::vector<std::string> remarks = lack_remarks(report.result);
  std::ranges::move(run_remarks(report.result), std::back_inserter(remarks));
  std::ranges::move(bit_remarks(report.result), std::back_inserter(remarks));
  return remarks;
}

std::vector<std::string> how_it_is_measured() {
  const SmoothingOptions defaults;
  std::vector<std::string> sentences;
  sentences.emplace_back(
      "Meshes: uniformly random points in the unit square, Delaunay triangulation, numbered at random; the boundary is "
      "fixed.");
  sentences.push_back(
      fmt::format("Smoothing runs until no vertex moves by more than {} of its edge length, {} sweeps at most.",
                  defaults.tolerance, defaults.max_sweeps));
  sentences.emplace_back(
      "Smoothing is the sweeps and the never-worse check, which the paper does not have. On a device its own clock "
      "measures it. What the paper's running time takes in, it does not say; it is in single precision.");
  sentences.emplace_back(
      "Transfer is that of the coordinates to the device and back. Topology is all that comes before the coordinates: "
      "neighbours, constraints, orientation, order in memory, memory itself, the copy of the triangles. On a device it "
      "is found there, in the GPU version by one thread as in the paper, in the others in parallel.");
  sentences.emplace_back(
      "Together is the whole call, by the host's clock. Every run starts from the triangles anew. A first one is not "
      "counted, unless it took all the time that there was.");
  sentences.emplace_back(
      "The serial CPU version is one thread that evaluates every vertex in every sweep, as the paper's. It is "
      "trismooth's own CPU code, in an order that is good for caches: a plainer one is slower, and speedups over it "
      "larger. In Form B it visits vertices colour by colour.");
  sentences.emplace_back(
      "Spreads are the least and the most of all runs; that of a quotient is what both spreads allow. Times differ "
      "where "
      "their spreads do not overlap. A claim holds where every comparison agrees, and in part where some do; a time "
      "measured once decides nothing. What \"slightly\" means is not judged: the factors are there.");
  return sentences;
}

}  // namespace trismooth::experiments
