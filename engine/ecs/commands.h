#pragma once

#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"

namespace vellus {

/// Structural changes recorded now and applied, in the order recorded, at the next sync point.
/// A system that takes `Commands&` has its own; the schedule applies them in schedule order. Not
/// to be shared between threads. Changes to an entity that is dead by then are dropped.
class Commands {
  public:
    Commands() = default;
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// A pending entity: good only for further calls on these Commands until they are applied.
    template <class... Ts>
    Entity spawn(Ts... components);
    template <class T>
    void add(Entity entity, T component);
    template <class T>
    void remove(Entity entity);
    void destroy(Entity entity);
    /// Calls `change(World&)` when its turn comes, for changes that need the real handles.
    template <class Change>
    void defer(Change change);

    /// Applies and forgets all that was recorded; keeps the memory.
    void apply(World& world);
    [[nodiscard]] bool empty() const noexcept { return blocks_.empty() || blocks_[0].used == 0; }

  private:
    static constexpr size_t kAlignment = 64;

    /// Lies in front of each recorded change. A null world means: only destroy it.
    struct Header {
        void (*run)(void* change, World* world, Commands& commands);
        size_t size;  // header and change, to the next header
    };
    struct FreeBlock {
        void operator()(std::byte* memory) const { ::operator delete(memory, kBlockAlignment); }
    };
    struct Block {
        std::unique_ptr<std::byte, FreeBlock> memory;
        size_t capacity;
        size_t used;
    };
    static constexpr std::align_val_t kBlockAlignment{kAlignment};

    template <class Change>
    void record(Change change);
    std::byte* allocate(size_t size);
    void run_all(World* world);
    [[nodiscard]] Entity resolve(Entity entity) const noexcept;

    std::vector<Block> blocks_;
    size_t block_ = 0;  // the one being filled
    uint32_t pending_ = 0;
    std::vector<Entity> spawned_;  // by pending index, while applying
};

template <class Change>
void Commands::record(Change change) {
    static_assert(alignof(Change) <= kAlignment);
    constexpr size_t kOffset = std::max(sizeof(Header), alignof(Change));
    constexpr size_t kSize = (kOffset + sizeof(Change) + kAlignment - 1) / kAlignment * kAlignment;
    std::byte* const place = allocate(kSize);
    const auto run = [](void* header, World* world, Commands& commands) {
        auto* const recorded =
            std::launder(reinterpret_cast<Change*>(static_cast<std::byte*>(header) + kOffset));
        if (world != nullptr) (*recorded)(*world, commands);
        std::destroy_at(recorded);
    };
    ::new (place) Header{run, kSize};
    ::new (place + kOffset) Change(std::move(change));
}

template <class... Ts>
Entity Commands::spawn(Ts... components) {
    record([values = std::tuple<Ts...>(std::move(components)...)](World& world,
                                                                  Commands& self) mutable {
        self.spawned_.push_back(
            std::apply([&](Ts&... each) { return world.spawn(std::move(each)...); }, values));
    });
    return {pending_++, 0};
}

template <class T>
void Commands::add(Entity entity, T component) {
    record([entity, value = std::move(component)](World& world, Commands& self) mutable {
        world.add(self.resolve(entity), std::move(value));
    });
}

template <class T>
void Commands::remove(Entity entity) {
    record([entity](World& world, Commands& self) { world.remove<T>(self.resolve(entity)); });
}

template <class Change>
void Commands::defer(Change change) {
    record([change = std::move(change)](World& world, Commands&) mutable { change(world); });
}

}  // namespace vellus
