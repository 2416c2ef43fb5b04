# SPDX-License-Identifier: BSD-3-Clause
# The serial HDF5 library for C: HDF5Serial_FOUND, HDF5Serial_LIBRARY and HDF5Serial_INCLUDE_DIR. CMake's own module takes
# the one for MPI where Debian has both.

find_path(HDF5Serial_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5Serial_LIBRARY NAMES hdf5_serial hdf5)
if(HDF5Serial_INCLUDE_DIR)
  file(STRINGS "${HDF5Serial_INCLUDE_DIR}/H5public.h" lines REGEX "^#define H5_VERS_(MAJOR|MINOR|RELEASE)[ \t]")
  string(REGEX MATCHALL "[ \t][0-9]+" numbers "${lines}")
  list(JOIN numbers "." HDF5Serial_VERSION)
  string(REGEX REPLACE "[ \t]" "" HDF5Serial_VERSION "${HDF5Serial_VERSION}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5Serial REQUIRED_VARS HDF5Serial_LIBRARY HDF5Serial_INCLUDE_DIR
                                  VERSION_VAR HDF5Serial_VERSION)
mark_as_advanced(HDF5Serial_INCLUDE_DIR HDF5Serial_LIBRARY)
