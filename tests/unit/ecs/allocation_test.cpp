// A schedule that has settled must not touch the heap: this program counts every `new`.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "engine/ecs/ecs.h"

namespace {

std::atomic<size_t> allocations{0};

void* counted(size_t size, size_t alignment) {
    ++allocations;
    void* const memory =
        std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) std::abort();
    return memory;
}

}  // namespace

// Not inlined, or GCC warns where it sees free() take what new gave.
[[gnu::noinline]] void* operator new(size_t size) {
    return counted(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace vellus {
namespace {

struct Position {
    float x;
};
struct Velocity {
    float x;
};
struct Spark {
    int frames_left;
};
struct Burning {};

TEST(Allocation, ASettledScheduleDoesNotAllocate) {
    World world;
    world.spawn_many<Position, Velocity>(1000);
    Schedule schedule;
    schedule.add("move", [](Query<Position, const Velocity> bodies) {
        bodies.each([](Position& p, const Velocity& v) { p.x += v.x; });
    });
    schedule.add("spawn", [](Commands& commands) {
        for (int i = 0; i < 10; ++i) commands.add(commands.spawn(Spark{3}), Burning{});
    });
    schedule
        .add("age",
             [](Query<Entity, Spark> sparks, Commands& commands) {
                 sparks.each([&](Entity e, Spark& spark) {
                     if (--spark.frames_left == 0) commands.destroy(e);
                 });
             })
        .after("spawn");
    schedule
        .add(
            "count",
            [](Query<const Position> bodies) { bodies.parallel_each([](const Position&) {}, 100); })
        .after("move");
    ASSERT_TRUE(schedule.build(world));
    for (int run = 0; run < 50; ++run) schedule.run(world);
    const size_t before = allocations.load();
    for (int run = 0; run < 500; ++run) schedule.run(world);
    EXPECT_EQ(allocations.load() - before, 0U);
    EXPECT_EQ((world.query<Spark, With<Burning>>().count()), 20U);
}

}  // namespace
}  // namespace vellus
