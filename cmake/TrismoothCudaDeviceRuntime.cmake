# SPDX-License-Identifier: BSD-3-Clause
# Makes target CUDA::cudadevrt, the device's side of the runtime for dynamic parallelism, where CMake (before 3.27) does
# not. After find_package(CUDAToolkit).
if(NOT TARGET CUDA::cudadevrt)
  find_library(TRISMOOTH_CUDADEVRT NAMES cudadevrt HINTS "${CUDAToolkit_LIBRARY_DIR}" REQUIRED)
  mark_as_advanced(TRISMOOTH_CUDADEVRT)
  add_library(CUDA::cudadevrt STATIC IMPORTED)
  set_target_properties(CUDA::cudadevrt PROPERTIES IMPORTED_LOCATION "${TRISMOOTH_CUDADEVRT}")
endif()
