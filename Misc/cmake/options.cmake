# Compile options that every module shares.
add_library(fb_options INTERFACE)
target_compile_options(fb_options INTERFACE -Wall -Wextra)
if(FULLBRIGHT_WERROR)
  target_compile_options(fb_options INTERFACE -Werror)
endif()
target_include_directories(fb_options INTERFACE ${CMAKE_SOURCE_DIR}/Quake ${CMAKE_SOURCE_DIR}/Shaders)
# The same bits from every x86-64 and arm64 compiler: no implicit contraction of a*b+c to fused multiply-add.
target_compile_options(fb_options INTERFACE -ffp-contract=off)
if(FULLBRIGHT_SANITIZE)
  target_compile_options(fb_options INTERFACE -fsanitize=${FULLBRIGHT_SANITIZE} -fno-omit-frame-pointer
                                              -fno-sanitize-recover=undefined)
  target_link_options(fb_options INTERFACE -fsanitize=${FULLBRIGHT_SANITIZE})
  # A fifth of the time to link; programs are larger than elsewhere.
  find_program(FULLBRIGHT_LLD ld.lld)
  if(FULLBRIGHT_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_link_options(fb_options INTERFACE -fuse-ld=lld)
  endif()
endif()
if(FULLBRIGHT_FUZZERS)
  target_compile_options(fb_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
