# SPDX-License-Identifier: BSD-3-Clause
# A project that knows nothing but PREFIX, where trismooth is installed, finds COMPONENT there, builds SOURCE with it and
# runs the program with ARGUMENTS. Packages in WITHOUT count as missing on the machine. With EXACT_ARITHMETIC it does the
# same with exact_arithmetic.cpp, which has flags of its own.
# Usage: cmake -D PREFIX=... -D GENERATOR=... -D COMPILER=... -D FLAGS=... -D FOLDER=... -D COMPONENT=... -D SOURCE=...
#        [-D WITHOUT=...] [-D ARGUMENTS=...] [-D EXACT_ARITHMETIC=ON] -P find_package.cmake
cmake_policy(VERSION 3.24)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# What an earlier run left must not help.
file(REMOVE_RECURSE "${FOLDER}")
foreach(package IN LISTS WITHOUT)
  list(APPEND missing "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
endforeach()
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${FOLDER}" -G "${GENERATOR}" --no-warn-unused-cli
    "-DCMAKE_PREFIX_PATH=${PREFIX}" "-DCOMPONENT=${COMPONENT}" "-DSOURCE=${SOURCE}"
    "-DEXACT_ARITHMETIC=${EXACT_ARITHMETIC}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
    "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${FOLDER}/programs" ${missing})
run("${CMAKE_COMMAND}" --build "${FOLDER}")
find_program(consumer NAMES consumer PATHS "${FOLDER}/programs" "${FOLDER}/programs/Debug" NO_DEFAULT_PATH REQUIRED)
run("${consumer}" ${ARGUMENTS})
if(EXACT_ARITHMETIC)
  find_program(exact_arithmetic NAMES exact_arithmetic PATHS "${FOLDER}/programs" "${FOLDER}/programs/Debug"
               NO_DEFAULT_PATH REQUIRED)
  run("${exact_arithmetic}")
endif()
