// Push constants of the mesh draw; mirrored by MeshPush in modules/character/mesh_data.h. GLSL only.
#ifndef VELLUS_MESH_PUSH_GLSL
#define VELLUS_MESH_PUSH_GLSL
#include "character/mesh_data.glsl"
#include "common/view.glsl"
#include "light/lights.glsl"

layout(buffer_reference, scalar) readonly buffer Texcoords { vec2 at[]; };
layout(buffer_reference, scalar) readonly buffer Colors { vec4 at[]; };

layout(push_constant, scalar) uniform Push {
    SkinnedVertices vertices;
    Texcoords texcoords;  // 0: none
    Colors colors;        // 0: white
    SkinnedCovers covers;
    vec4 base_color;
    vec3 emissive;
    float metallic;
    float roughness;
    float alpha_cutoff;  // 0: opaque; negative: alpha is the share of frames that show the surface
    float back_flip;     // normal's factor where the triangle faces away: -1 if two-sided
    float front_flip;    // and where it faces the eye: -1 if a mirrored two-sided mesh
    float hair_falloff;  // 1/m, extinction of light behind the closest hair
};

layout(set = 0, binding = 2, scalar) uniform Views { View view; };
layout(set = 0, binding = 3, scalar) uniform LightsBlock { LightBlock lights; };

#endif
