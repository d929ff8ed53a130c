#include <optional>

#include "engine/frame_graph/description.h"

namespace vellus::graph {

namespace {

constexpr uint32_t kMaxColors = 8;
constexpr Problem kUsage = Problem::kUnsupportedUsage;
constexpr Problem kFormat = Problem::kUnsupportedFormat;

bool overlap(const ImageRange& a, const ImageRange& b) {
    return a.mip < b.mip + b.mips && b.mip < a.mip + a.mips && a.layer < b.layer + b.layers &&
           b.layer < a.layer + a.layers;
}

bool in_image(const ImageRange& range, const ImageDesc& desc) {
    return range.mips > 0 && range.layers > 0 && uint32_t{range.mip} + range.mips <= desc.mips &&
           uint32_t{range.layer} + range.layers <= desc.layers;
}

bool conflict(const AccessRecord& a, const AccessRecord& b) {
    if (a.resource != b.resource || !overlap(a.range, b.range)) return false;
    if (a.write || b.write) return true;
    return a.image && info(a.access).layout != info(b.access).layout;
}

/// What keeps the access from fitting the kind of pass, the resource or its format, if anything.
std::optional<Problem> misfit(const AccessRecord& access, const ResourceRecord& resource,
                              PassKind kind) {
    const AccessInfo& how = info(access.access);
    const bool attachment = is_attachment(access.access);
    if (access.write != how.writes || (how.pass_kinds & access_table::bit(kind)) == 0 ||
        (attachment ? access.range.mips != 1 : access.load == Load::kClear) ||
        (access.image && !in_image(access.range, resource.image))) {
        return kUsage;
    }
    if ((how.targets & access_table::bit(resource.target)) != 0) return std::nullopt;
    return access.image && how.image_usage != 0 ? kFormat : kUsage;
}

}  // namespace

/// Part of an image: what the call leaves out reaches to the last mip or layer.
void GraphDescription::narrow(AccessRecord& access, const ImageRange& range) const {
    if (!access.image) return;
    const ImageRange all = resources_[access.resource].all;
    const auto rest = [](uint16_t count, uint16_t of, uint16_t first) {
        return count == ImageRange::kAll ? static_cast<uint16_t>(of - first) : count;
    };
    access.range = {range.mip, rest(range.mips, all.mips, range.mip), range.layer,
                    rest(range.layers, all.layers, range.layer)};
    access.whole = access.range == all;
}

/// Reports what the access, the last of its pass, does wrong.
void GraphDescription::inspect(const AccessRecord& access) {
    const ResourceRecord& resource = resources_[access.resource];
    const uint32_t before = access.write ? versions_[access.version].previous : access.version;
    const bool loads = is_attachment(access.access) && access.load == Load::kKeep;
    if (versions_[before].writer == kNoIndex && !resource.filled &&
        (!access.write || info(access.access).reads || loads)) {
        report(Problem::kReadNeverWritten, access.pass, access.resource, access.where);
    }
    if (const auto problem = misfit(access, resource, passes_[access.pass].kind)) {
        report(*problem, access.pass, access.resource, access.where);
    }
    for (const AccessRecord& other : accesses(access.pass)) {
        if (&other == &access) return;
        if (!conflict(other, access)) continue;
        report(Problem::kConflictingAccess, access.pass, access.resource, access.where);
        return;
    }
}

/// Attachments of one pass: not too many, all of one size.
void GraphDescription::attach(const AccessRecord& access) {
    PassRecord& pass = passes_[access.pass];
    if (pass.kind != PassKind::kRaster) return;
    const uint32_t attached = pass.colors + pass.depths;
    const ImageDesc& desc = resources_[access.resource].image;
    const uint32_t width = desc.width >> access.range.mip, height = desc.height >> access.range.mip;
    if (attached > 0 && (width != pass.width || height != pass.height)) {
        report(kFormat, access.pass, access.resource, access.where);
    }
    pass.width = width;
    pass.height = height;
    ++(access.access == Access::kColorAttachment ? pass.colors : pass.depths);
    if (pass.colors > kMaxColors || pass.depths > 1) {
        report(kUsage, access.pass, kNoIndex, pass.where);
    }
}

}  // namespace vellus::graph
