// Skin, cloth and other meshes: glTF 2.0's metallic-roughness material (specification, appendix B).
// Lambert + GGX with Smith's height-correlated masking (Heitz 2014) and Schlick's Fresnel term. Below the
// surface arrives what its reflection left, once on the way in and once out (Shirley et al. 1997), so the
// sum stays below 1; glTF's own 1 - F(v·h) adds up to 1.3 at grazing angles.
#ifndef VELLUS_PBR_GLSL
#define VELLUS_PBR_GLSL
#include "common/portable.glsl"

struct PbrSurface {
    vec3 base_color;  // linear, [0, 1]
    float metallic;   // [0, 1]
    float roughness;  // [0, 1], kept >= 0.089 for punctual lights, which have no size
};

VELLUS_FN vec3 pbr_f0(PbrSurface s) { return mix(vec3(0.04f), s.base_color, s.metallic); }

VELLUS_FN float pbr_fifth_power(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

/// Radiance to the eye per unit irradiance across the beam: BRDF times n·l; 0 below the horizon.
VELLUS_FN vec3 pbr_direct(PbrSurface s, vec3 n, vec3 to_light, vec3 to_view) {
    float n_l = saturate(dot(n, to_light));
    float n_v = max(abs(dot(n, to_view)), 1.0e-4f);
    // The half vector's angle to n from a cross product: 1 - (n·h)² loses the whole lobe to rounding. The
    // 1e-8 widens it where light and eye oppose each other and h has no direction.
    vec3 sum = to_light + to_view;
    vec3 off = cross(n, sum);
    float sum2 = dot(sum, sum);
    float sin2 = min((dot(off, off) + 1.0e-8f) / (sum2 + 1.0e-8f), 1.0f);
    float l_h = min(0.5f * sqrt(sum2), 1.0f);
    float alpha = square(max(s.roughness, 0.089f));
    float a2 = alpha * alpha;
    float d = a2 * kInvPi / square(sin2 + a2 * (1.0f - sin2));
    float g = 0.5f / max(n_l * sqrt(n_v * n_v * (1.0f - a2) + a2) +
                             n_v * sqrt(n_l * n_l * (1.0f - a2) + a2), 1.0e-7f);
    vec3 f0 = pbr_f0(s);
    vec3 fresnel = mix(f0, vec3(1.0f), pbr_fifth_power(1.0f - l_h));
    vec3 into = vec3(1.0f) - mix(f0, vec3(1.0f), pbr_fifth_power(1.0f - n_l));
    vec3 out_of = vec3(1.0f) - mix(f0, vec3(1.0f), pbr_fifth_power(1.0f - min(n_v, 1.0f)));
    vec3 diffuse = into * out_of * s.base_color * ((1.0f - s.metallic) * kInvPi);
    return (diffuse + fresnel * (d * g)) * n_l;
}

/// Radiance to the eye under an environment: `sh_normal` and `sh_reflected` are irradiance/π towards the
/// normal and the reflected view. Specular share by B. Karis's fit, "Physically Based Shading on Mobile", 2014.
VELLUS_FN vec3 pbr_environment(PbrSurface s, float n_dot_v, vec3 sh_normal, vec3 sh_reflected) {
    float n_v = saturate(n_dot_v);
    vec4 r = s.roughness * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * n_v)) * r.x + r.y;
    vec3 specular = clamp(pbr_f0(s) * (r.z - 1.04f * a) + vec3(1.04f * a + r.w), vec3(0.0f), vec3(1.0f));
    vec3 diffuse = (vec3(1.0f) - specular) * s.base_color * (1.0f - s.metallic);
    return diffuse * sh_normal + specular * sh_reflected;
}

#endif
