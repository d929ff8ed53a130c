#include "modules/scene/register.h"

#include "modules/scene/library.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/stages.h"
#include "modules/scene/transform.h"
#include "modules/scene/view.h"

namespace vellus::scene {
namespace {

template <class T>
void ensure_resource(World& world) {
    if (world.find_resource<T>() == nullptr) world.emplace_resource<T>();
}

}  // namespace

void register_scene(World& world, Schedule& schedule) {
    ensure_resource<SceneLibrary>(world);
    ensure_resource<FixedStep>(world);
    ensure_resource<ViewSettings>(world);
    ensure_resource<ViewState>(world);
    ensure_resource<Hierarchy>(world);
    order_stages(schedule);
    schedule.add(propagate_transforms).in(kTransforms);
    schedule.add(update_view).in(kView);
    if (world.find_resource<RenderFrame>() != nullptr) {
        schedule.add(begin_frame).in(kView).after(update_view);
    }
}

}  // namespace vellus::scene
