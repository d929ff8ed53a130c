// Every function that shades a hair or a pixel, evaluated at one set of inputs: the stability tests run it
// as C++ and, through probe.comp.glsl, on the device, and compare.
#ifndef VELLUS_HAIR_PROBE_GLSL
#define VELLUS_HAIR_PROBE_GLSL
#include "common/portable.glsl"
#include "common/pbr.glsl"
#include "common/tonemap.glsl"
#include "hair/opacity/dither.glsl"
#include "hair/scattering/karis.glsl"
#include "hair/scattering/melanin.glsl"
#include "hair/shadow/pcf_exponential.glsl"
#include "light/sh.glsl"
#include "temporal/taa.glsl"

struct ProbeInput {
    vec3 color;
    float roughness;
    vec3 tangent;
    float specular;
    vec3 to_light;
    float scatter;
    vec3 to_view;
    float shift;
    vec3 history;  // any colour
    float shadow;
    float receiver;
    float occluder;
    float falloff;
    float blend;
};

struct ProbeOutput {
    vec4 value[12];
};

VELLUS_FN HairSurface probe_surface(ProbeInput p) {
    HairSurface s;
    s.base_color = p.color;
    s.specular = p.specular;
    s.roughness = p.roughness;
    s.scatter = p.scatter;
    s.shift = p.shift;
    return s;
}

VELLUS_FN vec3 probe_taa(ProbeInput p) {
    vec3 current = taa_load(p.history);
    TaaBox box = taa_box_start(current);
    taa_box_add(box, taa_load(p.color));
    vec3 history = taa_clamp(box, rgb_to_ycocg(taa_sanitize(p.to_view)));
    return taa_resolve(current, history, p.blend);
}

VELLUS_FN vec3 probe_sh(ProbeInput p, vec3 n) {
    Sh9 sh;
    for (int i = 0; i < 9; ++i) sh.c[i] = p.color * (i == 0 ? 1.0f : 0.4f - 0.1f * float(i));
    return sh_irradiance_over_pi(sh, n);
}

VELLUS_FN ProbeOutput probe(ProbeInput p, uint index) {
    HairSurface s = probe_surface(p);
    HairFrame f = hair_frame(p.tangent, p.to_view);
    PbrSurface pbr;
    pbr.base_color = p.color;
    pbr.metallic = p.specular;
    pbr.roughness = p.roughness;
    DitherStrand strand = dither_strand(index);
    vec4 light = exponential_transmittance(p.receiver, vec4(p.occluder, 0.0f, 1.0f, p.receiver), p.falloff);
    vec4 weights = pcf_gather_weights(pcf_fraction(vec2(p.shadow, p.blend), vec2(1.0f, 1024.0f)));
    float n_v = dot(p.tangent, p.to_view);
    ProbeOutput o;
    o.value[0] = vec4(karis_bsdf(s, f, p.to_light), f.cos_r);
    o.value[1] = vec4(karis_scattering(s, f, p.to_light, p.shadow), dot(f.normal, f.normal));
    o.value[2] = vec4(karis_direct(s, f, p.to_light, p.shadow), p.shadow);
    o.value[3] = vec4(karis_environment(s, f, probe_sh(p, f.normal)), 0.0f);
    o.value[4] = vec4(probe_sh(p, p.to_light), dot(light, weights));
    o.value[5] = light;
    o.value[6] = opaque_visibility(p.receiver, vec4(p.occluder, 0.0f, 1.0f, p.receiver), 0.01f);
    o.value[7] = vec4(probe_taa(p), dither_threshold(strand, uvec2(index & 1023u, index >> 10u), index));
    o.value[8] = vec4(taa_sanitize(p.history), dither_threshold_still(strand, uvec2(index, 7u)));
    o.value[9] = vec4(display_color(p.history, 1.0f), srgb_encode(p.blend));
    o.value[10] = vec4(pbr_direct(pbr, p.tangent, p.to_light, p.to_view), 0.0f);
    o.value[11] = vec4(pbr_environment(pbr, n_v, p.color, p.color), melanin_base_color(p.receiver, p.falloff).x);
    return o;
}

#endif
