// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// The most shared memory that the parts of a patch may take on the current device.
std::size_t most_patch_bytes();
/// Lets a kernel have as much. The same for every launch: the limit belongs to the kernel, and several threads may be
/// launching it.
void allow_most_patch_bytes(const void* kernel);

/// Where the parts of a patch are.
struct PatchPlace {
  std::uint32_t first_vertex;  ///< among the vertices of all patches
  std::uint32_t first_entry;   ///< among the ring entries of all patches
  std::int32_t vertex_count;
  std::int32_t entry_count;
  std::int32_t own_begin;  ///< of the patch's vertices, those that it is there for
  std::int32_t own_end;
};

/// For kernels; see Patches. Vertices of a patch have local numbers, which ascend with their packed ones.
struct PatchesView {
  std::int32_t count;
  const PatchPlace* places;
  const std::int32_t* vertices;       ///< packed number of each patch vertex
  const std::uint8_t* sweeps;         ///< how many of a group's sweeps evaluate the vertex
  const std::uint8_t* colours;        ///< of the vertices; Form B
  const std::uint16_t* ring_begins;   ///< into the patch's entries; one more than vertices in each patch
  const std::uint16_t* ring_entries;  ///< local numbers, in ring order
};

/// A mesh cut into patches, one for each block of a launch. A patch has vertices of its own, a run of the packed order,
/// and a halo around them: all vertices that its own depend on during a group of sweeps. So a block brings its patch
/// through a whole group on its own, computing of the halo what the halo's owners compute as well; only then do blocks
/// have to wait for each other.
///
/// In Form A (Jacobi) a vertex depends on its neighbours before the sweep: a group of sweeps on so many rings around.
/// In Form B (coloured Gauss-Seidel) it depends on neighbours of lower colours after their update in the same sweep, so
/// a group is one sweep, and the halo is what can be reached by falling colours. A single patch has no halo, and a
/// group may have any length.
class Patches {
 public:
  static constexpr std::int32_t sweeps_in_group_a = 4;
  static constexpr std::int32_t sweeps_in_group_b = 1;

  /// Whether a mesh of so many vertices is worth an attempt in Execution::resident: where patches have their size, they
  /// are faster than sweeps over memory. Not where a quality target asks for the smallest shape after each sweep.
  /// `colours`: 0 for Form A.
  static bool may_suit(std::int32_t vertices, std::int32_t colours, const SmoothingOptions& options);

  /// Cuts the free vertices into patches, one for each multiprocessor or fewer. `rings` are packed; of `vertex_count`
  /// vertices. `colours`: one for each free vertex, 0 .. colour_count - 1, for Form B; null for Form A. None where a
  /// patch would be too large for a multiprocessor's shared memory, or for local numbers.
  static std::optional<Patches> cut(Context& context, const RingsView& rings, std::int32_t vertex_count,
                                    const std::uint8_t* colours, std::int32_t colour_count,
                                    const SmoothingOptions& options);

  PatchesView view() const;
  std::int32_t most_vertices() const { return most_vertices_; }
  std::int32_t most_entries() const { return most_entries_; }

 private:
  Patches() = default;

  std::int32_t count_ = 0;
  std::int32_t most_vertices_ = 0;
  std::int32_t most_entries_ = 0;
  DeviceBuffer<PatchPlace> places_;
  DeviceBuffer<std::int32_t> vertices_;
  DeviceBuffer<std::uint8_t> sweeps_;
  DeviceBuffer<std::uint8_t> colours_;
  DeviceBuffer<std::uint16_t> ring_begins_;
  DeviceBuffer<std::uint16_t> ring_entries_;
};

/// Bytes of shared memory that a block needs for its patch.
template <class T>
std::size_t patch_bytes(const Patches& patches, const SmoothingOptions& options);

}  // namespace trismooth::cuda
