// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <variant>

#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/paper/paper_engine.h"
#include "trismooth/cuda/sweeps/grid/grid_engine.h"
#include "trismooth/cuda/sweeps/patches/patch_engine.h"

namespace trismooth::cuda {

/// What sweeps over rings of a kind.
template <class T, class Rings>
struct EngineOf;
template <class T, Form form>
struct EngineOf<T, GridRings<form>> {
  using Type = GridEngine<T, form, GridRings<form>>;
};
template <class T, Form form>
struct EngineOf<T, MixedRings<form>> {
  using Type = GridEngine<T, form, MixedRings<form>>;
};
template <class T>
struct EngineOf<T, PatchedRings> {
  using Type = PatchEngine<T>;
};
template <class T, Layout layout>
struct EngineOf<T, PaperRings<layout>> {
  using Type = PaperEngine<T, layout>;
};
template <class T, class Rings>
using EngineOver = typename EngineOf<T, Rings>::Type;

template <class T, class AllRings>
struct EnginesOver;
template <class T, class... Rings>
struct EnginesOver<T, std::variant<Rings...>> {
  using Type = std::variant<EngineOver<T, Rings>...>;
};

/// A packed mesh at work: owns its rings and what its sweeps need beside them. Their functions are said at GridEngine.
template <class T>
using SweepEngine = typename EnginesOver<T, EngineRings>::Type;

/// The engine for these rings, of a mesh with a free vertex. `context` outlives it.
template <class T>
SweepEngine<T> make_sweep_engine(Context& context, const VertexOrder& order, EngineRings rings,
                                 const SmoothingOptions& options) {
  return std::visit(
      [&]<class Rings>(Rings& kind) -> SweepEngine<T> {
        return EngineOver<T, Rings>(context, order, std::move(kind), options);
      },
      rings);
}

}  // namespace trismooth::cuda
