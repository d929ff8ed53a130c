#include "engine/asset/gltf_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace vellus::asset::detail {
namespace {

struct Influence {
    uint32_t joint = 0;
    float weight = 0.0f;
};

/// Replaces a list by one entry per index.
template <class T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& indices) {
    if (values.empty()) {
        return;
    }
    std::vector<T> result;
    result.reserve(indices.size());
    for (const uint32_t index : indices) {
        result.push_back(values[index]);
    }
    values = std::move(result);
}

std::vector<uint32_t> strip_to_triangles(const std::vector<uint32_t>& strip) {
    std::vector<uint32_t> triangles;
    triangles.reserve(3 * strip.size());
    for (size_t i = 0; i + 2 < strip.size(); ++i) {
        const size_t odd = i % 2;  // every second triangle is wound the other way
        triangles.insert(triangles.end(), {strip[i], strip[i + 1 + odd], strip[i + 2 - odd]});
    }
    return triangles;
}

std::vector<uint32_t> fan_to_triangles(const std::vector<uint32_t>& fan) {
    std::vector<uint32_t> triangles;
    triangles.reserve(3 * fan.size());
    for (size_t i = 1; i + 1 < fan.size(); ++i) {
        triangles.insert(triangles.end(),
                         {fan[i], fan[i + 1], fan[0]});  // the specification's order
    }
    return triangles;
}

/// In double: lengths of float vectors neither overflow nor underflow there.
glm::vec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0f);
}

std::vector<glm::dvec3> area_normals(const Primitive& primitive) {
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array<uint32_t, 3> corner = {primitive.indices[i], primitive.indices[i + 1],
                                                primitive.indices[i + 2]};
        const glm::dvec3 a(primitive.positions[corner[0]]);
        const glm::dvec3 b(primitive.positions[corner[1]]);
        const glm::dvec3 c(primitive.positions[corner[2]]);
        for (const uint32_t index : corner) {
            sums[index] += glm::cross(b - a, c - a);
        }
    }
    return sums;
}

}  // namespace

InfluenceRepairs reduce_influences(const InfluenceSets& sets, Primitive& primitive) {
    InfluenceRepairs repairs;
    const size_t count = primitive.positions.size();
    primitive.joints.resize(count);
    primitive.weights.resize(count);
    std::vector<Influence> influences(4 * sets.joints.size());
    for (size_t v = 0; v < count; ++v) {
        float sum = 0.0f;
        bool repaired = false;
        for (size_t i = 0; i < influences.size(); ++i) {
            const float weight = sets.weights[i / 4][v][static_cast<glm::length_t>(i % 4)];
            repaired |= weight < 0.0f;
            influences[i] = {sets.joints[i / 4][4 * v + i % 4], std::max(weight, 0.0f)};
            sum += influences[i].weight;
        }
        const uint32_t first = influences[0].joint;
        std::stable_sort(
            influences.begin(), influences.end(),
            [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        repairs.dropped += influences.size() > 4 && influences[4].weight > 0.0f ? 1U : 0U;
        // 8-bit weights are off by up to 4/255 in sum.
        repaired |= std::abs(sum - 1.0f) > 0.02f;
        const float kept = influences[0].weight + influences[1].weight + influences[2].weight +
                           influences[3].weight;
        if (!(kept > 0.0f) || !std::isfinite(kept)) {
            influences[0] = {first, 1.0f};
            std::fill(influences.begin() + 1, influences.end(), Influence{});
        }
        for (glm::length_t i = 0; i < 4; ++i) {
            const Influence& influence = influences[static_cast<size_t>(i)];
            const float weight =
                kept > 0.0f && std::isfinite(kept) ? influence.weight / kept : influence.weight;
            repairs.joint_too_large |= weight > 0.0f && influence.joint > 0xffffU;
            primitive.joints[v][i] =
                weight > 0.0f ? static_cast<uint16_t>(influence.joint) : uint16_t{0};
            primitive.weights[v][i] = weight;
        }
        repairs.weights += repaired ? 1U : 0U;
    }
    return repairs;
}

size_t assemble(int mode, Primitive& primitive) {
    std::vector<uint32_t>& indices = primitive.indices;
    const auto trim = [&indices](size_t per_primitive) {
        const size_t left_over = indices.size() % per_primitive;
        indices.resize(indices.size() - left_over);
        return left_over;
    };
    const auto drop_below = [&indices](size_t least) {
        const size_t left_over = indices.size() < least ? indices.size() : 0;
        indices.resize(indices.size() - left_over);
        return left_over;
    };
    size_t left_over = 0;
    switch (mode) {
        case 0:
            primitive.topology = Topology::kPoints;
            break;
        case 1:
            primitive.topology = Topology::kLines;
            left_over = trim(2);
            break;
        case 2:
        case 3:
            primitive.topology = Topology::kLineStrip;
            left_over = drop_below(2);
            if (mode == 2 && !indices.empty()) {
                indices.push_back(indices.front());
            }
            break;
        case 5:
            left_over = drop_below(3);
            indices = strip_to_triangles(indices);
            break;
        case 6:
            left_over = drop_below(3);
            indices = fan_to_triangles(indices);
            break;
        default:
            left_over = trim(3);
    }
    return left_over;
}

size_t vertex_bytes(const Primitive& primitive) {
    size_t columns = 0;
    for (const VertexColumn& column : primitive.columns) columns += column.components;
    return columns * sizeof(float) + sizeof(glm::vec3) * (2 + 2 * primitive.morph_targets.size()) +
           sizeof(glm::vec2) + 2 * sizeof(glm::vec4) + sizeof(glm::u16vec4) + sizeof(float) +
           sizeof(uint32_t);
}

void separate_vertices(Primitive& primitive) {
    const std::vector<uint32_t> indices = std::move(primitive.indices);
    gather(primitive.positions, indices);
    gather(primitive.normals, indices);
    gather(primitive.texcoords, indices);
    gather(primitive.colors, indices);
    gather(primitive.thickness, indices);
    gather(primitive.joints, indices);
    gather(primitive.weights, indices);
    for (VertexColumn& column : primitive.columns) {
        std::vector<float> values;
        values.reserve(indices.size() * column.components);
        for (const uint32_t index : indices) {
            const auto first = column.values.begin() +
                               static_cast<std::ptrdiff_t>(size_t{index} * column.components);
            values.insert(values.end(), first, first + column.components);
        }
        column.values = std::move(values);
    }
    for (MorphTarget& target : primitive.morph_targets) {
        gather(target.positions, indices);
        gather(target.normals, indices);
    }
    primitive.indices.resize(indices.size());
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
}

size_t complete_normals(Primitive& primitive) {
    const bool given = !primitive.normals.empty();
    primitive.normals.resize(primitive.positions.size(), glm::vec3(0.0f));
    std::vector<size_t> missing;
    for (size_t i = 0; i < primitive.normals.size(); ++i) {
        primitive.normals[i] = unit(primitive.normals[i]);
        if (primitive.normals[i] == glm::vec3(0.0f)) {
            missing.push_back(i);
        }
    }
    if (!missing.empty()) {
        const std::vector<glm::dvec3> sums = area_normals(primitive);
        for (const size_t i : missing) {
            const glm::vec3 normal = unit(sums[i]);
            primitive.normals[i] = normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 1.0f, 0.0f) : normal;
        }
    }
    return given ? missing.size() : 0;
}

}  // namespace vellus::asset::detail
