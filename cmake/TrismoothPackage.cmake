# SPDX-License-Identifier: BSD-3-Clause
# The target `package` makes two packages of the programs:
#
# - trismooth-<version>-linux-<processor>.tar.gz, the portable one. It holds the programs with every shared library that
#   they need beside the C library, unpacks anywhere and runs on any Linux whose C library is as new as that of the
#   machine that made it.
# - trismooth_<version>_<architecture>.deb, for the release of Debian or Ubuntu that made it: the program, whose
#   libraries are those of the system. Needs the package dpkg-dev.
#
# What they hold are the install components `portable` and `debian`, which an ordinary `cmake --install` leaves out: that
# one is for building against trismooth, on a machine that has the libraries.

# trismooth_programs_below(<variable> <folder>) lists the executables that the folder and all below it make.
function(trismooth_programs_below variable folder)
  set(programs)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
      list(APPEND programs ${target})
    endif()
  endforeach()
  get_property(subfolders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(subfolder IN LISTS subfolders)
    trismooth_programs_below(below "${subfolder}")
    list(APPEND programs ${below})
  endforeach()
  set(${variable} ${programs} PARENT_SCOPE)
endfunction()

# trismooth_package_programs(<folder of the package> <target>...)
function(trismooth_package_programs folder)
  foreach(program IN LISTS ARGN)
    # The bundled libraries have no search path of their own, and only the older of the two kinds of path in a program,
    # DT_RPATH, serves the libraries of its libraries as well.
    target_link_options(${program} PRIVATE "$<HOST_LINK:LINKER:--disable-new-dtags>")
    get_target_property(path ${program} INSTALL_RPATH)
    if(NOT path)
      set(path)
    endif()
    list(APPEND path "$ORIGIN/../lib")
    list(REMOVE_DUPLICATES path)
    set_target_properties(${program} PROPERTIES INSTALL_RPATH "${path}")
  endforeach()
  install(TARGETS ${ARGN} RUNTIME DESTINATION "${folder}" COMPONENT portable EXCLUDE_FROM_ALL)
endfunction()

trismooth_programs_below(packaged_programs "${PROJECT_SOURCE_DIR}/pipeline")
if(TRISMOOTH_BENCHMARKS)
  trismooth_programs_below(benchmark_programs "${PROJECT_SOURCE_DIR}/benchmarks")
  list(APPEND packaged_programs ${benchmark_programs})
endif()
trismooth_package_programs(bin ${packaged_programs})

if(TRISMOOTH_TESTS AND TRISMOOTH_PACKAGE_TESTS)
  trismooth_programs_below(test_programs "${PROJECT_SOURCE_DIR}/tests")
  trismooth_package_programs(tests ${test_programs})
  list(APPEND packaged_programs ${test_programs})
  install(PROGRAMS scripts/test-gpu.sh DESTINATION tests COMPONENT portable EXCLUDE_FROM_ALL)
  install(DIRECTORY tests/end_to_end tests/mesh_io DESTINATION tests COMPONENT portable EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN "*.py")
endif()

# The library step, run at the time of installing. It reads the programs where they were built: there they find their
# libraries as the linker did.
set(packaged_files)
foreach(program IN LISTS packaged_programs)
  list(APPEND packaged_files "$<TARGET_FILE:${program}>")
endforeach()
# Libraries that are compiled in, by their Debian packages.
set(packages_compiled_in libcli11-dev libeigen3-dev libfmt-dev libopenmesh-dev libtbb-dev libvtk9-dev
                         nlohmann-json3-dev)
if(TRISMOOTH_TESTS AND TRISMOOTH_PACKAGE_TESTS)
  list(APPEND packages_compiled_in catch2)
endif()
install(CODE "
set(programs \"${packaged_files}\")
set(packages_compiled_in \"${packages_compiled_in}\")
set(with_cuda \"${TRISMOOTH_CUDA}\")
set(strip \"${CMAKE_STRIP}\")
set(licences \"share/doc/trismooth/third-party\")
set(licence_file LICENSE)
include(\"${CMAKE_CURRENT_LIST_DIR}/bundle_libraries.cmake\")
include(\"${CMAKE_CURRENT_LIST_DIR}/bundle_licences.cmake\")"
        COMPONENT portable EXCLUDE_FROM_ALL)

install(FILES README.md LICENSE CHANGELOG.md DESTINATION share/doc/trismooth COMPONENT portable EXCLUDE_FROM_ALL)
install(DIRECTORY docs DESTINATION share/doc/trismooth COMPONENT portable EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
# Where the README and the tests expect them, seen from the top of the package.
install(DIRECTORY examples/data DESTINATION examples COMPONENT portable EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.off" PATTERN "*.vtk" PATTERN "*.vtu" PATTERN "README.md")

# The Debian package: the program alone, its libraries where it cannot do without, and whose code it holds.
install(TARGETS trismooth_program RUNTIME DESTINATION bin COMPONENT debian EXCLUDE_FROM_ALL)
set(shared_libraries)
foreach(module IN LISTS trismooth_installed_modules)
  get_target_property(type trismooth_${module} TYPE)
  if(type STREQUAL "SHARED_LIBRARY")
    list(APPEND shared_libraries trismooth_${module})
  endif()
endforeach()
if(shared_libraries)
  install(TARGETS ${shared_libraries} LIBRARY DESTINATION lib COMPONENT debian EXCLUDE_FROM_ALL NAMELINK_SKIP)
endif()
install(CODE "
set(bundled_libraries \"\")
set(packages_compiled_in \"${packages_compiled_in}\")
set(with_cuda \"${TRISMOOTH_CUDA}\")
set(licences \"share/doc/trismooth/third-party\")
set(licence_file copyright)
# The system knows where its libraries are.
file(RPATH_REMOVE FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/trismooth\")
include(\"${CMAKE_CURRENT_LIST_DIR}/bundle_licences.cmake\")"
        COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES LICENSE DESTINATION share/doc/trismooth RENAME copyright COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES README.md CHANGELOG.md DESTINATION share/doc/trismooth COMPONENT debian EXCLUDE_FROM_ALL)

string(TOLOWER "${CMAKE_SYSTEM_NAME}" system)
set(CPACK_PACKAGE_FILE_NAME "trismooth-${PROJECT_VERSION}-${system}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_GENERATOR TGZ)
find_program(TRISMOOTH_DPKG_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(TRISMOOTH_DPKG_SHLIBDEPS)
if(TRISMOOTH_DPKG_SHLIBDEPS)
  list(APPEND CPACK_GENERATOR DEB)
endif()
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};trismooth;portable;/")
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/package_kinds.cmake")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "the trismooth authors")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Reads a planar triangle mesh, checks its quality, smooths it on the CPU or on an
NVIDIA GPU, and writes it back with everything else in the file untouched.
Boundaries and interfaces between regions stay as they are.")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)

if(TRISMOOTH_TESTS)
  set(test "install: the portable package brings its libraries")
  add_test(
    NAME "${test}"
    COMMAND
      "${CMAKE_COMMAND}" -D "BUILD=${PROJECT_BINARY_DIR}" -D "CONFIGURATION=$<CONFIG>" -D "READELF=${CMAKE_READELF}"
      -D "FOLDER=${PROJECT_BINARY_DIR}/tests/install/portable"
      -P "${PROJECT_SOURCE_DIR}/tests/install/portable_package.cmake")
  # Installing writes a list of files into the build folder: one at a time.
  set_tests_properties("${test}" PROPERTIES TIMEOUT 300 RESOURCE_LOCK install LABELS packaging)
  set(test "install: the Debian package has the program and depends on what runs it")
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  add_test(NAME "${test}"
           COMMAND Python3::Interpreter -B "${PROJECT_SOURCE_DIR}/tests/install/debian_package.py" "${CMAKE_CPACK_COMMAND}"
                   "${PROJECT_BINARY_DIR}/CPackConfig.cmake" "${PROJECT_BINARY_DIR}/tests/install/debian"
                   "${PROJECT_SOURCE_DIR}/examples/data/plate.off")
  set_tests_properties("${test}" PROPERTIES TIMEOUT 300 RESOURCE_LOCK install SKIP_RETURN_CODE 77 LABELS packaging)
endif()
