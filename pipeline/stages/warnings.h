#pragma once

namespace trismooth {

struct RunState;
struct SmoothingResult;

/// What the user should know before the smoothing: what single precision loses, options that the method takes no notice
/// of, a boundary that is too coarse.
void warn_before_smoothing(RunState& run);

/// And after it: folds that the never-worse check put back.
void warn_of_folds_put_back(RunState& run, const SmoothingResult& smoothing);

}  // namespace trismooth
