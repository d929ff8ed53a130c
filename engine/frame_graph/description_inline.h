#pragma once

// What every pass of every frame calls, in the header so that the caller's constants fold into it.
// Records are filled in where they lie: building them elsewhere and copying costs more than the
// rest. Included by description.h.

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/description.h"

namespace vellus::graph {

inline ResourceRecord& GraphDescription::add_resource(std::string_view name, Where where) {
    const auto version = static_cast<uint32_t>(versions_.size());
    versions_.emplace_back().resource = static_cast<uint32_t>(resources_.size());
    ResourceRecord& resource = resources_.emplace_back();
    resource.name = name;
    resource.first_version = version;
    resource.last_version = version;
    resource.where = where;
    return resource;
}

template <class H>
H GraphDescription::first_handle(const ResourceRecord& resource) const {
    H handle;
    handle.index = static_cast<uint32_t>(resources_.size() - 1);
    handle.version = resource.first_version;
    handle.generation = generation_;
    return handle;
}

inline ImageHandle GraphDescription::create_image(std::string_view name, const ImageDesc& desc,
                                                  Where where) {
    ResourceRecord& resource = add_resource(name, where);
    resource.image = desc;
    const auto handle = first_handle<ImageHandle>(resource);
    if (desc.format == gpu::Format::kUndefined || desc.width == 0 || desc.height == 0 ||
        desc.layers == 0 || desc.mips == 0) {
        report(Problem::kUnsupportedFormat, kNoIndex, handle.index, where);
    }
    return handle;
}

inline BufferHandle GraphDescription::create_buffer(std::string_view name, const BufferDesc& desc,
                                                    Where where) {
    ResourceRecord& resource = add_resource(name, where);
    resource.kind = ResourceKind::kBuffer;
    resource.buffer = desc;
    const auto handle = first_handle<BufferHandle>(resource);
    if (desc.bytes == 0) report(Problem::kUnsupportedFormat, kNoIndex, handle.index, where);
    return handle;
}

inline PassBuilder GraphDescription::add_pass(std::string_view name, PassKind kind, Where where) {
    const auto index = static_cast<uint32_t>(passes_.size());
    PassRecord& pass = passes_.emplace_back();
    pass.name = name;
    pass.kind = kind;
    pass.first_access = static_cast<uint32_t>(accesses_.size());
    pass.where = where;
    return {this, index};
}

inline AccessRecord& GraphDescription::add_access(uint32_t pass) {
    if (pass + 1 != passes_.size()) return insert_access(pass);
    ++passes_[pass].access_count;
    return accesses_.emplace_back();
}

/// The version that the pass makes of this one.
inline uint32_t GraphDescription::add_version(uint32_t pass, const Handle& handle, Where where) {
    const auto version = static_cast<uint32_t>(versions_.size());
    VersionRecord& made = versions_.emplace_back();
    VersionRecord& before = versions_[handle.version];
    if (before.next != kNoIndex) {
        report(Problem::kTwoWriters, pass, handle.index, where, versions_[before.next].writer);
    }
    before.next = version;
    made.resource = handle.index;
    made.writer = pass;
    made.previous = handle.version;
    made.number = before.number + 1;
    resources_[handle.index].last_version = version;
    return version;
}

[[gnu::always_inline]] inline uint32_t GraphDescription::touch(uint32_t pass, const Handle& handle,
                                                               Access access, bool write,
                                                               const ImageRange& range, Load load,
                                                               const LoadOp* clear, Where where) {
    if (!check(handle, pass, where)) return handle.version;
    const ResourceRecord& resource = resources_[handle.index];
    const AccessInfo& how = info(access);
    if (versions_[handle.version].writer == kNoIndex && resource.before == Access::kNone &&
        resource.origin != Origin::kHistoryPrevious) {
        const bool loads_attachment = load == Load::kKeep && (access == Access::kColorAttachment ||
                                                              access == Access::kDepthAttachment);
        if (how.reads || !write || loads_attachment) {
            report(Problem::kReadNeverWritten, pass, handle.index, where);
        }
    }
    if (write != how.writes) report(Problem::kUnsupportedUsage, pass, handle.index, where);

    const uint32_t version = write ? add_version(pass, handle, where) : handle.version;
    AccessRecord& record = add_access(pass);
    record.pass = pass;
    record.resource = handle.index;
    record.version = version;
    record.access = access;
    record.write = write;
    record.load = load;
    record.where = where;
    if (load == Load::kClear) {
        record.clear = static_cast<uint32_t>(clears_.size());
        clears_.push_back(clear ? *clear : LoadOp{load, {}});
    }
    record.image = resource.kind == ResourceKind::kImage;
    if (!record.image) {
        record.range = {0, 1, 0, 1};
        return version;
    }
    const ImageDesc& desc = resource.image;
    const auto rest = [](uint16_t count, uint32_t all, uint16_t first) {
        return count == ImageRange::kAll ? static_cast<uint16_t>(all - first) : count;
    };
    const uint16_t mips = rest(range.mips, desc.mips, range.mip);
    const uint16_t layers = rest(range.layers, desc.layers, range.layer);
    record.range = {range.mip, mips, range.layer, layers};
    record.whole = mips == desc.mips && layers == desc.layers;
    return version;
}

inline void PassBuilder::read(ImageHandle image, Access access, const ImageRange& range,
                              Where where) {
    graph_->touch(pass_, image, access, false, range, Load::kKeep, nullptr, where);
}

inline void PassBuilder::read(BufferHandle buffer, Access access, Where where) {
    graph_->touch(pass_, buffer, access, false, {}, Load::kKeep, nullptr, where);
}

inline ImageHandle PassBuilder::write(ImageHandle image, Access access, const ImageRange& range,
                                      Load load, Where where) {
    image.version = graph_->touch(pass_, image, access, true, range, load, nullptr, where);
    return image;
}

inline BufferHandle PassBuilder::write(BufferHandle buffer, Access access, Load load, Where where) {
    buffer.version = graph_->touch(pass_, buffer, access, true, {}, load, nullptr, where);
    return buffer;
}

inline ImageHandle PassBuilder::color(ImageHandle image, const LoadOp& load,
                                      const ImageRange& range, Where where) {
    image.version =
        graph_->touch(pass_, image, Access::kColorAttachment, true, range, load.op, &load, where);
    return image;
}

inline ImageHandle PassBuilder::depth(ImageHandle image, const LoadOp& load,
                                      const ImageRange& range, Where where) {
    image.version =
        graph_->touch(pass_, image, Access::kDepthAttachment, true, range, load.op, &load, where);
    return image;
}

}  // namespace vellus::graph
