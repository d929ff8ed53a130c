// Points that move, and which guides they follow; mirrored by modules/hair/dynamics/guide_selection.h.
#ifndef VELLUS_HAIR_FOLLOW_GLSL
#define VELLUS_HAIR_FOLLOW_GLSL
#include "hair/geometry/strands.glsl"

struct StrandGuides {
    uvec3 guides;
    vec3 weights;
    vec3 reach;
};
layout(buffer_reference, scalar) readonly buffer Follow { StrandGuides at[]; };
layout(buffer_reference, scalar) buffer Points { vec3 at[]; };

#endif
