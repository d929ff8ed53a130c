#include "tests/unit/frame_graph/random_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "engine/frame_graph/access.h"

namespace vellus::graph::test {

uint32_t Choices::below(uint32_t count) {
    if (!bytes_.empty()) {
        const uint8_t byte = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return byte % count;
    }
    state_ += 0x9e3779b97f4a7c15ULL;
    uint64_t z = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<uint32_t>((z ^ (z >> 31)) % count);
}

namespace {

struct Thing {
    std::vector<ImageHandle> image;  // all versions, oldest first
    std::vector<BufferHandle> buffer;
    ImageDesc desc;
    bool depth = false;
    bool readable = false;  // every subresource has content
    bool history_previous = false;
    bool imported = false;
    uint32_t used_by = kNoIndex;
};

struct Declared {
    PassBuilder pass;
    PassKind kind;
};

class Generator {
  public:
    Generator(Choices& choices, bool mischief, GraphDescription& graph)
        : c_(choices), mischief_(mischief), g_(graph) {}

    void run() {
        const uint32_t resources = 1 + c_.below(10);
        for (uint32_t i = 0; i < resources; ++i) add_resource(i);
        const uint32_t passes = 1 + c_.below(20);
        for (uint32_t p = 0; p < passes; ++p) add_pass(p);
        finish_history();
        for (Thing& thing : things_) {
            if (thing.readable && !thing.history_previous && c_.below(3) == 0) output(thing);
        }
    }

  private:
    void add_resource(uint32_t i) {
        Thing thing;
        const std::string_view name = g_.text(fmt::format("r{}", i));
        if (c_.one_in(3)) {
            const BufferDesc desc{64ULL + 64 * c_.below(40)};
            thing.imported = c_.one_in(4);
            thing.readable = thing.imported;
            const Access after = c_.one_in(2) ? Access::kHostRead : Access::kNone;
            thing.buffer.push_back(
                thing.imported ? g_.import_buffer(name, desc, nullptr, Access::kStorageRead, after)
                               : g_.create_buffer(name, desc));
            things_.push_back(thing);
            return;
        }
        thing.depth = c_.one_in(4);
        thing.desc = {thing.depth ? gpu::Format::kD32Float : gpu::Format::kRgba16Float, 16, 16,
                      1 + (c_.one_in(4) ? c_.below(3) : 0), 1 + (c_.one_in(4) ? c_.below(4) : 0)};
        const uint32_t origin = c_.below(6);
        if (origin == 0) {
            const Access before = c_.one_in(2) ? Access::kNone : Access::kTransferRead;
            const Access after = c_.one_in(2) ? Access::kNone : Access::kTransferRead;
            thing.imported = true;
            thing.readable = before != Access::kNone;
            thing.image.push_back(g_.import_image(name, thing.desc, nullptr, before, after));
        } else if (origin == 1) {
            const History history = g_.history(name, thing.desc, c_.one_in(4));
            Thing previous = thing;
            previous.readable = previous.history_previous = true;
            previous.image.push_back(history.previous);
            thing.image.push_back(history.next);
            next_of_history_.push_back(static_cast<uint32_t>(things_.size() + 1));
            things_.push_back(previous);
        } else {
            thing.image.push_back(g_.create_image(name, thing.desc));
        }
        things_.push_back(thing);
    }

    template <class H>
    H pick(const std::vector<H>& versions, bool write) {
        if (mischief_ && c_.one_in(6)) return versions[c_.below(versions.size())];
        // Old versions stay readable as long as their reader can run before they are overwritten.
        if (!write && c_.one_in(12) && versions.size() > 2) return versions[versions.size() - 2];
        return versions.back();
    }

    ImageRange some_range(const ImageDesc& desc, bool one_mip) {
        ImageRange range;
        if (one_mip || (desc.mips > 1 && c_.one_in(2))) {
            range.mip = static_cast<uint16_t>(c_.below(desc.mips));
            range.mips = 1;
        }
        if (desc.layers > 1 && c_.one_in(2)) {
            range.layer = static_cast<uint16_t>(c_.below(desc.layers));
            range.layers = 1;
        }
        if (mischief_ && c_.one_in(30)) range.mips = 9;
        return range;
    }

    void touch_buffer(PassBuilder& pass, Thing& thing, PassKind kind) {
        static constexpr std::array kReads = {Access::kStorageRead, Access::kIndirect,
                                              Access::kTransferRead};
        static constexpr std::array kRasterReads = {Access::kVertexBuffer, Access::kIndexBuffer,
                                                    Access::kGraphicsStorageRead,
                                                    Access::kIndirect};
        const bool raster = kind == PassKind::kRaster;
        if (kind == PassKind::kHost) {
            if (thing.readable && thing.imported) {
                pass.read(thing.buffer.back(), Access::kHostRead);
            }
            return;
        }
        if (thing.readable && c_.one_in(2)) {
            const Access compute = kReads[c_.below(kReads.size())];
            const Access read = raster ? kRasterReads[c_.below(kRasterReads.size())]
                                : kind == PassKind::kTransfer ? Access::kTransferRead
                                                              : compute;
            if (read == Access::kTransferRead && kind == PassKind::kCompute) return;
            pass.read(pick(thing.buffer, false), read);
            return;
        }
        Access access = raster ? Access::kFragmentStorageWrite : Access::kStorageWrite;
        if (kind == PassKind::kTransfer) access = Access::kTransferWrite;
        if (kind == PassKind::kCompute && thing.readable && c_.one_in(2)) {
            access = Access::kStorageReadWrite;
        }
        const Load load = c_.one_in(3) && !info(access).reads ? Load::kDiscard : Load::kKeep;
        thing.buffer.push_back(pass.write(pick(thing.buffer, true), access, load));
        thing.readable = true;
    }

    Access image_read(const Thing& thing, PassKind kind) {
        if (kind == PassKind::kTransfer) return Access::kTransferRead;
        if (kind == PassKind::kRaster) {
            return c_.one_in(2) ? Access::kSampledFragment : Access::kSampledVertex;
        }
        return thing.depth || c_.one_in(2) ? Access::kSampledCompute : Access::kStorageRead;
    }

    void write_image(PassBuilder& pass, Thing& thing, PassKind kind) {
        const bool attach = kind == PassKind::kRaster;
        if (thing.depth && kind == PassKind::kCompute) return;
        const ImageRange range = some_range(thing.desc, attach);
        const bool all = (range.mips == ImageRange::kAll || thing.desc.mips == 1) &&
                         (range.layers == ImageRange::kAll || thing.desc.layers == 1);
        if (!all && !thing.readable && !mischief_) return;
        const ImageHandle from = pick(thing.image, true);
        if (attach) {
            LoadOp load = c_.one_in(2) ? clear(0) : discard();
            if (thing.readable && c_.one_in(2)) load = keep();
            thing.image.push_back(thing.depth ? pass.depth(from, load, range)
                                              : pass.color(from, load, range));
        } else {
            Access access = Access::kStorageWrite;
            if (kind == PassKind::kTransfer)
                access = Access::kTransferWrite;
            else if (thing.readable && c_.one_in(3))
                access = Access::kStorageReadWrite;
            const Load load = c_.one_in(3) && !info(access).reads ? Load::kDiscard : Load::kKeep;
            thing.image.push_back(pass.write(from, access, range, load));
        }
        thing.readable = thing.readable || all;
    }

    void touch_image(PassBuilder& pass, Thing& thing, PassKind kind, bool& has_depth) {
        if (kind == PassKind::kHost) return;
        if (thing.history_previous || (thing.readable && c_.one_in(2))) {
            pass.read(pick(thing.image, false), image_read(thing, kind),
                      some_range(thing.desc, false));
            return;
        }
        if (kind == PassKind::kRaster && (thing.desc.mips > 1 || (thing.depth && has_depth))) {
            return;
        }
        if (kind == PassKind::kRaster && thing.depth) has_depth = true;
        write_image(pass, thing, kind);
    }

    void add_pass(uint32_t p) {
        static constexpr std::array kKinds = {PassKind::kCompute, PassKind::kCompute,
                                              PassKind::kRaster, PassKind::kTransfer,
                                              PassKind::kHost};
        const PassKind kind = kKinds[c_.below(kKinds.size())];
        PassBuilder pass = g_.add_pass(g_.text(fmt::format("p{}", p)), kind);
        if (c_.one_in(8)) pass.side_effect();
        bool has_depth = false;
        if (kind == PassKind::kRaster) {  // something to draw to
            const ImageHandle target =
                g_.create_image(g_.text(fmt::format("t{}", p)), {gpu::Format::kRgba8Unorm, 16, 16});
            Thing thing{.desc = {gpu::Format::kRgba8Unorm, 16, 16}, .readable = true};
            thing.image = {target, pass.color(target, clear(0))};
            thing.used_by = p;
            things_.push_back(thing);
        }
        const uint32_t accesses = 1 + c_.below(5);
        for (uint32_t a = 0; a < accesses; ++a) {
            Thing& thing = things_[c_.below(static_cast<uint32_t>(things_.size()))];
            if (thing.used_by == p && !mischief_) continue;
            thing.used_by = p;
            touch(pass, thing, kind, has_depth);
        }
        if (!passes_.empty() && c_.one_in(6))
            return_to(passes_[c_.below(static_cast<uint32_t>(passes_.size()))]);
        passes_.push_back({pass, kind});
    }

    void touch(PassBuilder& pass, Thing& thing, PassKind kind, bool& has_depth) {
        if (thing.buffer.empty())
            touch_image(pass, thing, kind, has_depth);
        else
            touch_buffer(pass, thing, kind);
    }

    /// Declares a pass further after others were added: it makes something new. Anything else may
    /// be a mistake.
    void return_to(Declared& earlier) {
        bool has_depth = true;
        if (mischief_) {
            touch(earlier.pass, things_[c_.below(static_cast<uint32_t>(things_.size()))],
                  earlier.kind, has_depth);
        }
        if (earlier.kind != PassKind::kCompute) return;
        Thing thing{.desc = {gpu::Format::kRgba16Float, 16, 16}, .readable = true};
        const std::string_view name = g_.text(fmt::format("late{}", things_.size()));
        thing.image.push_back(g_.create_image(name, thing.desc));
        thing.image.push_back(earlier.pass.write(thing.image.back(), Access::kStorageWrite));
        things_.push_back(thing);
    }

    void finish_history() {
        for (const uint32_t index : next_of_history_) {
            Thing& thing = things_[index];
            if (mischief_ && c_.one_in(3)) continue;
            PassBuilder pass = g_.add_pass("keep history", PassKind::kTransfer);
            thing.image.push_back(pass.write(thing.image.back(), Access::kTransferWrite));
            thing.readable = true;
        }
    }

    void output(Thing& thing) {
        if (thing.buffer.empty())
            g_.output(pick(thing.image, true));
        else
            g_.output(pick(thing.buffer, true));
    }

    Choices& c_;
    bool mischief_;
    GraphDescription& g_;
    std::vector<Thing> things_;
    std::vector<uint32_t> next_of_history_;
    std::vector<Declared> passes_;
};

}  // namespace

void random_graph(Choices& choices, bool mischief, GraphDescription& graph) {
    Generator(choices, mischief, graph).run();
}

Switches random_switches(Choices& choices) {
    Switches switches;
    if (choices.one_in(2)) return switches;
    switches.no_culling = choices.one_in(3);
    switches.no_aliasing = choices.one_in(4);
    switches.full_barriers = choices.one_in(4);
    switches.poison = choices.one_in(3);
    switches.immediate = choices.one_in(6);
    switches.random_order = choices.one_in(2);
    switches.seed = choices.below(256);
    return switches;
}

}  // namespace vellus::graph::test
