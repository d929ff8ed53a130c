#include "modules/hair/cards/bake.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/color_space.hpp>
#include <glm/gtc/packing.hpp>

#include "modules/hair/cards/strand_path.h"

namespace vellus::hair {

namespace {

constexpr uint32_t kNoPiece = 0xffffffffU;
/// Pieces are at most this many texels long.
constexpr float kPieceTexels = 1.5f;

/// A straight piece of a strand on the card: ends in samples, radius in metres.
struct Piece {
    glm::vec2 ends[2];
    float toward[2];  ///< in half thicknesses
    float radius = 0.0f;
    float sample_width = 0.0f;  ///< metres a sample measures across the card here
    glm::vec3 tangent{0.0f};
    float parameter = 0.0f;
    glm::vec3 color{1.0f};
    uint32_t strand = 0;
};

/// What one sample sees.
struct Sample {
    float toward = -1e30f;
    uint32_t piece = kNoPiece;
    uint32_t last_strand = kNoPiece;
    uint32_t strands = 0;  ///< over each other
};

/// Rasterises one card; columns are resolved at the end.
class Baker {
  public:
    Baker(const StrandData& strands, const Ribbon& ribbon, const BakeSettings& settings)
        : strands_(strands),
          ribbon_(ribbon),
          settings_(settings),
          grid_(settings.size * settings.samples),
          sample_height_(ribbon.length() / static_cast<float>(grid_.y)),
          samples_(size_t{grid_.x} * grid_.y) {}

    void add_strand(uint32_t strand) {
        uint32_t hint = 0;
        const float step = kPieceTexels * sample_height_ * static_cast<float>(settings_.samples);
        for (uint32_t p = strands_.strand_begin[strand]; p + 1 < strands_.strand_begin[strand + 1];
             ++p) {
            const glm::vec3 a = strands_.positions[p];
            const glm::vec3 b = strands_.positions[p + 1];
            const auto count = static_cast<uint32_t>(
                std::clamp(std::ceil(glm::distance(a, b) / step), 1.0f, 4096.0f));
            for (uint32_t i = 0; i < count; ++i) {
                const float t0 = static_cast<float>(i) / static_cast<float>(count);
                const float t1 = static_cast<float>(i + 1) / static_cast<float>(count);
                add_piece(strand, p, t0, t1, hint);
            }
        }
    }

    [[nodiscard]] CardAtlas resolve() const;

  private:
    glm::vec2 to_grid(const RibbonPoint& at) const {
        const float u = 0.5f + 0.5f * at.across / ribbon_.half_width(at);
        const float v = ribbon_.distance(at) / ribbon_.length();
        return glm::vec2(u, v) * glm::vec2(grid_);
    }

    void add_piece(uint32_t strand, uint32_t point, float t0, float t1, uint32_t& hint) {
        const glm::vec3 a = strands_.positions[point];
        const glm::vec3 step = strands_.positions[point + 1] - a;
        const auto fraction = [&](float t) {
            return glm::mix(static_cast<float>(strands_.point_parameter[point]),
                            static_cast<float>(strands_.point_parameter[point + 1]), t) /
                   65535.0f;
        };
        const RibbonPoint from = ribbon_.locate(a + step * t0, fraction(t0), hint);
        const RibbonPoint to = ribbon_.locate(a + step * t1, fraction(t1), from.interval);
        hint = to.interval;
        Piece piece;
        piece.ends[0] = to_grid(from);
        piece.ends[1] = to_grid(to);
        piece.toward[0] = from.toward / ribbon_.half_thickness(from);
        piece.toward[1] = to.toward / ribbon_.half_thickness(to);
        const float t = 0.5f * (t0 + t1);
        piece.radius = 0.5f * glm::mix(strand_width(strands_, point, settings_.tip_scale),
                                       strand_width(strands_, point + 1, settings_.tip_scale), t);
        piece.sample_width = 2.0f * ribbon_.half_width(from) / static_cast<float>(grid_.x);
        piece.tangent = tangent_there(step, from);
        piece.parameter = fraction(t);
        piece.strand = strands_.strand_source[strand];
        if (!strands_.point_color.empty()) {
            const glm::uvec2 halves = strands_.point_color[point];
            piece.color = glm::vec3(glm::unpackHalf2x16(halves.x), glm::unpackHalf2x16(halves.y).x);
        }
        pieces_.push_back(piece);
        draw(static_cast<uint32_t>(pieces_.size() - 1));
    }

    [[nodiscard]] glm::vec3 tangent_there(glm::vec3 step, const RibbonPoint& at) const {
        const RibbonRow& a = ribbon_.rows[at.interval];
        const RibbonRow& b = ribbon_.rows[at.interval + 1];
        const glm::vec3 tangent(glm::dot(step, glm::mix(a.across, b.across, at.t)),
                                glm::dot(step, glm::mix(a.along, b.along, at.t)),
                                glm::dot(step, glm::mix(a.toward, b.toward, at.t)));
        const float length = glm::length(tangent);
        return length > 0.0f ? tangent / length : glm::vec3(0, 1, 0);
    }

    /// Marks every sample within the piece's radius that sees nothing nearer.
    void draw(uint32_t index) {
        const Piece& piece = pieces_[index];
        const glm::vec2 metres(piece.sample_width, sample_height_);
        const glm::vec2 reach = piece.radius / metres;
        const glm::vec2 low = glm::min(piece.ends[0], piece.ends[1]) - reach;
        const glm::vec2 high = glm::max(piece.ends[0], piece.ends[1]) + reach;
        const int first_y = std::max(0, static_cast<int>(std::floor(low.y)));
        const int last_y =
            std::min(static_cast<int>(grid_.y) - 1, static_cast<int>(std::floor(high.y)));
        const int first_x = std::max(0, static_cast<int>(std::floor(low.x)) - 1);
        const int last_x =
            std::min(static_cast<int>(grid_.x) - 1, static_cast<int>(std::floor(high.x)));
        const glm::vec2 direction = (piece.ends[1] - piece.ends[0]) * metres;
        const float squared = glm::max(glm::dot(direction, direction), 1e-24f);
        for (int y = first_y; y <= last_y; ++y) {
            for (int x = first_x; x <= last_x; ++x) {
                const glm::vec2 offset =
                    (glm::vec2(static_cast<float>(x) + shift(y), static_cast<float>(y) + 0.5f) -
                     piece.ends[0]) *
                    metres;
                const float t = glm::clamp(glm::dot(offset, direction) / squared, 0.0f, 1.0f);
                const glm::vec2 away = offset - direction * t;
                if (glm::dot(away, away) > piece.radius * piece.radius) continue;
                const float toward = glm::mix(piece.toward[0], piece.toward[1], t);
                Sample& sample = samples_[size_t{grid_.x} * static_cast<size_t>(y) + x];
                if (sample.last_strand != piece.strand) ++sample.strands;
                sample.last_strand = piece.strand;
                if (toward <= sample.toward) continue;
                sample.toward = toward;
                sample.piece = index;
            }
        }
    }

    /// Samples of a row lie at this fraction of their cells, another one in each row: strands
    /// thinner than a cell would else be missed or met along all their length.
    static float shift(int row) {
        const float turned = static_cast<float>(row) * 0.618033989f;
        return turned - std::floor(turned);
    }

    const StrandData& strands_;
    const Ribbon& ribbon_;
    const BakeSettings& settings_;
    glm::uvec2 grid_;
    float sample_height_;
    std::vector<Sample> samples_;
    std::vector<Piece> pieces_;
};

glm::u8vec3 encode_color(glm::vec3 linear) {
    const glm::vec3 srgb = glm::convertLinearToSRGB(glm::clamp(linear, 0.0f, 1.0f));
    return glm::u8vec3(glm::round(srgb * 255.0f));
}

CardAtlas make_columns(glm::uvec2 size, bool colored) {
    CardAtlas atlas{.width = size.x, .height = size.y};
    atlas.opacity.assign(atlas.texels(), 0);
    atlas.depth.assign(atlas.texels(), 128);
    atlas.parameter.assign(atlas.texels(), 0);
    atlas.tangent.assign(atlas.texels(), glm::u8vec3(128, 255, 128));
    atlas.strand.assign(atlas.texels(), 0);
    atlas.fibres.assign(atlas.texels(), 0);
    if (colored) atlas.color.assign(atlas.texels(), glm::u8vec3(255));
    return atlas;
}

CardAtlas Baker::resolve() const {
    CardAtlas atlas = make_columns(settings_.size, !strands_.point_color.empty());
    const uint32_t per_axis = settings_.samples;
    for (size_t texel = 0; texel < atlas.texels(); ++texel) {
        const size_t corner_x = texel % atlas.width * per_axis;
        const size_t corner_y = texel / atlas.width * per_axis;
        float count = 0.0f;
        float fibres = 0.0f;
        float toward = 0.0f;
        float parameter = 0.0f;
        glm::vec3 tangent(0.0f);
        glm::vec3 color(0.0f);
        Sample front;
        for (uint32_t i = 0; i < per_axis * per_axis; ++i) {
            const Sample& sample =
                samples_[(corner_y + i / per_axis) * grid_.x + corner_x + i % per_axis];
            if (sample.piece == kNoPiece) continue;
            const Piece& piece = pieces_[sample.piece];
            count += 1.0f;
            fibres += static_cast<float>(sample.strands);
            toward += sample.toward;
            parameter += piece.parameter;
            // A strand lies along its tangent and against it: opposite ones are alike.
            tangent += glm::dot(tangent, piece.tangent) < 0.0f ? -piece.tangent : piece.tangent;
            color += piece.color;
            if (sample.toward > front.toward) front = sample;
        }
        if (count == 0.0f) continue;
        const float share = count / static_cast<float>(per_axis * per_axis);
        atlas.opacity[texel] = static_cast<uint8_t>(std::lround(255.0f * share));
        atlas.fibres[texel] = static_cast<uint8_t>(std::min(
            std::lround(kFibreSteps * fibres / static_cast<float>(per_axis * per_axis)), 255L));
        atlas.depth[texel] = encode_signed(toward / count);
        atlas.parameter[texel] = static_cast<uint8_t>(std::lround(255.0f * parameter / count));
        const glm::vec3 nearest = pieces_[front.piece].tangent;
        if (glm::length(tangent) < 0.1f) tangent = nearest;
        if (glm::dot(tangent, nearest) < 0.0f) tangent = -tangent;
        tangent = glm::normalize(tangent);
        atlas.tangent[texel] = {encode_signed(tangent.x), encode_signed(tangent.y),
                                encode_signed(tangent.z)};
        atlas.strand[texel] = static_cast<uint16_t>(pieces_[front.piece].strand);
        if (!atlas.color.empty()) atlas.color[texel] = encode_color(color / count);
    }
    return atlas;
}

void copy_texel(CardAtlas& atlas, size_t from, size_t to) {
    atlas.depth[to] = atlas.depth[from];
    atlas.parameter[to] = atlas.parameter[from];
    atlas.tangent[to] = atlas.tangent[from];
    atlas.strand[to] = atlas.strand[from];
    if (!atlas.color.empty()) atlas.color[to] = atlas.color[from];
}

/// Gives texels without hair everything but the opacity of the nearest one with hair.
void dilate(CardAtlas& atlas) {
    std::vector<uint8_t> known(atlas.texels(), 0);
    std::vector<size_t> front;
    for (size_t i = 0; i < known.size(); ++i) {
        known[i] = atlas.opacity[i] > 0 ? 1 : 0;
        if (known[i] != 0) front.push_back(i);
    }
    std::vector<size_t> next;
    while (!front.empty()) {
        next.clear();
        const auto spread = [&](size_t from, size_t to) {
            if (known[to] != 0) return;
            known[to] = 1;
            copy_texel(atlas, from, to);
            next.push_back(to);
        };
        for (const size_t i : front) {
            const size_t x = i % atlas.width;
            if (x > 0) spread(i, i - 1);
            if (x + 1 < atlas.width) spread(i, i + 1);
            if (i >= atlas.width) spread(i, i - atlas.width);
            if (i + atlas.width < atlas.texels()) spread(i, i + atlas.width);
        }
        front.swap(next);
    }
}

}  // namespace

CardAtlas bake_card(const StrandData& strands, std::span<const uint32_t> members,
                    const Ribbon& ribbon, const BakeSettings& settings) {
    Baker baker(strands, ribbon, settings);
    for (const uint32_t strand : members) baker.add_strand(strand);
    CardAtlas atlas = baker.resolve();
    dilate(atlas);
    return atlas;
}

}  // namespace vellus::hair
