#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/device_buffer.h"
#include "trismooth/cuda/point_arrays.h"
#include "trismooth/cuda/rings.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/quality/point2.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::cuda {

/// What the commit judges, in packed numbering, all of it on the device. Where a vertex would be stored is computed
/// from its working position whenever it is asked for, which is cheaper than keeping it.
template <class T, Layout layout>
struct CommitView {
  RingsView rings;                  ///< of the free vertices
  const std::int32_t* input_index;  ///< of all vertices
  const Point2<double>* before;     ///< all vertices as they were stored, in the local frame
  PointArrays<T, layout> working;   ///< all vertices as the sweeps left them
  LocalFrame frame;
  Storage storage;
};

/// What the commit took back and wrote.
struct CommitOutcome {
  std::int64_t rounds = 0;               ///< that took something back
  std::vector<RevertedVertex> reverted;  ///< ascending by vertex
  std::int64_t moved = 0;                ///< vertices that were written
  std::int64_t launches = 0;
};

/// The never-worse commit (never_worse.h) on the device, unless `guarded` is false; then the vertices that are
/// elsewhere are written to `stored` (input numbering), the others keep their bits. The host is asked once a round.
/// Working positions of reverted vertices are put back.
template <class T, Layout layout>
CommitOutcome commit(Context& context, const CommitView<T, layout>& view, bool guarded, Point2<double>* stored);

/// Enters the frame: before[v] = frame.enter(stored[input_index[v]]), and in working precision into both `first` and
/// `second` (which may be the same).
template <class T, Layout layout>
void launch_enter(const Point2<double>* stored, const std::int32_t* input_index, std::int32_t vertex_count,
                  const LocalFrame& frame, Point2<double>* before, const PointArrays<T, layout>& first,
                  const PointArrays<T, layout>& second, cudaStream_t stream);

}  // namespace trismooth::cuda
