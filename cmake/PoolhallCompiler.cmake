# Compiler flags of every target.
#
# -ffp-contract=off is part of the determinism contract (physics/README.md): a fused
# multiply-add rounds once where the source rounds twice.
add_library(poolhall_flags INTERFACE)
target_compile_options(poolhall_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror
  -ffp-contract=off -fno-fast-math
  # Nobody reads errno after a square root; without it the root is one instruction.
  -fno-math-errno
  # libstdc++ 12's own std::stable_sort uses what it calls deprecated; only clang says so.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
  # Physics joins conditions with & where a branch would cost more than both of them.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
# GCC 12 reports a false -Wrestrict in std::string's operator+ (GCC bug 105651).
target_compile_options(poolhall_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

if(CMAKE_UNITY_BUILD)
  # Sources that are compiled as one see each other's names, and none is the main file. Builds of
  # single sources (preset `debug`) keep these warnings.
  target_compile_options(poolhall_flags INTERFACE -Wno-shadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(POOLHALL_SANITIZE_ADDRESS)
  # Four checks that double the time to compile are the fuzzers' alone (clang, preset fuzz): where
  # they would speak of a null pointer, ASan ends the program as well.
  # GCC 12 reports false -Wmaybe-uninitialized positives in sanitized code.
  # At fixed addresses a program of 100 MB starts in three quarters of the time, and hundreds do.
  add_compile_options(-fsanitize=address,undefined
    -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all
    -fno-omit-frame-pointer -fno-pie -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined -no-pie)
endif()
if(POOLHALL_SANITIZE_THREAD)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -Wno-tsan)
  add_link_options(-fsanitize=thread)
endif()
if(POOLHALL_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(POOLHALL_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,undefined -fno-sanitize-recover=all
    -D_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=undefined)
endif()

# Sanitized code is compiled as it stands (-O0), for the tests have to end in time, and so do those
# of what computes: this is for such rooms.
function(poolhall_computes target)
  if(CMAKE_CXX_FLAGS_RELWITHDEBINFO MATCHES "-O0")
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
  endif()
endfunction()

# Nobody waits for this code; -O1 takes two thirds of the time to compile, or half.
# GCC 12 reports false -Wmaybe-uninitialized positives there.
function(poolhall_need_not_be_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endfunction()
