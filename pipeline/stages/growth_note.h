#pragma once

namespace trismooth {

struct RunState;
struct TriangleView;

/// Notes where the growth bound of the method mean-ratio keeps the worst element that has a free corner from getting
/// better: the smart rule would move that corner, but a triangle would grow beyond the bound. `before`: the mesh that
/// was read. Nothing for other methods, and where sizes or shapes are asked for. Complexity: linear.
void note_growth_bound(RunState& run, const TriangleView& before);

}  // namespace trismooth
