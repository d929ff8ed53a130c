#include "engine/frame_graph/description.h"

#include <algorithm>
#include <cstring>

#include "engine/frame_graph/access.h"

namespace vellus::graph {

namespace {

const LoadOp kKeepOp = keep();

}  // namespace

// Records are filled in where they lie: building them elsewhere and copying costs more than the
// rest.

ResourceRecord& GraphDescription::add_resource(std::string_view name, Where where) {
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
    handle.index = static_cast<uint32_t>(&resource - resources_.data());
    handle.version = resource.first_version;
    handle.generation = generation_;
    return handle;
}

ImageHandle GraphDescription::create_image(std::string_view name, const ImageDesc& desc,
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

BufferHandle GraphDescription::create_buffer(std::string_view name, const BufferDesc& desc,
                                             Where where) {
    ResourceRecord& resource = add_resource(name, where);
    resource.kind = ResourceKind::kBuffer;
    resource.buffer = desc;
    const auto handle = first_handle<BufferHandle>(resource);
    if (desc.bytes == 0) report(Problem::kUnsupportedFormat, kNoIndex, handle.index, where);
    return handle;
}

ImageHandle GraphDescription::import_image(std::string_view name, const ImageDesc& desc,
                                           void* external, Access before, Access after,
                                           Where where) {
    const ImageHandle image = create_image(name, desc, where);
    ResourceRecord& resource = resources_[image.index];
    resource.origin = Origin::kImported;
    resource.external = external;
    resource.before = before;
    resource.after = after;
    return image;
}

ImageHandle GraphDescription::import_native_image(std::string_view name, const ImageDesc& desc,
                                                  uint64_t image, uint64_t view, Access before,
                                                  Access after, Where where) {
    const ImageHandle handle = import_image(name, desc, nullptr, before, after, where);
    resources_[handle.index].native_image = image;
    resources_[handle.index].native_view = view;
    return handle;
}

BufferHandle GraphDescription::import_buffer(std::string_view name, const BufferDesc& desc,
                                             void* external, Access before, Access after,
                                             Where where) {
    const BufferHandle buffer = create_buffer(name, desc, where);
    ResourceRecord& resource = resources_[buffer.index];
    resource.origin = Origin::kImported;
    resource.external = external;
    resource.before = before;
    resource.after = after;
    return buffer;
}

History GraphDescription::history(std::string_view name, const ImageDesc& desc, bool restart,
                                  Where where) {
    const History pair{.previous = create_image(name, desc, where),
                       .next = create_image(name, desc, where)};
    ResourceRecord& previous = resources_[pair.previous.index];
    ResourceRecord& next = resources_[pair.next.index];
    previous.origin = Origin::kHistoryPrevious;
    previous.partner = pair.next.index;
    previous.restart = restart;
    next.origin = Origin::kHistoryNext;
    next.partner = pair.previous.index;
    return pair;
}

PassBuilder GraphDescription::add_pass(std::string_view name, PassKind kind, Where where) {
    const auto index = static_cast<uint32_t>(passes_.size());
    PassRecord& pass = passes_.emplace_back();
    pass.name = name;
    pass.kind = kind;
    pass.first_access = static_cast<uint32_t>(accesses_.size());
    pass.where = where;
    return {this, index};
}

void GraphDescription::output(ImageHandle image, Where where) {
    if (check(image, kNoIndex, where)) outputs_.push_back({image.version, where});
}

void GraphDescription::output(BufferHandle buffer, Where where) {
    if (check(buffer, kNoIndex, where)) outputs_.push_back({buffer.version, where});
}

std::string_view GraphDescription::text(std::string_view text) {
    char* copy = static_cast<char*>(arena_.allocate(text.size() + 1, 1));
    std::memcpy(copy, text.data(), text.size());
    copy[text.size()] = '\0';
    return {copy, text.size()};
}

void GraphDescription::reset() {
    resources_.clear();
    versions_.clear();
    passes_.clear();
    accesses_.clear();
    clears_.clear();
    outputs_.clear();
    problems_.clear();
    arena_.reset();
    ++generation_;
}

void GraphDescription::report(Problem problem, uint32_t pass, uint32_t resource, Where where,
                              uint32_t other) {
    problems_.push_back({problem, pass, resource, other, where});
}

AccessRecord& GraphDescription::add_access(uint32_t pass) {
    PassRecord& record = passes_[pass];
    const size_t at = record.first_access + record.access_count++;
    if (pass + 1 == passes_.size()) return accesses_.emplace_back();
    // A pass declared further after others were added: they move up. Rare, and then short.
    accesses_.emplace(accesses_.begin() + static_cast<ptrdiff_t>(at));
    for (size_t i = pass + 1; i < passes_.size(); ++i) ++passes_[i].first_access;
    return accesses_[at];
}

uint32_t GraphDescription::touch(uint32_t pass, const Handle& handle, Access access, bool write,
                                 const ImageRange& range, const LoadOp& load, Where where) {
    if (!check(handle, pass, where)) return handle.version;
    ResourceRecord& resource = resources_[handle.index];
    const AccessInfo& how = info(access);
    const VersionRecord& before = versions_[handle.version];
    if (before.writer == kNoIndex && resource.before == Access::kNone &&
        resource.origin != Origin::kHistoryPrevious) {
        const bool loads_attachment =
            load.op == Load::kKeep &&
            (access == Access::kColorAttachment || access == Access::kDepthAttachment);
        if (how.reads || !write || loads_attachment) {
            report(Problem::kReadNeverWritten, pass, handle.index, where);
        }
    }
    if (write != how.writes) report(Problem::kUnsupportedUsage, pass, handle.index, where);

    uint32_t version = handle.version;
    if (write) {
        if (before.next != kNoIndex) {
            report(Problem::kTwoWriters, pass, handle.index, where, versions_[before.next].writer);
        }
        const uint32_t number = before.number + 1;
        version = static_cast<uint32_t>(versions_.size());
        versions_[handle.version].next = version;
        VersionRecord& made = versions_.emplace_back();
        made.resource = handle.index;
        made.writer = pass;
        made.previous = handle.version;
        made.number = number;
        resource.last_version = version;
    }
    AccessRecord& record = add_access(pass);
    record.pass = pass;
    record.resource = handle.index;
    record.version = version;
    record.access = access;
    record.write = write;
    record.load = load.op;
    record.where = where;
    if (load.op == Load::kClear) {
        record.clear = static_cast<uint32_t>(clears_.size());
        clears_.push_back(load);
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
    record.range.mip = range.mip;
    record.range.mips = rest(range.mips, desc.mips, range.mip);
    record.range.layer = range.layer;
    record.range.layers = rest(range.layers, desc.layers, range.layer);
    record.whole = record.range.mips == desc.mips && record.range.layers == desc.layers;
    return version;
}

void PassBuilder::read(ImageHandle image, Access access, const ImageRange& range, Where where) {
    graph_->touch(pass_, image, access, false, range, kKeepOp, where);
}

void PassBuilder::read(BufferHandle buffer, Access access, Where where) {
    graph_->touch(pass_, buffer, access, false, {}, kKeepOp, where);
}

ImageHandle PassBuilder::write(ImageHandle image, Access access, const ImageRange& range, Load load,
                               Where where) {
    image.version = graph_->touch(pass_, image, access, true, range, {load, {}}, where);
    return image;
}

BufferHandle PassBuilder::write(BufferHandle buffer, Access access, Load load, Where where) {
    buffer.version = graph_->touch(pass_, buffer, access, true, {}, {load, {}}, where);
    return buffer;
}

ImageHandle PassBuilder::color(ImageHandle image, const LoadOp& load, const ImageRange& range,
                               Where where) {
    image.version = graph_->touch(pass_, image, Access::kColorAttachment, true, range, load, where);
    return image;
}

ImageHandle PassBuilder::depth(ImageHandle image, const LoadOp& load, const ImageRange& range,
                               Where where) {
    image.version = graph_->touch(pass_, image, Access::kDepthAttachment, true, range, load, where);
    return image;
}

void PassBuilder::side_effect() {
    graph_->passes_[pass_].side_effect = true;
}

}  // namespace vellus::graph
