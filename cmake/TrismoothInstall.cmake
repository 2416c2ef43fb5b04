# What `cmake --install` puts where, so that another project says find_package(trismooth).
# Every module is a component with an export file of its own: who asks for `smoothing` alone needs neither
# OpenMesh nor VTK on the machine.

include(CMakePackageConfigHelpers)
set(trismooth_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/trismooth")

foreach(module IN ITEMS base quality smoothing cuda mesh_io halfedge pipeline)
  if(TARGET trismooth_${module})
    install(TARGETS trismooth_${module} EXPORT trismooth_${module}
            LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    set_target_properties(trismooth_${module} PROPERTIES INSTALL_RPATH "$ORIGIN")
    # Headers over the private dependencies (VTK, CLI11) are of no use to others.
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/${module}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/trismooth/${module}"
            FILES_MATCHING PATTERN "*.h" PATTERN "*.cuh"
            REGEX "/(vtk_[a-z_]*|mesh_run|option_parsing|subcommands)\\.h$" EXCLUDE)
    list(APPEND trismooth_installed_modules ${module})
  endif()
endforeach()
install(TARGETS trismooth_all EXPORT trismooth_pipeline)
foreach(module IN LISTS trismooth_installed_modules)
  install(EXPORT trismooth_${module} FILE trismooth-${module}.cmake NAMESPACE trismooth::
          DESTINATION "${trismooth_package_dir}")
endforeach()

install(TARGETS trismooth RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
file(RELATIVE_PATH libraries_from_program "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(trismooth PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_program}")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/trismoothConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/trismoothConfig.cmake"
                              INSTALL_DESTINATION "${trismooth_package_dir}"
                              NO_SET_AND_CHECK_MACRO)
# Below 1.0 every minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/trismoothConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/trismoothConfig.cmake" "${PROJECT_BINARY_DIR}/trismoothConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/TrismoothCudaDeviceRuntime.cmake"
        DESTINATION "${trismooth_package_dir}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" OPTIONAL)
