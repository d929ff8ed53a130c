#include "engine/frame_graph/description.h"

#include <cstring>

namespace vellus::graph {

ImageHandle GraphDescription::import_image(std::string_view name, const ImageDesc& desc,
                                           void* external, Access before, Access after,
                                           Where where) {
    const ImageHandle image = create_image(name, desc, where);
    ResourceRecord& resource = resources_[image.index];
    resource.origin = Origin::kImported;
    externals_.push_back(image.index);
    resource.external = external;
    resource.before = before;
    resource.after = after;
    resource.filled = before != Access::kNone;
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
    resource.target = Target::kImportedBuffer;
    resource.origin = Origin::kImported;
    externals_.push_back(buffer.index);
    resource.external = external;
    resource.before = before;
    resource.after = after;
    resource.filled = before != Access::kNone;
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
    previous.filled = true;
    previous.restart = restart;
    next.origin = Origin::kHistoryNext;
    externals_.insert(externals_.end(), {pair.previous.index, pair.next.index});
    next.partner = pair.previous.index;
    return pair;
}

void GraphDescription::output(const ImageHandle& image, Where where) {
    if (check(image, kNoIndex, where)) outputs_.push_back({image.version, where});
}

void GraphDescription::output(const BufferHandle& buffer, Where where) {
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
    externals_.clear();
    outputs_.clear();
    problems_.clear();
    arena_.reset();
    in_order_ = true;
    ++generation_;
}

void GraphDescription::report(Problem problem, uint32_t pass, uint32_t resource, Where where,
                              uint32_t other) {
    problems_.push_back({problem, pass, resource, other, where});
}

/// For a pass declared further after others were added: they move up. Rare, and then short.
AccessRecord& GraphDescription::insert_access(uint32_t pass) {
    in_order_ = false;
    const uint32_t at = passes_[pass].first_access + passes_[pass].access_count++;
    for (uint32_t i = pass + 1; i < passes_.size(); ++i) ++passes_[i].first_access;
    return accesses_.insert(at);
}

void PassBuilder::side_effect() {
    graph_->passes_[pass_].side_effect = true;
}

}  // namespace vellus::graph
