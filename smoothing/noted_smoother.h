// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/backend_choice.h"

namespace trismooth {

/// A smoother, and what the user is to know of how it came about.
class NotedSmoother final : public PreparedSmoother {
 public:
  NotedSmoother(std::unique_ptr<PreparedSmoother> smoother, std::string note)
      : smoother_(std::move(smoother)), note_(std::move(note)) {}

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& frame) override {
    SmoothingResult result = smoother_->smooth(points, storage, frame);
    result.backend_note = joined_notes(note_, result.backend_note);
    return result;
  }

  void aim_at(std::span<const Point2<double>> reference, const LocalFrame& frame) override {
    smoother_->aim_at(reference, frame);
  }

  std::vector<std::uint8_t> fixed() const override { return smoother_->fixed(); }

 private:
  std::unique_ptr<PreparedSmoother> smoother_;
  std::string note_;
};

}  // namespace trismooth
