# Turns a folder of files of `key = value` lines into C++ at configure time, so that the presets
# are compiled in and the physics reads no files; a key that is no member does not compile.
#
#   poolhall_preset_blocks(tables PRESET_BLOCKS)        # config/tables/*.toml
#
# sets PRESET_BLOCKS to one block a file, named after it:
#   { auto& preset = add("bar7"); preset.width = 0.9906; ... }
# `pockets.kind` picks the alternative of preset.pockets, which is `pockets` from there on.
function(poolhall_preset_blocks folder result)
  set(pockets_of_mouth_lines "MouthLines")
  set(pockets_of_jaws "Jaws")
  file(GLOB files CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/config/${folder}/*.toml")
  set(blocks "")
  foreach(file IN LISTS files)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    get_filename_component(name "${file}" NAME_WE)
    string(APPEND blocks "  {\n    auto& preset = add(\"${name}\");\n")
    file(STRINGS "${file}" settings)
    foreach(setting IN LISTS settings)
      if(setting MATCHES "^ *(#|$)")
        continue()
      elseif(setting MATCHES "^pockets\\.kind = \"([a-z_]+)\"$")
        set(type "${pockets_of_${CMAKE_MATCH_1}}")
        string(APPEND blocks "    ${type}& pockets = preset.pockets.emplace<${type}>();\n")
      elseif(setting MATCHES "^(pockets\\.[a-z_.]+ = [-0-9.e]+)$")
        string(APPEND blocks "    ${CMAKE_MATCH_1};\n")
      elseif(setting MATCHES "^([a-z_]+ = [-0-9.e]+)$")
        string(APPEND blocks "    preset.${CMAKE_MATCH_1};\n")
      else()
        message(FATAL_ERROR "${file}: expected `key = number`, got `${setting}`")
      endif()
    endforeach()
    string(APPEND blocks "  }\n")
  endforeach()
  set(${result} "${blocks}" PARENT_SCOPE)
endfunction()
