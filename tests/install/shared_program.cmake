# SPDX-License-Identifier: BSD-3-Clause
# The whole project with shared libraries: built, installed and moved, the program finds its libraries, and other projects
# link mesh_io and pipeline on a machine without the packages that these are linked with. Then without halfedges, which
# nobody needs OpenMesh for.
# It builds everything once more: where TRISMOOTH_THOROUGH is not set in the environment it is skipped.
# Usage: cmake -D SOURCE=... -D GENERATOR=... -D COMPILER=... -D FLAGS=... -D LAUNCHER=... -D FOLDER=... -P shared_program.cmake
cmake_policy(VERSION 3.24)

if(NOT "$ENV{TRISMOOTH_THOROUGH}")
  message(STATUS "skipped: TRISMOOTH_THOROUGH=1 runs it")
  return()
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(plate "${SOURCE}/examples/data/plate.off")

# build_and_use(<options> <packages that are not there> <component>...)
function(build_and_use options missing)
  # What an earlier run left must not help.
  file(REMOVE_RECURSE "${FOLDER}/prefix" "${FOLDER}/moved")
  run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}/build" -G "${GENERATOR}" --no-warn-unused-cli -DBUILD_SHARED_LIBS=ON
      -DCMAKE_BUILD_TYPE=None -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 "-DCMAKE_CXX_COMPILER=${COMPILER}"
      "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" -DTRISMOOTH_CUDA=OFF -DTRISMOOTH_TESTS=OFF
      -DTRISMOOTH_EXAMPLES=OFF -DTRISMOOTH_BENCHMARKS=OFF ${options})
  run("${CMAKE_COMMAND}" --build "${FOLDER}/build")
  run("${CMAKE_COMMAND}" --install "${FOLDER}/build" --prefix "${FOLDER}/prefix")
  file(RENAME "${FOLDER}/prefix" "${FOLDER}/moved")
  run("${FOLDER}/moved/bin/trismooth" smooth "${plate}" "${FOLDER}/plate.vtu")
  foreach(component IN LISTS ARGN)
    run("${CMAKE_COMMAND}" -D "PREFIX=${FOLDER}/moved" -D "GENERATOR=${GENERATOR}" -D "COMPILER=${COMPILER}"
        -D "FLAGS=${FLAGS}" -D "FOLDER=${FOLDER}/${component}" -D "COMPONENT=${component}"
        -D "SOURCE=${CMAKE_CURRENT_LIST_DIR}/consumer/${component}.cpp" -D "WITHOUT=${missing}"
        -D "ARGUMENTS=${plate}\\;${FOLDER}/plate.vtu" -P "${CMAKE_CURRENT_LIST_DIR}/find_package.cmake")
  endforeach()
endfunction()

build_and_use("-DTRISMOOTH_HALFEDGE=ON;-DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=OFF" "EXPAT\\;PNG\\;PkgConfig\\;TBB\\;VTK\\;ZLIB\\;fmt" mesh_io pipeline)
build_and_use("-DTRISMOOTH_HALFEDGE=OFF;-DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON"
              "EXPAT\\;PNG\\;PkgConfig\\;TBB\\;VTK\\;ZLIB\\;fmt\\;Eigen3\\;OpenMesh" pipeline)
