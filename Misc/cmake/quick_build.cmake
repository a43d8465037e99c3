# For builds from nothing (FULLBRIGHT_QUICK_BUILD, which CI sets): half the time. Sources are compiled in groups, tests with
# the headers that nearly all of them include precompiled and with little optimisation. Off by default: a change to one
# file compiles a group anew, and a compiler cache finds less.
#
# Precompiled headers are not for the libraries: with them GCC 12 does not recognise system headers, and warns about their
# code; clang under the sanitizers gains nothing.
option(FULLBRIGHT_QUICK_BUILD "Compile sources in groups, with precompiled headers for the tests" OFF)

if(FULLBRIGHT_QUICK_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
  # A class that is private to its file may hold what is private to it, too.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# Files whose private names are those of another file of their target: they are compiled alone.
function(fb_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Tests that calculate for long by their own text: optimised under the sanitizers too, where other tests are not.
function(fb_optimised_tests)
  if(FULLBRIGHT_SANITIZE)
    fb_compile_alone(${ARGN})
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# Programs that calculate little by their own text.
function(fb_quick_program target)
  set_target_properties(${target} PROPERTIES FB_UNFUZZED ON)
  if(FULLBRIGHT_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  elseif(FULLBRIGHT_QUICK_BUILD)
    target_compile_options(${target} PRIVATE -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
  endif()
endfunction()

# The libraries come first on the linker's line: of an inline function that both compiled, theirs is taken, the optimised one.
function(fb_link_optimised target)
  foreach(library ${ARGN})
    if(TARGET ${library})
      get_target_property(type ${library} TYPE)
      if(type STREQUAL STATIC_LIBRARY)
        list(APPEND archives $<TARGET_FILE:${library}>)
      endif()
    endif()
  endforeach()
  if(archives)
    target_link_options(${target} PRIVATE -Wl,--whole-archive ${archives} -Wl,--no-whole-archive)
  endif()
endfunction()

# fb_quick_test(TARGET LIBRARIES...): compiles a test with little optimisation, but runs the libraries' own code as compiled.
function(fb_quick_test target)
  set_target_properties(${target} PROPERTIES FB_TEST_TEXT ON FB_UNFUZZED ON)
  if(FULLBRIGHT_SANITIZE)
    set(options -O0)
  else()
    set(options -O1)
  endif()
  if(FULLBRIGHT_SANITIZE OR FULLBRIGHT_QUICK_BUILD)
    # With little optimisation GCC 12 sees std::string copy beyond its own buffer.
    target_compile_options(${target} PRIVATE ${options} $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
    fb_link_optimised(${target} ${ARGN})
  endif()
  if(FULLBRIGHT_QUICK_BUILD)
    if(NOT TARGET fb_test_pch)
      file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/fb_test_pch.cpp CONTENT "")
      add_library(fb_test_pch OBJECT ${CMAKE_BINARY_DIR}/fb_test_pch.cpp)
      target_link_libraries(fb_test_pch PRIVATE fb_options fb_base GTest::gmock)
      target_compile_options(fb_test_pch PRIVATE ${options})
      set_target_properties(fb_test_pch PROPERTIES FB_TEST_TEXT ON FB_UNFUZZED ON)
      target_precompile_headers(fb_test_pch PRIVATE <algorithm> <array> <functional> <memory> <optional> <span> <string>
                                <string_view> <vector> <fmt/format.h> <gmock/gmock.h> <gtest/gtest.h>
                                ${CMAKE_SOURCE_DIR}/Quake/base/maths.h)
    endif()
    target_precompile_headers(${target} REUSE_FROM fb_test_pch)
  endif()
endfunction()
