# A room is one directory and one library. It can include the headers of the rooms that it
# names and of no other: every room has an include directory of its own in the build tree
# that holds one link to its sources, so an include across a closed door does not compile.
#
#   poolhall_room(rules PATH rules ROOMS physics LIBRARIES ... PRIVATE_LIBRARIES ...)
#
# makes the library poolhall_rules (alias poolhall::rules) of all *.cpp in rules/.
function(poolhall_room name)
  cmake_parse_arguments(ROOM "" "PATH" "ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(target poolhall_${name})
  set(staged "${CMAKE_BINARY_DIR}/rooms/${name}")
  get_filename_component(parent "${staged}/${ROOM_PATH}" DIRECTORY)
  file(MAKE_DIRECTORY "${parent}")
  if(NOT IS_SYMLINK "${staged}/${ROOM_PATH}")
    file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${ROOM_PATH}" "${staged}/${ROOM_PATH}" SYMBOLIC)
  endif()

  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/${ROOM_PATH}/*.cpp")
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    # Whoever links an installed room needs the language, not our warnings and our sources'
    # libraries; what of a library does have to be linked stands in LIBRARIES.
    target_compile_features(${target} PUBLIC cxx_std_20)
    foreach(library IN ITEMS poolhall_flags LISTS ROOM_PRIVATE_LIBRARIES)
      target_link_libraries(${target} PRIVATE "$<BUILD_INTERFACE:${library}>")
    endforeach()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(poolhall::${name} ALIAS ${target})
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${staged}>"
    "$<INSTALL_INTERFACE:include/poolhall>")
  foreach(other IN LISTS ROOM_ROOMS)
    target_link_libraries(${target} ${scope} poolhall_${other})
  endforeach()
  target_link_libraries(${target} ${scope} ${ROOM_LIBRARIES})
endfunction()
