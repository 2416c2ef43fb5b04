#include "trismooth/smoothing/backend_choice.h"

#include <utility>

#include "trismooth/smoothing/cpu_backend.h"

namespace trismooth {

const Backend& backend_of(const SmoothingOptions& options) {
  return options.backend != nullptr ? *options.backend : cpu_backend();
}

MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> local,
                    std::span<const Triangle> triangles, const Constraints& constraints,
                    const std::function<MeshRings()>& on_host) {
  if (options.topology == Topology::device) {
    if (auto found = backend_of(options).find_rings(local, triangles, constraints, options)) {
      return *std::move(found);
    }
  }
  return on_host();
}

std::string joined_notes(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

}  // namespace trismooth
