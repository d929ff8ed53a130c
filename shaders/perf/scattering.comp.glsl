#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "common/thread.glsl"
#include "hair/scattering/scattering.glsl"

// Single scattering alone: each thread has one fibre and eye and turns a light around them.
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kScattering = 0;
layout(buffer_reference, scalar) writeonly buffer Sums { float at[]; };
layout(push_constant, scalar) uniform Push {
    Sums sums;
    uint count;
    uint lights;
    vec3 color;
    float roughness;
    float shift;
};
layout(binding = 0, scalar) uniform Fibre { HairFibre fibre; };

vec3 direction(uint seed) {
    float z = 2.0 * unit_float(hash_uint(seed)) - 1.0;
    float azimuth = 6.2831853 * unit_float(hash_uint(seed ^ 0x9e3779b9u));
    return vec3(sqrt(1.0 - z * z) * vec2(cos(azimuth), sin(azimuth)), z);
}

void main() {
    uint i = thread_index();
    if (i >= count) return;
    HairSurface surface = HairSurface(color, 0.5, roughness, 1.0, shift);
    HairFrame frame = hair_frame(direction(3u * i), direction(3u * i + 1u));
    // Once for all lights, as where a pixel's lights are unrolled.
    HairFibre shared_fibre = fibre;
    HairEye eye = hair_eye(shared_fibre, frame);
    vec3 to_light = direction(3u * i + 2u);
    vec3 sum = vec3(0.0);
    for (uint light = 0u; light < lights; ++light) {
        // A turn by 137.5 degrees about an axis askew to everything.
        to_light = vec3(dot(to_light, vec3(-0.48577, -0.11152, 0.86695)),
                        dot(to_light, vec3(0.86695, -0.17377, 0.46306)),
                        dot(to_light, vec3(0.09901, 0.97849, 0.18129)));
        sum += hair_bsdf(kScattering, shared_fibre, surface, frame, eye, to_light);
    }
    sums.at[i] = sum.x + sum.y + sum.z;
}
