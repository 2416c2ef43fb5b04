# SPDX-License-Identifier: BSD-3-Clause
# How every target of the project is made: one language level, one set of warnings, and floating-point
# arithmetic that is the same for every compiler, thread count and instruction set.

# Sources say `#include "trismooth/quality/metrics.h"` in the tree as well as installed: the build tree holds a link for
# each folder, for the project's own targets, and for those of others one for each public header of what is built.
set(trismooth_headers "${PROJECT_BINARY_DIR}/include/trismooth")
set(trismooth_public "${PROJECT_BINARY_DIR}/public/trismooth")
file(MAKE_DIRECTORY "${trismooth_headers}" "${trismooth_public}")
foreach(folder IN ITEMS base quality smoothing mesh_io mpi pipeline cuda)
  file(REMOVE_RECURSE "${trismooth_public}/${folder}")
endforeach()
foreach(folder IN ITEMS base space quality smoothing mesh_io mpi pipeline paper cuda)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}" "${trismooth_headers}/${folder}" SYMBOLIC)
endforeach()
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/python/src" "${trismooth_headers}/python" SYMBOLIC)
configure_file("${CMAKE_CURRENT_LIST_DIR}/version.h.in" "${trismooth_public}/version.h" @ONLY)
configure_file("${CMAKE_CURRENT_LIST_DIR}/trismooth.h" "${trismooth_public}/trismooth.h" COPYONLY)

function(trismooth_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} BEFORE PRIVATE "${PROJECT_BINARY_DIR}/include")
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(
    ${target}
    PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
            # Results are the same bits everywhere only if no multiply and add are ever fused.
            -ffp-contract=off
            # No effect on any value: nobody looks at floating-point traps or errno, which lets a quotient be a
            # select instead of a branch.
            -fno-trapping-math -fno-math-errno>
            # GCC 12 warns of "literal" + std::string where nothing overlaps (its bug 105651), and of the default-made
            # Eigen vectors with which OpenMesh fills a new point property.
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized>)
  if(TRISMOOTH_WERROR)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
  endif()
endfunction()

# How far a release build optimises a target beyond which nothing would be gained: -O3 takes half again the time that -O1
# takes to compile. What visits vertices in sweeps keeps -O3.
function(trismooth_optimise target level)
  target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:${level}>)
endfunction()

# Has the fuzzer see which edges of the target it reaches.
function(trismooth_guide_fuzzer target)
  if(TRISMOOTH_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# Whoever links the target computes what its headers hold inline to the bits of the library, with whatever flags of their
# own: no multiply and add are fused. nvcc's -use_fast_math, of which no header can tell, is taken back option by option.
function(trismooth_carry_exact_arithmetic target)
  target_compile_options(
    ${target}
    INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang,IntelLLVM>:-ffp-contract=off>
              $<$<COMPILE_LANG_AND_ID:CUDA,Clang>:-ffp-contract=off>
              $<$<COMPILE_LANG_AND_ID:CUDA,NVIDIA>:-fmad=false;-ftz=false;-prec-div=true;-prec-sqrt=true;-Xcompiler=-ffp-contract=off>)
endfunction()

# trismooth_library(<name> <source>...) makes target trismooth_<name>, used as trismooth::<name>. It is static unless
# BUILD_SHARED_LIBS says otherwise.
function(trismooth_library name)
  add_library(trismooth_${name} ${ARGN})
  add_library(trismooth::${name} ALIAS trismooth_${name})
  # Below 1.0 every minor version may change the interface. All symbols are visible: no macro tells the sources of a
  # shared library from those of a static one, and what was compiled serves both.
  set_target_properties(trismooth_${name} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
                                                     SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                                                     DEFINE_SYMBOL "")
  trismooth_configure(trismooth_${name})
  trismooth_guide_fuzzer(trismooth_${name})
  target_include_directories(
    trismooth_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/public> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# trismooth_public_headers(<header>...): what others may include, by their paths below trismooth/. These are installed; all
# other headers are private.
function(trismooth_public_headers)
  foreach(header IN LISTS ARGN)
    set(file "${PROJECT_SOURCE_DIR}/${header}")
    cmake_path(GET header PARENT_PATH folder)
    if(folder STREQUAL "")
      set(file "${trismooth_public}/${header}")
    else()
      file(MAKE_DIRECTORY "${trismooth_public}/${folder}")
      file(CREATE_LINK "${file}" "${trismooth_public}/${header}" SYMBOLIC)
    endif()
    if(TRISMOOTH_INSTALL)
      install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/trismooth/${folder}")
    endif()
  endforeach()
endfunction()

# Adds to a target that compiles CUDA what its .cu files need: the host's rules once more, for nvcc.
function(trismooth_configure_cuda target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON CUDA_RUNTIME_LIBRARY Static)
  target_include_directories(${target} BEFORE PRIVATE "${PROJECT_BINARY_DIR}/include" "${PROJECT_BINARY_DIR}/public")
  target_compile_options(
    ${target}
    PRIVATE # The language level is said by hand: the CMake of Debian 12 does not know the flag of CUDA 13.
            $<$<COMPILE_LANGUAGE:CUDA>:-std=c++20 --expt-relaxed-constexpr
            # No multiply and add are ever fused, on either side.
            -fmad=false -Xcompiler=-ffp-contract=off,-fno-trapping-math,-fno-math-errno
            # Machine code is stored compressed, as PTX is anyway, and both as small as they get: an eighth of their size,
            # and a millisecond for each megabyte of the kernels that a run uses.
            -Xfatbin=-compress-all --compress-mode=size
            # Messages name files of the project, not of the machine that it was built on.
            -Xcompiler=-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=>)
  if(TRISMOOTH_WERROR)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings>)
  endif()
endfunction()
