#include "modules/hair/cards/card_columns.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vellus::hair {

namespace {

/// Sets of points that triangles join (union-find with path halving); a set's name is its smallest
/// point.
class Islands {
  public:
    explicit Islands(size_t points) : parent_(points) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    uint32_t find(uint32_t point) {
        while (parent_[point] != point) {
            parent_[point] = parent_[parent_[point]];
            point = parent_[point];
        }
        return point;
    }
    void join(uint32_t a, uint32_t b) {
        const uint32_t low = std::min(find(a), find(b));
        const uint32_t high = std::max(find(a), find(b));
        parent_[high] = low;
    }

  private:
    std::vector<uint32_t> parent_;
};

void find_ribbons(CardGroom& cards) {
    const size_t rows = cards.points.size() / 3;
    std::vector<uint8_t> joined(rows, 0);
    for (const glm::uvec3& t : cards.triangles) {
        joined[std::min({t.x, t.y, t.z}) / 3] = 1;
    }
    cards.card_begin.assign(1, 0);
    for (size_t row = 0; row < rows; ++row) {
        if (joined[row] == 0) cards.card_begin.push_back(static_cast<uint32_t>(3 * (row + 1)));
    }
}

/// Sorts points by card, in the order of each card's first point.
void find_islands(CardGroom& cards) {
    const auto count = static_cast<uint32_t>(cards.points.size());
    Islands islands(count);
    for (const glm::uvec3& t : cards.triangles) {
        islands.join(t.x, t.y);
        islands.join(t.x, t.z);
    }
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(
        order, [&](uint32_t a, uint32_t b) { return islands.find(a) < islands.find(b); });
    std::vector<uint32_t> place(count);
    std::vector<glm::vec3> points(count);
    std::vector<glm::vec2> uvs(count);
    cards.card_begin.assign(1, 0);
    for (uint32_t i = 0; i < count; ++i) {
        place[order[i]] = i;
        points[i] = cards.points[order[i]];
        uvs[i] = cards.uvs[order[i]];
        if (i > 0 && islands.find(order[i]) != islands.find(order[i - 1])) {
            cards.card_begin.push_back(i);
        }
    }
    cards.card_begin.push_back(count);
    cards.points = std::move(points);
    cards.uvs = std::move(uvs);
    for (glm::uvec3& t : cards.triangles) t = {place[t.x], place[t.y], place[t.z]};
}

void set_parameters(CardGroom& cards) {
    cards.parameters.resize(cards.points.size());
    for (size_t card = 0; card < cards.card_count(); ++card) {
        const uint32_t begin = cards.card_begin[card];
        const uint32_t end = cards.card_begin[card + 1];
        float low = cards.uvs[begin].y;
        float high = low;
        for (uint32_t i = begin; i < end; ++i) {
            low = std::min(low, cards.uvs[i].y);
            high = std::max(high, cards.uvs[i].y);
        }
        const float scale = high > low ? 65535.0f / (high - low) : 0.0f;
        for (uint32_t i = begin; i < end; ++i) {
            cards.parameters[i] =
                static_cast<uint16_t>(std::lround((cards.uvs[i].y - low) * scale));
        }
    }
}

/// The edges at each point that lead most along the card (down the atlas) and most across it.
void set_frames(CardGroom& cards) {
    cards.frames.assign(cards.points.size(), glm::uvec4(0));
    std::vector<glm::vec2> best(cards.points.size(), glm::vec2(0.0f));
    const auto offer = [&](uint32_t point, uint32_t a, uint32_t b) {
        const glm::vec2 step = cards.uvs[b] - cards.uvs[a];
        glm::uvec4& frame = cards.frames[point];
        if (std::abs(step.y) > best[point].x) {
            best[point].x = std::abs(step.y);
            frame.x = step.y > 0.0f ? a : b;
            frame.y = step.y > 0.0f ? b : a;
        }
        if (std::abs(step.x) > best[point].y) {
            best[point].y = std::abs(step.x);
            frame.z = step.x > 0.0f ? a : b;
            frame.w = step.x > 0.0f ? b : a;
        }
    };
    for (const glm::uvec3& t : cards.triangles) {
        for (int i = 0; i < 3; ++i) {
            for (int edge = 0; edge < 3; ++edge) offer(t[i], t[edge], t[(edge + 1) % 3]);
        }
    }
}

}  // namespace

void derive_columns(CardGroom& cards) {
    if (cards.ribbons) {
        find_ribbons(cards);
    } else {
        find_islands(cards);
        set_frames(cards);
    }
    set_parameters(cards);
}

}  // namespace vellus::hair
