#pragma once

#include <string_view>

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/types.h"

namespace vellus::graph {

class PassContext;

enum class ResourceKind : uint8_t { kImage, kBuffer };

/// Who owns the memory and how long the content lives.
enum class Origin : uint8_t { kTransient, kImported, kHistoryPrevious, kHistoryNext };

struct ResourceRecord {
    std::string_view name;
    ResourceKind kind = ResourceKind::kImage;
    Target target = Target::kColorImage;
    Origin origin = Origin::kTransient;
    Access before = Access::kNone;
    Access after = Access::kNone;
    bool filled = false;                ///< has content before any pass
    bool restart = false;               ///< history only
    uint32_t partner = kNoIndex;        ///< history only: the other resource of the pair
    uint32_t first_version = kNoIndex;  ///< the content before any pass
    uint32_t last_version = kNoIndex;
    ImageDesc image{};
    BufferDesc buffer{};
    void* external = nullptr;   ///< gpu::Image* or gpu::Buffer*
    uint64_t native_image = 0;  ///< VkImage, where there is no gpu::Image
    uint64_t native_view = 0;
    SourceLine where;
    ImageRange all{0, 1, 0, 1};      ///< every subresource
    uint32_t usage = 0;              ///< VkImageUsageFlags or VkBufferUsageFlags of all accesses
    uint32_t first_pass = kNoIndex;  ///< that accesses it
    uint32_t last_pass = kNoIndex;
};

/// All reads of one version, so that one barrier serves them all.
struct Readers {
    uint32_t stages = 0;
    uint32_t access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool mixed_layouts = false;

    void add(const AccessInfo& how) {
        mixed_layouts |= stages != 0 && layout != how.layout;
        layout = how.layout;
        stages |= how.stages;
        access |= how.access;
    }
};

/// One value of a resource. The chain previous/next orders the writers.
struct VersionRecord {
    uint32_t resource = kNoIndex;
    uint32_t writer = kNoIndex;    ///< pass; kNoIndex: the content before any pass
    uint32_t previous = kNoIndex;  ///< version
    uint32_t next = kNoIndex;      ///< version
    uint32_t number = 0;           ///< counts from 0 per resource, for messages
    Readers readers;
};

struct PassRecord {
    std::string_view name;
    PassKind kind = PassKind::kCompute;
    bool side_effect = false;
    uint8_t colors = 0;  ///< attachments; kRaster only
    uint8_t depths = 0;
    uint32_t width = 0;  ///< of the attachments, pixels
    uint32_t height = 0;
    uint32_t first_access = 0;  ///< into accesses()
    uint32_t access_count = 0;
    const void* closure = nullptr;
    void (*record)(const void* closure, PassContext& context) = nullptr;
    SourceLine where;
};

struct AccessRecord {
    uint32_t pass = kNoIndex;
    uint32_t resource = kNoIndex;
    uint32_t version = kNoIndex;  ///< the one read, or the one produced
    uint32_t clear = kNoIndex;    ///< into clears()
    ImageRange range{};           ///< resolved: no kAll
    Access access = Access::kNone;
    bool write = false;
    Load load = Load::kKeep;
    bool image = false;  ///< or buffer
    bool whole = true;   ///< the range is all of the resource
    SourceLine where;
};

struct OutputRecord {
    uint32_t version = kNoIndex;
    SourceLine where;
};

}  // namespace vellus::graph
