#include "modules/hair/cards/build_cards.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/clock.h"
#include "engine/platform/jobs.h"
#include "modules/hair/cards/bake.h"
#include "modules/hair/cards/card_columns.h"
#include "modules/hair/cards/cluster.h"
#include "modules/hair/cards/face_outwards.h"
#include "modules/hair/cards/pack.h"

namespace vellus::hair {

namespace {

/// Strands of cluster c: strands[begin[c]] to strands[begin[c + 1] - 1].
struct Members {
    std::vector<uint32_t> strands;
    std::vector<uint32_t> begin{0};

    [[nodiscard]] size_t count() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const uint32_t> of(size_t cluster) const {
        return std::span(strands).subspan(begin[cluster], begin[cluster + 1] - begin[cluster]);
    }
};

Members group(const std::vector<uint32_t>& labels) {
    Members members;
    const uint32_t count = *std::ranges::max_element(labels) + 1;
    members.begin.assign(count + 1, 0);
    for (const uint32_t label : labels) ++members.begin[label + 1];
    for (uint32_t c = 0; c < count; ++c) members.begin[c + 1] += members.begin[c];
    std::vector<uint32_t> next(members.begin.begin(), members.begin.end() - 1);
    members.strands.resize(labels.size());
    for (uint32_t i = 0; i < labels.size(); ++i) members.strands[next[labels[i]]++] = i;
    return members;
}

/// A rectangle's side: `metres` at this density, a multiple of the alignment.
uint32_t side(double metres, double density) {
    const double steps = std::ceil(metres * density / kCardAlignment - 1e-9);
    return static_cast<uint32_t>(std::clamp(steps, 1.0, 1024.0)) * kCardAlignment;
}

glm::uvec2 card_size(const Ribbon& ribbon, double density, double along_ratio) {
    float half_width = 0.0f;
    for (const RibbonRow& row : ribbon.rows) half_width = std::max(half_width, row.half_width);
    return {side(2.0 * half_width, density), side(ribbon.length(), density * along_ratio)};
}

uint64_t texels_of(const std::vector<Ribbon>& ribbons, double density, double along_ratio) {
    uint64_t texels = 0;
    for (const Ribbon& ribbon : ribbons) {
        const glm::uvec2 size = card_size(ribbon, density, along_ratio);
        texels += uint64_t{size.x} * size.y;
    }
    return texels;
}

/// The density asked for, or the highest below it that keeps the atlas in its limit. The smallest
/// rectangles set a floor.
double choose_density(const std::vector<Ribbon>& ribbons, const StrandData& strands,
                      const CardBuildOptions& options) {
    double density = options.texels_per_metre > 0.0f
                         ? options.texels_per_metre
                         : 1.0 / std::max(static_cast<double>(strands.width), kThinnestStrand);
    while (density > 1.0 && texels_of(ribbons, density, options.along_ratio) > options.max_texels) {
        density *= 0.97;
    }
    return density;
}

void append_ribbon(const Ribbon& ribbon, glm::uvec2 corner, glm::uvec2 size, CardGroom& cards) {
    const auto first = static_cast<uint32_t>(cards.points.size());
    const glm::vec2 atlas(cards.atlas.width, cards.atlas.height);
    const glm::vec2 low = glm::vec2(corner) / atlas;
    const glm::vec2 high = glm::vec2(corner + size) / atlas;
    for (const RibbonRow& row : ribbon.rows) {
        const glm::vec3 across = row.across * row.half_width;
        cards.points.push_back(row.center - across);
        cards.points.push_back(row.center + across);
        cards.points.push_back(row.center + row.toward * row.half_thickness);
        const float fraction = row.distance / ribbon.length();
        const float v = glm::mix(low.y, high.y, fraction);
        cards.uvs.emplace_back(low.x, v);
        cards.uvs.emplace_back(high.x, v);
        cards.uvs.emplace_back(0.5f * (low.x + high.x), v);
    }
    for (uint32_t row = 0; row + 1 < ribbon.rows.size(); ++row) {
        const uint32_t a = first + 3 * row;
        cards.triangles.emplace_back(a, a + 3, a + 1);
        cards.triangles.emplace_back(a + 1, a + 3, a + 4);
    }
}

template <class T>
void copy_rows(const std::vector<T>& from, uint32_t width, std::vector<T>& to, uint32_t to_width,
               glm::uvec2 corner) {
    for (size_t row = 0; row * width < from.size(); ++row) {
        std::copy_n(from.begin() + static_cast<ptrdiff_t>(row * width), width,
                    to.begin() + static_cast<ptrdiff_t>((corner.y + row) * to_width + corner.x));
    }
}

void place(const CardAtlas& card, glm::uvec2 corner, CardAtlas& atlas) {
    copy_rows(card.opacity, card.width, atlas.opacity, atlas.width, corner);
    copy_rows(card.depth, card.width, atlas.depth, atlas.width, corner);
    copy_rows(card.parameter, card.width, atlas.parameter, atlas.width, corner);
    copy_rows(card.tangent, card.width, atlas.tangent, atlas.width, corner);
    copy_rows(card.strand, card.width, atlas.strand, atlas.width, corner);
    copy_rows(card.fibres, card.width, atlas.fibres, atlas.width, corner);
    copy_rows(card.color, card.width, atlas.color, atlas.width, corner);
}

void clear(glm::uvec2 size, bool colored, CardAtlas& atlas) {
    atlas.width = size.x;
    atlas.height = size.y;
    atlas.opacity.assign(atlas.texels(), 0);
    atlas.depth.assign(atlas.texels(), 128);
    atlas.parameter.assign(atlas.texels(), 0);
    atlas.tangent.assign(atlas.texels(), glm::u8vec3(128, 255, 128));
    atlas.strand.assign(atlas.texels(), 0);
    atlas.fibres.assign(atlas.texels(), 0);
    if (colored) atlas.color.assign(atlas.texels(), glm::u8vec3(255));
}

constexpr size_t kMostInAll = 65536;

Result<void> check(const StrandData& strands, const CardBuildOptions& options) {
    const auto outside = [](const char* name, double value, const char* range) {
        return Error{fmt::format("{} is {}", name, value), "cards", fmt::format("give {}", range)};
    };
    if (strands.strand_count() == 0) {
        return Error{"the groom has no strands", "cards", "build cards from a groom with strands"};
    }
    if (options.cards > kMostInAll) {
        return outside("count", options.cards, "1 to 65536, or 0 to have it chosen");
    }
    if (!(options.texels_per_metre >= 0.0f && options.texels_per_metre <= 1e6f)) {
        return outside("texels per metre", options.texels_per_metre, "0 to 1e6");
    }
    if (!(options.along_ratio >= 0.01f && options.along_ratio <= 1.0f)) {
        return outside("along ratio", options.along_ratio, "0.01 to 1");
    }
    if (options.max_texels < 256 || options.max_texels > 1U << 27U) {
        return outside("max texels", options.max_texels, "256 to 134217728");
    }
    if (options.samples < 1 || options.samples > 16) {
        return outside("samples", options.samples, "1 to 16");
    }
    if (options.max_rows < 2 || options.max_rows > 64) {
        return outside("max rows", options.max_rows, "2 to 64");
    }
    if (!(options.tolerance > 0.0f)) {
        return outside("tolerance", options.tolerance, "a number above 0");
    }
    return {};
}

/// Cards of most styles, 0.01 to 0.02 thick at this count.
constexpr uint32_t kFewCards = 300;
/// Curls are 0.03 thick, the stiff locks of a mohawk 0.05 and short hair 0.10: their outlines want
/// more.
constexpr float kThick = 0.025f;
/// Of a braid 1.8 and of a ponytail 2.1, whose cards at the tie cover a head too little; of all
/// hair that hangs at most 1.1.
constexpr float kGathered = 1.4f;
constexpr uint32_t kSomeCards = 900;
/// Fur is 0.13 thick and coils 0.20; at the next count 0.08 and 0.05.
constexpr float kStout = 0.11f;
constexpr uint32_t kManyCards = 1200;
/// A fox's fur, which lies flat, is 0.10 thick at that count and 0.06 at the next.
constexpr float kStillStout = 0.09f;
constexpr uint32_t kMostCards = 4000;

/// Where fewer strands would share a card, each has its own: a tube around two holds neither well.
constexpr size_t kShared = 3;

/// Clusters of strands and a ribbon for each.
struct Fit {
    Members members;
    std::vector<Ribbon> ribbons;
    float stoutness = 0.0f;
    float gathering = 0.0f;
    double cluster_seconds = 0.0;
    double fit_seconds = 0.0;
};

float stoutness(const std::vector<Ribbon>& ribbons) {
    double thickness = 0.0;
    double length = 0.0;
    for (const Ribbon& ribbon : ribbons) {
        double sum = 0.0;
        for (const RibbonRow& row : ribbon.rows) sum += static_cast<double>(row.half_thickness);
        thickness += sum / static_cast<double>(ribbon.rows.size());
        length += static_cast<double>(ribbon.length());
    }
    return static_cast<float>(thickness / std::max(length, 1e-9));
}

/// How many times as wide as on average over their length cards are at their roots.
float gathering(const std::vector<Ribbon>& ribbons) {
    double sum = 0.0;
    for (const Ribbon& ribbon : ribbons) {
        const std::vector<RibbonRow>& rows = ribbon.rows;
        double area = 0.0;
        for (size_t i = 0; i + 1 < rows.size(); ++i) {
            area += static_cast<double>((rows[i].half_width + rows[i + 1].half_width) *
                                        (rows[i + 1].distance - rows[i].distance));
        }
        const auto root = static_cast<double>(rows[1].half_width);
        sum += root * 2.0 * static_cast<double>(ribbon.length()) / std::max(area, 1e-12);
    }
    return static_cast<float>(sum / static_cast<double>(ribbons.size()));
}

Fit fit_cards(const StrandData& strands, uint32_t count, const CardBuildOptions& options) {
    Fit fit;
    const double start = wall_seconds();
    fit.members = group(cluster_strands(strands, count));
    const double clustered = wall_seconds();
    fit.ribbons.resize(fit.members.count());
    const RibbonLimits limits{options.max_rows, options.tolerance, options.tip_scale};
    parallel_ranges(fit.ribbons.size(), 1, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            fit.ribbons[i] = fit_ribbon(strands, fit.members.of(i), limits);
        }
    });
    face_outwards(fit.ribbons);
    fit.stoutness = stoutness(fit.ribbons);
    fit.gathering = gathering(fit.ribbons);
    fit.cluster_seconds = clustered - start;
    fit.fit_seconds = wall_seconds() - clustered;
    return fit;
}

/// How many cards would hold the strands better than these `count`, or as many.
uint32_t better_count(uint32_t count, const Fit& fit) {
    if (count == kManyCards && fit.stoutness >= kStillStout) return kMostCards;
    if (count != kFewCards) return count;
    if (fit.stoutness >= kStout) return kManyCards;
    return fit.stoutness >= kThick || fit.gathering >= kGathered ? kSomeCards : count;
}

Fit fit_as_asked(const StrandData& strands, const CardBuildOptions& options) {
    uint32_t count = options.cards > 0 ? options.cards : kFewCards;
    Fit fit = fit_cards(strands, count, options);
    while (options.cards == 0) {
        const uint32_t better = better_count(count, fit);
        if (better == count) break;
        count = strands.strand_count() < kShared * better
                    ? static_cast<uint32_t>(std::min(strands.strand_count(), kMostInAll))
                    : better;
        Fit next = fit_cards(strands, count, options);
        next.cluster_seconds += fit.cluster_seconds;
        next.fit_seconds += fit.fit_seconds;
        fit = std::move(next);
    }
    return fit;
}

void bake_all(const StrandData& strands, const Members& members, const std::vector<Ribbon>& ribbons,
              const std::vector<glm::uvec2>& sizes, const CardBuildOptions& options,
              CardGroom& cards) {
    const Packing packing = pack_shelves(sizes);
    clear(packing.size, !strands.point_color.empty(), cards.atlas);
    // Cards own disjoint texels, so no core waits for another.
    parallel_ranges(ribbons.size(), 1, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const BakeSettings settings{sizes[i], options.samples, options.tip_scale};
            place(bake_card(strands, members.of(i), ribbons[i], settings), packing.corners[i],
                  cards.atlas);
        }
    });
    for (size_t i = 0; i < ribbons.size(); ++i) {
        append_ribbon(ribbons[i], packing.corners[i], sizes[i], cards);
    }
    derive_columns(cards);
}

}  // namespace

std::string to_text(const CardReport& report) {
    return fmt::format(
        "{} strands -> {} cards, {} triangles, atlas {} x {} ({:.0f} texels per metre across), "
        "{:.1f} MiB, half thickness {:.2f} of length, roots {:.1f} times as wide; clustered in "
        "{:.2f} s, fitted in {:.2f} s, "
        "baked in {:.2f} s",
        report.strands, report.cards, report.triangles, report.atlas_size.x, report.atlas_size.y,
        report.texels_per_metre, static_cast<double>(report.bytes) / (1U << 20U), report.stoutness,
        report.gathering, report.cluster_seconds, report.fit_seconds, report.bake_seconds);
}

Result<CardBuild> build_cards(const StrandData& strands, const CardBuildOptions& options) {
    if (auto checked = check(strands, options); !checked) return checked.error();
    CardBuild build;
    build.cards.ribbons = true;
    if (strands.has_color && strands.point_color.empty()) {
        build.cards.color = glm::clamp(glm::vec3(strands.color), 0.0f, 1.0f);
    }
    const Fit fit = fit_as_asked(strands, options);
    const std::vector<Ribbon>& ribbons = fit.ribbons;
    const double fitted = wall_seconds();
    const double density = choose_density(ribbons, strands, options);
    std::vector<glm::uvec2> sizes;
    sizes.reserve(ribbons.size());
    for (const Ribbon& ribbon : ribbons) {
        sizes.push_back(card_size(ribbon, density, options.along_ratio));
    }
    bake_all(strands, fit.members, ribbons, sizes, options, build.cards);
    build.report = {.strands = strands.strand_count(),
                    .cards = build.cards.card_count(),
                    .stoutness = fit.stoutness,
                    .gathering = fit.gathering,
                    .triangles = build.cards.triangles.size(),
                    .atlas_size = {build.cards.atlas.width, build.cards.atlas.height},
                    .texels_per_metre = static_cast<float>(density),
                    .cluster_seconds = fit.cluster_seconds,
                    .fit_seconds = fit.fit_seconds,
                    .bake_seconds = wall_seconds() - fitted,
                    .bytes = build.cards.bytes()};
    return build;
}

}  // namespace vellus::hair
