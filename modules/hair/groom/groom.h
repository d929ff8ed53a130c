#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

namespace vellus::hair {

enum class GroomFormat : uint8_t { kNone, kHair, kTfx3, kTfx4, kGltf };

/// Diameters in metres that a strand may have.
constexpr double kThinnestStrand = 1e-6;
constexpr double kThickestStrand = 0.05;

/// An axis-aligned box; `low > high` in every axis means empty.
struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(glm::vec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] glm::vec3 size() const { return empty() ? glm::vec3(0.0f) : high - low; }
    [[nodiscard]] glm::vec3 center() const {
        return empty() ? glm::vec3(0.0f) : (low + high) / 2.0f;
    }
};

/// Strands as columns, exactly as their file says: its axes, its unit, its colour numbers. Nothing
/// is converted here, so what is written reads back bit for bit; upright_transform() leads to
/// metres, Y up, and prepare_strands() applies it.
struct Groom {
    GroomFormat format = GroomFormat::kNone;
    /// Root to tip, one strand after the other.
    std::vector<glm::vec3> points;
    /// Strand s has the points [strand_begin[s], strand_begin[s + 1]); size is strands + 1.
    std::vector<uint32_t> strand_begin{0};

    /// Diameter in the file's unit: empty, one per point, or one per strand.
    std::vector<float> thickness;
    /// 0 opaque to 1 clear (.hair only): empty or one per point.
    std::vector<float> transparency;
    /// Colour and opacity: empty or one per point; alpha is 1 where the file has none.
    std::vector<glm::vec4> colors;
    /// Texture coordinates of the root: empty or one per strand.
    std::vector<glm::vec2> strand_uvs;
    /// Texture coordinates (.tfx only): empty or one per point.
    std::vector<glm::vec2> point_uvs;
    /// 0 where a point is held, else 1 (.tfx 4 only): empty or one per point.
    std::vector<float> inverse_mass;

    /// For where the columns are empty; thickness 0 means the file gives none.
    float default_thickness = 0.0f;
    float default_transparency = 0.0f;
    glm::vec3 default_color{0.0f};
    bool has_default_color = false;
    /// Free text of the file, e.g. its author.
    std::string info;
    /// What the reader had to decide, one line each.
    std::vector<std::string> notes;

    [[nodiscard]] size_t strand_count() const { return strand_begin.size() - 1; }
    [[nodiscard]] uint32_t point_count(size_t strand) const {
        return strand_begin[strand + 1] - strand_begin[strand];
    }
};

/// Diameter at `point` of `strand`, from whichever the groom has: points, strands or its default.
float thickness_at(const Groom& groom, size_t strand, size_t point);
/// 0 opaque to 1 clear, from the transparency column, the colours' alpha or the default.
float transparency_at(const Groom& groom, size_t point);
/// Colour (the default, or white, where there is no column) and 1 - transparency, as the file
/// encodes them.
glm::vec4 color_at(const Groom& groom, size_t point);
/// The same with linear RGB: .hair and .tfx give colours as sRGB, glTF gives them linear.
glm::vec4 linear_color_at(const Groom& groom, size_t point);
glm::vec3 linear_default_color(const Groom& groom);
bool has_colors(const Groom& groom);

/// Box of all points, in the file's unit.
Bounds bounds_of(const Groom& groom);

}  // namespace vellus::hair
