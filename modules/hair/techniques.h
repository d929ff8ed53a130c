#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/gpu/shader_table.h"
#include "engine/platform/result.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::hair {

enum class OpacityTechnique : uint8_t { kDither, kDitherStill };
enum class ShadowTechnique : uint8_t { kNone, kPcfExponential, kDeepOpacity };
/// In the order of shaders/hair/scattering/scattering.glsl; add_scattering makes further values.
enum class ScatteringTechnique : uint8_t {
    kKaris,
    kKajiyaKay,
    kMarschner,
    kKarisRational,
    kSeriesGaussian,
    kSeriesA2,
    kSeriesB,
    kSeriesExact,
    kDeon,
};
constexpr uint32_t kScatteringTechniques = 9;
/// In the order of shaders/hair/scattering/scattering.glsl.
enum class MultipleTechnique : uint8_t { kNone, kFakeNormal, kDual };
enum class EnvironmentTechnique : uint8_t { kNone, kSh, kShDepth };

/// How a groom is drawn, one choice on each axis. Component; may change from frame to frame. As
/// made it is Karis's path.
struct HairTechniques {
    OpacityTechnique opacity = OpacityTechnique::kDither;
    ShadowTechnique shadow = ShadowTechnique::kPcfExponential;
    ScatteringTechnique scattering = ScatteringTechnique::kKaris;
    MultipleTechnique multiple = MultipleTechnique::kFakeNormal;
    EnvironmentTechnique environment = EnvironmentTechnique::kSh;
};

/// Adds a technique to the scattering axis, for the whole process; call it before worlds are made
/// and from one thread. `shade` is the stage that draws it, made as ADD_A_TECHNIQUE.md says.
/// Errors: the id is taken, or there are too many.
Result<ScatteringTechnique> add_scattering(std::string_view id, const gpu::EmbeddedShader& shade);
/// The stage of an added technique; null for the module's own.
const gpu::EmbeddedShader* added_stage(ScatteringTechnique technique);

/// The nearest to the path tracer that is still cheap; what files get that choose nothing.
constexpr HairTechniques best_techniques() {
    return {.shadow = ShadowTechnique::kDeepOpacity,
            .scattering = ScatteringTechnique::kSeriesB,
            .multiple = MultipleTechnique::kDual,
            .environment = EnvironmentTechnique::kShDepth};
}

/// The axes in their order, and the ids of the techniques on one of them, in the enum's order.
std::span<const std::string_view> axes();
std::span<const std::string_view> technique_ids(std::string_view axis);

/// Chooses by id, e.g. ("shadow", "none"); errors list what there is.
Result<void> set_technique(HairTechniques& techniques, std::string_view axis, std::string_view id);
/// All ids a scene gives; empty ones leave the default.
Result<void> set_techniques(HairTechniques& techniques, const TechniqueIds& ids);
/// The id of the technique chosen on this axis.
std::string_view technique_id(const HairTechniques& techniques, std::string_view axis);

}  // namespace vellus::hair
