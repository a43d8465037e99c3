# Precompiled headers, for builds from nothing (FULLBRIGHT_PCH, which CI sets): what nearly every source includes is parsed
# once for the libraries and once for the tests. Off by default, since a compiler cache then serves less.
option(FULLBRIGHT_PCH "Precompile the headers that most sources include" OFF)

# fb_use_pch(TARGET library|test)
function(fb_use_pch target kind)
  if(NOT FULLBRIGHT_PCH)
    return()
  endif()
  set(pch fb_pch_${kind})
  if(NOT TARGET ${pch})
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${pch}.cpp CONTENT "")
    add_library(${pch} OBJECT ${CMAKE_BINARY_DIR}/${pch}.cpp)
    target_link_libraries(${pch} PRIVATE fb_options fb_base)
    set(headers <algorithm> <array> <functional> <memory> <optional> <span> <string> <string_view> <vector>
                <fmt/format.h> ${CMAKE_SOURCE_DIR}/Quake/base/maths.h)
    if(kind STREQUAL test)
      target_link_libraries(${pch} PRIVATE GTest::gmock)
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    endif()
    target_precompile_headers(${pch} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${pch})
endfunction()
