// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/in_parts/parts_smoother.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/in_parts/mesh_cut.h"
#include "trismooth/smoothing/in_parts/thread_team.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"

namespace trismooth {

namespace {

constexpr std::int64_t copy_grain = 16384;

/// "A", "2 x A", "A and 2 x B".
std::string listed(std::span<const SmoothingResult> results) {
  std::map<std::string, int> counts;
  for (const SmoothingResult& result : results) {
    ++counts[result.device];
  }
  const auto counted_device = [](const auto& counted) {
    return (counted.second > 1 ? std::to_string(counted.second) + " x " : "") + counted.first;
  };
  return list_text(counts, counted_device, " and ");
}

class PartsSmoother final : public PreparedSmoother {
 public:
  PartsSmoother(MeshRings mesh, const ElementList& elements, std::span<const Point2<double>> local,
                const SmoothingOptions& options, int parts, const OffloadsOfPart& offloads)
      : workers_(options.threads), options_(options), fixed_(std::move(mesh.fixed)), team_(parts) {
    const Stopwatch watch;
    mesh.fixed = fixed_;
    std::vector<CutPart> cut =
        cut_into_parts(mesh, elements, local, team_, options.progress || options.cancel, workers_);
    mesh = {};
    for (CutPart& part : cut) {
      parts_.emplace_back();
      parts_.back().part = part.mesh.part;
      parts_.back().vertices = std::move(part.vertices);
    }
    team_.run([&](int number) {
      const auto p = static_cast<std::size_t>(number);
      parts_[p].smoother = prepare_part(std::move(cut[p].mesh), cut[p].elements.list(), cut[p].local, of_part(number),
                                        offloads ? offloads(*parts_[p].part) : nullptr);
    });
    prepare_ms_ = watch.milliseconds();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    // Parts would name vertices by their own numbers.
    require_target_lengths(options_, fixed_);
    const LocalFrame frame = known_frame ? *known_frame : local_frame_of_cells(points, fixed_);
    std::vector<SmoothingResult> results(parts_.size());
    const CallLimit::Clock::time_point begin = CallLimit::begin_of_current();
    CallLimit::lift_current();  // what the parts have done by then is put together
    team_.run([&](int number) {
      CallLimit limit(options_.time_limit_seconds, number == 0 ? options_.cancel : std::function<bool()>(), begin);
      limit.lift();
      Part& part = parts_[static_cast<std::size_t>(number)];
      part.read(points, options_.aims_at_sizes() ? lengths() : std::span<const double>());
      results[static_cast<std::size_t>(number)] = part.smoother->smooth(part.points, storage, frame);
    });
    for (const Part& part : parts_) {
      write(part, points);
    }
    return joined(results);
  }

  std::vector<std::uint8_t> fixed() const override { return fixed_; }

 private:
  struct Part {
    std::shared_ptr<const MeshPart> part;
    BulkVector<std::int32_t> vertices;  ///< as CutPart::vertices
    std::vector<double> lengths;        ///< that are asked for, of its vertices
    BulkVector<Point2<double>> points;  ///< of a call
    std::unique_ptr<PreparedSmoother> smoother;

    void read(std::span<const Point2<double>> whole, const RealView& lengths_of_whole) {
      points.resize(vertices.size());
      std::ranges::transform(vertices, points.begin(), [&](std::int32_t v) { return whole[v]; });
      if (!lengths_of_whole.empty()) {
        std::ranges::transform(vertices, lengths.begin(), [&](std::int32_t v) { return lengths_of_whole[v]; });
      }
    }
  };

  const RealView& lengths() const { return options_.mean_ratio.target_lengths; }

  /// The options for a part's own numbers. The caller's callback is called by one of them.
  SmoothingOptions of_part(int number) {
    SmoothingOptions options = options_;
    options.threads = std::max(1, workers_.count() / team_.count());
    if (number > 0) {
      options.progress = {};
    }
    if (options_.aims_at_sizes()) {
      Part& part = parts_[static_cast<std::size_t>(number)];
      // Never empty: that would say that no sizes are asked for.
      part.lengths.resize(std::max<std::size_t>(part.vertices.size(), 1), 1.0);
      options.mean_ratio.target_lengths = part.lengths;
    }
    return options;
  }

  void write(const Part& part, std::span<Point2<double>> points) {
    workers_.for_blocks(std::ssize(part.vertices), copy_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        if (part.part->ghosts[v] == 0) {
          points[part.vertices[v]] = part.points[v];
        }
      }
    });
  }

  /// What is not the same for all parts.
  SmoothingResult joined(std::vector<SmoothingResult>& results) {
    std::vector<RevertedVertex> reverted;
    std::int64_t device_memory = 0;
    int threads = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (const auto& [vertex, position] : results[p].reverted) {
        reverted.push_back({parts_[p].vertices[vertex], position});
      }
      threads += results[p].threads;
      device_memory += results[p].device_memory_bytes;
    }
    std::ranges::sort(reverted, {}, &RevertedVertex::vertex);
    const std::string device = listed(results);
    SmoothingResult result = std::move(results.front());
    result.reverted = std::move(reverted);
    result.reverted_vertices = std::ssize(result.reverted);
    result.device = device;
    result.threads = threads;
    result.device_memory_bytes = device_memory;
    result.timings.prepare = std::exchange(prepare_ms_, 0);
    return result;
  }

  Workers workers_;
  SmoothingOptions options_;
  std::vector<std::uint8_t> fixed_;  ///< as MeshRings::fixed
  ThreadTeam team_;
  std::vector<Part> parts_;
  double prepare_ms_ = 0;  ///< until a call has reported it
};

}  // namespace

std::unique_ptr<PreparedSmoother> prepare_in_parts(MeshRings mesh, const ElementList& elements,
                                                   std::span<const Point2<double>> local,
                                                   const SmoothingOptions& options, int parts,
                                                   const OffloadsOfPart& offloads) {
  return std::make_unique<PartsSmoother>(std::move(mesh), elements, local, options, parts, offloads);
}

}  // namespace trismooth
