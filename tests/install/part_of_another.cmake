# SPDX-License-Identifier: BSD-3-Clause
# A project that has trismooth as a part of it builds base, quality and smoothing on a machine with TBB alone, and a
# program with them: by add_subdirectory with static libraries, then by FetchContent with shared ones that it installs.
# What was compiled for the one serves the other.
# Usage: cmake -D SOURCE=... -D GENERATOR=... -D COMPILER=... -D FLAGS=... -D LAUNCHER=... -D READELF=... -D FOLDER=...
#        -P part_of_another.cmake
cmake_policy(VERSION 3.24)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# What an earlier run left must not help.
file(REMOVE_RECURSE "${FOLDER}")
set(missing)
foreach(package IN ITEMS CLI11 CUDAToolkit EXPAT Eigen3 OpenMesh PNG PkgConfig VTK ZLIB fmt nlohmann_json)
  list(APPEND missing "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
endforeach()

function(build_and_run)
  run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/parent" -B "${FOLDER}/build" -G "${GENERATOR}" --no-warn-unused-cli
      "-DTRISMOOTH=${SOURCE}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
      "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" ${missing} ${ARGN})
  run("${CMAKE_COMMAND}" --build "${FOLDER}/build")
  run("${FOLDER}/build/programs/trismooth")
  run("${CMAKE_COMMAND}" --install "${FOLDER}/build" --prefix "${FOLDER}/prefix")
endfunction()

build_and_run()
file(GLOB_RECURSE installed "${FOLDER}/prefix/*")
if(installed)
  message(SEND_ERROR "Nobody asked for these to be installed: ${installed}")
endif()

build_and_run(-DFETCH=ON -DBUILD_SHARED_LIBS=ON -DTRISMOOTH_INSTALL=ON)
file(RENAME "${FOLDER}/prefix" "${FOLDER}/moved")
foreach(module IN ITEMS base quality smoothing)
  file(GLOB_RECURSE libraries "${FOLDER}/moved/libtrismooth_${module}.so.0.1")
  list(LENGTH libraries count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "libtrismooth_${module}.so.0.1 is not there once: ${libraries}")
  endif()
  execute_process(COMMAND "${READELF}" --dynamic "${libraries}" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
  if(NOT dynamic MATCHES "\\(SONAME\\)[^\n]*\\[libtrismooth_${module}\\.so\\.0\\.1\\]")
    message(SEND_ERROR "${libraries} has another SONAME: ${dynamic}")
  endif()
  # Its neighbours, wherever they all are.
  if(NOT dynamic MATCHES "\\(RUNPATH\\)[^\n]*\\[\\$ORIGIN\\]")
    message(SEND_ERROR "${libraries} does not look beside itself: ${dynamic}")
  endif()
  if(NOT module STREQUAL "base" AND NOT dynamic MATCHES "\\(NEEDED\\)[^\n]*\\[libtrismooth_base\\.so\\.0\\.1\\]")
    message(SEND_ERROR "${libraries} does not need base: ${dynamic}")
  endif()
endforeach()
