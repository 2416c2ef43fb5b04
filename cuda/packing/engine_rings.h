// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/packing/colouring.h"
#include "trismooth/cuda/packing/patches.h"
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"

/// One-rings in device memory, renumbered for the sweeps. There are several kinds, one for each way to sweep; which one
/// a run has is decided here, once, and all else follows from the kind.
namespace trismooth::cuda {

/// How large a mesh is, for what it takes on the device.
struct MeshSize {
  std::int64_t vertices = 0;
  std::int64_t free_vertices = 0;
  std::int64_t ring_entries = 0;  ///< the sizes of all rings together
  bool has_quadrilaterals = false;
};

/// A mesh in input numbering before it is packed, on the device.
struct UnpackedMesh {
  const DeviceRings& rings;
  DeviceBuffer<Point2<double>>& points;  ///< of every vertex, local frame; given back by pack()
  DeviceColouring& colouring;            ///< of Form B in colour order, else empty; given back by pack()
};

/// In Form A neighbours have near numbers, and slots are differences of 16 bits; in Form B they are of other colours,
/// so they are far away.
template <Form form>
using SlotOf = std::conditional_t<form == Form::swap, std::int16_t, std::int32_t>;

/// Execution::resident with all of the grid on all of the mesh.
template <Form form>
struct GridRings {
  using Slot = SlotOf<form>;
  using View = SlottedRingsView<Slot>;

  SlottedRings<Slot> rings;

  /// Fills the order as well. So do all functions of this name.
  static GridRings pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options, VertexOrder& order);
  /// An estimate of the device memory that they take.
  static std::size_t bytes(const MeshSize& size);

  View view() const { return rings.view(); }
};

/// Those of a mesh with quadrilaterals, for the same engine.
template <Form form>
struct MixedRings {
  using Slot = SlotOf<form>;
  using View = SlottedMixedRingsView<Slot>;

  SlottedRings<Slot> rings;

  static MixedRings pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options, VertexOrder& order);
  static std::size_t bytes(const MeshSize& size);

  View view() const { return rings.mixed_view(); }
};

/// Execution::resident on patches in shared memory: small meshes. All free vertices are one batch.
struct PatchedRings {
  DeviceRings rings;
  Patches patches;
  Form form;

  /// None where patches do not suit the mesh. What `mesh` owns is not given back then.
  static std::optional<PatchedRings> pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options,
                                          VertexOrder& order);

  RingsView view() const { return rings.view(); }
};

/// Execution::single_block and Execution::cdp: the paper's versions, in one of its data layouts.
template <Layout layout>
struct PaperRings {
  DeviceRings rings;
  bool with_children;  ///< Execution::cdp

  static PaperRings pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options, VertexOrder& order);
  static std::size_t bytes(const MeshSize& size);

  RingsView view() const { return rings.view(); }
};

using EngineRings = std::variant<GridRings<Form::swap>, GridRings<Form::in_place>, PatchedRings, MixedRings<Form::swap>,
                                 MixedRings<Form::in_place>, PaperRings<Layout::aos>, PaperRings<Layout::soa>>;

/// Calls visit(std::type_identity<Kind>{}) with the kind of rings for these options, and for a mesh with quadrilaterals
/// or without. Where it is GridRings, a mesh that patches suit gets PatchedRings instead.
template <class Visit>
decltype(auto) with_rings_kind(const SmoothingOptions& options, bool has_quadrilaterals, const Visit& visit) {
  if (has_quadrilaterals) {
    return options.form == Form::swap ? visit(std::type_identity<MixedRings<Form::swap>>{})
                                      : visit(std::type_identity<MixedRings<Form::in_place>>{});
  }
  if (options.execution != Execution::resident) {
    return options.layout == Layout::aos ? visit(std::type_identity<PaperRings<Layout::aos>>{})
                                         : visit(std::type_identity<PaperRings<Layout::soa>>{});
  }
  return options.form == Form::swap ? visit(std::type_identity<GridRings<Form::swap>>{})
                                    : visit(std::type_identity<GridRings<Form::in_place>>{});
}

/// A mesh without its coordinates, ready for sweeps.
struct PackedMesh {
  VertexOrder order;
  EngineRings rings;  ///< empty where there is no free vertex
};

/// Packs rings in input numbering for a run with these options, and gives their memory back on the way. `points` (one
/// for every vertex, local frame, on the device) steer the order; their memory goes back too. In Form B in colour order
/// there is a batch for each colour, unless there are patches; else one batch of all free vertices. With quadrilaterals
/// the execution is Execution::resident.
PackedMesh pack(Context& context, DeviceRings rings, DeviceBuffer<Point2<double>> points,
                const SmoothingOptions& options);

}  // namespace trismooth::cuda
