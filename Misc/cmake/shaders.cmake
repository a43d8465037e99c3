# fb_shader(NAME SOURCE [DEFINES A=1 ...]) compiles SOURCE with glslang to SPIR-V for Vulkan 1.2 and embeds it: the
# generated NAME.spv.h holds `inline constexpr std::uint32_t kNameSpv[]`. Shaders/CMakeLists.txt lists every variant.
find_program(GLSLANG NAMES glslangValidator glslang REQUIRED)
set(FB_SHADER_DIR ${CMAKE_BINARY_DIR}/shaders)
file(MAKE_DIRECTORY ${FB_SHADER_DIR})

function(fb_shader name source)
  cmake_parse_arguments(S "" "" "DEFINES" ${ARGN})
  set(flags)
  foreach(define ${S_DEFINES})
    list(APPEND flags -D${define})
  endforeach()
  set(out ${FB_SHADER_DIR}/${name}.spv.h)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${GLSLANG} -V --quiet --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR}/Shaders ${flags}
            --vn ${name}_spv --depfile ${out}.d -o ${out} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    DEPFILE ${out}.d
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    COMMENT "glslang ${name}" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY FB_SHADER_HEADERS ${out})
endfunction()
