#include "modules/scene/transform.h"

#include <algorithm>

#include "engine/platform/jobs.h"
#include "engine/platform/log.h"

namespace vellus::scene {
namespace {

constexpr size_t kGrain = 512;
constexpr uint32_t kUnset = ~0U;

/// Copies the rows' entities and parents; true where they differ from last frame's.
bool gather(const TransformQuery& query, Hierarchy& h) {
    const size_t count = query.count();
    bool changed = h.entities.size() != count;
    h.entities.resize(count);
    h.parents.resize(count);
    h.world.resize(count);
    size_t row = 0;
    query.each([&](Entity entity, const LocalTransform&, const Parent* parent, WorldTransform&,
                   PreviousWorldTransform&) {
        const Entity up = parent == nullptr ? kNoEntity : parent->entity;
        changed |= h.entities[row] != entity || h.parents[row] != up;
        h.entities[row] = entity;
        h.parents[row] = up;
        ++row;
    });
    return changed;
}

void find_parent_rows(Hierarchy& h) {
    const auto count = static_cast<uint32_t>(h.entities.size());
    uint32_t slots = 0;
    for (const Entity entity : h.entities) slots = std::max(slots, entity.index + 1);
    std::vector<uint32_t> row_of(slots, kUnset);
    for (uint32_t row = 0; row < count; ++row) row_of[h.entities[row].index] = row;
    h.parent_row.resize(count);
    for (uint32_t row = 0; row < count; ++row) {
        const Entity up = h.parents[row];
        const uint32_t found = up.index < slots ? row_of[up.index] : kUnset;
        const bool alive = found != kUnset && h.entities[found] == up;
        h.parent_row[row] = alive ? found : row;
    }
}

/// Depth of every row; a row on a cycle loses its parent.
std::vector<uint32_t> find_depths(Hierarchy& h) {
    const auto count = static_cast<uint32_t>(h.entities.size());
    std::vector<uint32_t> depth(count, kUnset);
    std::vector<uint32_t> visited_by(count, kUnset);
    std::vector<uint32_t> chain;
    for (uint32_t start = 0; start < count; ++start) {
        uint32_t row = start;
        while (depth[row] == kUnset && h.parent_row[row] != row) {
            if (visited_by[row] == start) {
                log_error("scene: entity {} is its own ancestor; it becomes a root",
                          h.entities[row].index);
                h.parent_row[row] = row;
                break;
            }
            visited_by[row] = start;
            chain.push_back(row);
            row = h.parent_row[row];
        }
        if (depth[row] == kUnset) depth[row] = 0;
        for (; !chain.empty(); chain.pop_back()) {
            const uint32_t below = chain.back();
            if (h.parent_row[below] != below) depth[below] = depth[h.parent_row[below]] + 1;
        }
    }
    return depth;
}

/// Counting sort of the rows by depth.
void sort_by_depth(Hierarchy& h, const std::vector<uint32_t>& depth) {
    uint32_t deepest = 0;
    for (const uint32_t d : depth) deepest = std::max(deepest, d);
    h.levels.assign(depth.empty() ? 1 : deepest + 2, 0);
    for (const uint32_t d : depth) ++h.levels[d + 1];
    for (size_t i = 1; i < h.levels.size(); ++i) h.levels[i] += h.levels[i - 1];
    std::vector<uint32_t> next(h.levels.begin(), h.levels.end());
    h.order.resize(depth.size());
    for (uint32_t row = 0; row < depth.size(); ++row) h.order[next[depth[row]]++] = row;
}

void rebuild(Hierarchy& h) {
    find_parent_rows(h);
    sort_by_depth(h, find_depths(h));
    ++h.rebuilds;
}

}  // namespace

glm::dmat4 to_matrix(const LocalTransform& transform) {
    glm::dmat4 matrix = glm::mat4_cast(glm::normalize(glm::dquat(transform.rotation)));
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= static_cast<double>(transform.scale[axis]);
    matrix[3] = glm::dvec4(transform.translation, 1.0);
    return matrix;
}

void propagate_transforms(TransformQuery query, Res<Hierarchy> hierarchy) {
    Hierarchy& h = *hierarchy;
    if (gather(query, h)) rebuild(h);
    // Chunks come in row order, so a running row number ties them to the columns.
    size_t base = 0;
    query.each_chunk([&](std::span<const Entity>, std::span<const LocalTransform> locals,
                         std::span<const Parent>, std::span<WorldTransform>,
                         std::span<PreviousWorldTransform>) {
        parallel_ranges(locals.size(), kGrain, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) h.world[base + i] = to_matrix(locals[i]);
        });
        base += locals.size();
    });
    for (size_t level = 1; level + 1 < h.levels.size(); ++level) {
        const uint32_t begin = h.levels[level];
        parallel_ranges(h.levels[level + 1] - begin, kGrain, [&](size_t first, size_t last) {
            for (size_t i = begin + first; i < begin + last; ++i) {
                const uint32_t row = h.order[i];
                h.world[row] = h.world[h.parent_row[row]] * h.world[row];
            }
        });
    }
    base = 0;
    query.each_chunk([&](std::span<const Entity>, std::span<const LocalTransform>,
                         std::span<const Parent>, std::span<WorldTransform> worlds,
                         std::span<PreviousWorldTransform> previous) {
        parallel_ranges(worlds.size(), kGrain, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                const glm::dmat4& now = h.world[base + i];
                previous[i].matrix = previous[i].known ? worlds[i].matrix : now;
                previous[i].known = true;
                worlds[i].matrix = now;
            }
        });
        base += worlds.size();
    });
}

}  // namespace vellus::scene
