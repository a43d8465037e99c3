# fb_shader(NAME SOURCE [TRACES] [QUICK]) compiles SOURCE with glslang to SPIR-V for Vulkan 1.2 and embeds every variant of it:
# arrays bound or by address (Shaders/lib/arrays.glsl), and, where it TRACES, through ray query as well (by address:
# devices with ray query have addresses). fb_shader_table(FILE) then writes a header whose kCompiledShaders lists all.
# Of QUICK ones a build with FULLBRIGHT_QUICK_SHADERS optimises the first variant alone.
#
# compile_shader.py takes what is compiled already from a cache (FULLBRIGHT_SHADER_CACHE); without Python all is compiled.
#
# fb_test_shader(NAME SOURCE) embeds one variant as NAME.spv.h with `NAME_spv`.
find_program(GLSLANG NAMES glslangValidator glslang REQUIRED)
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND)
  set(FB_SHADER_CACHE ${CMAKE_SOURCE_DIR}/Misc/cmake/compile_shader.py)
  # What stands first in the PATH may be a script that looks for the interpreter, which takes longer than this one.
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sys; print(sys.executable)" OUTPUT_VARIABLE python
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(FB_SHADER_LAUNCHER ${python} -I -S ${FB_SHADER_CACHE})
endif()
# FULLBRIGHT_SHADERS_FROM=FOLDER: another build folder of the same sources, whose compiled shaders are taken as they are, and
# never compiled anew (CI's second build).
#
# FULLBRIGHT_QUICK_SHADERS (CI's builds): variants that no test of it draws with are compiled, but left as they are written. That is a sixth of
# a build from nothing, and what each new technique adds most of.
option(FULLBRIGHT_QUICK_SHADERS "Optimise those variants of shaders alone that Debian 12's lavapipe takes" OFF)
# FULLBRIGHT_RAW_SHADERS leaves glslang's optimizer out: drivers then see the shaders as they are written (Misc/docs/building.md).
option(FULLBRIGHT_RAW_SHADERS "Compile shaders without glslang's optimizer" OFF)
set(FULLBRIGHT_SHADERS_FROM "" CACHE PATH "build folder of the same sources whose compiled shaders are taken as they are")
if(FULLBRIGHT_SHADERS_FROM)
  set(FB_SHADER_DIR ${FULLBRIGHT_SHADERS_FROM}/shaders)
else()
  set(FB_SHADER_DIR ${CMAKE_BINARY_DIR}/shaders)
  file(MAKE_DIRECTORY ${FB_SHADER_DIR})

  # Drivers inline every function of a shader before they leave out what is never reached, for each pipeline anew; lavapipe
  # takes four times as long over it as where glslang has done so. A glslang may be built without its optimizer.
  file(WRITE ${FB_SHADER_DIR}/nothing.comp "#version 460\nvoid main() {}\n")
  execute_process(COMMAND ${GLSLANG} -V --quiet -Os -o ${FB_SHADER_DIR}/nothing.spv ${FB_SHADER_DIR}/nothing.comp
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(FULLBRIGHT_RAW_SHADERS)
    message(STATUS "shaders are compiled without glslang's optimizer")
  elseif(failed)
    message(STATUS "${GLSLANG} has no optimizer: the first picture will take longer on lavapipe")
  else()
    set(FB_SHADER_OPTIMIZE -Os)
  endif()
endif()

function(fb_compile_shader name source optimize)
  set(out ${FB_SHADER_DIR}/${name}.spv.h)
  if(FULLBRIGHT_SHADERS_FROM)
    if(NOT EXISTS ${out})
      message(FATAL_ERROR "FULLBRIGHT_SHADERS_FROM: there is no ${out}: build that folder first")
    endif()
    return()
  endif()
  list(TRANSFORM ARGN PREPEND -D)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${FB_SHADER_LAUNCHER} ${GLSLANG} -V --quiet ${optimize} --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR}/Shaders ${ARGN}
            --vn ${name}_spv --depfile ${out}.d -o ${out} ${source}
    DEPFILE ${out}.d
    DEPENDS ${source} ${FB_SHADER_CACHE}
    COMMENT "glslang ${name}" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY FB_SHADER_HEADERS ${out})
endfunction()

function(fb_test_shader name source)
  fb_compile_shader(${name} ${CMAKE_CURRENT_SOURCE_DIR}/${source} "${FB_SHADER_OPTIMIZE}")
endfunction()

function(fb_shader name source)
  cmake_parse_arguments(S "TRACES;QUICK" "" "" ${ARGN})
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  set(others "${FB_SHADER_OPTIMIZE}")
  if(S_QUICK AND FULLBRIGHT_QUICK_SHADERS)
    set(others "")
  endif()
  fb_compile_shader(${name}_bound ${source} "${FB_SHADER_OPTIMIZE}" INTERSECTOR_QUERY=0 ARRAYS_BY_ADDRESS=0 ${S_UNPARSED_ARGUMENTS})
  fb_compile_shader(${name}_address ${source} "${others}" INTERSECTOR_QUERY=0 ARRAYS_BY_ADDRESS=1 ${S_UNPARSED_ARGUMENTS})
  set(query "{}")
  if(S_TRACES)
    fb_compile_shader(${name}_query ${source} "${others}" INTERSECTOR_QUERY=1 ARRAYS_BY_ADDRESS=1 ${S_UNPARSED_ARGUMENTS})
    set(query ${name}_query_spv)
    set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_INCLUDES "#include \"${name}_query.spv.h\"\n")
  endif()
  set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_INCLUDES
               "#include \"${name}_address.spv.h\"\n#include \"${name}_bound.spv.h\"\n")
  set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_ROWS
               "    fb::render::CompiledShader{\"${name}\", ${name}_bound_spv, ${name}_address_spv, ${query}},\n")
endfunction()

function(fb_shader_table file)
  get_property(includes GLOBAL PROPERTY FB_SHADER_INCLUDES)
  get_property(rows GLOBAL PROPERTY FB_SHADER_ROWS)
  file(CONFIGURE OUTPUT ${FB_SHADER_DIR}/${file} @ONLY CONTENT
"// Written by CMake from Shaders/CMakeLists.txt: every shader of the renderer. Include it once.
#include <array>

#include \"render/passes/shader_code.h\"

@includes@
inline const std::array kCompiledShaders{
@rows@};
")
endfunction()
