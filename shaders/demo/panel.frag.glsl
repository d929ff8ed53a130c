#version 460

// The picture below is sRGB-encoded already, and so are the panels' colours.
layout(set = 0, binding = 0) uniform sampler2D glyphs;

layout(location = 0) in vec2 texcoord;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 out_color;

void main() { out_color = vec4(color.rgb, color.a * texture(glyphs, texcoord).r); }
