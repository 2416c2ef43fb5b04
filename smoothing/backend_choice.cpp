// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/backend_choice.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

const Backend& backend_of(const SmoothingOptions& options) {
  const Backend& backend = options.backend != nullptr ? *options.backend : cpu_backend();
  if (options.proposal && &backend != &cpu_backend()) {
    throw std::invalid_argument("a proposal is a function of the host: the CPU backend alone takes it");
  }
  return backend;
}

MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> local, const ElementList& elements,
                    const Constraints& constraints, const std::function<MeshRings()>& on_host) {
  std::string note;
  // A device does not know of named lines.
  if (options.prefers_topology_of_device() && elements.are_triangles() && !constraints.slide.names_vertices()) {
    try {
      if (auto found = backend_of(options).find_rings(local, elements.triangles(), constraints, options)) {
        Workers workers(options.threads);
        found->found_by = Topology::device;
        found->slidable = find_slidable(elements.triangles(), found->fixed, constraints, workers);
        return *std::move(found);
      }
    } catch (const DeviceError& error) {
      if (options.topology == Topology::device) {
        throw;
      }
      note = host_took_over(error);
    }
  }
  MeshRings found = on_host();
  found.note = elements.are_triangles() ? std::move(note) : std::string(host_finds_quadrilaterals(options));
  return found;
}

std::string_view host_finds_quadrilaterals(const SmoothingOptions& options) {
  return options.topology == Topology::device ? host_found_quadrilaterals : "";
}

std::string host_took_over(const DeviceError& error) {
  return std::string("the host found the neighbours: ") + error.what();
}

std::string joined_notes(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

}  // namespace trismooth
