#include "engine/frame_graph/compile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/frame_graph/simulator.h"

namespace vellus::graph {
namespace {

constexpr ImageDesc kColor{gpu::Format::kRgba16Float, 32, 32};
constexpr ImageDesc kDepth{gpu::Format::kD32Float, 32, 32};
constexpr uint64_t kBytes = 32 * 32 * 8;

/// Compiles what the test described, and lets the simulator judge every plan.
class CompileTest : public testing::Test {
  protected:
    bool compile(const Switches& switches = {}) {
        const CompileOptions options{.switches = switches};
        const bool made = compiler_.compile(g_, options, plan_, diagnostics_);
        if (made) {
            EXPECT_EQ(test::simulate(g_, options, plan_), "") << explain(g_, plan_);
        }
        return made;
    }
    /// The message of the only mistake.
    std::string mistake() {
        EXPECT_FALSE(compile());
        EXPECT_EQ(diagnostics_.size(), 1U) << describe(g_, diagnostics_);
        return diagnostics_.empty() ? "" : describe(g_, diagnostics_[0]);
    }
    std::string order() const {
        std::string names;
        for (const Step& step : plan_.steps) {
            names += step.kind == StepKind::kPass ? g_.passes()[step.index].name : "*";
            names += ' ';
        }
        return names;
    }
    PassBuilder compute(std::string_view name) { return g_.add_pass(name, PassKind::kCompute); }
    ImageHandle make(std::string_view name) {
        auto pass = compute(name);
        return pass.write(g_.create_image(name, kColor), Access::kStorageWrite);
    }
    ImageHandle from(std::string_view name, std::initializer_list<ImageHandle> inputs) {
        auto pass = compute(name);
        for (const ImageHandle input : inputs) pass.read(input, Access::kSampledCompute);
        return pass.write(g_.create_image(name, kColor), Access::kStorageWrite);
    }
    const Barrier* barrier_before(std::string_view pass, uint32_t resource) const {
        for (const Step& step : plan_.steps) {
            if (g_.passes()[step.index].name != pass) continue;
            for (const Barrier& barrier : plan_.barriers_of(step)) {
                if (barrier.resource == resource && !barrier.global) return &barrier;
            }
        }
        return nullptr;
    }

    GraphDescription g_;
    Compiler compiler_;
    Plan plan_;
    Diagnostics diagnostics_;
};

// a -> b -> out      c (nobody reads it)      d (side effect)
TEST_F(CompileTest, CullsWhatNoOutputNeeds) {
    const auto a = make("a");
    make("c");
    const auto b = from("b", {a});
    compute("d").side_effect();
    g_.output(b);
    ASSERT_TRUE(compile());
    EXPECT_EQ(order(), "a b d ");
    ASSERT_TRUE(compile({.no_culling = true}));
    EXPECT_EQ(order(), "a c b d ");
}

// a writes x; b overwrites all of x; out: nobody sees what a wrote.
TEST_F(CompileTest, CullsAWriterThatIsOverwritten) {
    auto x = make("a");
    auto b = compute("b");
    x = b.write(x, Access::kStorageWrite, {}, Load::kDiscard);
    g_.output(x);
    ASSERT_TRUE(compile());
    EXPECT_EQ(order(), "b ");
}

// x0 -> write -> x1 -> write -> x2, and "late" asks for x1: it runs before the second write.
TEST_F(CompileTest, ReaderOfAnOldVersionRunsBeforeItIsOverwritten) {
    const auto x1 = make("first");
    auto second = compute("second");
    const auto x2 = second.write(x1, Access::kStorageReadWrite);
    const auto seen = from("late", {x1});
    g_.output(x2);
    g_.output(seen);
    ASSERT_TRUE(compile());
    EXPECT_EQ(order(), "first late second ");
    EXPECT_EQ(barrier_before("second", x1.index)->reason, Reason::kWriteAfterRead);
}

// a   b   c   (no edges): every order is legal, and seeds find more than one.
TEST_F(CompileTest, RandomOrderVariesWithTheSeedOnly) {
    for (const char* name : {"a", "b", "c", "d"}) g_.output(make(name));
    std::vector<std::string> seen;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        ASSERT_TRUE(compile({.random_order = true, .seed = seed}));
        seen.push_back(order());
        ASSERT_TRUE(compile({.random_order = true, .seed = seed}));
        EXPECT_EQ(order(), seen.back());
    }
    std::ranges::sort(seen);
    EXPECT_GT(std::ranges::unique(seen).begin() - seen.begin(), 3);
}

// a -> b -> c -> d: b reads a while it lives, so two images suffice for four.
TEST_F(CompileTest, ResourcesWhoseLivesDoNotMeetShareMemory) {
    g_.output(from("d", {from("c", {from("b", {make("a")})})}));
    ASSERT_TRUE(compile());
    EXPECT_EQ(plan_.transient_bytes, 2 * kBytes);
    EXPECT_EQ(plan_.transient_unaliased_bytes, 4 * kBytes);
    EXPECT_EQ(barrier_before("c", 2)->reason, Reason::kAlias);
    ASSERT_TRUE(compile({.no_aliasing = true}));
    EXPECT_EQ(plan_.transient_bytes, 4 * kBytes);
}

// a -> b: one barrier for both readers, whatever their stage.
//   \-> c
TEST_F(CompileTest, OneBarrierServesAllReadersOfAVersion) {
    const auto a = make("a");
    const auto b = from("b", {a});
    auto draw = g_.add_pass("draw", PassKind::kRaster);
    draw.read(a, Access::kSampledFragment);
    draw.read(b, Access::kSampledFragment);
    g_.output(draw.color(g_.create_image("target", kColor), clear(0)));
    ASSERT_TRUE(compile());
    const Barrier* barrier = barrier_before("b", a.index);
    ASSERT_NE(barrier, nullptr);
    EXPECT_EQ(barrier->reason, Reason::kReadAfterWrite);
    EXPECT_EQ(barrier->src_stages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(barrier->src_access, VK_ACCESS_SHADER_WRITE_BIT);
    EXPECT_EQ(barrier->dst_stages,
              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    EXPECT_EQ(barrier->dst_access, VK_ACCESS_SHADER_READ_BIT);
    EXPECT_EQ(barrier->old_layout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(barrier->new_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(barrier_before("draw", a.index), nullptr);
    EXPECT_NE(explain(g_, plan_, *barrier)
                  .find("'a': a [compute] -> b [fragment+compute], general "
                        "-> shader read only: read after write"),
              std::string::npos)
        << explain(g_, plan_, *barrier);
}

// scene (clear color, clear depth) -> fog (keeps color, tests depth) -> out
TEST_F(CompileTest, LoadAndStoreOpsFollowFromWhoReads) {
    auto color = g_.create_image("color", kColor);
    auto depth = g_.create_image("depth", kDepth);
    auto scene = g_.add_pass("scene", PassKind::kRaster);
    color = scene.color(color, clear(0));
    depth = scene.depth(depth, clear(0));
    auto fog = g_.add_pass("fog", PassKind::kRaster);
    fog.read(depth, Access::kDepthReadOnly);
    color = fog.color(color);
    auto scratch = fog.color(g_.create_image("scratch", kColor), discard());
    g_.output(color);
    ASSERT_TRUE(compile());
    ASSERT_EQ(plan_.attachments.size(), 5U);
    const auto expect = [&](size_t i, Load load, bool store, bool read_only) {
        EXPECT_EQ(plan_.attachments[i].load.op, load) << i;
        EXPECT_EQ(plan_.attachments[i].store, store) << i;
        EXPECT_EQ(plan_.attachments[i].read_only, read_only) << i;
    };
    expect(0, Load::kClear, true, false);     // color, read by fog
    expect(1, Load::kClear, true, false);     // depth, tested by fog
    expect(2, Load::kKeep, true, false);      // color, asked for
    expect(3, Load::kDiscard, false, false);  // scratch, read by nobody
    EXPECT_TRUE(plan_.attachments[4].read_only);
    EXPECT_EQ(plan_.steps[1].color_count, 2U);
    EXPECT_TRUE(plan_.steps[1].has_depth);
    static_cast<void>(scratch);
}

// mip 0 -> mip 1 -> mip 2 of one image: only the parts move between layouts.
TEST_F(CompileTest, SubresourcesHaveTheirOwnBarriers) {
    auto image = g_.create_image("pyramid", {gpu::Format::kRgba16Float, 32, 32, 1, 3});
    for (uint16_t mip = 0; mip < 3; ++mip) {
        auto pass = compute(g_.text("mip" + std::to_string(mip)));
        const uint16_t above = mip == 0 ? 0 : static_cast<uint16_t>(mip - 1);
        if (mip > 0) pass.read(image, Access::kSampledCompute, {above, 1, 0, 1});
        image = pass.write(image, Access::kStorageWrite, {mip, 1, 0, 1});
    }
    g_.output(image);
    ASSERT_TRUE(compile());
    const Barrier* barrier = barrier_before("mip2", image.index);
    ASSERT_NE(barrier, nullptr);
    EXPECT_EQ(barrier->range, (ImageRange{1, 1, 0, 1}));
    EXPECT_EQ(plan_.barriers.size(), 2U);  // mip 0 and mip 1 become readable
    EXPECT_EQ(plan_.prologue.size(), 4U);  // frame start, three first uses
}

// history.previous -> accumulate -> history.next, out
TEST_F(CompileTest, HistoryIsReadableNextFrame) {
    const History history = g_.history("taa", kColor);
    auto pass = compute("accumulate");
    pass.read(history.previous, Access::kSampledCompute);
    static_cast<void>(pass.write(history.next, Access::kStorageWrite));
    pass.side_effect();
    ASSERT_TRUE(compile());
    ASSERT_EQ(plan_.epilogue.size(), 1U);
    EXPECT_EQ(plan_.epilogue[0].resource, history.next.index);
    EXPECT_EQ(plan_.epilogue[0].new_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(plan_.transient_bytes, 0U);
}

// Who reads last frame's image keeps alive who writes this frame's.
TEST_F(CompileTest, ReadingHistoryKeepsItsWriter) {
    const History history = g_.history("h", kColor);
    auto show = compute("show");
    show.read(history.previous, Access::kSampledCompute);
    g_.output(show.write(g_.create_image("out", kColor), Access::kStorageWrite));
    auto next = compute("next");
    static_cast<void>(next.write(history.next, Access::kStorageWrite));
    ASSERT_TRUE(compile());
    EXPECT_EQ(order(), "show next ");
}

TEST_F(CompileTest, ImportsArriveAndLeaveInTheirStates) {
    auto back = g_.import_image("back", kColor, nullptr, Access::kNone, Access::kPresent);
    auto draw = g_.add_pass("draw", PassKind::kRaster);
    back = draw.color(back, clear(0));
    g_.output(back);
    ASSERT_TRUE(compile());
    EXPECT_EQ(plan_.prologue.back().new_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    ASSERT_EQ(plan_.epilogue.size(), 1U);
    EXPECT_EQ(plan_.epilogue[0].new_layout, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    EXPECT_EQ(plan_.epilogue[0].reason, Reason::kFinalState);
}

TEST_F(CompileTest, PoisonFillsWhatTakesOverMemory) {
    g_.output(from("b", {make("a")}));
    ASSERT_TRUE(compile({.poison = true}));
    EXPECT_EQ(order(), "* a * b ");
}

TEST_F(CompileTest, FullBarriersStandBeforeEveryPass) {
    g_.output(from("b", {make("a")}));
    ASSERT_TRUE(compile({.full_barriers = true}));
    for (const Step& step : plan_.steps) {
        const Barrier& first = plan_.barriers_of(step).front();
        EXPECT_TRUE(first.global);
        EXPECT_EQ(first.reason, Reason::kFullBarrier);
    }
}

// A pass may be declared further after others were added.
TEST_F(CompileTest, InterleavedBuildersKeepTheirAccesses) {
    auto a = compute("a");
    auto b = compute("b");
    auto x = a.write(g_.create_image("x", kColor), Access::kStorageWrite);
    b.read(x, Access::kSampledCompute);
    auto y = a.write(g_.create_image("y", kColor), Access::kStorageWrite);
    b.read(y, Access::kSampledCompute);
    g_.output(b.write(g_.create_image("z", kColor), Access::kStorageWrite));
    ASSERT_TRUE(compile());
    EXPECT_EQ(g_.accesses(0).size(), 2U);
    EXPECT_EQ(g_.accesses(1).size(), 3U);
    EXPECT_EQ(order(), "a b ");
}

TEST_F(CompileTest, SameDescriptionSamePlan) {
    g_.output(from("d", {from("c", {from("b", {make("a")})})}));
    ASSERT_TRUE(compile());
    const std::string text = explain(g_, plan_);
    Compiler other;
    Plan plan;
    ASSERT_TRUE(other.compile(g_, {}, plan, diagnostics_));
    EXPECT_EQ(explain(g_, plan), text);
}

// ---- mistakes ------------------------------------------------------------------------------

void expect_parts(const std::string& message, std::initializer_list<std::string> parts) {
    for (const std::string& part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
}
std::string here(int line) {
    return "compile_test.cpp:" + std::to_string(line);
}

TEST_F(CompileTest, ReadOfSomethingNeverWritten) {
    auto pass = compute("shade");
    pass.read(g_.create_image("hole", kColor), Access::kSampledCompute);
    expect_parts(mistake(), {here(__LINE__ - 1), "'shade'", "'hole'", "no pass has written"});
}

TEST_F(CompileTest, ReadOfASubresourceNeverWritten) {
    auto image = g_.create_image("mips", {gpu::Format::kRgba16Float, 32, 32, 1, 2});
    auto top = compute("top");
    image = top.write(image, Access::kStorageWrite, {0, 1, 0, 1});
    auto all = compute("all");
    all.side_effect();
    all.read(image, Access::kSampledCompute);
    expect_parts(mistake(), {here(__LINE__ - 1), "'all'", "'mips'", "no pass has written"});
}

TEST_F(CompileTest, StaleHandle) {
    const auto old = make("a");
    g_.reset();
    make("b");
    auto pass = compute("late");
    pass.read(old, Access::kSampledCompute);
    expect_parts(mistake(), {here(__LINE__ - 1), "'late'", "not of this description"});
}

TEST_F(CompileTest, TwoWritersOfOneVersion) {
    const auto x = make("x");
    static_cast<void>(compute("one").write(x, Access::kStorageWrite));
    static_cast<void>(compute("two").write(x, Access::kStorageWrite));
    expect_parts(mistake(), {here(__LINE__ - 1), "'two'", "'x'", "'one'", "already"});
}

TEST_F(CompileTest, ConflictingAccessInOnePass) {
    const auto x = make("x");
    auto pass = compute("both");
    pass.read(x, Access::kSampledCompute);
    static_cast<void>(pass.write(x, Access::kStorageWrite));
    expect_parts(mistake(), {here(__LINE__ - 1), "'both'", "'x'", "exclude each other"});
}

// "early" goes on after "late" touched x too; only its own accesses count.
TEST_F(CompileTest, ConflictOfAPassDeclaredFurtherLater) {
    const auto x = make("x");
    auto early = compute("early");
    auto late = compute("late");
    early.read(x, Access::kSampledCompute);
    late.read(x, Access::kSampledCompute);
    early.read(x, Access::kStorageRead);
    expect_parts(mistake(), {here(__LINE__ - 1), "'early'", "'x'", "exclude each other"});
}

TEST_F(CompileTest, AttachmentOfSeveralMips) {
    auto pass = g_.add_pass("draw", PassKind::kRaster);
    const auto image = g_.create_image("pyramid", {gpu::Format::kRgba16Float, 32, 32, 1, 3});
    static_cast<void>(pass.color(image, clear(0)));
    expect_parts(mistake(), {here(__LINE__ - 1), "'draw'", "'pyramid'", "not possible"});
}

TEST_F(CompileTest, DrawingToNothing) {
    g_.add_pass("draw", PassKind::kRaster).side_effect();
    expect_parts(mistake(), {here(__LINE__ - 1), "'draw'", "not possible"});
}

TEST_F(CompileTest, MoreColorsThanAnyDeviceMustHave) {
    auto pass = g_.add_pass("draw", PassKind::kRaster);
    for (int i = 0; i < 9; ++i) {
        static_cast<void>(pass.color(g_.create_image("x", kColor), clear(0)));
    }
    expect_parts(mistake(), {"'draw'", "not possible"});
}

TEST_F(CompileTest, TwoLayoutsAtOnceConflict) {
    const auto x = make("x");
    auto pass = compute("both");
    pass.read(x, Access::kSampledCompute);
    pass.read(x, Access::kStorageRead);
    expect_parts(mistake(), {here(__LINE__ - 1), "'both'", "'x'", "exclude each other"});
}

TEST_F(CompileTest, MissingHistory) {
    const History history = g_.history("taa", kColor);
    auto pass = compute("resolve");
    pass.side_effect();
    pass.read(history.previous, Access::kSampledCompute);
    expect_parts(mistake(), {here(__LINE__ - 1), "'resolve'", "'taa'", "no pass writes its next"});
}

// "mix" reads x1 and x2: before "bump", because it overwrites x1, and after it, because of x2.
TEST_F(CompileTest, Cycle) {
    const auto x1 = make("x");
    auto bump = compute("bump");
    const auto x2 = bump.write(x1, Access::kStorageReadWrite);
    auto mix = compute("mix");
    mix.side_effect();
    mix.read(x2, Access::kStorageRead);
    mix.read(x1, Access::kStorageRead);
    expect_parts(mistake(), {"compile_test.cpp:", "'mix'", "'bump'", "'x'", "before and after"});
}

TEST_F(CompileTest, UnsupportedFormat) {
    auto pass = compute("shade");
    static_cast<void>(pass.write(g_.create_image("d", kDepth), Access::kStorageWrite));
    expect_parts(mistake(), {here(__LINE__ - 1), "'shade'", "'d'", "format"});
}

TEST_F(CompileTest, FormatTheDeviceDoesNotSupport) {
    make("x");
    std::array<uint32_t, kFormatCount> none{};
    EXPECT_FALSE(compiler_.compile(g_, {.format_usage = &none}, plan_, diagnostics_));
    ASSERT_EQ(diagnostics_.size(), 1U);
    EXPECT_EQ(diagnostics_[0].problem, Problem::kUnsupportedFormat);
}

TEST_F(CompileTest, RangeOutsideTheImage) {
    auto pass = compute("shade");
    static_cast<void>(
        pass.write(g_.create_image("x", kColor), Access::kStorageWrite, {1, 1, 0, 1}));
    expect_parts(mistake(), {here(__LINE__ - 1), "'shade'", "'x'", "not possible"});
}

TEST_F(CompileTest, HostReadOfTransientMemory) {
    auto fill = compute("fill");
    const auto buffer = fill.write(g_.create_buffer("b", {64}), Access::kStorageWrite);
    auto pass = g_.add_pass("look", PassKind::kHost);
    pass.read(buffer, Access::kHostRead);
    expect_parts(mistake(), {here(__LINE__ - 1), "'look'", "'b'", "not possible"});
}

TEST_F(CompileTest, UnsupportedUsage) {
    auto pass = compute("shade");
    static_cast<void>(pass.color(g_.create_image("x", kColor), clear(0)));
    expect_parts(mistake(), {here(__LINE__ - 1), "'shade'", "'x'", "not possible"});
}

TEST_F(CompileTest, OutputThatIsOverwritten) {
    const auto x1 = make("x");
    auto again = compute("again");
    again.side_effect();
    static_cast<void>(again.write(x1, Access::kStorageReadWrite));
    g_.output(x1);
    expect_parts(mistake(), {here(__LINE__ - 1), "'x'", "'again'", "overwrites"});
}

TEST_F(CompileTest, AttachmentsOfDifferentSize) {
    auto pass = g_.add_pass("draw", PassKind::kRaster);
    static_cast<void>(pass.color(g_.create_image("big", kColor), clear(0)));
    static_cast<void>(
        pass.depth(g_.create_image("small", {gpu::Format::kD32Float, 16, 16}), clear(0)));
    expect_parts(mistake(), {"compile_test.cpp:", "'draw'", "'small'", "size"});
}

}  // namespace
}  // namespace vellus::graph
