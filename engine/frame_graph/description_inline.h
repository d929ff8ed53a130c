#pragma once

// What every pass of every frame calls, in the header so that the caller's constants fold into it.
// Records are filled in where they lie: building them elsewhere and copying costs more than the
// rest. Included by description.h.

#include "engine/frame_graph/description.h"

namespace vellus::graph {

inline ResourceRecord& GraphDescription::add_resource(std::string_view name, Where where) {
    const auto version = versions_.size();
    versions_.append().resource = resources_.size();
    ResourceRecord& resource = resources_.append();
    resource.name = name;
    resource.first_version = version;
    resource.last_version = version;
    resource.where = where;
    return resource;
}

template <class H>
H GraphDescription::first_handle(const ResourceRecord& resource) const {
    H handle;
    handle.index = resources_.size() - 1;
    handle.version = resource.first_version;
    handle.generation = generation_;
    return handle;
}

inline ImageHandle GraphDescription::create_image(std::string_view name, const ImageDesc& desc,
                                                  Where where) {
    ResourceRecord& resource = add_resource(name, where);
    resource.image = desc;
    if (gpu::is_depth(desc.format)) resource.target = Target::kDepthImage;
    resource.all = {0, static_cast<uint16_t>(desc.mips), 0, static_cast<uint16_t>(desc.layers)};
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
    resource.target = Target::kTransientBuffer;
    resource.buffer = desc;
    const auto handle = first_handle<BufferHandle>(resource);
    if (desc.bytes == 0) report(Problem::kUnsupportedFormat, kNoIndex, handle.index, where);
    return handle;
}

inline PassBuilder GraphDescription::add_pass(std::string_view name, PassKind kind, Where where) {
    const auto index = passes_.size();
    PassRecord& pass = passes_.append();
    pass.name = name;
    pass.kind = kind;
    pass.first_access = accesses_.size();
    pass.where = where;
    return {this, index};
}

inline AccessRecord& GraphDescription::add_access(uint32_t pass) {
    if (pass + 1 != passes_.size()) return insert_access(pass);
    ++passes_[pass].access_count;
    return accesses_.append();
}

/// The version that the pass makes of this one.
inline uint32_t GraphDescription::add_version(uint32_t pass, const Handle& handle, Where where) {
    const auto version = versions_.size();
    VersionRecord& made = versions_.append();
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

/// The access suits the kind of pass and of resource; where not, inspect() says why.
[[gnu::always_inline]] inline bool suits(Access access, bool write, Load load, PassKind kind,
                                         const ResourceRecord& resource) {
    const AccessInfo& how = info(access);
    return (how.pass_kinds & access_table::bit(kind)) != 0 &&
           (how.targets & access_table::bit(resource.target)) != 0 && write == how.writes &&
           (is_attachment(access) ? resource.all.mips == 1 : load != Load::kClear);
}

/// Everything that can be wrong is seen here at the price of one branch; inspect() says what it is.
[[gnu::always_inline]] inline uint32_t GraphDescription::touch(uint32_t pass, const Handle& handle,
                                                               Access access, bool write,
                                                               const ImageRange& range, Load load,
                                                               const LoadOp* clear, Where where) {
    if (!check(handle, pass, where)) return handle.version;
    const AccessInfo& how = info(access);
    ResourceRecord& resource = resources_[handle.index];
    const bool empty = versions_[handle.version].writer == kNoIndex && !resource.filled;
    const bool loads = how.reads || !write || (is_attachment(access) && load == Load::kKeep);
    const bool doubtful = (empty && loads) || resource.last_pass == pass ||
                          !suits(access, write, load, passes_[pass].kind, resource);
    uint32_t version = handle.version;
    if (write) {
        version = add_version(pass, handle, where);
    } else {
        VersionRecord& read = versions_[version];
        read.readers.add(how);
        if (read.next != kNoIndex && versions_[read.next].writer != pass) in_order_ = false;
    }
    AccessRecord& record = add_access(pass);
    record.pass = pass;
    record.resource = handle.index;
    record.version = version;
    record.range = resource.all;
    record.access = access;
    record.write = write;
    record.load = load;
    record.image = resource.kind == ResourceKind::kImage;
    record.where = where;
    if (range != ImageRange{}) narrow(record, range);
    if (load == Load::kClear) {
        record.clear = clears_.size();
        clears_.append() = clear ? *clear : LoadOp{load, {}};
    }
    if (doubtful || !in_order_ || !record.whole) inspect(record);
    if (is_attachment(access)) attach(record);
    resource.usage |= record.image ? how.image_usage : how.buffer_usage;
    if (resource.first_pass == kNoIndex) resource.first_pass = pass;
    resource.last_pass = pass;
    return version;
}

/// Field by field: the parts were just stored one by one, and a wider load would wait for them.
template <class H>
H with_version(const H& handle, uint32_t version) {
    H made;
    made.index = handle.index;
    made.version = version;
    made.generation = handle.generation;
    return made;
}

inline void PassBuilder::read(const ImageHandle& image, Access access, const ImageRange& range,
                              Where where) {
    graph_->touch(pass_, image, access, false, range, Load::kKeep, nullptr, where);
}

inline void PassBuilder::read(const BufferHandle& buffer, Access access, Where where) {
    graph_->touch(pass_, buffer, access, false, {}, Load::kKeep, nullptr, where);
}

inline ImageHandle PassBuilder::write(const ImageHandle& image, Access access,
                                      const ImageRange& range, Load load, Where where) {
    return with_version(image,
                        graph_->touch(pass_, image, access, true, range, load, nullptr, where));
}

inline BufferHandle PassBuilder::write(const BufferHandle& buffer, Access access, Load load,
                                       Where where) {
    return with_version(buffer,
                        graph_->touch(pass_, buffer, access, true, {}, load, nullptr, where));
}

inline ImageHandle PassBuilder::color(const ImageHandle& image, const LoadOp& load,
                                      const ImageRange& range, Where where) {
    return with_version(image, graph_->touch(pass_, image, Access::kColorAttachment, true, range,
                                             load.op, &load, where));
}

inline ImageHandle PassBuilder::depth(const ImageHandle& image, const LoadOp& load,
                                      const ImageRange& range, Where where) {
    return with_version(image, graph_->touch(pass_, image, Access::kDepthAttachment, true, range,
                                             load.op, &load, where));
}

}  // namespace vellus::graph
