#pragma once

/// All public headers of the components that are there. A component whose headers need those of another library (OpenMesh
/// with Eigen, CUDA) counts where the compiler finds these as well. A program that links one component and wants to be
/// compiled fast includes that component's own headers.

#include "trismooth/version.h"

// The component base comes with the others: points, arrays as views, errors.
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/smooth.h"
