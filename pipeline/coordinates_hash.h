// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace trismooth {

/// XXH64 (seed 0) of the numbers as little-endian float64, one after the other: the fingerprint of a mesh's
/// coordinates, x, y, z of every vertex in the file's order. It tells apart any two bits, so -0 from 0 too. The same on
/// every machine. Complexity: linear, at about the speed of memory.
std::uint64_t coordinates_hash(std::span<const double> xyz);

/// coordinates_hash() of a mesh in the plane z = 0: x and y of every vertex.
std::uint64_t planar_coordinates_hash(std::span<const double> xy);

/// A hash as reports write it: 16 lower-case hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace trismooth
