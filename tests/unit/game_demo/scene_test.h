#pragma once

#include <memory>
#include <string>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "modules/hair/dynamics/components.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::demo {

/// One of the project's own scenes as the demo draws it, small; hair moves however small it is.
class SceneTest : public test::GpuTest {
  protected:
    void open(const std::string& name) {
        auto made = Renderer::create(device(), {});
        ASSERT_TRUE(made) << made.error().message();
        renderer_ = std::move(*made);
        Options options;
        options.scene = VELLUS_SOURCE_DIR "/assets/scenes/" + name + ".gltf";
        options.size = {64, 64};
        ASSERT_TRUE(load_content(*renderer_, options));
        world().query<hair::HairMotion>().each(
            [](hair::HairMotion& motion) { motion.smallest_pixels = 0.0f; });
    }
    World& world() { return renderer_->world(); }
    void draw_frame() {
        EXPECT_TRUE(renderer_->draw(Output::kNowhere));
        EXPECT_TRUE(renderer_->wait());
    }

  private:
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace vellus::demo
