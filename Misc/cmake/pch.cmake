# Precompiled headers for the tests, for builds from nothing (FULLBRIGHT_PCH, which CI sets): headers that nearly every test
# includes are parsed once. Off by default, because a compiler cache works less well with them. Not for the libraries:
# with precompiled headers GCC 12 does not recognise system headers, and warns about their code.
option(FULLBRIGHT_PCH "Precompile the headers that most tests include" OFF)

function(fb_use_test_pch target)
  if(NOT FULLBRIGHT_PCH)
    return()
  endif()
  if(NOT TARGET fb_test_pch)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/fb_test_pch.cpp CONTENT "")
    add_library(fb_test_pch OBJECT ${CMAKE_BINARY_DIR}/fb_test_pch.cpp)
    target_link_libraries(fb_test_pch PRIVATE fb_options fb_base GTest::gmock)
    if(FULLBRIGHT_SANITIZE)
      target_compile_options(fb_test_pch PRIVATE -O0)
    endif()
    target_precompile_headers(fb_test_pch PRIVATE <algorithm> <array> <functional> <memory> <optional> <span> <string>
                              <string_view> <vector> <fmt/format.h> <gmock/gmock.h> <gtest/gtest.h>
                              ${CMAKE_SOURCE_DIR}/Quake/base/maths.h)
  endif()
  target_precompile_headers(${target} REUSE_FROM fb_test_pch)
endfunction()
