// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Marks functions that run on the host and, compiled by nvcc, on the device: one definition of each formula.
#ifdef __CUDACC__
#define TRISMOOTH_HOST_DEVICE __host__ __device__
/// Marks a long function for both that a kernel calls at many places: one copy of it on the device. Inlined at each of
/// them it would take the compiler minutes.
#define TRISMOOTH_HOST_DEVICE_CALL __host__ __device__ __noinline__
#else
#define TRISMOOTH_HOST_DEVICE
#define TRISMOOTH_HOST_DEVICE_CALL
#endif
