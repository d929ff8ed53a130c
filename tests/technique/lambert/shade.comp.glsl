#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lambert/lambert.glsl"
#define VELLUS_HAIR_BSDF(fibre, surface, frame, eye, to_light) lambert_bsdf(surface, frame, to_light)
#include "hair/scattering/shade.glsl"
