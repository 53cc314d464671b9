# Writes a C++ source that holds the files of a folder as text, when one of them has changed.
#
#   poolhall_embed(poolhall_web "${CMAKE_SOURCE_DIR}/clients/web" "*.html;*.js;*.css;*.svg")
#
# adds a definition of poolhall::web::embedded_files() to the target. As a script (-P) it writes:
#   cmake -DOUT=embedded.cpp -DFOLDER=clients/web "-DFILES=/index.html;/main.js" -P PoolhallEmbed.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  set(text "#include \"server/web/static_files.hpp\"\n\n#include <array>\n\n")
  string(APPEND text "namespace poolhall::web {\nnamespace {\n\n")
  set(entries "")
  set(count 0)
  foreach(file IN LISTS FILES)
    file(READ "${FOLDER}${file}" content HEX)
    # A literal of bytes: whatever the file holds, and without a limit on its length.
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${content}")
    string(APPEND text "constexpr char file_${count}[] = {${bytes}'\\0'};\n")
    string(APPEND entries
      "    EmbeddedFile{\"${file}\", {file_${count}, sizeof file_${count} - 1}},\n")
    math(EXPR count "${count} + 1")
  endforeach()
  string(APPEND text "\nconstexpr std::array files{\n${entries}};\n\n}  // namespace\n\n")
  string(APPEND text "std::span<const EmbeddedFile> embedded_files() {\n  return files;\n}\n\n")
  string(APPEND text "}  // namespace poolhall::web\n")
  file(WRITE "${OUT}" "${text}")
  return()
endif()

set(POOLHALL_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(poolhall_embed target folder patterns)
  list(TRANSFORM patterns PREPEND "${folder}/")
  file(GLOB paths CONFIGURE_DEPENDS ${patterns})
  list(TRANSFORM paths REPLACE "^${folder}" "" OUTPUT_VARIABLE files)
  set(out "${CMAKE_CURRENT_BINARY_DIR}/${target}_files.cpp")
  add_custom_command(OUTPUT "${out}"
    COMMAND "${CMAKE_COMMAND}" "-DOUT=${out}" "-DFOLDER=${folder}" "-DFILES=${files}"
      -P "${POOLHALL_EMBED_SCRIPT}"
    DEPENDS ${paths} "${POOLHALL_EMBED_SCRIPT}" VERBATIM)
  target_sources(${target} PRIVATE "${out}")
endfunction()
