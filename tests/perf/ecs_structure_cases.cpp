#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <utility>

#include "engine/ecs/ecs.h"
#include "tests/perf/ecs_baseline.h"
#include "tests/perf/ecs_cases.h"

namespace vellus::bench {
namespace {

using Hand = HandWorld<Health, Position, Velocity>;
using HandOfFour = HandWorld<Health, Position, Velocity, Mass>;

Position position_of(size_t i) {
    return {static_cast<float>(i), 1, 2};
}
Velocity velocity_of(size_t i) {
    return {3, static_cast<float>(i), 4};
}

bool is(const Position* p, const Velocity* v, size_t i) {
    const auto value = static_cast<float>(i);
    return p != nullptr && v != nullptr && p->x == value && p->y == 1 && p->z == 2 && v->x == 3 &&
           v->y == value && v->z == 4;
}

/// The two worlds' entities, and the order in which the timed work visits them.
struct Structure {
    size_t count;
    std::vector<size_t> order;
    World world;
    std::vector<Entity> entities;
    Hand hand;
    HandOfFour hand_of_four;
    std::vector<HandHandle> handles;

    Structure(size_t entity_count, bool shuffled) : count(entity_count), order(entity_count) {
        std::iota(order.begin(), order.end(), size_t{0});
        if (shuffled) std::shuffle(order.begin(), order.end(), std::mt19937_64(7));
        entities.resize(count);
        handles.resize(count);
    }
};

/// Each run starts from a new Structure, made outside of the timed part.
template <class Prepare, class Work, class Verify>
std::function<Timed()> side(size_t count, bool shuffled, Prepare prepare, Work work,
                            Verify verify) {
    return [=] {
        const auto state = std::make_unique<Structure>(count, shuffled);
        prepare(*state);
        const double seconds = seconds_of([&] { work(*state); });
        bool good = true;
        for (size_t i = 0; i < count; ++i) good &= verify(*state, i);
        return Timed{seconds, good};
    };
}

void nothing(Structure&) {}

void create(Structure& s) {
    for (size_t i = 0; i < s.count; ++i) {
        s.entities[i] = s.world.spawn(position_of(i), velocity_of(i));
    }
}
void create_by_hand(Structure& s) {
    for (size_t i = 0; i < s.count; ++i) {
        s.handles[i] = s.hand.create(position_of(i), velocity_of(i));
    }
}
void create_extended(Structure& s) {
    create(s);
    for (const Entity entity : s.entities) s.world.add(entity, Health{5});
}
void create_extended_by_hand(Structure& s) {
    create_by_hand(s);
    for (const HandHandle handle : s.handles) s.hand.add(handle, {5});
}

bool is_plain(const Structure& s, size_t i) {
    const Entity e = s.entities[i];
    return is(s.world.get<Position>(e), s.world.get<Velocity>(e), i) && !s.world.has<Health>(e);
}
bool is_plain_by_hand(Structure& s, size_t i) {
    const HandHandle h = s.handles[i];
    return is(s.hand.get<Position>(h), s.hand.get<Velocity>(h), i) &&
           !s.hand.slots[h.index].extended;
}

EcsCase creation(size_t count) {
    return {2.0, count, side(count, false, nothing, create, is_plain),
            side(count, false, nothing, create_by_hand, is_plain_by_hand)};
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): clang 14 loses std::function's heap

EcsCase bulk_creation(size_t count) {
    const auto fill = [](size_t i, Position& p, Velocity& v) {
        p = position_of(i);
        v = velocity_of(i);
    };
    // On both sides the handles are in index order, so verification can make them up.
    const auto vellus = side(
        count, false, nothing,
        [=](Structure& s) { s.world.spawn_many<Position, Velocity>(s.count, fill); },
        [](Structure& s, size_t i) {
            s.entities[i] = {static_cast<uint32_t>(i), 1};
            return is_plain(s, i);
        });
    const auto by_hand = side(
        count, false, nothing,
        [=](Structure& s) { s.hand.create_many(static_cast<uint32_t>(s.count), fill); },
        [](Structure& s, size_t i) {
            s.handles[i] = {static_cast<uint32_t>(i), 0};
            return is_plain_by_hand(s, i);
        });
    return {1.0, count, vellus, by_hand};
}

EcsCase addition(size_t count, bool shuffled) {
    const auto vellus = side(
        count, shuffled, create,
        [](Structure& s) {
            for (const size_t i : s.order) {
                s.world.add(s.entities[i], Health{static_cast<int32_t>(i)});
            }
        },
        [](Structure& s, size_t i) {
            const Entity e = s.entities[i];
            const Health* const health = s.world.get<Health>(e);
            return is(s.world.get<Position>(e), s.world.get<Velocity>(e), i) && health != nullptr &&
                   health->points == static_cast<int32_t>(i);
        });
    const auto by_hand = side(
        count, shuffled, create_by_hand,
        [](Structure& s) {
            for (const size_t i : s.order) s.hand.add(s.handles[i], {static_cast<int32_t>(i)});
        },
        [](Structure& s, size_t i) {
            const HandHandle h = s.handles[i];
            const auto& slot = s.hand.slots[h.index];
            return is(s.hand.get<Position>(h), s.hand.get<Velocity>(h), i) && slot.extended &&
                   s.hand.extended.column<Health>()[slot.row].points == static_cast<int32_t>(i);
        });
    return {1.5, count, vellus, by_hand};
}

EcsCase removal(size_t count, bool shuffled) {
    const auto vellus = side(
        count, shuffled, create_extended,
        [](Structure& s) {
            for (const size_t i : s.order) s.world.remove<Health>(s.entities[i]);
        },
        is_plain);
    const auto by_hand = side(
        count, shuffled, create_extended_by_hand,
        [](Structure& s) {
            for (const size_t i : s.order) s.hand.remove(s.handles[i]);
        },
        is_plain_by_hand);
    return {1.5, count, vellus, by_hand};
}

/// Destroys all but each tenth entity, so that what must survive is checked too.
EcsCase destruction(size_t count, bool shuffled) {
    const auto survives = [](size_t i) { return i % 10 == 0; };
    const auto vellus = side(
        count, shuffled,
        [](Structure& s) {
            for (size_t i = 0; i < s.count; ++i) {
                s.entities[i] = s.world.spawn(position_of(i), velocity_of(i), Mass{1}, Health{2});
            }
        },
        [=](Structure& s) {
            for (const size_t i : s.order) {
                if (!survives(i)) s.world.destroy(s.entities[i]);
            }
        },
        [=](Structure& s, size_t i) {
            const Entity e = s.entities[i];
            if (!survives(i)) return !s.world.alive(e);
            return is(s.world.get<Position>(e), s.world.get<Velocity>(e), i);
        });
    const auto by_hand = side(
        count, shuffled,
        [](Structure& s) {
            for (size_t i = 0; i < s.count; ++i) {
                s.handles[i] = s.hand_of_four.create(position_of(i), velocity_of(i), Mass{1});
                s.hand_of_four.add(s.handles[i], {2});
            }
        },
        [=](Structure& s) {
            for (const size_t i : s.order) {
                if (!survives(i)) s.hand_of_four.destroy(s.handles[i]);
            }
        },
        [=](Structure& s, size_t i) {
            const HandHandle h = s.handles[i];
            if (!survives(i)) return !s.hand_of_four.alive(h);
            return is(s.hand_of_four.get<Position>(h), s.hand_of_four.get<Velocity>(h), i);
        });
    return {2.0, count - count / 10, vellus, by_hand};
}

EcsCase random_get(size_t count) {
    const auto visited = [](const Position* p, size_t i) {
        return p != nullptr && p->x == static_cast<float>(i) && p->y == 2;
    };
    const auto vellus = side(
        count, true,
        [](Structure& s) {
            create(s);
            std::shuffle(s.entities.begin(), s.entities.end(), std::mt19937_64(9));
        },
        [](Structure& s) {
            for (const Entity entity : s.entities) {
                if (Position* const p = s.world.get<Position>(entity)) p->y += 1;
            }
        },
        [=](Structure& s, size_t i) {
            return visited(s.world.get<Position>({static_cast<uint32_t>(i), 1}), i);
        });
    const auto by_hand = side(
        count, true,
        [](Structure& s) {
            create_by_hand(s);
            std::shuffle(s.handles.begin(), s.handles.end(), std::mt19937_64(9));
        },
        [](Structure& s) {
            for (const HandHandle handle : s.handles) {
                if (Position* const p = s.hand.get<Position>(handle)) p->y += 1;
            }
        },
        [=](Structure& s, size_t i) {
            return visited(s.hand.get<Position>({static_cast<uint32_t>(i), 0}), i);
        });
    return {1.5, count, vellus, by_hand};
}

}  // namespace

std::vector<EcsCaseMaker> structure_cases(bool quick) {
    const size_t count = quick ? 50'000 : 1'000'000;
    std::vector<EcsCaseMaker> makers{
        // clang 14 loses std::function's heap.
        // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
        {"create 2 components", [=] { return creation(count); }},
        {"create 2 components in bulk", [=] { return bulk_creation(count); }}};
    for (const bool shuffled : {false, true}) {
        const char* const order = shuffled ? "shuffled" : "in order";
        makers.push_back(
            {fmt::format("add 1 component, {}", order), [=] { return addition(count, shuffled); }});
        makers.push_back({fmt::format("remove 1 component, {}", order),
                          [=] { return removal(count, shuffled); }});
        makers.push_back({fmt::format("destroy 4 components, {}", order),
                          [=] { return destruction(count, shuffled); }});
    }
    makers.push_back({"random get", [=] { return random_get(count); }});
    return makers;
}

}  // namespace vellus::bench
