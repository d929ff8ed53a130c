#pragma once

#include "engine/asset/json_fields.h"
#include "modules/hair/dynamics/components.h"

namespace vellus::hair {

/// "motion" of VELLUS_hair.
struct MotionChoice {
    HairMotion motion;
    uint32_t guides = 0;  ///< 0: one strand in 24
};

/// Reads the fields of "motion"; errors and unknown fields are those of `fields`.
void read_motion(asset::JsonFields& fields, MotionChoice& motion);

}  // namespace vellus::hair
