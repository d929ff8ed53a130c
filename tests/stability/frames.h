#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/stability/report.h"
#include "tests/support/hair_scene.h"

namespace vellus::test {

using Pixels = std::vector<glm::vec4>;

/// Largest difference of two linear pictures as shown, 1 being white; infinite where a value is not
/// finite or the sizes differ. `where` receives the pixel and both values.
double display_error(const Pixels& a, const Pixels& b, std::string* where = nullptr);
/// How many values are not finite or negative.
double bad_values(const Pixels& picture);

/// `count` wavy strands of `points` points, 0.5 to 0.9 m before the camera of a HairScene, the same
/// for the same seed; each has a root no other has.
std::vector<std::vector<glm::vec3>> wavy_tuft(size_t count, size_t points = 12, uint64_t seed = 1);
/// Columns of these strands, with dither seeds that depend on a strand's root alone, so that order
/// and number of strands do not matter to the others.
hair::StrandData rooted_strands(const std::vector<std::vector<glm::vec3>>& strands, float width);

/// Blond, alike in all strands, without taper.
hair::HairExtension plain_look();

/// Puts one pixel's worth of half floats into the picture between hair and TAA.
struct Injection {
    gpu::Buffer texel;
    bool armed = false;
    glm::uvec2 at{0};

    void arm(const glm::uvec2& pixel, uint16_t half);
};
/// Adds the system that injects, armed or not; before the schedule is built.
void add_injection(World& world, Schedule& schedule, gpu::Device& device);

/// A HairScene under sun and sky with TAA, wearing a tuft; `set_up` may add to it before it is
/// built.
struct TuftScene : HairScene {
    TuftScene(gpu::Device& device, uint32_t width, uint32_t height,
              const std::function<void(TuftScene&)>& set_up = {});
    Pixels draw_frames(int count);
    /// The next frame is the first after a cut.
    Pixels draw_cut();
    void place(const glm::dvec3& offset);

    Entity tuft;
    Entity sun;
};

}  // namespace vellus::test
