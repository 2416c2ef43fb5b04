// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// All public headers of the components that the build has. A component whose headers need those of another library
/// (OpenMesh with Eigen, CUDA) counts where the compiler finds these as well. A program that links one component and wants to be
/// compiled fast includes that component's own headers.

#include "trismooth/version.h"

// The component base comes with the others: points, arrays as views, errors.
#include "trismooth/base/hold.h"
#include "trismooth/base/repeated_triangles.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quadratic_quadrilateral.h"
#include "trismooth/quality/quadratic_triangle.h"
#include "trismooth/quality/quadrilateral_quality.h"
#include "trismooth/quality/quality.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/quality/region_area.h"
#include "trismooth/quality/region_quality.h"
#include "trismooth/quality/size_change.h"
#include "trismooth/quality/size_fit.h"
#include "trismooth/quality/size_ratio.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/keep_never_worse.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/sliding.h"
#include "trismooth/smoothing/smooth.h"

#if __has_include("trismooth/mesh_io/mesh_file.h")
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#endif
#if __has_include("trismooth/mesh_io/halfedge/smooth_mesh.h") && \
    __has_include(<OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>) && __has_include(<Eigen/Core>)
#include "trismooth/mesh_io/halfedge/mesh_constraints.h"
#include "trismooth/mesh_io/halfedge/mesh_quality.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#if __has_include("trismooth/pipeline/halfedge_stage.h")
#include "trismooth/pipeline/halfedge_stage.h"
#endif
#endif
#if __has_include("trismooth/pipeline/pipeline.h")
#include "trismooth/pipeline/auto_backend.h"
#include "trismooth/pipeline/gates.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/html_report.h"
#include "trismooth/pipeline/report/json_report.h"
#endif
#if __has_include("trismooth/cuda/backend.h") && __has_include(<cuda_runtime_api.h>)
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/moving_mesh.h"
#endif
#if __has_include("trismooth/mpi/plan.h") && __has_include(<mpi.h>)
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/mpi/moving_mesh.h"
#include "trismooth/mpi/plan.h"
#include "trismooth/mpi/traffic.h"
#endif
