#pragma once

#include <span>

#include "trismooth/smoothing/result.h"

namespace trismooth {

struct MeshDocument;
struct RunState;

/// What the document's file will hold of a coordinate that was `before` and is to be `now`: `before` itself where they
/// are equal.
double stored_coordinate(const MeshDocument& document, double before, double now);

/// Whether the file will hold another mesh than the smoother could know of: its numbers have few characters, of which
/// it holds the nearest; or nodes in the middle of sides follow these.
bool is_stored_otherwise(const RunState& run);

/// Brings points (x, y, z each) that were smoothed to what the file will hold. `input`: those that were read. Middles
/// of sides follow the side's ends (see middle_nodes.h of smoothing), so that straight sides stay straight; all
/// coordinates that are not those of the input are rounded to what the file holds.
void fit_to_file(RunState& run, std::span<const double> input, std::span<double> points);

/// Brings the document to what the file will hold of the result: see fit_to_file(). Then the never-worse guard runs its
/// rounds once more, in double on exactly these coordinates, with a rule of its own for quadratic triangles: one that
/// was valid (see quadratic_triangle.h) and is not any more offends, too. Corners go back to where they were in
/// `input`, and their middles with them. Counts of `smoothing` are brought up to date. run.local: of the input.
void store_result(RunState& run, std::span<const double> input, SmoothingResult& smoothing);

}  // namespace trismooth
