#pragma once

#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// System, after gather_hair: ambient depths of grooms that are drawn with them for the first time.
void upload_ambient_depths(Res<HairLibrary> library, Res<HairFrame> hair,
                           Res<scene::RenderFrame> frame);

}  // namespace vellus::hair
