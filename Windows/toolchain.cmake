# CMake toolchain: Windows on x86-64 by Debian's MinGW-w64 with POSIX threads. Libraries are those of FULLBRIGHT_WINDOWS_DEPS
# alone (Windows/dependencies.sh); nothing of the host's is found.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_AR x86_64-w64-mingw32-gcc-ar-posix)
set(CMAKE_RANLIB x86_64-w64-mingw32-gcc-ranlib-posix)

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FULLBRIGHT_WINDOWS_DEPS)
if(NOT FULLBRIGHT_WINDOWS_DEPS)
  message(FATAL_ERROR "FULLBRIGHT_WINDOWS_DEPS names no folder: call Windows/build.sh, which gives it")
endif()
set(CMAKE_FIND_ROOT_PATH ${FULLBRIGHT_WINDOWS_DEPS} /usr/x86_64-w64-mingw32)
set(CMAKE_PREFIX_PATH ${FULLBRIGHT_WINDOWS_DEPS})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${FULLBRIGHT_WINDOWS_DEPS}/lib/pkgconfig)
set(ENV{PKG_CONFIG_PATH} "")
set(PKG_CONFIG_ARGN --static)  # static libraries name what they need
