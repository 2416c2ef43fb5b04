# SPDX-License-Identifier: BSD-3-Clause
# Read by CPack for each kind of package: what the Debian one holds is another install component than that of the
# portable one.
if(CPACK_GENERATOR STREQUAL "DEB")
  list(TRANSFORM CPACK_INSTALL_CMAKE_PROJECTS REPLACE "^portable$" "debian")
  set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
endif()
