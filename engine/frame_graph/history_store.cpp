#include "engine/frame_graph/history_store.h"

#include <algorithm>

namespace vellus::graph {

namespace {

constexpr uint64_t kPatience = 30;  // frames

bool used(const GraphDescription& graph, const Plan& plan, uint32_t resource) {
    const ResourceRecord& record = graph.resources()[resource];
    return record.partner != kNoIndex &&
           (plan.placements[resource].usage != 0 || plan.placements[record.partner].usage != 0);
}

}  // namespace

HistoryStore::~HistoryStore() {
    for (auto& entry : entries_) retire(*entry);
}

HistoryStore::Entry* HistoryStore::find(std::string_view name) {
    const auto found = std::ranges::find_if(entries_, [&](auto& e) { return e->name == name; });
    return found == entries_.end() ? nullptr : found->get();
}

void HistoryStore::retire(Entry& entry) {
    for (size_t i = 0; i < 2; ++i) {
        for (const ViewOfRange& view : entry.views[i]) {
            graveyard_.add({.frame = entry.last_frame, .view = view.view});
        }
        entry.views[i].clear();
        if (entry.images[i]) graveyard_.add(entry.last_frame, std::move(entry.images[i]));
        entry.images[i] = {};
    }
    entry.valid = false;
}

Result<HistoryStore::Entry*> HistoryStore::entry_for(const ResourceRecord& resource,
                                                     uint64_t frame) {
    Entry* entry = find(resource.name);
    if (!entry) {
        entries_.push_back(std::make_unique<Entry>());
        entry = entries_.back().get();
        entry->name = resource.name;
    }
    if (!entry->images[0] || entry->desc != resource.image) {
        retire(*entry);
        entry->desc = resource.image;
        for (gpu::Image& image : entry->images) {
            const ImageDesc& d = resource.image;
            auto made = gpu::Image::create(device_, {d.format, d.width, d.height, d.layers, d.mips},
                                           entry->name.c_str());
            if (!made) return made.error();
            image = std::move(*made);
            created_ += 2;
            graveyard_.expect();
        }
    }
    entry->last_frame = frame;
    return entry;
}

Result<void> HistoryStore::bind(const GraphDescription& graph, const Plan& plan, uint64_t frame,
                                std::vector<Physical>& physical, std::vector<uint32_t>& clears) {
    const auto resources = graph.resources();
    for (uint32_t i = 0; i < resources.size(); ++i) {
        if (resources[i].origin != Origin::kHistoryPrevious || !used(graph, plan, i)) continue;
        auto found = entry_for(resources[i], frame);
        if (!found) return found.error();
        Entry& entry = **found;
        entry.valid = entry.valid && !resources[i].restart && entry.written_frame + 1 == frame;
        if (!entry.valid && plan.placements[i].usage != 0) clears.push_back(i);
        const auto fill = [&](uint32_t resource, uint32_t slot) {
            physical[resource].image = entry.images[slot].handle();
            physical[resource].views = &entry.views[slot];
            physical[resource].history_valid = entry.valid;
        };
        fill(i, entry.previous);
        fill(resources[i].partner, entry.previous ^ 1U);
    }
    return {};
}

void HistoryStore::advance(const GraphDescription& graph, const Plan& plan, uint64_t frame) {
    const auto resources = graph.resources();
    for (uint32_t i = 0; i < resources.size(); ++i) {
        if (resources[i].origin != Origin::kHistoryNext || !used(graph, plan, i)) continue;
        Entry& entry = *find(resources[i].name);
        entry.valid = plan.placements[i].usage != 0;
        if (!entry.valid) continue;
        entry.previous ^= 1U;
        entry.written_frame = frame;
    }
}

void HistoryStore::trim(uint64_t frame) {
    std::erase_if(entries_, [&](auto& entry) {
        if (entry->last_frame + kPatience >= frame) return false;
        retire(*entry);
        return true;
    });
}

}  // namespace vellus::graph
