# SPDX-License-Identifier: MIT
# cmake --install and find_package(dch): one exported set for all library targets.
include(CMakePackageConfigHelpers)

install(EXPORT dch-targets NAMESPACE dch:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/dch)
configure_package_config_file(${CMAKE_CURRENT_SOURCE_DIR}/cmake/dch-config.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/dch)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/dch)
