# SPDX-License-Identifier: MIT
# Whether this version serves a call of find_package(PhysVib).
if(PACKAGE_FIND_VERSION_RANGE)
    include(${CMAKE_CURRENT_LIST_DIR}/PhysVibVersionRange.cmake)
else()
    include(${CMAKE_CURRENT_LIST_DIR}/PhysVibVersionOne.cmake)
endif()
