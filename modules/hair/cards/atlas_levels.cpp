#include "modules/hair/cards/atlas_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

constexpr size_t kRowsPerJob = 16;

uint32_t byte_of(uint32_t word, uint32_t index) {
    return (word >> (8 * index)) & 0xffU;
}

/// Four texels of a level and how much each counts.
struct Block {
    std::array<size_t, 4> texels{};
    std::array<float, 4> weights{};
    size_t strongest = 0;
};

Block block_of(const std::vector<uint32_t>& shape, size_t first, glm::uvec2 size, glm::uvec2 at) {
    Block block;
    float sum = 0.0f;
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t x = std::min(2 * at.x + (i & 1U), size.x - 1);
        const uint32_t y = std::min(2 * at.y + (i >> 1U), size.y - 1);
        block.texels[i] = first + size_t{y} * size.x + x;
        block.weights[i] = static_cast<float>(byte_of(shape[block.texels[i]], 0));
        if (block.weights[i] > block.weights[block.strongest]) block.strongest = i;
        sum += block.weights[i];
    }
    for (float& weight : block.weights) weight = sum > 0.0f ? weight / sum : 0.25f;
    return block;
}

uint32_t mean_byte(const std::vector<uint32_t>& words, const Block& block, uint32_t index) {
    float sum = 0.0f;
    for (size_t i = 0; i < 4; ++i) {
        sum += block.weights[i] * static_cast<float>(byte_of(words[block.texels[i]], index));
    }
    return static_cast<uint32_t>(std::lround(sum));
}

/// Of what `value(texel)` is at the four. Halves are rounded up and down in turn, so that no level
/// drifts.
template <class Value>
uint32_t plain_mean(const Block& block, glm::uvec2 at, const Value& value) {
    uint32_t sum = 1 + ((at.x ^ at.y) & 1U);
    for (const size_t texel : block.texels) sum += value(texel);
    return sum / 4;
}

uint32_t mean_color(const std::vector<uint32_t>& colors, const Block& block) {
    uint32_t word = 0;
    for (uint32_t i = 0; i < 3; ++i) word |= mean_byte(colors, block, i) << (8 * i);
    return word;
}

void add_level(glm::uvec2 below, glm::uvec2 size, size_t first, AtlasLevels& levels) {
    const size_t next = levels.shape.size();
    const size_t end = next + size_t{size.x} * size.y;
    levels.shape.resize(end);
    levels.strand.resize(end);
    if (!levels.fibres.empty()) levels.fibres.resize(end);
    if (!levels.color.empty()) levels.color.resize(end);
    parallel_ranges(size.y, kRowsPerJob, [&](size_t from, size_t to) {
        for (size_t y = from; y < to; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const glm::uvec2 at(x, static_cast<uint32_t>(y));
                const Block block = block_of(levels.shape, first, below, at);
                const size_t texel = next + y * size.x + x;
                levels.shape[texel] =
                    plain_mean(block, at, [&](size_t t) { return byte_of(levels.shape[t], 0); }) |
                    mean_byte(levels.shape, block, 1) << 8U |
                    (levels.shape[block.texels[block.strongest]] & 0xffff0000U);
                levels.strand[texel] = levels.strand[block.texels[block.strongest]];
                if (!levels.fibres.empty()) {
                    levels.fibres[texel] = static_cast<uint8_t>(plain_mean(
                        block, at, [&](size_t t) { return uint32_t{levels.fibres[t]}; }));
                }
                if (!levels.color.empty()) {
                    levels.color[texel] = mean_color(levels.color, block);
                }
            }
        }
    });
}

}  // namespace

glm::uvec2 level_size(const CardAtlas& atlas, uint32_t level) {
    return glm::max(glm::uvec2(atlas.width >> level, atlas.height >> level), 1u);
}

AtlasLevels make_levels(const CardAtlas& atlas) {
    AtlasLevels levels;
    levels.shape.resize(atlas.texels());
    levels.strand.resize(atlas.texels());
    levels.fibres = atlas.fibres;
    levels.color.resize(atlas.color.size());
    for (size_t i = 0; i < atlas.texels(); ++i) {
        levels.shape[i] = uint32_t{atlas.opacity[i]} | uint32_t{atlas.depth[i]} << 8U |
                          uint32_t{atlas.strand.empty() ? uint16_t{0} : atlas.strand[i]} << 16U;
        const glm::u8vec3 tangent = atlas.tangent[i];
        const uint32_t parameter = atlas.parameter.empty() ? 0 : atlas.parameter[i];
        levels.strand[i] = uint32_t{tangent.x} | uint32_t{tangent.y} << 8U |
                           uint32_t{tangent.z} << 16U | parameter << 24U;
        if (!atlas.color.empty()) {
            const glm::u8vec3 color = atlas.color[i];
            levels.color[i] =
                uint32_t{color.x} | uint32_t{color.y} << 8U | uint32_t{color.z} << 16U;
        }
    }
    size_t first = 0;
    for (uint32_t level = 1; level < kCardLevels; ++level) {
        const size_t next = levels.shape.size();
        add_level(level_size(atlas, level - 1), level_size(atlas, level), first, levels);
        first = next;
    }
    return levels;
}

}  // namespace vellus::hair
