# Debian packages: `./pool package` makes them in build/packages.
#
#   poolhall          the program, its service, example settings and tournaments
#   libpoolhall-dev   the libraries that bots in C++ link, with the CMake package
#   python3-poolhall  the Python package, where the extension could be built
#
# The service's settings are config/poolhall.toml with the database below /var/lib/poolhall.
include(GNUInstallDirs)

set(settings_file "${CMAKE_BINARY_DIR}/etc/poolhall.toml")
file(READ "${CMAKE_SOURCE_DIR}/config/poolhall.toml" settings)
foreach(pair IN ITEMS "database = \"poolhall.db\"|database = \"/var/lib/poolhall/poolhall.db\""
    "admin_token_file = \"\"|admin_token_file = \"/var/lib/poolhall/admin.token\"")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 given)
  list(GET pair 1 wanted)
  string(FIND "${settings}" "${given}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "config/poolhall.toml has no line '${given}' that the package could change")
  endif()
  string(REPLACE "${given}" "${wanted}" settings "${settings}")
endforeach()
file(WRITE "${settings_file}" "${settings}")

install(TARGETS poolhall RUNTIME COMPONENT program)
install(FILES "${settings_file}" DESTINATION /etc/poolhall COMPONENT program)
install(FILES "${CMAKE_SOURCE_DIR}/packaging/poolhall.service"
  DESTINATION /lib/systemd/system COMPONENT program)
install(DIRECTORY "${CMAKE_SOURCE_DIR}/config/tournaments" "${CMAKE_SOURCE_DIR}/config/tables"
    "${CMAKE_SOURCE_DIR}/config/noise"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/poolhall" COMPONENT program)
install(FILES "${CMAKE_SOURCE_DIR}/config/README.md"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/poolhall" COMPONENT program)
install(FILES "${CMAKE_BINARY_DIR}/man/poolhall.1.gz"
  DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program OPTIONAL)

set(packages program:poolhall)
if(COMMAND poolhall_install_room)
  list(APPEND packages development:libpoolhall-dev)
endif()
if(TARGET poolhall_python)
  list(APPEND packages python:python3-poolhall)
endif()
set(CPACK_COMPONENTS_ALL "")
# What has to be built for them; nothing else is when a package is made.
set(packaged_program poolhall)
set(packaged_development poolhall_client)
set(packaged_python poolhall_python)
add_custom_target(packaged)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
foreach(pair IN LISTS packages)
  string(REPLACE ":" ";" pair "${pair}")
  list(GET pair 0 component)
  list(GET pair 1 package)
  list(APPEND CPACK_COMPONENTS_ALL "${component}")
  add_custom_target("packaged_${component}" DEPENDS "${packaged_${component}}")
  add_dependencies(packaged "packaged_${component}")
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${package}")
  install(FILES "${CMAKE_SOURCE_DIR}/LICENSE" RENAME copyright
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT "${component}")
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_SOURCE_DIR}/build/packages")
set(CPACK_PACKAGE_CONTACT "The Poolhall authors <poolhall@localhost>")
set(CPACK_SET_DESTDIR ON)  # or what belongs in /etc would be put into this machine's
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
  "Tournament server for computational pool\n Bots connect over TCP and play 8-ball or nine-ball; the server owns the table,\n adds noise, simulates, referees, stores and rates.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION games)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/packaging/conffiles"
  "${CMAKE_SOURCE_DIR}/packaging/postinst" "${CMAKE_SOURCE_DIR}/packaging/prerm"
  "${CMAKE_SOURCE_DIR}/packaging/postrm")

set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
  "Libraries for pool bots in C++\n The simulator, the referee, the protocol and a client, as static libraries\n with headers and a CMake package.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libboost1.81-dev, libssl-dev, libexpected-dev")

set(CPACK_DEBIAN_PYTHON_DESCRIPTION
  "Python package for pool bots\n The simulator, the referee and a client.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" matched "${POOLHALL_PYTHON_VERSION}")
math(EXPR next_minor "0${CMAKE_MATCH_2} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= ${matched}), python3 (<< ${CMAKE_MATCH_1}.${next_minor}), python3-numpy")
include(CPack)
