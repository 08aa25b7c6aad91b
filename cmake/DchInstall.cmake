# SPDX-License-Identifier: MIT
# cmake --install and find_package(dch). The trajectory library has an exported set of its own, since it alone needs
# further packages: who links dch::core only has to have none of them.
include(CMakePackageConfigHelpers)

set(DCH_CONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/dch)
install(EXPORT dch-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER})
if(TARGET dch_trajectory)
  install(EXPORT dch-trajectory-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER})
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dch-config.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
                              INSTALL_DESTINATION ${DCH_CONFIG_FOLDER})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
        DESTINATION ${DCH_CONFIG_FOLDER})
