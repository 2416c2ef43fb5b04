# SPDX-License-Identifier: BSD-3-Clause
# Installs the build once, for the tests that look at what is installed, and moves it: nothing in it may know where it
# was installed. No text in it names a folder of the project or of the build.
# Usage: cmake -D BUILD=... -D CONFIGURATION=... -D SOURCE=... -D FOLDER=... -P installed_tree.cmake
cmake_policy(VERSION 3.24)

# What an earlier run left must not help.
file(REMOVE_RECURSE "${FOLDER}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --config "${CONFIGURATION}" --prefix "${FOLDER}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${FOLDER}/prefix" "${FOLDER}/moved")

file(GLOB_RECURSE texts "${FOLDER}/moved/*.cmake" "${FOLDER}/moved/*.pc" "${FOLDER}/moved/*.h")
foreach(text IN LISTS texts)
  file(READ "${text}" content)
  foreach(place IN ITEMS "${SOURCE}/" "${BUILD}/" "${FOLDER}/")
    string(FIND "${content}" "${place}" at)
    if(NOT at EQUAL -1)
      message(SEND_ERROR "${text} names ${place}")
    endif()
  endforeach()
endforeach()
