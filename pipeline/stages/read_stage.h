#pragma once

namespace trismooth {

struct RunState;

/// Reads the input. What the reader says of the file is among the notes, or, where another format is written, among
/// the losses.
void read_input(RunState& run);

/// Takes the document that the run has been given: what the result says of the input.
void take_input(RunState& run);

}  // namespace trismooth
