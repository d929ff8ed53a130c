#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Hair as bright as the light that arrives there, in a colour that nothing else has: no green.
#define VELLUS_HAIR_BSDF(fibre, surface, frame, eye, to_light) vec3(1.0, 0.0, 1.0)
#include "hair/scattering/shade.glsl"
