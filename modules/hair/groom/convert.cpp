#include "modules/hair/groom/convert.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/groom/upright.h"

namespace vellus::hair {

namespace {

bool same_format(GroomFormat a, GroomFormat b) {
    const auto is_tfx = [](GroomFormat f) {
        return f == GroomFormat::kTfx3 || f == GroomFormat::kTfx4;
    };
    return a == b || (is_tfx(a) && is_tfx(b));
}

// IEC 61966-2-1.
float linear_to_srgb(float value) {
    if (value <= 0.0031308f) return value * 12.92f;
    return 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

glm::vec3 encode(glm::vec3 linear, GroomFormat target) {
    if (target == GroomFormat::kGltf) return linear;
    return {linear_to_srgb(linear.r), linear_to_srgb(linear.g), linear_to_srgb(linear.b)};
}

/// From metres, Y up, face +Z to the format's own axes and unit.
glm::dmat3 axes_of(GroomFormat format) {
    if (format != GroomFormat::kHair) return glm::dmat3(1.0);
    // Columns: where X, Y and Z of the upright groom go.
    return glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)) * 100.0;
}

void move_points(const Groom& from, GroomFormat target, Groom& to) {
    const Upright upright = upright_transform(from);
    const glm::dmat3 turn = axes_of(target) * glm::dmat3(upright.to_metres);
    const double unit = std::cbrt(std::abs(glm::determinant(turn)));
    for (glm::vec3& point : to.points) point = glm::vec3(turn * glm::dvec3(point));
    for (float& thickness : to.thickness) thickness = static_cast<float>(thickness * unit);
    to.default_thickness = static_cast<float>(to.default_thickness * unit);
}

void recolor(const Groom& from, GroomFormat target, Groom& to) {
    for (size_t p = 0; p < to.colors.size(); ++p) {
        const glm::vec4 linear = linear_color_at(from, p);
        to.colors[p] = glm::vec4(encode(glm::vec3(linear), target), linear.a);
    }
    if (from.has_default_color) {
        to.default_color = encode(linear_default_color(from), target);
    }
}

class Fitter {
  public:
    Fitter(ConvertedGroom& result) : groom_(result.groom), notes_(result.notes) {}

    void fit_hair() {
        groom_.format = GroomFormat::kHair;
        spread_thickness_to_points();
        split_alpha();
        drop(groom_.strand_uvs, "texture coordinates of roots");
        drop(groom_.point_uvs, "texture coordinates of points");
        drop(groom_.inverse_mass, "which points are held");
        constexpr size_t kInfoBytes = 88;
        if (groom_.info.size() > kInfoBytes) {
            groom_.info.resize(kInfoBytes);
            notes_.emplace_back("free text cut to 88 bytes");
        }
        const glm::vec3 color = groom_.default_color;
        if (!groom_.has_default_color) {
            groom_.default_color = glm::vec3(0.0f);
        } else if (color == glm::vec3(0.0f) || color == glm::vec3(1.0f)) {
            // Black and white stand for "no colour" there: a column says it.
            if (groom_.colors.empty()) {
                groom_.colors.assign(groom_.points.size(), glm::vec4(color, 1.0f));
            }
            groom_.has_default_color = false;
        }
    }

    void fit_tfx() {
        groom_.format = GroomFormat::kTfx4;
        thickness_to_strands();
        color_to_points();
        if (groom_.inverse_mass.empty()) {
            groom_.inverse_mass.assign(groom_.points.size(), 1.0f);
            for (size_t s = 0; s < groom_.strand_count(); ++s) {
                if (groom_.point_count(s) > 0) groom_.inverse_mass[groom_.strand_begin[s]] = 0.0f;
            }
        }
        drop_text();
        groom_.default_color = glm::vec3(0.0f);
        groom_.has_default_color = false;
    }

    void fit_gltf() {
        groom_.format = GroomFormat::kGltf;
        spread_thickness_to_points();
        if (groom_.thickness.empty() && groom_.default_thickness > 0.0f) {
            groom_.thickness.assign(groom_.points.size(), groom_.default_thickness);
        }
        groom_.default_thickness = 0.0f;
        merge_alpha();
        if (!groom_.point_uvs.empty()) {
            if (!groom_.strand_uvs.empty())
                notes_.emplace_back("texture coordinates of roots dropped");
            groom_.strand_uvs.clear();
            uvs_to_strands();
        }
        drop(groom_.inverse_mass, "which points are held");
        drop_text();
        if (!groom_.has_default_color) groom_.default_color = glm::vec3(0.0f);
    }

  private:
    template <class T>
    void drop(std::vector<T>& column, const char* what) {
        if (!column.empty()) notes_.push_back(fmt::format("{} dropped", what));
        column.clear();
    }
    void drop_text() {
        if (!groom_.info.empty()) notes_.emplace_back("free text dropped");
        groom_.info.clear();
    }

    void spread_thickness_to_points() {
        if (groom_.thickness.empty() || groom_.thickness.size() == groom_.points.size()) return;
        std::vector<float> points(groom_.points.size());
        for (size_t s = 0; s < groom_.strand_count(); ++s) {
            std::fill(points.begin() + groom_.strand_begin[s],
                      points.begin() + groom_.strand_begin[s + 1], groom_.thickness[s]);
        }
        groom_.thickness = std::move(points);
    }

    void thickness_to_strands() {
        const size_t strands = groom_.strand_count();
        if (groom_.thickness.empty() && groom_.default_thickness > 0.0f) {
            groom_.thickness.assign(strands, groom_.default_thickness);
        } else if (!groom_.thickness.empty()) {
            std::vector<float> roots(strands);
            bool varied = false;
            for (size_t s = 0; s < strands; ++s) {
                const uint32_t first = groom_.strand_begin[s];
                roots[s] = thickness_at(groom_, s, first);
                for (uint32_t p = first; p < groom_.strand_begin[s + 1]; ++p) {
                    varied |= thickness_at(groom_, s, p) != roots[s];
                }
            }
            if (varied) notes_.emplace_back("diameters along strands dropped, those of roots kept");
            groom_.thickness = std::move(roots);
        }
        groom_.default_thickness = 0.0f;
    }

    /// .tfx keeps colour and opacity in one column.
    void color_to_points() {
        const bool clear = groom_.default_transparency > 0.0f && groom_.colors.empty();
        if (groom_.colors.empty() && (groom_.has_default_color || clear)) {
            groom_.colors.resize(groom_.points.size());
            for (size_t p = 0; p < groom_.colors.size(); ++p) {
                groom_.colors[p] =
                    glm::vec4(groom_.has_default_color ? groom_.default_color : glm::vec3(1.0f),
                              1.0f - transparency(p));
            }
            groom_.transparency.clear();
        }
        merge_alpha();
    }

    float transparency(size_t p) const {
        return groom_.transparency.empty() ? groom_.default_transparency : groom_.transparency[p];
    }

    void merge_alpha() {
        if (!groom_.transparency.empty()) {
            if (groom_.colors.empty()) groom_.colors.assign(groom_.points.size(), glm::vec4(1.0f));
            for (size_t p = 0; p < groom_.colors.size(); ++p) {
                groom_.colors[p].a = 1.0f - groom_.transparency[p];
            }
            groom_.transparency.clear();
        }
        groom_.default_transparency = 0.0f;
    }

    void split_alpha() {
        const bool varied =
            std::ranges::any_of(groom_.colors, [](const glm::vec4& c) { return c.a != 1.0f; });
        if (varied && groom_.transparency.empty()) {
            groom_.transparency.resize(groom_.points.size());
            for (size_t p = 0; p < groom_.points.size(); ++p) {
                groom_.transparency[p] = 1.0f - groom_.colors[p].a;
            }
        }
        for (glm::vec4& color : groom_.colors) color.a = 1.0f;
    }

    /// Texture coordinates that are the same all along each strand are those of the roots.
    void uvs_to_strands() {
        std::vector<glm::vec2> roots;
        for (size_t s = 0; s < groom_.strand_count(); ++s) {
            const auto first = groom_.point_uvs.begin() + groom_.strand_begin[s];
            const auto last = groom_.point_uvs.begin() + groom_.strand_begin[s + 1];
            if (first == last ||
                std::any_of(first, last, [&](glm::vec2 uv) { return uv != *first; })) {
                return;
            }
            roots.push_back(*first);
        }
        groom_.strand_uvs = std::move(roots);
        groom_.point_uvs.clear();
    }

    Groom& groom_;
    std::vector<std::string>& notes_;
};

/// Where a new point lies between two old ones.
struct Between {
    size_t first;
    float t;
};

template <class T>
std::vector<T> resampled(const std::vector<T>& column, const std::vector<Between>& places,
                         size_t points) {
    if (column.size() != points) return column;
    std::vector<T> result(places.size());
    for (size_t i = 0; i < places.size(); ++i) {
        const size_t next = std::min(places[i].first + 1, points - 1);
        result[i] = places[i].t == 0.0f
                        ? column[places[i].first]
                        : glm::mix(column[places[i].first], column[next], places[i].t);
    }
    return result;
}

void place_points(const Groom& groom, size_t strand, uint32_t count, Between* out) {
    const uint32_t begin = groom.strand_begin[strand];
    const uint32_t end = groom.strand_begin[strand + 1];
    std::vector<double> along{0.0};
    for (uint32_t p = begin; p + 1 < end; ++p) {
        along.push_back(along.back() + glm::distance(glm::dvec3(groom.points[p]),
                                                     glm::dvec3(groom.points[p + 1])));
    }
    size_t segment = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const double at = along.back() * i / (count - 1);
        while (segment + 2 < along.size() && along[segment + 1] <= at) ++segment;
        const double step = segment + 1 < along.size() ? along[segment + 1] - along[segment] : 0.0;
        double t = step > 0.0 ? std::clamp((at - along[segment]) / step, 0.0, 1.0) : 0.0;
        size_t first = begin + segment;
        if (i + 1 == count) {
            first = end - 1;
            t = 0.0;
        }
        out[i] = {first, static_cast<float>(t)};
    }
}

}  // namespace

ConvertedGroom convert_groom(const Groom& groom, GroomFormat target, bool keep_axes) {
    ConvertedGroom result{groom, {}};
    result.groom.notes.clear();
    const bool known = groom.format != GroomFormat::kNone;
    if (known && !same_format(groom.format, target)) {
        if (!keep_axes) move_points(groom, target, result.groom);
        recolor(groom, target, result.groom);
    }
    Fitter fitter(result);
    switch (target) {
        case GroomFormat::kHair:
            fitter.fit_hair();
            break;
        case GroomFormat::kTfx3:
        case GroomFormat::kTfx4:
            fitter.fit_tfx();
            break;
        case GroomFormat::kGltf:
        case GroomFormat::kNone:
            fitter.fit_gltf();
            break;
    }
    return result;
}

Groom resample_groom(const Groom& groom, uint32_t points) {
    std::vector<Between> places(groom.strand_count() * points);
    parallel_ranges(groom.strand_count(), 256, [&](size_t first, size_t last) {
        for (size_t s = first; s < last; ++s) place_points(groom, s, points, &places[s * points]);
    });
    Groom result = groom;
    const size_t before = groom.points.size();
    result.points = resampled(groom.points, places, before);
    result.transparency = resampled(groom.transparency, places, before);
    result.colors = resampled(groom.colors, places, before);
    result.point_uvs = resampled(groom.point_uvs, places, before);
    result.thickness = resampled(groom.thickness, places, before);
    result.inverse_mass.clear();
    for (size_t s = 0; s <= groom.strand_count(); ++s) {
        result.strand_begin[s] = static_cast<uint32_t>(s * points);
    }
    return result;
}

GroomFormat format_of_extension(const std::string& extension) {
    if (extension == ".hair") return GroomFormat::kHair;
    if (extension == ".tfx") return GroomFormat::kTfx4;
    if (extension == ".glb" || extension == ".gltf") return GroomFormat::kGltf;
    return GroomFormat::kNone;
}

const char* format_name(GroomFormat format) {
    switch (format) {
        case GroomFormat::kHair:
            return ".hair";
        case GroomFormat::kTfx3:
            return ".tfx 3";
        case GroomFormat::kTfx4:
            return ".tfx 4";
        case GroomFormat::kGltf:
            return "glTF line strips";
        case GroomFormat::kNone:
            break;
    }
    return "none";
}

}  // namespace vellus::hair
