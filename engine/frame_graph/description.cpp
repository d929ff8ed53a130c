#include "engine/frame_graph/description.h"

#include <algorithm>
#include <cstring>

#include "engine/frame_graph/access.h"

namespace vellus::graph {

namespace {

ImageRange resolve(const ImageRange& range, const ImageDesc& desc) {
    ImageRange out = range;
    if (out.mips == ImageRange::kAll) out.mips = static_cast<uint16_t>(desc.mips - range.mip);
    if (out.layers == ImageRange::kAll) {
        out.layers = static_cast<uint16_t>(desc.layers - range.layer);
    }
    return out;
}

template <class H>
H handle(uint32_t resource, uint32_t version, uint32_t generation) {
    H out;
    out.index = resource;
    out.version = version;
    out.generation = generation;
    return out;
}

}  // namespace

uint32_t GraphDescription::add_resource(ResourceRecord&& resource) {
    const auto index = static_cast<uint32_t>(resources_.size());
    const auto version = static_cast<uint32_t>(versions_.size());
    resource.first_version = resource.last_version = version;
    resources_.push_back(resource);
    versions_.push_back({.resource = index});
    return index;
}

ImageHandle GraphDescription::create_image(std::string_view name, const ImageDesc& desc,
                                           Where where) {
    const uint32_t index = add_resource({.name = name, .image = desc, .where = where});
    if (desc.format == gpu::Format::kUndefined || desc.width == 0 || desc.height == 0 ||
        desc.layers == 0 || desc.mips == 0) {
        report(Problem::kUnsupportedFormat, kNoIndex, index, where);
    }
    return handle<ImageHandle>(index, resources_[index].first_version, generation_);
}

BufferHandle GraphDescription::create_buffer(std::string_view name, const BufferDesc& desc,
                                             Where where) {
    const uint32_t index =
        add_resource({.name = name, .kind = ResourceKind::kBuffer, .buffer = desc, .where = where});
    if (desc.bytes == 0) report(Problem::kUnsupportedFormat, kNoIndex, index, where);
    return handle<BufferHandle>(index, resources_[index].first_version, generation_);
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
    passes_.push_back({.name = name,
                       .kind = kind,
                       .first_access = static_cast<uint32_t>(accesses_.size()),
                       .where = where});
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

bool GraphDescription::check(Handle handle, uint32_t pass, Where where) {
    if (handle.generation == generation_ && handle.version < versions_.size() &&
        versions_[handle.version].resource == handle.index) {
        return true;
    }
    report(Problem::kStaleHandle, pass, kNoIndex, where);
    return false;
}

void GraphDescription::insert(AccessRecord&& access) {
    PassRecord& pass = passes_[access.pass];
    const size_t at = pass.first_access + pass.access_count++;
    if (at == accesses_.size()) {
        accesses_.push_back(access);
        return;
    }
    // A pass declared further after others were added: they move up. Rare, and then short.
    accesses_.insert(accesses_.begin() + static_cast<ptrdiff_t>(at), access);
    for (size_t i = access.pass + 1; i < passes_.size(); ++i) ++passes_[i].first_access;
}

uint32_t GraphDescription::touch(uint32_t pass, Handle handle, Access access, bool write,
                                 ImageRange range, LoadOp load, Where where) {
    if (!check(handle, pass, where)) return handle.version;
    ResourceRecord& resource = resources_[handle.index];
    const AccessInfo& how = info(access);
    const VersionRecord before = versions_[handle.version];
    const bool undefined = before.writer == kNoIndex && resource.before == Access::kNone &&
                           resource.origin != Origin::kHistoryPrevious;
    const bool loads_attachment = load.op == Load::kKeep && (access == Access::kColorAttachment ||
                                                             access == Access::kDepthAttachment);
    if (undefined && (how.reads || !write || loads_attachment)) {
        report(Problem::kReadNeverWritten, pass, handle.index, where);
    }
    if (write != how.writes) report(Problem::kUnsupportedUsage, pass, handle.index, where);

    uint32_t version = handle.version;
    if (write) {
        if (before.next != kNoIndex) {
            report(Problem::kTwoWriters, pass, handle.index, where, versions_[before.next].writer);
        }
        version = static_cast<uint32_t>(versions_.size());
        versions_.push_back({.resource = handle.index,
                             .writer = pass,
                             .previous = handle.version,
                             .number = before.number + 1});
        versions_[handle.version].next = version;
        resource.last_version = version;
    }
    uint32_t clear = kNoIndex;
    if (load.op == Load::kClear) {
        clear = static_cast<uint32_t>(clears_.size());
        clears_.push_back(load);
    }
    const bool image = resource.kind == ResourceKind::kImage;
    insert({.pass = pass,
            .resource = handle.index,
            .version = version,
            .clear = clear,
            .range = image ? resolve(range, resource.image) : ImageRange{0, 1, 0, 1},
            .access = access,
            .write = write,
            .load = load.op,
            .where = where});
    return version;
}

void PassBuilder::read(ImageHandle image, Access access, ImageRange range, Where where) {
    graph_->touch(pass_, image, access, false, range, {}, where);
}

void PassBuilder::read(BufferHandle buffer, Access access, Where where) {
    graph_->touch(pass_, buffer, access, false, {}, {}, where);
}

ImageHandle PassBuilder::write(ImageHandle image, Access access, ImageRange range, Load load,
                               Where where) {
    image.version = graph_->touch(pass_, image, access, true, range, {load, {}}, where);
    return image;
}

BufferHandle PassBuilder::write(BufferHandle buffer, Access access, Load load, Where where) {
    buffer.version = graph_->touch(pass_, buffer, access, true, {}, {load, {}}, where);
    return buffer;
}

ImageHandle PassBuilder::color(ImageHandle image, LoadOp load, ImageRange range, Where where) {
    image.version = graph_->touch(pass_, image, Access::kColorAttachment, true, range, load, where);
    return image;
}

ImageHandle PassBuilder::depth(ImageHandle image, LoadOp load, ImageRange range, Where where) {
    image.version = graph_->touch(pass_, image, Access::kDepthAttachment, true, range, load, where);
    return image;
}

void PassBuilder::side_effect() {
    graph_->passes_[pass_].side_effect = true;
}

}  // namespace vellus::graph
