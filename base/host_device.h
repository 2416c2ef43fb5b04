#pragma once

/// Marks functions that run on the host and, compiled by nvcc, on the device: one definition of each formula.
#ifdef __CUDACC__
#define TRISMOOTH_HOST_DEVICE __host__ __device__
#else
#define TRISMOOTH_HOST_DEVICE
#endif
