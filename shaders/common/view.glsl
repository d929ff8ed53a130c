// What every pass knows about the picture being made. Positions "rel" are world positions minus the
// position of the current camera, in metres. Depth is reversed: near = 1, infinitely far = 0.
// Pixel (0, 0) is the top left one, its centre at (0.5, 0.5). C++: modules/scene/view.h.
#ifndef VELLUS_COMMON_VIEW_GLSL
#define VELLUS_COMMON_VIEW_GLSL

#include "common/portable.glsl"

struct View {
    mat4 view_projection;             // rel -> clip, jittered: what is rasterised
    mat4 view_projection_unjittered;  // rel -> clip: for velocity
    mat4 previous_view_projection;    // rel (to the *current* camera) -> last frame's clip, unjittered
    vec3 right;                       // the camera's axes in the world
    vec3 up;
    vec3 forward;
    vec2 tan_half_fov;    // horizontal, vertical
    vec3 camera_delta;    // current minus previous camera position, metres
    vec2 jitter;          // pixels, right and down; in (-0.5, 0.5)
    uvec2 size;           // pixels
    float near_plane;     // metres
    float pixel_angle;    // width of a pixel at 1 m distance, metres
    float exposure;       // factor on linear radiance before the tone map
    uint frame_index;
    uint seed;
    uint cut;             // 1: last frame's pictures are of no use (first frame, camera cut)
};

/// Metres along `forward` of a reversed depth; infinite for 0.
VELLUS_FN float view_distance(View view, float depth) { return view.near_plane / depth; }

/// Direction through a jittered pixel position, its component along `forward` being 1.
VELLUS_FN vec3 view_ray(View view, vec2 pixel) {
    vec2 ndc = 2.0f * (pixel - view.jitter) / vec2(view.size) - 1.0f;
    return view.forward + view.right * (ndc.x * view.tan_half_fov.x) -
           view.up * (ndc.y * view.tan_half_fov.y);
}

/// Position relative to the camera of a pixel with this depth (> 0).
VELLUS_FN vec3 view_position(View view, vec2 pixel, float depth) {
    return view_ray(view, pixel) * view_distance(view, depth);
}

/// How far a point moved on the picture since last frame, in pixels, right and down. Takes
/// unjittered clip positions.
VELLUS_FN vec2 view_velocity(View view, vec4 clip, vec4 previous_clip) {
    vec2 now = vec2(clip.x, clip.y) / clip.w;
    vec2 before = vec2(previous_clip.x, previous_clip.y) / previous_clip.w;
    return (now - before) * 0.5f * vec2(view.size);
}

#endif
