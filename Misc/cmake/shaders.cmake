# fb_shader(NAME SOURCE [TRACES] [QUICK]) compiles SOURCE with glslang to SPIR-V for Vulkan 1.2 and embeds every variant of it:
# arrays bound or by address (Shaders/lib/arrays.glsl), and, where it TRACES, through ray query as well (by address:
# devices with ray query have addresses). fb_shader_table() then writes compiled_shaders.S, which holds them all, and compiled_shaders.inc, whose
# compiled_shader_table() lists them. No compiler reads them as text: they are 190 MB of it.
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

function(fb_compile_shader out source optimize)
  if(FULLBRIGHT_SHADERS_FROM)
    if(NOT EXISTS ${out})
      message(FATAL_ERROR "FULLBRIGHT_SHADERS_FROM: there is no ${out}: build that folder first")
    endif()
    return()
  endif()
  cmake_parse_arguments(S "" "VARIABLE" "" ${ARGN})
  set(options ${S_UNPARSED_ARGUMENTS})
  list(TRANSFORM options PREPEND -D)
  if(S_VARIABLE)
    list(APPEND options --vn ${S_VARIABLE})
  endif()
  get_filename_component(name ${out} NAME_WE)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${FB_SHADER_LAUNCHER} ${GLSLANG} -V --quiet ${optimize} --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR}/Shaders ${options}
            --depfile ${out}.d -o ${out} ${source}
    DEPFILE ${out}.d
    DEPENDS ${source} ${FB_SHADER_CACHE}
    COMMENT "glslang ${name}" VERBATIM)
endfunction()

function(fb_test_shader name source)
  fb_compile_shader(${FB_SHADER_DIR}/${name}.spv.h ${CMAKE_CURRENT_SOURCE_DIR}/${source} "${FB_SHADER_OPTIMIZE}" VARIABLE ${name}_spv)
endfunction()

function(fb_shader name source)
  cmake_parse_arguments(S "TRACES;QUICK" "" "" ${ARGN})
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  set(others "${FB_SHADER_OPTIMIZE}")
  if(S_QUICK AND FULLBRIGHT_QUICK_SHADERS)
    set(others "")
  endif()
  set(made ${FB_SHADER_DIR}/${name})
  set(codes ${name}_bound ${name}_address)
  fb_compile_shader(${made}_bound.spv ${source} "${FB_SHADER_OPTIMIZE}" INTERSECTOR_QUERY=0 ARRAYS_BY_ADDRESS=0 ${S_UNPARSED_ARGUMENTS})
  fb_compile_shader(${made}_address.spv ${source} "${others}" INTERSECTOR_QUERY=0 ARRAYS_BY_ADDRESS=1 ${S_UNPARSED_ARGUMENTS})
  set(query "{}")
  if(S_TRACES)
    fb_compile_shader(${made}_query.spv ${source} "${others}" INTERSECTOR_QUERY=1 ARRAYS_BY_ADDRESS=1 ${S_UNPARSED_ARGUMENTS})
    list(APPEND codes ${name}_query)
    set(query "FB_CODE(${name}_query)")
  endif()
  foreach(code ${codes})
    set_property(GLOBAL APPEND PROPERTY FB_SHADER_FILES ${FB_SHADER_DIR}/${code}.spv)
    set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_BYTES "code ${code}, \"${FB_SHADER_DIR}/${code}.spv\"\n")
    set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_NAMES "FB_DECLARE_CODE(${code})\n")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY FB_SHADER_ROWS
               "      {\"${name}\", FB_CODE(${name}_bound), FB_CODE(${name}_address), ${query}},\n")
endfunction()

function(fb_shader_table)
  get_property(bytes GLOBAL PROPERTY FB_SHADER_BYTES)
  get_property(names GLOBAL PROPERTY FB_SHADER_NAMES)
  get_property(rows GLOBAL PROPERTY FB_SHADER_ROWS)
  file(CONFIGURE OUTPUT ${FB_SHADER_DIR}/compiled_shaders.S @ONLY CONTENT
"// Written by CMake from Shaders/CMakeLists.txt: the code of every shader of the renderer.
#ifdef __ELF__
  .section .note.GNU-stack, \"\", %progbits
  .section .rodata
#else
  .section .rdata, \"dr\"
#endif
  .macro code name, file
  .balign 4
  .globl fb_code_\\name, fb_code_end_\\name
fb_code_\\name:
  .incbin \"\\file\"
fb_code_end_\\name:
  .endm
@bytes@")
  file(CONFIGURE OUTPUT ${FB_SHADER_DIR}/compiled_shaders.inc @ONLY CONTENT
"// Written by CMake from Shaders/CMakeLists.txt: every shader of the renderer. Include it once.
#include <vector>

#include \"render/passes/shader_code.h\"

#define FB_DECLARE_CODE(name) extern \"C\" const std::uint32_t fb_code_##name[], fb_code_end_##name[];
#define FB_CODE(name) {fb_code_##name, fb_code_end_##name}
@names@
inline const std::vector<fb::render::CompiledShader>& compiled_shader_table() {
  static const std::vector<fb::render::CompiledShader> table{
@rows@  };
  return table;
}
")
endfunction()
