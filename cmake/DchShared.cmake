# SPDX-License-Identifier: MIT
# libdch.so: the libraries that need the standard library alone, as one, of the objects of the static ones. One, since they
# share what is no part of their interface. Before 1.0 the second number of the version tells what fits.
get_property(DCH_SHARED_PARTS GLOBAL PROPERTY DCH_SHARED_PARTS)
add_library(dch_shared SHARED)
set_target_properties(dch_shared PROPERTIES
                      OUTPUT_NAME dch EXPORT_NAME dch LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_compile_features(dch_shared PUBLIC cxx_std_17)
dch_target_defaults(dch_shared)
set(DCH_SHARED_MAP ${CMAKE_CURRENT_LIST_DIR}/libdch.map)
target_link_options(dch_shared PRIVATE LINKER:--version-script,${DCH_SHARED_MAP})
set_target_properties(dch_shared PROPERTIES LINK_DEPENDS ${DCH_SHARED_MAP})
if(NOT DCH_SANITIZE)
  target_link_options(dch_shared PRIVATE LINKER:--no-undefined)
endif()
install(TARGETS dch_shared EXPORT dch-shared-targets
        LIBRARY COMPONENT libdch NAMELINK_COMPONENT libdch-dev)

# dch::core and so on for who links libdch: the headers of each, and the one library.
foreach(part IN LISTS DCH_SHARED_PARTS)
  target_sources(dch_shared PRIVATE $<TARGET_OBJECTS:dch_${part}>)
  add_library(dch_${part}_shared INTERFACE)
  set_target_properties(dch_${part}_shared PROPERTIES EXPORT_NAME ${part})
  target_include_directories(dch_${part}_shared INTERFACE
                             $<BUILD_INTERFACE:$<TARGET_PROPERTY:dch_${part},INTERFACE_INCLUDE_DIRECTORIES>>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(dch_${part}_shared INTERFACE dch_shared)
  install(TARGETS dch_${part}_shared EXPORT dch-shared-targets COMPONENT libdch-dev)
  if(DCH_LINK_SHARED)
    add_library(dch::${part} ALIAS dch_${part}_shared)
  endif()
endforeach()
