# SPDX-License-Identifier: BSD-3-Clause
# Part of installing the portable package: copies every shared library that `programs` need to its folder lib, and
# leaves them in `bundled_libraries`, by their paths on this machine.
# Expects beside the variables of an install script: programs, strip.
cmake_policy(VERSION 3.22)

# The C library belongs to the system that the package runs on, and so does CUDA's driver.
set(libraries_of_the_system "^(ld-linux.*|lib(c|m|mvec|dl|pthread|rt|resolv|util|anl|cuda))\\.so")

file(GET_RUNTIME_DEPENDENCIES
     EXECUTABLES ${programs}
     PRE_EXCLUDE_REGEXES "${libraries_of_the_system}"
     RESOLVED_DEPENDENCIES_VAR bundled_libraries
     UNRESOLVED_DEPENDENCIES_VAR not_found)
if(not_found)
  list(JOIN not_found ", " not_found)
  message(FATAL_ERROR "The package would lack shared libraries, which are not found on this machine: ${not_found}")
endif()

file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/lib" TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN
     FILES ${bundled_libraries})
foreach(library IN LISTS bundled_libraries)
  file(REAL_PATH "${library}" library)
  get_filename_component(name "${library}" NAME)
  set(copy "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/lib/${name}")
  # A search path of a library's own would go before that of the program.
  file(RPATH_REMOVE FILE "${copy}")
  if(CMAKE_INSTALL_DO_STRIP AND strip)
    execute_process(COMMAND "${strip}" --strip-unneeded "${copy}" COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
