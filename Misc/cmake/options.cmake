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
  # Half of a sanitized build is the tests' own text: there, without the checks that are a third of it. A null pointer ends
  # a test as an access of address 0, too. These options must follow -fsanitize, which else has the last word; what a
  # target itself asks for comes before it.
  target_compile_options(fb_options INTERFACE
    $<$<BOOL:$<TARGET_PROPERTY:FB_TEST_TEXT>>:-fno-sanitize=null,alignment,vptr,pointer-overflow>)
  target_link_options(fb_options INTERFACE -fsanitize=${FULLBRIGHT_SANITIZE})
  # A fifth of the time to link; programs are larger than elsewhere.
  find_program(FULLBRIGHT_LLD ld.lld)
  if(FULLBRIGHT_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_link_options(fb_options INTERFACE -fuse-ld=lld)
  endif()
endif()
if(FULLBRIGHT_FUZZERS)
  # What no fuzzer links counts no coverage: that is a fifth of the time in tests, a tenth in libraries.
  target_compile_options(fb_options INTERFACE $<$<NOT:$<BOOL:$<TARGET_PROPERTY:FB_UNFUZZED>>>:-fsanitize=fuzzer-no-link>)
endif()
# Sources that say alike what each system says in its own words: x_posix.cpp, x_windows.cpp.
if(WIN32)
  set(FB_SYSTEM windows)
  # What Linux gives: 8 MiB of stack, and libraries that the programs bring along.
  target_link_options(fb_options INTERFACE -static -Wl,--stack,8388608)
  # Quake/base/narrow_text_windows.cpp comes before the C library.
  target_link_options(fb_options INTERFACE -Wl,-u,mbrtowc -Wl,-u,mbsrtowcs -Wl,-u,mbrlen)
  target_compile_definitions(fb_options INTERFACE NOMINMAX UNICODE WIN32_LEAN_AND_MEAN)
else()
  set(FB_SYSTEM posix)
endif()
