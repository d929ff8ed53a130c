#version 460
#extension GL_EXT_scalar_block_layout : require

layout(binding = 0) uniform sampler2D image;
layout(push_constant, scalar) uniform Push { float depth; float brightness; };
layout(location = 0) out vec4 color;

void main() { color = brightness * texelFetch(image, ivec2(gl_FragCoord.xy), 0); }
