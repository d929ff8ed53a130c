#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/arena.h"
#include "engine/frame_graph/diagnostics.h"
#include "engine/frame_graph/record_list.h"
#include "engine/frame_graph/records.h"
#include "engine/frame_graph/types.h"

namespace vellus::graph {

class GraphDescription;

/// Declares what one pass touches and the commands it records. Valid until the next reset().
class PassBuilder {
  public:
    using Where = SourceLine;

    /// The pass reads this version.
    void read(const ImageHandle& image, Access access, const ImageRange& range = {},
              Where = Where::current());
    void read(const BufferHandle& buffer, Access access, Where = Where::current());

    /// The pass writes the resource after this version; returns the version it produces.
    [[nodiscard]] ImageHandle write(const ImageHandle& image, Access access,
                                    const ImageRange& range = {}, Load load = Load::kKeep,
                                    Where = Where::current());
    [[nodiscard]] BufferHandle write(const BufferHandle& buffer, Access access,
                                     Load load = Load::kKeep, Where = Where::current());

    /// The next color attachment (location = order of the calls), one mip of one or all layers.
    [[nodiscard]] ImageHandle color(const ImageHandle& image, const LoadOp& load = {},
                                    const ImageRange& range = {}, Where = Where::current());
    /// The depth attachment, tested and written. For a test only: read(h, Access::kDepthReadOnly).
    [[nodiscard]] ImageHandle depth(const ImageHandle& image, const LoadOp& load = {},
                                    const ImageRange& range = {}, Where = Where::current());

    /// Never culled: the pass does something the graph does not see.
    void side_effect();

    /// Records the commands: `record(PassContext&)`. It captures handles and plain data only, and
    /// is copied into the description; no destructor runs.
    template <class F>
    void execute(F record);

  private:
    friend class GraphDescription;
    PassBuilder(GraphDescription* graph, uint32_t pass) : graph_(graph), pass_(pass) {}

    GraphDescription* graph_;
    uint32_t pass_;
};

/// One frame as data: resources, passes, what each pass touches, what is asked for. Describing
/// never fails; compile() reports every mistake with pass, resource and the line that made it.
/// Names are not copied: pass literals, or text().
class GraphDescription {
  public:
    using Where = SourceLine;

    ImageHandle create_image(std::string_view name, const ImageDesc& desc,
                             Where = Where::current());
    BufferHandle create_buffer(std::string_view name, const BufferDesc& desc,
                               Where = Where::current());

    /// A resource that lives outside: `external` is a gpu::Image* or gpu::Buffer*. `before` is how
    /// it was last used (kNone: content undefined), `after` how it is left (kNone: as the last pass
    /// did).
    ImageHandle import_image(std::string_view name, const ImageDesc& desc, void* external,
                             Access before, Access after = Access::kNone, Where = Where::current());
    /// The same for an image that is not a gpu::Image, such as one of a swapchain; VkImage and
    /// VkImageView of all of it, usable as color attachment and transfer destination.
    ImageHandle import_native_image(std::string_view name, const ImageDesc& desc, uint64_t image,
                                    uint64_t view, Access before, Access after,
                                    Where = Where::current());
    BufferHandle import_buffer(std::string_view name, const BufferDesc& desc, void* external,
                               Access before, Access after = Access::kNone,
                               Where = Where::current());

    /// An image kept from frame to frame under its name. Reading `previous` requires writing
    /// `next`. `restart` (camera cut) makes PassContext::history_valid false; so do first frame and
    /// resize. Invalid history reads as zeros.
    History history(std::string_view name, const ImageDesc& desc, bool restart = false,
                    Where = Where::current());

    PassBuilder add_pass(std::string_view name, PassKind kind, Where = Where::current());

    /// Asks for this version: it stays intact to the end of the frame. Passes nothing asked for
    /// needs are culled.
    void output(const ImageHandle& image, Where = Where::current());
    void output(const BufferHandle& buffer, Where = Where::current());

    /// Copies text into the description, e.g. a name put together at run time.
    std::string_view text(std::string_view text);

    /// Forgets everything but keeps the memory. Handles of before become stale.
    void reset();

    [[nodiscard]] std::span<const ResourceRecord> resources() const { return resources_.span(); }
    [[nodiscard]] std::span<const VersionRecord> versions() const { return versions_.span(); }
    [[nodiscard]] std::span<const PassRecord> passes() const { return passes_.span(); }
    [[nodiscard]] std::span<const AccessRecord> accesses() const { return accesses_.span(); }
    [[nodiscard]] std::span<const AccessRecord> accesses(uint32_t pass) const {
        return accesses().subspan(passes_[pass].first_access, passes_[pass].access_count);
    }
    [[nodiscard]] std::span<const LoadOp> clears() const { return clears_.span(); }
    /// Resources that are not transient.
    [[nodiscard]] std::span<const uint32_t> externals() const { return externals_; }
    [[nodiscard]] std::span<const OutputRecord> outputs() const { return outputs_; }
    /// Mistakes seen while describing.
    [[nodiscard]] std::span<const Diagnostic> problems() const { return problems_; }
    /// Every pass is declared after those that write what it needs and before those that overwrite
    /// what it reads, and was not returned to once the next one was added.
    [[nodiscard]] bool in_order() const { return in_order_; }
    [[nodiscard]] uint32_t generation() const { return generation_; }

  private:
    friend class PassBuilder;

    ResourceRecord& add_resource(std::string_view name, Where where);
    template <class H>
    H first_handle(const ResourceRecord& resource) const;
    uint32_t touch(uint32_t pass, const Handle& handle, Access access, bool write,
                   const ImageRange& range, Load load, const LoadOp* clear, Where where);
    uint32_t add_version(uint32_t pass, const Handle& handle, Where where);
    AccessRecord& add_access(uint32_t pass);
    AccessRecord& insert_access(uint32_t pass);
    void narrow(AccessRecord& access, const ImageRange& range) const;
    void attach(const AccessRecord& access);
    void inspect(const AccessRecord& access);
    bool check(const Handle& handle, uint32_t pass, Where where) {
        if (handle.generation == generation_ && handle.version < versions_.size() &&
            versions_[handle.version].resource == handle.index) {
            return true;
        }
        report(Problem::kStaleHandle, pass, kNoIndex, where);
        return false;
    }
    void report(Problem problem, uint32_t pass, uint32_t resource, Where where,
                uint32_t other = kNoIndex);

    RecordList<ResourceRecord> resources_;
    RecordList<VersionRecord> versions_;
    RecordList<PassRecord> passes_;
    RecordList<AccessRecord> accesses_;
    RecordList<LoadOp> clears_;
    std::vector<uint32_t> externals_;
    std::vector<OutputRecord> outputs_;
    std::vector<Diagnostic> problems_;
    Arena arena_;
    uint32_t generation_ = 1;
    bool in_order_ = true;
};

template <class F>
void PassBuilder::execute(F record) {
    static_assert(std::is_trivially_destructible_v<F> && std::is_trivially_copyable_v<F>,
                  "a pass captures handles and plain data only");
    static_assert(alignof(F) <= alignof(std::max_align_t));
    PassRecord& pass = graph_->passes_[pass_];
    pass.closure = new (graph_->arena_.allocate(sizeof(F), alignof(F))) F(std::move(record));
    pass.record = [](const void* closure, PassContext& context) {
        (*static_cast<const F*>(closure))(context);
    };
}

}  // namespace vellus::graph

#include "engine/frame_graph/description_inline.h"
