#include "assets/generator/figure_mesh.h"

#include "assets/generator/bust.h"
#include "assets/generator/eyeball.h"
#include "assets/generator/figure.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// Fine at the face, coarser at neck and hair, and fine again at both hands.
Grid skin_grid() {
    constexpr double kHand = 0.0042;
    constexpr double kFace = 0.0023;
    return {
        grid_lines(-0.600, {{-0.440, kHand},
                            {-0.220, 0.0090},
                            {-0.095, 0.0060},
                            {-0.052, 0.0035},
                            {0.052, kFace},
                            {0.095, 0.0035},
                            {0.220, 0.0060},
                            {0.440, 0.0090},
                            {0.600, kHand}}),
        grid_lines(
            0.780,
            {{0.960, kHand}, {1.250, 0.0090}, {1.425, 0.0055}, {1.565, kFace}, {1.680, 0.0055}}),
        grid_lines(-0.090, {{-0.030, 0.0070}, {0.085, 0.0042}, {0.168, kFace}})};
}

Grid even_grid(dvec3 low, dvec3 high, double step) {
    return {grid_lines(low.x, {{high.x, step}}), grid_lines(low.y, {{high.y, step}}),
            grid_lines(low.z, {{high.z, step}})};
}

/// Both eyes as one part.
SkinnedPart eyes() {
    constexpr double kRings[] = {0.0020, 0.0024, 0.0048, 0.0058, 0.0095, 0.0135};
    SkinnedPart part{"eyes", {}, {}, {}, dvec3(1.0), 0.10};
    Influences head;
    head.joints[0] = kHead;
    head.weights[0] = 1.0;
    for (const double side : {1.0, -1.0}) {
        const Eyeball eye =
            make_eyeball(kHeadMiddle + kEyeCenter * dvec3(side, 1.0, 1.0), kEyeRadius, 8, kRings);
        const auto first = static_cast<uint32_t>(part.surface.positions.size());
        for (size_t i = 0; i < eye.colors.size(); ++i) {
            part.surface.positions.push_back(eye.surface.positions[i]);
            part.surface.normals.push_back(eye.surface.normals[i]);
            part.colors.push_back(eye.colors[i]);
            part.influences.push_back(head);
        }
        for (const uint32_t index : eye.surface.indices) {
            part.surface.indices.push_back(first + index);
        }
    }
    return part;
}

}  // namespace

std::vector<PartRecipe> figure_recipes(bool far_away) {
    const size_t divisor = far_away ? 2 : 1;
    std::vector<PartRecipe> recipes;
    const auto add = [&](const char* name, Grid grid, double (*field)(dvec3), dvec3 (*color)(dvec3),
                         size_t triangles, dvec3 base, double roughness) {
        recipes.push_back({name, std::move(grid), field, color, figure_influences,
                           triangles / divisor, base, roughness});
    };
    add("skin", skin_grid(), figure_skin, figure_skin_color, far_away ? 8'000 : 5'200, dvec3(1.0),
        0.55);
    add("shirt", even_grid({-0.330, 0.860, -0.160}, {0.330, 1.430, 0.160}, 0.0085), figure_shirt,
        shirt_shade, 2'300, {0.36, 0.085, 0.060}, 0.9);
    add("trousers", even_grid({-0.220, 0.030, -0.160}, {0.220, 1.020, 0.140}, 0.0090),
        figure_trousers, trousers_shade, 1'900, {0.060, 0.095, 0.180}, 0.9);
    add("shoes", even_grid({-0.150, -0.020, -0.110}, {0.150, 0.120, 0.200}, 0.0055), figure_shoes,
        shoes_shade, 1'300, {0.62, 0.58, 0.52}, 0.7);
    return recipes;
}

std::vector<SkinnedPart> make_figure(bool far_away) {
    std::vector<SkinnedPart> parts;
    for (const PartRecipe& recipe : figure_recipes(far_away)) {
        parts.push_back(sculpt_part(recipe));
    }
    parts.push_back(eyes());
    return parts;
}

}  // namespace vellus::sculpt
