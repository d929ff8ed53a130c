#pragma once

// Images kept from one frame to the next; internal to this folder.

#include <array>
#include <string>
#include <vector>

#include "engine/frame_graph/physical.h"

namespace vellus::graph {

class HistoryStore {
  public:
    HistoryStore(gpu::Device& device, Graveyard& graveyard)
        : device_(device), graveyard_(graveyard) {}
    ~HistoryStore();
    HistoryStore(const HistoryStore&) = delete;
    HistoryStore& operator=(const HistoryStore&) = delete;

    /// Fills in the history resources of `physical`; images whose content must become zero before
    /// the frame are appended to `clears`.
    Result<void> bind(const GraphDescription& graph, const Plan& plan, uint64_t frame,
                      std::vector<Physical>& physical, std::vector<uint32_t>& clears);
    /// The frame was submitted: what it wrote is the next frame's history.
    void advance(const GraphDescription& graph, const Plan& plan, uint64_t frame);
    /// Gives up what is no longer described.
    void trim(uint64_t frame);
    [[nodiscard]] uint64_t created() const { return created_; }

  private:
    struct Entry {
        std::string name;
        ImageDesc desc{};
        std::array<gpu::Image, 2> images;
        std::array<std::vector<ViewOfRange>, 2> views;
        uint32_t previous = 0;
        uint64_t last_frame = 0;     ///< described
        uint64_t written_frame = 0;  ///< frame that wrote `previous`
        bool valid = false;
    };
    Entry* find(std::string_view name);
    Result<Entry*> entry_for(const ResourceRecord& resource, uint64_t frame);
    void retire(Entry& entry);

    gpu::Device& device_;
    Graveyard& graveyard_;
    std::vector<std::unique_ptr<Entry>> entries_;
    uint64_t created_ = 0;
};

}  // namespace vellus::graph
