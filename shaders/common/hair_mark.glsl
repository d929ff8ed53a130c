// What hair leaves in the alpha of the HDR picture, which is 0 or 1 elsewhere: temporal antialiasing treats
// dithered strands apart from surfaces.
#ifndef VELLUS_HAIR_MARK_GLSL
#define VELLUS_HAIR_MARK_GLSL
const float kHairMark = 2.0;
#endif
