#include <optional>

#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

constexpr uint32_t kMaxColors = 8;

bool overlap(const ImageRange& a, const ImageRange& b) {
    return a.mip < b.mip + b.mips && b.mip < a.mip + a.mips && a.layer < b.layer + b.layers &&
           b.layer < a.layer + a.layers;
}

bool in_image(const ImageRange& range, const ImageDesc& desc) {
    return range.mips > 0 && range.layers > 0 && uint32_t{range.mip} + range.mips <= desc.mips &&
           uint32_t{range.layer} + range.layers <= desc.layers;
}

bool is_attachment(Access access) {
    return access == Access::kColorAttachment || access == Access::kDepthAttachment ||
           access == Access::kDepthReadOnly;
}

bool format_allows(const CompileState& s, const ImageDesc& desc, const AccessInfo& how) {
    const bool depth_usage = (how.image_usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
    const bool color_usage =
        (how.image_usage & (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT)) != 0;
    const bool depth = gpu::is_depth(desc.format);
    if ((depth_usage && !depth) || (color_usage && depth)) return false;
    if (!s.options->format_usage) return true;
    const uint32_t supported = (*s.options->format_usage)[static_cast<size_t>(desc.format)];
    return (how.image_usage & ~supported) == 0;
}

constexpr Problem kUsage = Problem::kUnsupportedUsage;
constexpr Problem kFormat = Problem::kUnsupportedFormat;

/// What keeps the access from fitting the kind of pass, the resource or its format, if anything.
std::optional<Problem> check_usage(const CompileState& s, const AccessRecord& access,
                                   const AccessInfo& how, const ResourceRecord& resource,
                                   PassKind kind) {
    if ((how.pass_kinds >> static_cast<int>(kind) & 1) == 0) return kUsage;
    if (!access.image) {
        const bool host_sees = resource.origin == Origin::kImported;
        const bool fits =
            how.buffer_usage != 0 && (access.access != Access::kHostRead || host_sees);
        return fits ? std::nullopt : std::optional(kUsage);
    }
    if (how.image_usage == 0 || !in_image(access.range, resource.image)) return kUsage;
    if (is_attachment(access.access)) {
        if (access.range.mips != 1) return kUsage;
    } else if (access.load == Load::kClear) {
        return kUsage;
    }
    return format_allows(s, resource.image, how) ? std::nullopt : std::optional(kFormat);
}

bool conflict(const CompileState& s, const AccessRecord& a, const AccessRecord& b) {
    if (a.resource != b.resource || !overlap(a.range, b.range)) return false;
    if (a.write || b.write) return true;
    return s.graph->resources()[a.resource].kind == ResourceKind::kImage &&
           info(a.access).layout != info(b.access).layout;
}

/// Attachments of one pass: at least one, not too many, all of one size.
bool check_attachments(CompileState& s, uint32_t pass) {
    uint32_t colors = 0, depths = 0, width = 0, height = 0;
    for (const AccessRecord& access : s.graph->accesses(pass)) {
        if (!is_attachment(access.access)) continue;
        ++(access.access == Access::kColorAttachment ? colors : depths);
        const ImageDesc& desc = s.graph->resources()[access.resource].image;
        const uint32_t w = desc.width >> access.range.mip, h = desc.height >> access.range.mip;
        if (width != 0 && (w != width || h != height)) {
            s.report(Problem::kUnsupportedFormat, pass, access.resource, access.where);
            return false;
        }
        width = w;
        height = h;
    }
    if (colors + depths > 0 && colors <= kMaxColors && depths <= 1) return true;
    s.report(Problem::kUnsupportedUsage, pass, kNoIndex, s.graph->passes()[pass].where);
    return false;
}

void check_conflicts(CompileState& s, const AccessRecord& access) {
    for (const AccessRecord& other : s.graph->accesses(access.pass)) {
        if (&other >= &access) return;
        if (conflict(s, other, access)) {
            s.report(Problem::kConflictingAccess, access.pass, access.resource, access.where);
            return;
        }
    }
}

/// The pass is declared after whoever writes what it needs and before whoever overwrites it.
bool follows(std::span<const VersionRecord> versions, const AccessRecord& access, uint32_t pass) {
    const VersionRecord& version = versions[access.version];
    const uint32_t writer = access.write ? versions[version.previous].writer : version.writer;
    if (writer != kNoIndex && writer > pass) return false;
    return access.write || version.next == kNoIndex || versions[version.next].writer >= pass;
}

}  // namespace

bool validate(CompileState& s) {
    const auto passes = s.graph->passes();
    const auto versions = s.graph->versions();
    const auto resources = s.graph->resources();
    const auto accesses = s.graph->accesses();
    begin_lifetimes(s);
    const std::span<Placement> placements = s.plan->placements;
    const std::span<Readers> readers = s.readers;
    bool forward = true;
    for (uint32_t pass = 0; pass < passes.size(); ++pass) {
        const PassKind kind = passes[pass].kind;
        bool usable = true;
        const uint32_t first = passes[pass].first_access;
        for (const AccessRecord& access : accesses.subspan(first, passes[pass].access_count)) {
            const AccessInfo& how = info(access.access);
            const auto wrong = check_usage(s, access, how, resources[access.resource], kind);
            if (wrong) {
                s.report(*wrong, pass, access.resource, access.where);
                usable = false;
            }
            Placement& placement = placements[access.resource];
            if (placement.last_step == pass) check_conflicts(s, access);
            count_access(access, how, placement, readers, pass);
            forward = forward && follows(versions, access, pass);
        }
        if (kind == PassKind::kRaster && usable) check_attachments(s, pass);
    }
    s.forward = forward;
    return s.diagnostics->empty();
}

}  // namespace vellus::graph
