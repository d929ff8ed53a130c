#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "tests/stability/cases.h"
#include "tests/stability/report.h"
#include "tests/support/gpu_fixture.h"

// Every case again on the device: the same inputs, the shader's own arithmetic.
namespace vellus::test {
namespace {

class DeviceProbe : public GpuTest {
  protected:
    std::vector<ProbeOutput> run(const std::vector<ProbeInput>& inputs) {
        std::vector<ProbeOutput> outputs(inputs.size());
        auto in = gpu::Buffer::upload_span<ProbeInput>(device(), inputs, "probe inputs");
        auto out = gpu::Buffer::create(device(), outputs.size() * sizeof(ProbeOutput),
                                       gpu::MemoryKind::kDevice, "probe outputs");
        const struct {
            VkDeviceAddress inputs, outputs;
            uint32_t count, padding;
        } push{in->address(), out->address(), static_cast<uint32_t>(inputs.size()), 0};
        const auto pipeline = device().pipelines().compute(
            {.shader = "hair/reference/probe.comp.glsl", .push_bytes = sizeof(push)});
        if (!pipeline) {
            ADD_FAILURE() << pipeline.error().message();
            return outputs;
        }
        EXPECT_TRUE(device().submit_now("probe", [&](VkCommandBuffer handle) {
            gpu::CommandBuffer commands(handle);
            commands.bind(**pipeline);
            commands.push(push);
            commands.dispatch_threads(push.count, 64);
        }));
        EXPECT_TRUE(out->read_back(device(), std::as_writable_bytes(std::span(outputs))));
        return outputs;
    }
};

std::vector<ProbeInput> inputs_of(const Generator& generator, size_t count) {
    std::vector<ProbeInput> inputs;
    for (size_t i = 0; i < count; ++i) {
        Random random(21, i);
        inputs.push_back(generator(random));
    }
    return inputs;
}

TEST_F(DeviceProbe, ExtremesAreFiniteAndNotNegative) {
    const auto inputs = inputs_of(extreme_input, 200'000);
    const auto outputs = run(inputs);
    Worst worst;
    for (size_t i = 0; i < inputs.size(); ++i) {
        for (const glm::vec4& value : outputs[i].value) {
            for (int c = 0; c < 4; ++c) {
                const bool fine = std::isfinite(value[c]) && value[c] >= 0.0f;
                worst.add(fine ? 0.0 : 1.0, [&] {
                    return fmt::format("output {}.{} = {}: {}", &value - outputs[i].value, c,
                                       value[c], describe(inputs[i]));
                });
            }
        }
    }
    worst.report("device", "extremes: finite, >= 0", 0.0);
}

TEST_F(DeviceProbe, AgreesWithTheSameCodeInCpp) {
    const auto inputs = inputs_of(ordinary_input, 200'000);
    const auto outputs = run(inputs);
    Worst worst;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const ProbeOutput exact = hair::probe::probe(inputs[i], static_cast<uint32_t>(i));
        for (int row = 0; row < 12; ++row) {
            for (int c = 0; c < 4; ++c) {
                const double a = exact.value[row][c];
                const double b = outputs[i].value[row][c];
                worst.add(std::abs(a - b) / (std::abs(a) + 0.05), [&] {
                    return fmt::format("output {}.{} {} vs {}: {}", row, c, b, a,
                                       describe(inputs[i]));
                });
            }
        }
    }
    // Vulkan allows exp2 3 + 2|x| ulp: 1e-4 at exponents of a few hundred times the lobes' slopes.
    worst.report("device", "difference from C++", 0.01);
}

}  // namespace
}  // namespace vellus::test
