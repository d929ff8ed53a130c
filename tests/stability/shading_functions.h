#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace vellus::test {

/// hair::glsl::HairFibre as it lies in memory.
using FibreFloats = std::array<float, 90>;

/// Fitted fibres: of the default index and widths, and of the ends of their ranges.
constexpr size_t kFibres = 4;
FibreFloats fibre_floats(size_t fibre, float roughness, float shift);

/// What any of the shading functions takes; the fields are ProbeInput's.
struct ShadingInput {
    glm::vec3 color, tangent, to_light, to_view, history;
    float roughness, specular, scatter, shift, shadow, receiver, occluder, falloff, blend;
    FibreFloats fibre;
};

/// The functions below by name; the first are the techniques of the scattering axis.
inline constexpr std::array kShadingFunctions = {"karis",
                                                 "kajiya_kay",
                                                 "marschner",
                                                 "karis_rational",
                                                 "series_gaussian",
                                                 "series_a2",
                                                 "series_b",
                                                 "series_exact",
                                                 "deon",
                                                 "dual",
                                                 "fake_normal",
                                                 "direct",
                                                 "environment",
                                                 "exponential",
                                                 "opaque",
                                                 "taa",
                                                 "display",
                                                 "pbr_direct",
                                                 "pbr_environment",
                                                 "sh",
                                                 "melanin"};
constexpr int kDeonFunction = 8;

/// The shaders' own code, compiled as C++ in float and once more with every float a double.
namespace in_float {
glm::vec4 evaluate(int function, const ShadingInput& input);
}
namespace in_double {
glm::dvec4 evaluate(int function, const ShadingInput& input);
}

}  // namespace vellus::test
