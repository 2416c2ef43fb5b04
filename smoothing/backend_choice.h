// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

/// The backend that the options name, or the CPU's. Throws std::invalid_argument for another one than the CPU's where
/// there is a proposal.
const Backend& backend_of(const SmoothingOptions& options);

/// The rings of a mesh as the options want them found: by their backend where they prefer that and it finds rings (of
/// triangles alone), else by `on_host`, which finds what find_mesh_rings() finds. The same numbers either way. `local`
/// are the points in the local frame. Throws DeviceError where the backend does and the options say Topology::device.
MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> local, const ElementList& elements,
                    const Constraints& constraints, const std::function<MeshRings()>& on_host);

/// What the user is to know where a device would find the topology but for quadrilaterals.
inline constexpr std::string_view host_found_quadrilaterals =
    "the host found the neighbours: of a mesh with quadrilaterals no device does";

/// host_found_quadrilaterals where the options want a device to find it; else empty.
std::string_view host_finds_quadrilaterals(const SmoothingOptions& options);

/// What the user is to know where a device has failed to find the topology and the host does it instead.
std::string host_took_over(const DeviceError& error);

/// What two backends have to tell the user, as one note: "first; second". Each may be empty.
std::string joined_notes(const std::string& first, const std::string& second);

}  // namespace trismooth
