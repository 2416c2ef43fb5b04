# SPDX-License-Identifier: BSD-3-Clause
# Files for pkg-config, one a component: trismooth-smoothing.pc and others. They name no folder of this machine, so an
# installed tree may be moved. Not for cuda, nor for a pipeline that holds it: where the CUDA toolkit is, only CMake finds
# out.

file(RELATIVE_PATH prefix_from_pkg_config "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")

# trismooth_pkg_config(<module> <description> [FLAGS <flag>...] [REQUIRES <package>...] [LIBRARIES <flag>...]
#                      [INSIDE_REQUIRES <package>...] [INSIDE_LIBRARIES <flag>...])
# The last two are what the sources need and the headers do not. A shared library is linked with them already; with a
# static one whoever links the library links them.
function(trismooth_pkg_config module description)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "FLAGS;REQUIRES;LIBRARIES;INSIDE_REQUIRES;INSIDE_LIBRARIES")
  get_target_property(type trismooth_${module} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND arg_REQUIRES ${arg_INSIDE_REQUIRES})
    list(APPEND arg_LIBRARIES ${arg_INSIDE_LIBRARIES})
    set(arg_INSIDE_REQUIRES)
    set(arg_INSIDE_LIBRARIES)
  endif()
  list(JOIN arg_FLAGS " " flags)
  list(JOIN arg_REQUIRES ", " requires)
  list(JOIN arg_LIBRARIES " " libraries)
  list(JOIN arg_INSIDE_REQUIRES ", " requires_private)
  list(JOIN arg_INSIDE_LIBRARIES " " libraries_private)
  set(file "${PROJECT_BINARY_DIR}/pkgconfig/trismooth-${module}.pc")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/trismooth.pc.in" "${file}" @ONLY)
  install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()

# The flag is that of trismooth_carry_exact_arithmetic().
trismooth_pkg_config(base "Points, arrays as views and errors of trismooth" FLAGS -ffp-contract=off INSIDE_REQUIRES tbb)
trismooth_pkg_config(quality "Quality of planar finite element meshes" REQUIRES trismooth-base)
trismooth_pkg_config(smoothing "Smart Laplacian smoothing of planar finite element meshes" REQUIRES trismooth-quality)
if(TRISMOOTH_MESH_IO)
  set(requires zlib)
  set(libraries)
  if(TRISMOOTH_VTK OR TRISMOOTH_HDF5)
    list(APPEND requires expat)
  endif()
  if(TRISMOOTH_VTK)
    get_target_property(linked trismooth_mesh_io LINK_LIBRARIES)
    foreach(library IN LISTS linked)
      # VTK::IOXML is the file libvtkIOXML-9.1.so.
      if(library MATCHES "^VTK::")
        string(REPLACE "VTK::" "-lvtk" flag "${library}")
        list(APPEND libraries "${flag}-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}")
      endif()
    endforeach()
  endif()
  if(TRISMOOTH_HDF5)
    list(APPEND libraries "${HDF5Serial_LIBRARY}")
  endif()
  trismooth_pkg_config(mesh_io "Mesh files of trismooth: OFF, OBJ, PLY, STL, VTK" REQUIRES trismooth-base
                       INSIDE_REQUIRES ${requires} INSIDE_LIBRARIES ${libraries})
endif()
if(TARGET trismooth_space)
  trismooth_pkg_config(space "Planes and maps that plane meshes lie in: what trismooth-pipeline and -halfedge need"
                       REQUIRES trismooth-smoothing)
endif()
if(TRISMOOTH_HALFEDGE)
  trismooth_pkg_config(halfedge "Smart Laplacian smoothing of OpenMesh meshes" REQUIRES trismooth-space eigen3 openmesh)
endif()
if(TRISMOOTH_PIPELINE AND NOT TRISMOOTH_CUDA)
  set(halfedge)
  if(TRISMOOTH_HALFEDGE)
    set(halfedge trismooth-halfedge)
  endif()
  trismooth_pkg_config(pipeline "Mesh files read, checked, smoothed and written, as the program trismooth does it"
                       REQUIRES trismooth-mesh_io trismooth-space ${halfedge} INSIDE_REQUIRES fmt libpng libxxhash)
endif()
