#include "modules/hair/dynamics/device_guides.h"

#include <algorithm>
#include <cassert>

namespace vellus::hair {

namespace {

Result<void> upload_column(gpu::Device& device, const std::vector<float>& column, const char* name,
                           gpu::Buffer& out) {
    auto made = gpu::Buffer::upload_span(device, std::span(column), name);
    if (!made) return made.error();
    out = *std::move(made);
    return {};
}

constexpr uint64_t aligned(uint64_t bytes) {
    return (bytes + 255) & ~uint64_t{255};
}

template <class T>
uint64_t put(std::byte* at, std::span<const T> values) {
    std::ranges::copy(std::as_bytes(values), at);
    return aligned(values.size_bytes());
}

}  // namespace

uint64_t DeviceGuides::slot_bytes() const {
    return aligned(sizeof(glsl::RodParams)) + aligned(guides * sizeof(glsl::RodRoot)) +
           aligned(kMostCapsules * sizeof(glsl::RodCapsule)) + aligned(guides * sizeof(glm::vec4));
}

Result<DeviceGuides> DeviceGuides::upload(gpu::Device& device, const GuideSet& set,
                                          const GuideState& state) {
    DeviceGuides made;
    made.guides = set.count;
    made.stride = set.stride;
    made.links = set.links;
    std::vector<float> columns;
    for (const GuideColumns* column : {&state.rotation, &state.velocity, &state.tension}) {
        columns.insert(columns.end(), column->data.begin(), column->data.end());
    }
    columns.resize(columns.size() + size_t{2} * kTurnSlots * set.count * set.links);
    const Result<void> steps[] = {
        upload_column(device, set.rest.data, "hair guide links", made.rest),
        upload_column(device, set.preload.data, "hair guide preloads", made.preload),
        upload_column(device, columns, "hair guide state", made.state),
    };
    for (const auto& step : steps) {
        if (!step) return step.error();
    }
    auto inputs = gpu::Buffer::create(device, kTurnSlots * made.slot_bytes(),
                                      gpu::MemoryKind::kUpload, "hair guide inputs");
    if (!inputs) return inputs.error();
    made.inputs = *std::move(inputs);
    return made;
}

VkDeviceAddress DeviceGuides::turns(uint32_t slot) const {
    return state.address() + 8 * column_bytes() + uint64_t{8} * slot * guides * links;
}

SolvePush DeviceGuides::write(uint32_t slot, const MotionWork& work,
                              std::span<const RootPose> shown) {
    assert(slot < kTurnSlots && shown.size() == guides && work.capsules.size() <= kMostCapsules);
    const uint64_t first = slot * slot_bytes();
    std::byte* const memory = inputs.mapped() + first;
    SolvePush push{.rest = rest.address(),
                   .preload = preload.address(),
                   .rotation = state.address(),
                   .velocity = state.address() + 4 * column_bytes(),
                   .tension = state.address() + 7 * column_bytes(),
                   .turns = turns(slot),
                   .count = guides,
                   .stride = stride,
                   .links = links};
    uint64_t at = 0;
    push.params = inputs.address() + first + at;
    at += put(memory + at, std::span<const glsl::RodParams>(&work.params, 1));
    push.roots = inputs.address() + first + at;
    at += put(memory + at, std::span<const glsl::RodRoot>(work.roots));
    push.capsules = inputs.address() + first + at;
    at += put(memory + at, std::span<const glsl::RodCapsule>(work.capsules));
    push.shown = inputs.address() + first + at;
    auto* const quaternions = reinterpret_cast<glm::vec4*>(memory + at);
    for (uint32_t g = 0; g < guides; ++g) {
        const glm::dquat& q = shown[g].turn;
        quaternions[g] = glm::vec4(q.x, q.y, q.z, q.w);
    }
    return push;
}

}  // namespace vellus::hair
