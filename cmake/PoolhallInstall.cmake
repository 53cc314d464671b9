# What bots in C++ link: physics, rules, protocol and client, for `find_package(poolhall)`.
#
#   cmake --install build/release --component development --prefix /usr/local
#
#   find_package(poolhall 0.1 REQUIRED)                      # or COMPONENTS physics rules
#   target_link_libraries(my_bot PRIVATE poolhall::client)   # and with it the other three
#
# Headers go to include/poolhall, which the targets name: "physics/simulator.hpp" is included as in
# the house itself. The client wants Boost and OpenSSL, and is left out of what is looked for when
# COMPONENTS does not name it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(POOLHALL_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/poolhall")

# poolhall_install_room(EXPORT NAME PATH): the library, and PATH's headers without its sub-folders'.
function(poolhall_install_room export name path)
  set(target "poolhall_${name}")
  set_target_properties(${target} PROPERTIES EXPORT_NAME "${name}")
  install(TARGETS ${target} EXPORT "poolhall-${export}"
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/${path}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/poolhall/${path}" COMPONENT development
    FILES_MATCHING PATTERN "*.hpp" PATTERN "reference" EXCLUDE)
endfunction()

function(poolhall_install_package)
  foreach(export IN ITEMS core client)
    if(export STREQUAL "core" OR NOT POOLHALL_PARTS STREQUAL "python")
      install(EXPORT "poolhall-${export}" FILE "poolhall-${export}.cmake" NAMESPACE "poolhall::"
        DESTINATION "${POOLHALL_PACKAGE_DIR}" COMPONENT development)
    endif()
  endforeach()
  configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/poolhall-config.cmake.in"
    "${CMAKE_BINARY_DIR}/poolhall-config.cmake" INSTALL_DESTINATION "${POOLHALL_PACKAGE_DIR}")
  # Until 1.0 a new minor version may ask for changes in bots.
  write_basic_package_version_file("${CMAKE_BINARY_DIR}/poolhall-config-version.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_BINARY_DIR}/poolhall-config.cmake"
    "${CMAKE_BINARY_DIR}/poolhall-config-version.cmake"
    DESTINATION "${POOLHALL_PACKAGE_DIR}" COMPONENT development)
endfunction()
