# SPDX-License-Identifier: BSD-3-Clause
# Installs what the portable package holds, moves it elsewhere and looks at every program and library there: none has a
# search path that leaves the package, and each finds all that it needs in the package, but for the C library.
# Usage: cmake -D BUILD=... -D CONFIGURATION=... -D READELF=... -D FOLDER=... -P portable_package.cmake
cmake_policy(VERSION 3.22)

set(package "${FOLDER}/moved")
set(c_library "^(linux-vdso|.*ld-linux.*|lib(c|m|mvec|dl|pthread|rt|resolv|util|anl))\\.so")

# What an earlier run left must not help.
file(REMOVE_RECURSE "${FOLDER}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --config "${CONFIGURATION}" --component portable
                        --prefix "${FOLDER}/prefix" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${FOLDER}/prefix" "${package}")
foreach(document IN ITEMS README.md docs/library.md docs/images/before.svg LICENSE CHANGELOG.md third-party/NOTICE)
  if(NOT EXISTS "${package}/share/doc/trismooth/${document}")
    message(SEND_ERROR "${document} is missing")
  endif()
endforeach()

# The libraries that the loader would take, as in an environment that says nothing about it.
function(check_libraries_of file)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH --unset=LD_PRELOAD ldd "${file}"
                  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${listing}")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[ \t]*([^ ]+)( => ([^ ]+))?")
      message(SEND_ERROR "${file}: '${line}' is not understood")
    endif()
    set(name "${CMAKE_MATCH_1}")
    set(place "${CMAKE_MATCH_3}")
    if(NOT name MATCHES "${c_library}")
      string(FIND "${place}" "${package}/" at)
      if(NOT at EQUAL 0)
        message(SEND_ERROR "${file} takes ${name} from outside the package: ${line}")
      endif()
    endif()
  endforeach()
endfunction()

file(GLOB programs "${package}/bin/*" "${package}/tests/test_*")
file(GLOB libraries "${package}/lib/*.so*")
foreach(file IN LISTS programs libraries)
  execute_process(COMMAND "${READELF}" --dynamic "${file}" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "\\((RPATH|RUNPATH)\\)[^\n]*" paths "${dynamic}")
  if(file IN_LIST libraries AND paths)
    message(SEND_ERROR "${file} has a search path of its own, which goes before the program's: ${paths}")
  elseif(file IN_LIST programs AND NOT paths MATCHES "^\\(RPATH\\) .*\\[\\$ORIGIN/[^:]*(:\\$ORIGIN/[^:]*)*\\]$")
    message(SEND_ERROR "${file} has no DT_RPATH that stays within the package: ${paths}")
  endif()
endforeach()
# A library is looked for on behalf of a program: its own dependencies are in the program's list.
foreach(program IN LISTS programs)
  check_libraries_of("${program}")
endforeach()

execute_process(COMMAND "${package}/bin/trismooth" info OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
