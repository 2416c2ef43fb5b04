// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gpu_smoothing_session.h"

/// The experiments: each prints a table, and adds rows to the report under its name.
namespace benchmarks {

/// Smoothing until it stops, every execution beside the CPU. Its rows are the report's "rows".
void smooth_to_stop(Session& session);

/// Sweeps over all vertices, Form A, by the device's clock: the difference between runs of N and of 2 N sweeps, so that
/// nothing but sweeps is in it; as a share of the copy bandwidth too.
void sweep_fully(Session& session);

/// One-rings from a triangle list that is on the device.
void find_rings(Session& session);

/// Arrays of the host in, smoothed arrays of the host out, pageable and page-locked, by the host's clock.
void smooth_host_arrays(Session& session);

/// A plan on the device called again with coordinates that are there, by the host's clock.
void call_plan_again(Session& session);

/// Vertices of boundaries that slide, beside the same without, on the CPU and on the device, by the host's clock.
void slide_along(Session& session);

/// The device beside one CPU thread that evaluates every vertex in every sweep, and beside the CPU at its best.
void compare_with_serial(Session& session);

}  // namespace benchmarks
