# SPDX-License-Identifier: BSD-3-Clause
# Part of installing the portable package: writes to its folder `licences` whose code it holds beside trismooth's own.
# Debian and its kin know that, with the licence of each package; elsewhere only the libraries are listed.
# Expects beside the variables of an install script: bundled_libraries, packages_compiled_in, with_cuda, licences, licence_file.
cmake_policy(VERSION 3.22)

set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${licences}")
file(REMOVE_RECURSE "${folder}")
file(MAKE_DIRECTORY "${folder}")
find_program(DPKG_QUERY dpkg-query)

# package_of(<variable> <library>): the Debian package that a library came with; empty where that is unknown.
function(package_of variable library)
  set(${variable} "" PARENT_SCOPE)
  if(NOT DPKG_QUERY)
    return()
  endif()
  file(REAL_PATH "${library}" library)
  # A package may call the folder /usr/lib by its old name.
  string(REGEX REPLACE "^/usr/" "/" old_path "${library}")
  foreach(path IN ITEMS "${library}" "${old_path}")
    execute_process(COMMAND "${DPKG_QUERY}" --search "${path}" OUTPUT_VARIABLE found ERROR_QUIET
                    RESULT_VARIABLE result)
    if(result EQUAL 0 AND found MATCHES "^([^:,]+)[:,]")
      set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# copy_licence(<package>): its notice, and the texts that the notice refers to.
function(copy_licence package)
  set(notice "/usr/share/doc/${package}/copyright")
  if(NOT EXISTS "${notice}")
    return()
  endif()
  file(REAL_PATH "${notice}" notice)
  file(COPY_FILE "${notice}" "${folder}/${package}.txt")
  file(STRINGS "${notice}" lines REGEX "/usr/share/common-licenses/")
  foreach(line IN LISTS lines)
    string(REGEX MATCHALL "/usr/share/common-licenses/[A-Za-z0-9.+-]*[A-Za-z0-9]" texts "${line}")
    foreach(text IN LISTS texts)
      if(EXISTS "${text}")
        get_filename_component(name "${text}" NAME)
        file(MAKE_DIRECTORY "${folder}/common-licenses")
        file(REAL_PATH "${text}" text)
        file(COPY_FILE "${text}" "${folder}/common-licenses/${name}" ONLY_IF_DIFFERENT)
      endif()
    endforeach()
  endforeach()
endfunction()

# package_line(<variable> <package>): the package with its version.
function(package_line variable package)
  execute_process(COMMAND "${DPKG_QUERY}" --show "--showformat=\${Package} \${Version}" "${package}"
                  OUTPUT_VARIABLE line ERROR_QUIET RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    set(line "")
  endif()
  set(${variable} "${line}" PARENT_SCOPE)
endfunction()

set(shared "")
foreach(library IN LISTS bundled_libraries)
  get_filename_component(name "${library}" NAME)
  package_of(package "${library}")
  set(line "unknown")
  if(package)
    copy_licence("${package}")
    package_line(line "${package}")
  endif()
  list(APPEND shared "  ${name}: ${line}")
endforeach()
list(SORT shared)
list(JOIN shared "\n" shared)

set(compiled_in "")
if(DPKG_QUERY)
  foreach(package IN LISTS packages_compiled_in)
    package_line(line "${package}")
    if(line)
      copy_licence("${package}")
      string(APPEND compiled_in "  ${line}\n")
    endif()
  endforeach()
endif()
if(with_cuda)
  string(APPEND compiled_in "  the CUDA runtime of NVIDIA, under the licence agreement of the CUDA Toolkit,
  in the programs that use CUDA\n")
endif()

set(shared_notice "")
if(shared)
  set(shared_notice "Shared libraries in lib/ and the Debian packages that they came with. Search paths were taken out of them; they are
otherwise as they were. They may be replaced by others of the same name.

${shared}

")
endif()
file(WRITE "${folder}/NOTICE" "trismooth is under the licence in ../${licence_file}. This package holds code of others as well.

${shared_notice}Compiled into the programs, by Debian package:

${compiled_in}
<package>.txt is the copyright notice of a package. Texts that notices find in /usr/share/common-licenses are in
common-licenses/ here.
")
