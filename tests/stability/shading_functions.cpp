#include "tests/stability/shading_functions.h"

// Compiled twice: as it stands, and with every float turned into a double (to_double.sed), it and
// the shaders' headers. What the two disagree on is rounding.
namespace vellus::test::in_float {

namespace {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL has no other vocabulary
#include "common/pbr.glsl"
#include "common/tonemap.glsl"
#include "hair/scattering/melanin.glsl"
#include "hair/scattering/scattering.glsl"
#include "hair/shadow/pcf_exponential.glsl"
#include "light/sh.glsl"
#include "temporal/taa.glsl"

HairFibre fibre_of(const ShadingInput& p) {
    static_assert(sizeof(HairFibre) == sizeof(float) * std::tuple_size_v<decltype(p.fibre)>);
    HairFibre fibre;
    auto* out = reinterpret_cast<float*>(&fibre);
    for (size_t i = 0; i < p.fibre.size(); ++i) out[i] = p.fibre[i];
    return fibre;
}

HairSurface surface_of(const ShadingInput& p) {
    return {vec3(p.color), p.specular, p.roughness, p.scatter, p.shift};
}

vec3 hair(int function, const ShadingInput& p) {
    const HairSurface s = surface_of(p);
    const HairFrame f = hair_frame(vec3(p.tangent), vec3(p.to_view));
    const vec3 to_light(p.to_light);
    const HairFibre fibre = fibre_of(p);
    const HairEye eye = hair_eye(fibre, f);
    if (function < kScatteringCount) return hair_bsdf(function, fibre, s, f, eye, to_light);
    if (function == 9) {
        // As many fibres behind as another field of [0, 1] says.
        return dual_scattering(fibre, s, f, eye, to_light, p.shadow, kDualMostFibres * p.blend);
    }
    if (function == 10) return karis_scattering(s, f, to_light, p.shadow);
    return karis_direct(s, f, to_light, p.shadow);
}

vec3 sh(const ShadingInput& p, const vec3& n) {
    Sh9 coefficients;
    for (int i = 0; i < 9; ++i) {
        coefficients.c[i] = vec3(p.color) * (i == 0 ? 1.0f : 0.4f - 0.1f * float(i));
    }
    return sh_irradiance_over_pi(coefficients, n);
}

vec3 environment(const ShadingInput& p) {
    const HairFrame f = hair_frame(vec3(p.tangent), vec3(p.to_view));
    return karis_environment(surface_of(p), f, sh(p, f.normal));
}

vec3 taa(const ShadingInput& p) {
    const vec3 current = taa_load(vec3(p.history));
    TaaBox box = taa_box_start(current);
    taa_box_add(box, taa_load(vec3(p.color)));
    const vec3 history = taa_clamp(box, rgb_to_ycocg(taa_sanitize(vec3(p.to_view))));
    return taa_resolve(current, history, p.blend);
}

PbrSurface pbr(const ShadingInput& p) {
    return {vec3(p.color), p.specular, p.roughness};
}

}  // namespace

vec4 evaluate(int function, const ShadingInput& p) {
    const vec4 occluders(p.occluder, 0.0f, 1.0f, p.receiver);
    switch (function) {
        case 12:
            return {environment(p), 0.0f};
        case 13:
            return exponential_transmittance(p.receiver, occluders, p.falloff);
        case 14:
            return opaque_visibility(p.receiver, occluders, 0.01f);
        case 15:
            return {taa(p), 0.0f};
        case 16:
            return {display_color(vec3(p.history), 1.0f), srgb_encode(p.blend)};
        case 17:
            return {pbr_direct(pbr(p), vec3(p.tangent), vec3(p.to_light), vec3(p.to_view)), 0.0f};
        case 18:
            return {pbr_environment(pbr(p), dot(vec3(p.tangent), vec3(p.to_view)), vec3(p.color),
                                    vec3(p.color)),
                    0.0f};
        case 19:
            return {sh(p, vec3(p.to_light)), 0.0f};
        case 20:
            return {melanin_base_color(p.receiver, p.falloff), 0.0f};
        default:
            return {hair(function, p), 0.0f};
    }
}

}  // namespace vellus::test::in_float
