# Installs the libraries into a folder of its own, builds the example against them and runs it.
#
#   cmake -DBUILD=build/release -DEXAMPLE=tests/install/example -DWORK=DIR -DCOMPILER=g++ -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}\n${text}")
  endif()
  set(output "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --component development --prefix "${WORK}/prefix")
run("${CMAKE_COMMAND}" -S "${EXAMPLE}" -B "${WORK}/build" -G Ninja "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
run("${CMAKE_COMMAND}" --build "${WORK}/build" -j 2)
run("${WORK}/build/referee")
if(NOT output MATCHES "^[0-9]+ events, first contact [0-9]+, ")
  message(FATAL_ERROR "referee printed: ${output}")
endif()
message(STATUS "referee: ${output}")

# A component that does not exist, and a version that is not this one's, are refused in words.
foreach(wrong IN ITEMS "0.1 REQUIRED COMPONENTS snooker" "0.2 REQUIRED")
  file(WRITE "${WORK}/wrong/CMakeLists.txt"
    "cmake_minimum_required(VERSION 3.25)\nproject(wrong LANGUAGES NONE)\nfind_package(poolhall ${wrong})\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -S "${WORK}/wrong" -B "${WORK}/wrong/build" -G Ninja
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE text)
  if(NOT failed OR NOT text MATCHES "snooker|version \"0.2\"")
    message(FATAL_ERROR "find_package(poolhall ${wrong}) gave ${failed}: ${text}")
  endif()
endforeach()
file(REMOVE_RECURSE "${WORK}")
