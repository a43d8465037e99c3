# fb_module(NAME SOURCES a.cpp ... [LINKS fb_base ...] [PRIVATE_LINKS ...] [TESTS a_test.cpp ...] [TEST_LINKS ...]
#           [BENCHMARKS b.cpp ...] [BENCHMARK_LINKS ...] [FUZZERS fuzz_x.cpp ...])
# makes the library fb_NAME, the test program NAME_test, the benchmark NAME_bench and one fuzzer for each file.
#
# The test program runs as test NAME, without what tests of their own with a label run:
#   statistical: NAME_statistical. Hypothesis tests over many frames, whose host code other tests run, too: files
#     x_statistics_test.cpp, whose suites end in Statistics (Misc/check_text.py holds each to the other). A sanitized build
#     leaves these files out unless FULLBRIGHT_ALL_TESTS is set.
#   intersector: NAME_intersector, which runs INTERSECTOR, a filter of GoogleTest ("A*:B*"). What another driver may do
#     otherwise; "*" labels the whole program, else label repeats, too: the host code is run by NAME already.
#   sequences: NAME_sequences. Tests that compile many shaders, draw many frames or calculate for long, whose host code others
#     run: suites whose names end in Sequences; label repeats, too.
# Each of these, and NAME itself (label drawn) where there are SHARDS, runs in a build without sanitizers where the sources of the module
# and of those that it links changed (Misc/unless_passed.py).
#
# SHARDS n: each of these in n parts, which may run side by side.
# COST n: about how many seconds the longest of them take on two cores under the sanitizers; ctest begins with those, so
# that none is left running alone at the end.
#
# FULLBRIGHT_TESTED: modules whose test programs are built; empty: all. CI's release build leaves those to its sanitized one
# that neither draw nor depend on the optimizer.
option(FULLBRIGHT_ALL_TESTS "Build the statistical tests under the sanitizers, too" OFF)
set(FULLBRIGHT_TESTED "" CACHE STRING "Modules whose test programs are built; empty: all")
set(FB_STATISTICAL_SUITES "*Statistics.*:*Statistics/*")
set(FB_SEQUENCE_SUITES "*Sequences.*")

# Whether one of these files has a suite whose name ends in Sequences.
function(fb_has_sequences result)
  set(${result} FALSE PARENT_SCOPE)
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${file} suites REGEX "^TEST(_F)?\\([A-Za-z0-9]*Sequences," LIMIT_COUNT 1)
    if(suites)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The folders of a module and of all modules that it links.
function(fb_folders_of result)
  set(folders)
  set(waiting ${ARGN})
  while(waiting)
    list(POP_FRONT waiting target)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" target ${target})
    if(NOT target MATCHES "^fb_" OR NOT TARGET ${target})
      continue()
    endif()
    get_target_property(folder ${target} SOURCE_DIR)
    if(folder IN_LIST folders OR folder STREQUAL CMAKE_SOURCE_DIR)
      continue()
    endif()
    list(APPEND folders ${folder})
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(links ${target} ${property})
      if(links)
        list(APPEND waiting ${links})
      endif()
    endforeach()
  endwhile()
  set(${result} ${folders} PARENT_SCOPE)
endfunction()

# The words before a test's command that leave it out where it is known to pass: of what folders it is a function, and which
# tests in them count.
function(fb_unless_passed result name tests)
  set(${result} "" PARENT_SCOPE)
  if(FULLBRIGHT_SANITIZE OR NOT Python3_FOUND)
    return()
  endif()
  execute_process(COMMAND ${GLSLANG} --version OUTPUT_VARIABLE glslang ERROR_QUIET)
  string(REGEX MATCH "[^\n]*" glslang "${glslang}")
  set(tools "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE}, ${glslang} ${FB_SHADER_OPTIMIZE}")
  set(${result} ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/Misc/unless_passed.py ${name} --stamps ${CMAKE_BINARY_DIR}/passed --tests ${tests}
      --tools ${tools} --device $<TARGET_FILE:fullbright> --of ${ARGN} -- PARENT_SCOPE)
endfunction()

# The same for a test of whole programs, which is a function of all sources.
macro(fb_whole_unless_passed result name)
  fb_unless_passed(${result} ${name} none ${CMAKE_SOURCE_DIR}/CMakeLists.txt ${CMAKE_SOURCE_DIR}/Quake ${CMAKE_SOURCE_DIR}/Shaders
                   ${CMAKE_SOURCE_DIR}/Linux ${CMAKE_SOURCE_DIR}/Misc/basegame ${CMAKE_SOURCE_DIR}/Misc/cmake ${CMAKE_SOURCE_DIR}/Misc/python
                   ${CMAKE_SOURCE_DIR}/testdemos ${ARGN})
endmacro()

function(fb_add_gtest name program filter label shards cost)
  foreach(shard RANGE 1 ${shards})
    set(test ${name})
    if(shards GREATER 1)
      string(APPEND test _${shard})
    endif()
    math(EXPR index "${shard} - 1")
    set(unless_passed)
    if(label MATCHES "statistical")
      fb_unless_passed(unless_passed ${test} *_statistics_test.cpp ${ARGN})
    elseif(ARGN)
      fb_unless_passed(unless_passed ${test} *_test.cpp ${ARGN})
    endif()
    add_test(NAME ${test} COMMAND ${unless_passed} $<TARGET_FILE:${program}> WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
    set_tests_properties(${test} PROPERTIES LABELS "${label}" COST ${cost})
    if(NOT filter STREQUAL "*")
      set_tests_properties(${test} PROPERTIES ENVIRONMENT
        "GTEST_FILTER=${filter};GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
    endif()
  endforeach()
endfunction()

function(fb_module name)
  cmake_parse_arguments(M "" "INTERSECTOR;SHARDS;COST" "SOURCES;LINKS;PRIVATE_LINKS;TESTS;TEST_LINKS;BENCHMARKS;BENCHMARK_LINKS;FUZZERS" ${ARGN})
  if(M_SOURCES)
    add_library(fb_${name} STATIC ${M_SOURCES})
    target_link_libraries(fb_${name} PUBLIC fb_options ${M_LINKS} PRIVATE ${M_PRIVATE_LINKS})
  else()
    add_library(fb_${name} INTERFACE)
    target_link_libraries(fb_${name} INTERFACE fb_options ${M_LINKS})
  endif()
  if(M_TESTS AND FULLBRIGHT_TESTS AND (NOT FULLBRIGHT_TESTED OR name IN_LIST FULLBRIGHT_TESTED))
    set(statistical ${M_TESTS})
    list(FILTER statistical INCLUDE REGEX "_statistics_test\\.cpp$")
    if(statistical AND FULLBRIGHT_SANITIZE AND NOT FULLBRIGHT_ALL_TESTS)
      list(REMOVE_ITEM M_TESTS ${statistical})
      set(statistical)
    endif()
    add_executable(${name}_test ${M_TESTS})
    target_link_libraries(${name}_test PRIVATE fb_${name} ${M_TEST_LINKS} GTest::gmock GTest::gtest_main)
    fb_quick_test(${name}_test fb_${name} ${M_LINKS} ${M_PRIVATE_LINKS})
    if(NOT M_SHARDS)
      set(M_SHARDS 1)
    endif()
    if(NOT M_COST)
      set(M_COST 0)
    endif()
    fb_folders_of(folders fb_${name} ${M_TEST_LINKS})
    list(APPEND folders ${CMAKE_SOURCE_DIR}/Shaders ${CMAKE_SOURCE_DIR}/Misc/cmake)
    list(REMOVE_DUPLICATES folders)
    set(filter "*")
    set(label "")
    if(statistical)
      list(APPEND moved "${FB_STATISTICAL_SUITES}")
      fb_add_gtest(${name}_statistical ${name}_test "${FB_STATISTICAL_SUITES}" statistical ${M_SHARDS} ${M_COST} ${folders})
    endif()
    if(M_INTERSECTOR STREQUAL "*")
      set(label intersector)
    elseif(M_INTERSECTOR)
      list(APPEND moved "${M_INTERSECTOR}")
      fb_add_gtest(${name}_intersector ${name}_test "${M_INTERSECTOR}" "intersector;repeats" ${M_SHARDS} ${M_COST} ${folders})
    endif()
    fb_has_sequences(sequences ${M_TESTS})
    if(sequences)
      list(APPEND moved "${FB_SEQUENCE_SUITES}")
      fb_add_gtest(${name}_sequences ${name}_test "${FB_SEQUENCE_SUITES}" "sequences;repeats" 1 ${M_COST} ${folders})
    endif()
    if(moved)
      string(JOIN ":" moved ${moved})
      set(filter "-${moved}")
    endif()
    if(M_SHARDS EQUAL 1)
      set(folders)
    else()
      set(label drawn)
      list(APPEND folders ${CMAKE_SOURCE_DIR}/testdemos/suites ${CMAKE_SOURCE_DIR}/testdemos/fight.dem ${CMAKE_SOURCE_DIR}/testdemos/hub.dem)
    endif()
    fb_add_gtest(${name} ${name}_test "${filter}" "${label}" 1 ${M_COST} ${folders})
  endif()
  if(M_BENCHMARKS AND FULLBRIGHT_BENCHMARKS AND benchmark_FOUND)
    add_executable(${name}_bench ${M_BENCHMARKS})
    target_link_libraries(${name}_bench PRIVATE fb_${name} ${M_BENCHMARK_LINKS} benchmark::benchmark_main)
  endif()
  if(FULLBRIGHT_FUZZERS)
    foreach(source ${M_FUZZERS})
      get_filename_component(target ${source} NAME_WE)
      add_executable(${target} ${source})
      target_link_libraries(${target} PRIVATE fb_${name} ${M_TEST_LINKS})
      target_link_options(${target} PRIVATE -fsanitize=fuzzer)
    endforeach()
  endif()
endfunction()
