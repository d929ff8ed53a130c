#include "modules/hair/environment/mesh_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/platform/jobs.h"
#include "modules/hair/environment/ambient.h"

namespace vellus::hair {

namespace {

constexpr size_t kDirections = 64;
constexpr float kLight = 0.3f;  // what hair of light colour takes of a beam by optical depth
constexpr float kAbove = 1.2f;  // cells from a vertex to where rays begin to look for other skin

/// Spread over the sphere by a Fibonacci lattice: the same for all vertices, so that neighbours
/// differ by what is around them alone.
std::array<glm::vec3, kDirections> directions() {
    std::array<glm::vec3, kDirections> all;
    for (size_t i = 0; i < kDirections; ++i) {
        const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / kDirections;
        const float turn = 2.39996323f * static_cast<float>(i);
        const float r = std::sqrt(1.0f - z * z);
        all[i] = {r * std::cos(turn), r * std::sin(turn), z};
    }
    return all;
}

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : glm::vec3(0.0f);
}

/// A direction above the surface, or what lies along it.
struct Ray {
    glm::vec3 direction;
    float cosine;
    float depth;
};

/// One vertex after the other, with room for its rays.
class Looker {
  public:
    explicit Looker(std::span<const CoveringGroom> grooms)
        : grooms_(grooms), amounts_(grooms.size()) {}

    SkyAtVertex at(const glm::vec3& p, const glm::vec3& normal) {
        const glm::vec3 n = unit(normal);
        std::ranges::fill(amounts_, 0.0f);
        size_t count = 0;
        bool any = false;
        for (const glm::vec3& d : directions_) {
            const float cosine = glm::dot(d, n);
            if (cosine <= 0.0f) continue;
            rays_[count] = {d, cosine, depth(p, d, cosine)};
            any |= rays_[count++].depth > 0.0f;
        }
        return any ? mean(p, n, {rays_.data(), count}) : SkyAtVertex{};
    }
    /// Of the last vertex, by groom.
    [[nodiscard]] std::span<const float> amounts() const { return amounts_; }

  private:
    float depth(const glm::vec3& p, const glm::vec3& d, float cosine) {
        float sum = 0.0f;
        for (size_t g = 0; g < grooms_.size(); ++g) {
            const CoveringGroom& groom = grooms_[g];
            const float deep = depth_along(
                groom.volume, glm::vec3(groom.to_groom * glm::vec4(p, 1)),
                unit(glm::mat3(groom.to_groom) * d), std::numeric_limits<float>::infinity());
            amounts_[g] += cosine * deep;
            sum += deep;
        }
        return std::min(sum, glsl::kAmbientMost);
    }
    bool hidden(const glm::vec3& p, const glm::vec3& n, const glm::vec3& d) const {
        return std::ranges::any_of(grooms_, [&](const CoveringGroom& groom) {
            const glm::mat3 turn(groom.to_groom);
            const glm::vec3 above = glm::vec3(groom.to_groom * glm::vec4(p, 1)) +
                                    unit(turn * n) * (kAbove * groom.volume.cell());
            return !std::isinf(skin_along(groom.volume, above, unit(turn * d)));
        });
    }
    SkyAtVertex mean(const glm::vec3& p, const glm::vec3& n, std::span<const Ray> rays) const {
        float whole = 0.0f;
        float light = 0.0f;
        float dark = 0.0f;
        glm::vec3 seen(0.0f);
        glm::vec3 left(0.0f);
        for (const Ray& ray : rays) {
            if (hidden(p, n, ray.direction)) continue;
            whole += ray.cosine;
            light += ray.cosine * std::exp(-kLight * ray.depth);
            dark += ray.cosine * std::exp(-ray.depth);
            seen += ray.cosine * ray.direction;
            left += ray.cosine * std::exp(-0.5f * ray.depth) * ray.direction;
        }
        if (whole <= 0.0f) return {};
        SkyAtVertex sky = fit_sky(light / whole, dark / whole);
        sky.lean = unit(left) - unit(seen);
        return sky;
    }

    std::span<const CoveringGroom> grooms_;
    std::vector<float> amounts_;
    std::array<glm::vec3, kDirections> directions_ = directions();
    std::array<Ray, kDirections> rays_{};
};

}  // namespace

SkyAtVertex fit_sky(float mean_light, float mean_dark) {
    const float dark = std::clamp(mean_dark, 1e-20f, 1.0f);
    if (dark >= 1.0f) return {};
    // With the open share that makes `dark` exact, light falls with depth from dark^0.3 to what is
    // open.
    const auto open_at = [&](float depth) {
        const float passed = std::exp(-depth);
        return std::max((dark - passed) / (1.0f - passed), 0.0f);
    };
    float least = -std::log(dark);
    float most = glsl::kAmbientMost;
    for (int i = 0; i < 24 && least < most; ++i) {
        const float depth = 0.5f * (least + most);
        const float open = open_at(depth);
        const float light = open + (1.0f - open) * std::exp(-kLight * depth);
        (light > mean_light ? least : most) = depth;
    }
    return {.open = open_at(least), .depth = least};
}

MeshCover mesh_cover(const CoveredSurface& surface, std::span<CoveringGroom> grooms) {
    std::vector<glm::vec3> in_groom(surface.positions.size());
    for (CoveringGroom& groom : grooms) {
        for (size_t v = 0; v < in_groom.size(); ++v) {
            in_groom[v] = groom.to_groom * glm::vec4(surface.positions[v], 1.0f);
        }
        groom.volume.skin.clear();
        add_skin(in_groom, surface.triangles, groom.volume);
    }
    MeshCover cover{.vertices = std::vector<SkyAtVertex>(surface.positions.size()),
                    .amounts = std::vector<float>(grooms.size())};
    std::vector<float> amounts(surface.positions.size() * grooms.size());
    parallel_ranges(cover.vertices.size(), 64, [&](size_t first, size_t last) {
        Looker looker(grooms);
        for (size_t v = first; v < last; ++v) {
            cover.vertices[v] = looker.at(surface.positions[v], surface.normals[v]);
            std::ranges::copy(looker.amounts(), &amounts[v * grooms.size()]);
        }
    });
    for (size_t i = 0; i < amounts.size(); ++i) cover.amounts[i % grooms.size()] += amounts[i];
    return cover;
}

}  // namespace vellus::hair
