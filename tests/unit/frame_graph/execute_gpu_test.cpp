#include "engine/frame_graph/execute.h"

#include <cmath>
#include <cstring>

#include "engine/frame_graph/context.h"
#include "engine/platform/hash.h"
#include "tests/support/failing_driver.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::graph {
namespace {

constexpr uint32_t kSide = 64;
constexpr ImageDesc kHdr{gpu::Format::kRgba16Float, kSide, kSide};
constexpr uint64_t kPixelBytes = kSide * kSide * 8;

struct CombinePush {
    VkDeviceAddress words;
    uint32_t use_words;
    uint32_t use_second;
};
struct ClearPush {
    VkDeviceAddress words;
    uint32_t count;
    uint32_t value;
};
struct TrianglePush {
    float depth;
    float brightness;
};

struct Pipelines {
    const gpu::Pipeline *pattern, *combine, *clear, *triangle;
};

class ExecutorTest : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        using gpu::Binding;
        auto& library = device().pipelines();
        const auto get = [](Result<const gpu::Pipeline*> made) {
            EXPECT_TRUE(made) << made.error().message();
            return made ? *made : nullptr;
        };
        pipelines_.pattern = get(library.compute({.shader = "testing/pattern.comp.glsl",
                                                  .bindings = {Binding::kStorage},
                                                  .push_bytes = 4}));
        pipelines_.combine = get(library.compute(
            {.shader = "testing/combine.comp.glsl",
             .bindings = {Binding::kSampledLinear, Binding::kSampledNearest, Binding::kStorage},
             .push_bytes = sizeof(CombinePush)}));
        pipelines_.clear = get(library.compute(
            {.shader = "common/clear_words.comp.glsl", .push_bytes = sizeof(ClearPush)}));
        pipelines_.triangle = get(library.raster({.vertex_shader = "testing/triangle.vert.glsl",
                                                  .fragment_shader = "testing/triangle.frag.glsl",
                                                  .bindings = {Binding::kSampledNearest},
                                                  .push_bytes = sizeof(TrianglePush),
                                                  .color_formats = {kHdr.format},
                                                  .depth_format = gpu::Format::kD32Float,
                                                  .depth = gpu::DepthMode::kTestWrite}));
        auto buffer = gpu::Buffer::create(device(), kPixelBytes, gpu::MemoryKind::kReadback, "out");
        ASSERT_TRUE(buffer) << buffer.error().message();
        readback_ = std::move(*buffer);
    }

    ImageHandle pattern(std::string_view name, uint32_t frame) {
        auto pass = graph_.add_pass(name, PassKind::kCompute);
        auto image = graph_.create_image(name, kHdr);
        image = pass.write(image, Access::kStorageWrite, {}, Load::kDiscard);
        pass.execute([=, p = pipelines_](PassContext& ctx) {
            ctx.commands().bind(*p.pattern);
            ctx.commands().images({ctx.view(image)});
            ctx.commands().push(frame);
            ctx.commands().dispatch(kSide / 8, kSide / 8);
        });
        return image;
    }

    ImageHandle combine(std::string_view name, ImageHandle first, ImageHandle second,
                        ImageHandle into) {
        auto pass = graph_.add_pass(name, PassKind::kCompute);
        pass.read(first, Access::kSampledCompute);
        if (!(second == first)) pass.read(second, Access::kSampledCompute);
        into = pass.write(into, Access::kStorageWrite, {}, Load::kDiscard);
        pass.execute([=, p = pipelines_](PassContext& ctx) {
            ctx.commands().bind(*p.combine);
            ctx.commands().images({ctx.view(first), ctx.view(second), ctx.view(into)});
            ctx.commands().push(CombinePush{0, 0, 1});
            ctx.commands().dispatch(kSide / 8, kSide / 8);
        });
        return into;
    }

    BufferHandle words(uint32_t value) {
        auto pass = graph_.add_pass("words", PassKind::kCompute);
        auto buffer = graph_.create_buffer("words", {256});
        buffer = pass.write(buffer, Access::kStorageWrite, Load::kDiscard);
        pass.execute([=, p = pipelines_](PassContext& ctx) {
            ctx.commands().bind(*p.clear);
            ctx.commands().push(ClearPush{ctx.address(buffer), 64, value});
            ctx.commands().dispatch(1);
        });
        return buffer;
    }

    /// Each mip of a pyramid from the one before, the last one scaled up again by sampling.
    ImageHandle pyramid(ImageHandle source) {
        auto levels = graph_.create_image("pyramid", {kHdr.format, kSide, kSide, 1, 3});
        for (uint16_t mip = 0; mip < 3; ++mip) {
            auto pass = graph_.add_pass("pyramid", PassKind::kCompute);
            const ImageRange to{mip, 1, 0, 1};
            const ImageRange from{static_cast<uint16_t>(mip - 1), 1, 0, 1};
            const ImageHandle before = mip == 0 ? source : levels;
            const ImageRange before_range = mip == 0 ? ImageRange{0, 1, 0, 1} : from;
            pass.read(before, Access::kSampledCompute, before_range);
            levels = pass.write(levels, Access::kStorageWrite, to, Load::kDiscard);
            pass.execute([=, p = pipelines_](PassContext& ctx) {
                ctx.commands().bind(*p.combine);
                const VkImageView in = ctx.view(before, before_range);
                ctx.commands().images({in, in, ctx.view(levels, to)});
                ctx.commands().push(CombinePush{0, 0, 1});
                ctx.commands().dispatch(kSide / 8, kSide / 8);
            });
        }
        return levels;
    }

    ImageHandle triangles(ImageHandle texture) {
        auto pass = graph_.add_pass("triangles", PassKind::kRaster);
        auto color = graph_.create_image("color", kHdr);
        auto depth = graph_.create_image("depth", {gpu::Format::kD32Float, kSide, kSide});
        pass.read(texture, Access::kSampledFragment);
        color = pass.color(color, clear(0.25F, 0.5F, 0, 1));
        static_cast<void>(pass.depth(depth, clear(0)));
        pass.execute([=, p = pipelines_](PassContext& ctx) {
            ctx.commands().bind(*p.triangle);
            ctx.commands().images({ctx.view(texture)});
            ctx.commands().push(TrianglePush{0.5F, 1});
            ctx.commands().draw(3);
            ctx.commands().push(TrianglePush{0.25F, 2});  // hidden behind the first
            ctx.commands().draw(3);
        });
        return color;
    }

    ImageHandle accumulate(ImageHandle color, ImageHandle pyramid_levels, BufferHandle buffer) {
        const History history = graph_.history("trail", kHdr);
        auto pass = graph_.add_pass("accumulate", PassKind::kCompute);
        pass.read(history.previous, Access::kSampledCompute);
        pass.read(color, Access::kSampledCompute);
        pass.read(buffer, Access::kStorageRead);
        const auto next = pass.write(history.next, Access::kStorageWrite, {}, Load::kDiscard);
        bool* valid = &history_was_valid_;
        pass.execute([=, p = pipelines_](PassContext& ctx) {
            *valid = ctx.history_valid(history.previous);
            ctx.commands().bind(*p.combine);
            ctx.commands().images({ctx.view(color), ctx.view(history.previous), ctx.view(next)});
            ctx.commands().push(CombinePush{ctx.address(buffer), 64, 1});
            ctx.commands().dispatch(kSide / 8, kSide / 8);
        });
        return combine("finish", next, pyramid_levels, graph_.create_image("final", kHdr));
    }

    void copy_out(ImageHandle image) {
        auto pass = graph_.add_pass("copy out", PassKind::kTransfer);
        auto out = graph_.import_buffer("out", {kPixelBytes}, &readback_, Access::kNone,
                                        Access::kHostRead);
        pass.read(image, Access::kTransferRead);
        out = pass.write(out, Access::kTransferWrite, Load::kDiscard);
        pass.execute([=](PassContext& ctx) {
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                           .imageExtent = {kSide, kSide, 1}};
            vkCmdCopyImageToBuffer(ctx.commands().handle(), ctx.image(image),
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, ctx.buffer(out), 1,
                                   &region);
        });
        graph_.output(out);
    }

    void describe_frame(uint32_t frame) {
        graph_.reset();
        const auto a = pattern("a", frame);
        const auto unused = pattern("unused", 99);
        const auto b = combine("b", a, a, graph_.create_image("b", kHdr));
        const auto c = combine("c", b, a, graph_.create_image("c", kHdr));
        const auto levels = pyramid(c);
        const auto color = triangles(combine("d", c, b, graph_.create_image("d", kHdr)));
        static_cast<void>(combine("nobody asks", unused, color, graph_.create_image("n", kHdr)));
        copy_out(accumulate(color, levels, words(frame + 3)));
    }

    std::vector<std::byte> picture() {
        std::vector<std::byte> bytes(kPixelBytes);
        std::memcpy(bytes.data(), readback_.mapped(), bytes.size());
        return bytes;
    }

    /// Runs frames under the switches and fingerprints all pictures.
    uint64_t run(const Switches& switches, uint32_t frames = 4) {
        auto executor = Executor::create(device());
        if (!executor) {
            ADD_FAILURE() << executor.error().message();
            return 0;
        }
        (*executor)->switches() = switches;
        uint64_t hash = kHashSeed;
        for (uint32_t frame = 0; frame < frames; ++frame) {
            describe_frame(frame);
            const auto done = (*executor)->execute(graph_);
            if (!done) ADD_FAILURE() << done.error().message();
            EXPECT_TRUE((*executor)->wait());
            EXPECT_EQ(history_was_valid_, frame > 0);
            hash = fnv1a(picture(), hash);
        }
        return hash;
    }

    GraphDescription graph_;
    Pipelines pipelines_{};
    gpu::Buffer readback_;
    bool history_was_valid_ = false;
};

// a -> b -> c -> d -> triangles -> accumulate -> finish -> out
//       \____/ \-> pyramid x3 ___________________/     (and a history, a buffer, two idle passes)
TEST_F(ExecutorTest, EverySwitchGivesTheSamePicture) {
    const uint64_t plain = run({});
    EXPECT_NE(plain, run({}, 3));  // frames do differ
    EXPECT_EQ(plain, run({.no_culling = true}));
    EXPECT_EQ(plain, run({.no_aliasing = true}));
    EXPECT_EQ(plain, run({.full_barriers = true}));
    EXPECT_EQ(plain, run({.poison = true}));
    EXPECT_EQ(plain, run({.immediate = true}));
    for (uint64_t seed = 1; seed < 6; ++seed) {
        EXPECT_EQ(plain, run({.random_order = true, .seed = seed})) << seed;
    }
    EXPECT_EQ(plain, run({.no_culling = true,
                          .full_barriers = true,
                          .poison = true,
                          .immediate = true,
                          .random_order = true,
                          .seed = 9}));
}

TEST_F(ExecutorTest, PictureIsWhatThePassesSay) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    graph_.reset();
    copy_out(pattern("a", 5));
    ASSERT_TRUE((*executor)->execute(graph_));
    ASSERT_TRUE((*executor)->wait());
    const auto bytes = picture();
    for (uint32_t y = 0; y < kSide; y += 7) {
        for (uint32_t x = 0; x < kSide; x += 5) {
            uint16_t half = 0;
            std::memcpy(&half, &bytes[(y * kSide + x) * 8], 2);
            const uint32_t want = (x * 73 + y * 151 * 7 + 5 * 29) % 256;
            // k / 256 as a half: exact for k < 256.
            const auto got = std::ldexp(half >> 10 ? 1024 + (half & 1023) : half & 1023,
                                        (half >> 10 ? half >> 10 : 1) - 25);
            ASSERT_EQ(got * 256, want) << x << ", " << y;
        }
    }
}

TEST_F(ExecutorTest, SteadyFramesCreateNothing) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    uint64_t created = 0;
    for (uint32_t frame = 0; frame < 12; ++frame) {
        describe_frame(frame);
        ASSERT_TRUE((*executor)->execute(graph_));
        if (frame == 3) created = (*executor)->objects_created();
    }
    EXPECT_EQ((*executor)->objects_created(), created);
    ASSERT_TRUE((*executor)->wait());
}

TEST_F(ExecutorTest, ReportNamesPassesAndAddsUp) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    describe_frame(0);
    ASSERT_TRUE((*executor)->execute(graph_));
    ASSERT_TRUE((*executor)->wait());
    const FrameReport& report = (*executor)->report();
    EXPECT_EQ(report.index, 0U);
    double sum = report.unattributed_ms;
    uint32_t draws = 0, dispatches = 0;
    for (const PassReport& pass : report.passes) {
        EXPECT_NE(pass.name, "nobody asks");
        EXPECT_GE(pass.gpu_ms, 0);
        sum += pass.gpu_ms;
        draws += pass.draws;
        dispatches += pass.dispatches;
    }
    // a, b, c, 3 of the pyramid, d, triangles, words, accumulate, finish, copy out.
    EXPECT_EQ(report.passes.size(), 12U);
    EXPECT_EQ(draws, 2U);
    EXPECT_EQ(dispatches, 10U);  // all but the triangles and the copy
    EXPECT_GT(report.gpu_ms, 0);
    EXPECT_NEAR(sum, report.gpu_ms, 1e-9 + 1e-9 * report.gpu_ms);  // rounding of the sum
    EXPECT_LT(report.memory.transient_bytes, report.memory.transient_unaliased_bytes);
    EXPECT_GT(report.memory.persistent_bytes, 2 * kPixelBytes);  // the history's two images
}

TEST_F(ExecutorTest, HistoryRestartsAfterACutAndAGap) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    bool valid = false;
    const auto frame = [&](bool described, bool cut, ImageDesc desc) {
        graph_.reset();
        auto pass = graph_.add_pass("pass", PassKind::kTransfer);
        pass.side_effect();
        if (described) {
            const History history = graph_.history("h", desc, cut);
            pass.read(history.previous, Access::kTransferRead);
            static_cast<void>(pass.write(history.next, Access::kTransferWrite));
            bool* out = &valid;
            pass.execute([=](PassContext& ctx) {
                *out = ctx.history_valid(history.previous);
                const VkClearColorValue value{};
                const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
                vkCmdClearColorImage(ctx.commands().handle(), ctx.image(history.next),
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &all);
            });
        }
        const auto done = (*executor)->execute(graph_);
        EXPECT_TRUE(done) << (done ? "" : done.error().message());
        return valid;
    };
    constexpr ImageDesc kSmall{gpu::Format::kRgba16Float, 16, 16};
    EXPECT_FALSE(frame(true, false, kHdr));
    EXPECT_TRUE(frame(true, false, kHdr));
    EXPECT_FALSE(frame(true, true, kHdr));
    EXPECT_TRUE(frame(true, false, kHdr));
    frame(false, false, kHdr);
    EXPECT_FALSE(frame(true, false, kHdr));
    EXPECT_FALSE(frame(true, false, kSmall));
    EXPECT_TRUE(frame(true, false, kSmall));
}

TEST_F(ExecutorTest, HostPassSeesWhatTheDeviceWrote) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    graph_.reset();
    auto out =
        graph_.import_buffer("out", {kPixelBytes}, &readback_, Access::kNone, Access::kHostRead);
    auto write = graph_.add_pass("write", PassKind::kCompute);
    out = write.write(out, Access::kStorageWrite);
    write.execute([=, p = pipelines_](PassContext& ctx) {
        ctx.commands().bind(*p.clear);
        ctx.commands().push(ClearPush{ctx.address(out), 64, 0xabcdU});
        ctx.commands().dispatch(1);
    });
    auto look = graph_.add_pass("look", PassKind::kHost);
    look.read(out, Access::kHostRead);
    look.side_effect();
    uint32_t seen = 0;
    look.execute([&seen, mapped = readback_.mapped()](PassContext&) {
        std::memcpy(&seen, mapped + 63 * 4, 4);
    });
    ASSERT_TRUE((*executor)->execute(graph_));
    EXPECT_EQ(seen, 0xabcdU);
    ASSERT_TRUE((*executor)->wait());
}

TEST_F(ExecutorTest, UndeclaredAccessNamesPassAndResource) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    graph_.reset();
    const auto a = pattern("a", 0);
    auto sneak = graph_.add_pass("sneak", PassKind::kCompute);
    sneak.side_effect();
    sneak.execute([=, p = pipelines_](PassContext& ctx) {
        ctx.commands().bind(*p.pattern);
        EXPECT_NE(ctx.view(a), VkImageView{VK_NULL_HANDLE});
    });
    const auto done = (*executor)->execute(graph_);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message().find("'sneak'"), std::string::npos) << done.error().message();
    EXPECT_NE(done.error().message().find("'a'"), std::string::npos);
    EXPECT_NE(done.error().message().find("did not declare"), std::string::npos);
    // The next frame is none the worse for it.
    describe_frame(0);
    EXPECT_TRUE((*executor)->execute(graph_));
    EXPECT_TRUE((*executor)->wait());
}

TEST_F(ExecutorTest, OutOfMemoryNamesTheLargestResource) {
    if (!test::MemoryLimit::possible()) GTEST_SKIP() << "sanitizers need all the address space";
    if (!device().traits().is_cpu) GTEST_SKIP() << "memory runs out on a CPU device only";
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    graph_.reset();
    auto pass = graph_.add_pass("fill", PassKind::kCompute);
    const ImageDesc small{gpu::Format::kRgba32Float, 16, 16};
    const ImageDesc large{gpu::Format::kRgba32Float, 8192, 8192};
    graph_.output(pass.write(graph_.create_image("small", small), Access::kStorageWrite));
    graph_.output(pass.write(graph_.create_image("large", large), Access::kStorageWrite));
    {
        const test::MemoryLimit limit(256 << 20);
        ASSERT_TRUE(limit.works());
        const auto done = (*executor)->execute(graph_);
        ASSERT_FALSE(done);
        const std::string message = done.error().message();
        EXPECT_NE(message.find("out of device memory"), std::string::npos) << message;
        EXPECT_NE(message.find("'large'"), std::string::npos) << message;
    }
    describe_frame(0);
    EXPECT_TRUE((*executor)->execute(graph_));
    EXPECT_TRUE((*executor)->wait());
}

TEST_F(ExecutorTest, ALostDeviceEndsInAnError) {
    auto executor = Executor::create(device());
    ASSERT_TRUE(executor);
    describe_frame(0);
    ASSERT_TRUE((*executor)->execute(graph_));
    {
        const PFN_vkWaitForFences lost = [](VkDevice, uint32_t, const VkFence*, VkBool32,
                                            uint64_t) { return VK_ERROR_DEVICE_LOST; };
        const test::Replaced replaced(vkWaitForFences, lost);
        const auto done = (*executor)->wait();
        ASSERT_FALSE(done);
        EXPECT_NE(done.error().message().find("device was lost"), std::string::npos);
    }
    ASSERT_TRUE((*executor)->wait());
    const PFN_vkQueueSubmit2 lost = [](VkQueue, uint32_t, const VkSubmitInfo2*, VkFence) {
        return VK_ERROR_DEVICE_LOST;
    };
    const test::Replaced replaced(vkQueueSubmit2, lost);
    describe_frame(1);
    const auto done = (*executor)->execute(graph_);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message().find("device was lost"), std::string::npos);
    EXPECT_NE(done.error().message().find("submitting the frame"), std::string::npos);
}

}  // namespace
}  // namespace vellus::graph
