# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` puts where, so that another project says find_package(trismooth) or asks pkg-config.
# Every module is a component with an export file of its own: who asks for `smoothing` alone needs neither
# OpenMesh nor VTK on the machine.

include(CMakePackageConfigHelpers)
set(trismooth_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/trismooth")

foreach(module IN ITEMS base quality smoothing cuda mpi mesh_io space halfedge pipeline)
  if(TARGET trismooth_${module})
    install(TARGETS trismooth_${module} EXPORT trismooth_${module}
            LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    set_target_properties(trismooth_${module} PROPERTIES INSTALL_RPATH "$ORIGIN")
    list(APPEND trismooth_installed_modules ${module})
  endif()
endforeach()
install(TARGETS trismooth_all EXPORT trismooth_all)
foreach(module IN LISTS trismooth_installed_modules ITEMS all)
  install(EXPORT trismooth_${module} FILE trismooth-${module}.cmake NAMESPACE trismooth::
          DESTINATION "${trismooth_package_dir}")
endforeach()
include(TrismoothPkgConfig)

if(TRISMOOTH_CLI)
  install(TARGETS trismooth_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  file(RELATIVE_PATH libraries_from_program "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(trismooth_program PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_program}")
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/trismoothConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/trismoothConfig.cmake"
                              INSTALL_DESTINATION "${trismooth_package_dir}"
                              NO_SET_AND_CHECK_MACRO)
# Below 1.0 every minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/trismoothConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/trismoothConfig.cmake" "${PROJECT_BINARY_DIR}/trismoothConfigVersion.cmake"
        DESTINATION "${trismooth_package_dir}")
if(TRISMOOTH_CUDA)
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/TrismoothCudaDeviceRuntime.cmake" DESTINATION "${trismooth_package_dir}")
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        OPTIONAL)
# The pages that the README leads to.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
