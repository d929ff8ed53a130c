#include "engine/ecs/commands.h"

#include <algorithm>

namespace vellus {
namespace {

constexpr size_t kBlockSize = size_t{16} * 1024;

}  // namespace

Commands::~Commands() {
    run_all(nullptr);
}

void Commands::destroy(Entity entity) {
    record([entity](World& world, Commands& self) { world.destroy(self.resolve(entity)); });
}

void Commands::apply(World& world) {
    run_all(&world);
    for (Block& block : blocks_) block.used = 0;
    block_ = 0;
    pending_ = 0;
    spawned_.clear();
}

std::byte* Commands::allocate(size_t size) {
    while (block_ < blocks_.size() && blocks_[block_].capacity - blocks_[block_].used < size) {
        ++block_;
    }
    if (block_ == blocks_.size()) {
        const size_t capacity = std::max(kBlockSize, size);
        auto* memory = static_cast<std::byte*>(::operator new(capacity, kBlockAlignment));
        blocks_.push_back({std::unique_ptr<std::byte, FreeBlock>(memory), capacity, 0});
    }
    Block& block = blocks_[block_];
    std::byte* const place = block.memory.get() + block.used;
    block.used += size;
    return place;
}

void Commands::run_all(World* world) {
    for (Block& block : blocks_) {
        for (size_t at = 0; at < block.used;) {
            std::byte* const place = block.memory.get() + at;
            const auto* header = std::launder(reinterpret_cast<const Header*>(place));
            at += header->size;
            header->run(place, world, *this);
        }
    }
}

Entity Commands::resolve(Entity entity) const noexcept {
    const bool pending = entity.generation == 0 && entity.index < spawned_.size();
    return pending ? spawned_[entity.index] : entity;
}

}  // namespace vellus
