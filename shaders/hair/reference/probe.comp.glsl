#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "common/thread.glsl"
#include "hair/reference/probe.glsl"

// Evaluates probe() for each of `count` inputs.
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) readonly buffer Inputs { ProbeInput at[]; };
layout(buffer_reference, scalar) writeonly buffer Outputs { ProbeOutput at[]; };
layout(push_constant, scalar) uniform Push { Inputs inputs; Outputs outputs; uint count; };

void main() {
    uint i = thread_index();
    if (i < count) outputs.at[i] = probe(inputs.at[i], i);
}
