// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/in_parts/parts_smoother.h"

namespace parts_backend {

/// The CPU in so many parts.
class PartsBackend final : public trismooth::Backend {
 public:
  explicit PartsBackend(int parts) : parts_(parts) {}

  std::string name() const override { return "cpu in parts"; }
  std::unique_ptr<trismooth::PreparedSmoother> prepare(trismooth::MeshRings mesh,
                                                       const trismooth::ElementList& elements,
                                                       std::span<const trismooth::Point2<double>> local,
                                                       const trismooth::SmoothingOptions& options) const override {
    return trismooth::prepare_in_parts(std::move(mesh), elements, local, options, parts_);
  }
  bool takes_quadrilaterals() const override { return true; }

 private:
  int parts_;
};

}  // namespace parts_backend
