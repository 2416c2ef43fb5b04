// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/packing/engine_rings.h"

#include <algorithm>
#include <utility>

#include "trismooth/cuda/packing/renumbering.h"

namespace trismooth::cuda {

namespace {

/// Orders the vertices, and gives back what that alone needs.
Renumbering reorder(Context& context, UnpackedMesh& mesh, Windows windows, VertexOrder& order) {
  const RingsView rings = mesh.rings.view();
  order.colours = mesh.colouring.count;
  order_vertices(context, rings, std::move(mesh.points), mesh.colouring.colours.data(), std::max(1, order.colours),
                 windows, order);
  mesh.colouring.colours.reset();
  return {context, rings, order.input_index.data(), order.free_count()};
}

/// Differences reach only so far, numbers everywhere.
template <class Slot>
constexpr Windows windows_for = sizeof(Slot) == 2 ? Windows::far_last : Windows::by_size;

}  // namespace

template <Form form>
GridRings<form> GridRings<form>::pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& /*options*/,
                                      VertexOrder& order) {
  const Renumbering numbers = reorder(context, mesh, windows_for<Slot>, order);
  return {slotted<Slot>(context, numbers)};
}

template <Form form>
std::size_t GridRings<form>::bytes(const MeshSize& size) {
  // One ring in ten, or less, is too long for a record.
  return static_cast<std::size_t>(size.free_vertices) * sizeof(RingRecord<Slot>) +
         static_cast<std::size_t>(size.ring_entries) / 8 * sizeof(std::int32_t);
}

template struct GridRings<Form::swap>;
template struct GridRings<Form::in_place>;

template <Form form>
MixedRings<form> MixedRings<form>::pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& /*options*/,
                                        VertexOrder& order) {
  const Renumbering numbers = reorder(context, mesh, windows_for<Slot>, order);
  return {slotted_mixed<Slot>(context, numbers, mesh.rings.opposites.data())};
}

template <Form form>
std::size_t MixedRings<form>::bytes(const MeshSize& size) {
  // All rings may be too long.
  return static_cast<std::size_t>(size.free_vertices) * sizeof(RingRecord<Slot>) +
         static_cast<std::size_t>(2 * size.ring_entries) * sizeof(std::int32_t);
}

template struct MixedRings<Form::swap>;
template struct MixedRings<Form::in_place>;

std::optional<PatchedRings> PatchedRings::pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options,
                                               VertexOrder& order) {
  const RingsView from = mesh.rings.view();
  const std::int32_t colour_count = mesh.colouring.count;
  if (!Patches::may_suit(from.size, colour_count, options)) {
    return std::nullopt;
  }
  DeviceBuffer<Point2<double>> points(context, mesh.points.size());
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(points.data(), mesh.points.data(), points.size() * sizeof(Point2<double>),
                                       cudaMemcpyDeviceToDevice, context.stream()));
  order.colours = colour_count;
  order_vertices(context, from, std::move(points), nullptr, 1, Windows::none, order);
  const Renumbering numbers(context, from, order.input_index.data(), order.free_count());
  DeviceRings rings = renumbered(context, numbers, mesh.rings);
  const DeviceBuffer<std::uint8_t> colours = renumbered(context, numbers, mesh.colouring.colours.data());
  std::optional<Patches> patches =
      Patches::cut(context, rings.view(), from.size, colours.data(), colour_count, options);
  if (!patches) {
    return std::nullopt;
  }
  mesh.points.reset();
  mesh.colouring.colours.reset();
  return PatchedRings{std::move(rings), std::move(*patches), options.form};
}

template <Layout layout>
PaperRings<layout> PaperRings<layout>::pack(Context& context, UnpackedMesh& mesh, const SmoothingOptions& options,
                                            VertexOrder& order) {
  // The paper's versions read a neighbour where it lies in memory: being near counts for more than rings of like size.
  const Renumbering numbers = reorder(context, mesh, Windows::none, order);
  return {renumbered(context, numbers, mesh.rings), options.execution == Execution::cdp};
}

template <Layout layout>
std::size_t PaperRings<layout>::bytes(const MeshSize& size) {
  return static_cast<std::size_t>(size.free_vertices + size.ring_entries) * sizeof(std::int32_t);
}

template struct PaperRings<Layout::aos>;
template struct PaperRings<Layout::soa>;

PackedMesh pack(Context& context, DeviceRings rings, DeviceBuffer<Point2<double>> points,
                const SmoothingOptions& options) {
  PackedMesh packed;
  // A parameter lives as long as the caller's expression; the memory is to go back with this function.
  const DeviceRings source = std::move(rings);
  if (source.size() == 0) {
    return packed;
  }
  DeviceColouring colouring;
  if (options.form == Form::in_place && options.order == Order::colour) {
    colouring = source.has_quadrilaterals() ? colour_vertices(context, source.mixed_view())
                                            : colour_vertices(context, source.view());
  }
  UnpackedMesh mesh{source, points, colouring};
  if (!source.has_quadrilaterals()) {
    if (std::optional<PatchedRings> patched = PatchedRings::pack(context, mesh, options, packed.order)) {
      packed.rings = std::move(*patched);
      return packed;
    }
  }
  with_rings_kind(options, source.has_quadrilaterals(), [&]<class Rings>(std::type_identity<Rings>) {
    packed.rings = Rings::pack(context, mesh, options, packed.order);
  });
  return packed;
}

}  // namespace trismooth::cuda
