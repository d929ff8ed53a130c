# vellus_embed_shaders(NAME ROOT): every *.comp.glsl, *.vert.glsl and *.frag.glsl below the calling folder becomes
# SPIR-V words in the static library NAME, whose `vellus::gpu::NAME()` (NAME.h) lists them by their
# path below ROOT. They include headers by their path below ROOT or below Vellus's own shaders/
# (VELLUS_SHADER_FOLDER). Part of the installed package: techniques outside the tree use it.
function(vellus_embed_shaders name root)
    cmake_path(ABSOLUTE_PATH root NORMALIZE)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.comp.glsl
        ${CMAKE_CURRENT_SOURCE_DIR}/*.vert.glsl ${CMAKE_CURRENT_SOURCE_DIR}/*.frag.glsl)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name})
    set(generated)
    set(declarations "")
    set(rows "")
    foreach(source IN LISTS sources)
        file(RELATIVE_PATH path ${root} ${source})
        string(MAKE_C_IDENTIFIER ${path} symbol)
        string(REGEX MATCH "\\.(comp|vert|frag)\\.glsl$" _ ${path})
        set(stage ${CMAKE_MATCH_1})
        set(output ${folder}/${path}.h)
        cmake_path(GET output PARENT_PATH output_folder)
        file(MAKE_DIRECTORY ${output_folder})
        add_custom_command(OUTPUT ${output}
            COMMAND ${VELLUS_GLSLANG} --target-env vulkan1.3 --quiet -S ${stage} --vn ${symbol}
                -I${root} -I${VELLUS_SHADER_FOLDER} --depfile ${output}.d -o ${output} ${source}
            DEPENDS ${source} DEPFILE ${output}.d VERBATIM
            COMMENT "GLSL ${path}")
        list(APPEND generated ${output})
        string(APPEND declarations "#include \"${path}.h\"\n")
        string(APPEND rows "    {\"${path}\", ${symbol}},\n")
    endforeach()
    file(CONFIGURE OUTPUT ${folder}/${name}.h @ONLY CONTENT [[
#pragma once

#include "engine/gpu/shader_table.h"

namespace vellus::gpu {

std::span<const EmbeddedShader> @name@();

}  // namespace vellus::gpu
]])
    file(CONFIGURE OUTPUT ${folder}/${name}.cpp @ONLY CONTENT [[
#include "@name@.h"

#include <cstdint>
#include <iterator>

@declarations@
namespace vellus::gpu {

namespace {
constexpr EmbeddedShader kTable[] = {
@rows@    {"", {}},
};
}  // namespace

std::span<const EmbeddedShader> @name@() {
    return std::span(kTable).first(std::size(kTable) - 1);
}

}  // namespace vellus::gpu
]])
    add_library(${name} STATIC ${folder}/${name}.cpp ${generated})
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${folder}>)
endfunction()
