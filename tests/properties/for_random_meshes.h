// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "support/random_meshes.h"

/// Checks of properties that every mesh has.
namespace properties {

using random_meshes::RandomMesh;

/// What is wrong with a mesh; empty where nothing is. A function of the mesh alone.
using Property = std::function<std::string(const RandomMesh&)>;

/// Checks `count` random meshes, and fails the running test at the first of which the property does not hold (or
/// throws): with its kind, its seed, and the smallest mesh found of which it does not hold either. In the environment,
/// TRISMOOTH_MESHES=n has n per cent of the count checked, TRISMOOTH_SEED=n that one mesh alone.
void for_random_meshes(std::int64_t count, const Property& property);

/// So many of `count` as are checked; 0 with TRISMOOTH_SEED, as nothing can be said of how many meshes do what then.
std::int64_t meshes_of(std::int64_t count);

}  // namespace properties
