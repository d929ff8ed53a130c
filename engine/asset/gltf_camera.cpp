#include <cmath>
#include <numbers>

#include "engine/asset/gltf_context.h"

// glTF 2.0 specification, chapter 3.10 (cameras); KHR_lights_punctual.
namespace vellus::asset::detail {
namespace {

/// `value` where it is a usable positive number; else `fallback`, reported.
float positive_or(double value, float fallback, const std::string& pointer, Context& context) {
    const auto number = static_cast<float>(value);
    if (std::isfinite(number) && number > 0.0f) {
        return number;
    }
    context.warn(pointer, fmt::format("{} replaced by {}", value, fallback));
    return fallback;
}

/// The far plane; 0 means infinite.
float far_plane(double value, float near_plane, const std::string& pointer, Context& context) {
    const auto number = static_cast<float>(value);
    if (number == 0.0f || number > near_plane) {
        return number;
    }
    context.warn(pointer, fmt::format("{} is not behind the near plane; infinite instead", value));
    return 0.0f;
}

Camera read_camera(const tinygltf::Camera& from, const std::string& pointer, Context& context) {
    Camera camera;
    camera.name = from.name;
    camera.perspective = from.type == "perspective";
    if (camera.perspective) {
        const tinygltf::PerspectiveCamera& p = from.perspective;
        const std::string place = pointer + "/perspective";
        const Camera defaults;
        camera.vertical_fov = positive_or(p.yfov, defaults.vertical_fov, place + "/yfov", context);
        if (camera.vertical_fov >= std::numbers::pi_v<float>) {
            context.warn(place + "/yfov", fmt::format("{} is half a turn or more; {} instead",
                                                      p.yfov, defaults.vertical_fov));
            camera.vertical_fov = defaults.vertical_fov;
        }
        camera.aspect = p.aspectRatio == 0.0
                            ? 0.0f
                            : positive_or(p.aspectRatio, 1.0f, place + "/aspectRatio", context);
        camera.near_plane = positive_or(p.znear, defaults.near_plane, place + "/znear", context);
        camera.far_plane = far_plane(p.zfar, camera.near_plane, place + "/zfar", context);
    } else {
        const tinygltf::OrthographicCamera& o = from.orthographic;
        const std::string place = pointer + "/orthographic";
        camera.half_extent = {positive_or(std::abs(o.xmag), 1.0f, place + "/xmag", context),
                              positive_or(std::abs(o.ymag), 1.0f, place + "/ymag", context)};
        camera.near_plane = static_cast<float>(o.znear);
        if (camera.near_plane < 0.0f) {
            context.warn(place + "/znear", fmt::format("{} replaced by 0", o.znear));
            camera.near_plane = 0.0f;
        }
        camera.far_plane = far_plane(o.zfar, camera.near_plane, place + "/zfar", context);
    }
    return camera;
}

void read_cone(const tinygltf::SpotLight& spot, const std::string& pointer, Context& context,
               Light& light) {
    constexpr float kRightAngle = std::numbers::pi_v<float> / 2.0f;
    light.inner_cone = static_cast<float>(spot.innerConeAngle);
    light.outer_cone = static_cast<float>(spot.outerConeAngle);
    const float outer = std::min(light.outer_cone, kRightAngle);
    const float inner = std::min(light.inner_cone, outer);
    // Files write a right angle as 1.5708.
    if (light.outer_cone > kRightAngle + 1e-4f || light.inner_cone >= light.outer_cone ||
        !(outer > 0.0f)) {
        context.warn(
            pointer,
            fmt::format("cone angles {} and {} must be 0 <= inner < outer <= pi/2; clamped",
                        light.inner_cone, light.outer_cone));
    }
    light.outer_cone = std::max(outer, 1e-3f);
    light.inner_cone = inner;
}

Light read_light(const tinygltf::Light& from, const std::string& pointer, Context& context) {
    Light light;
    light.name = from.name;
    light.intensity = static_cast<float>(from.intensity);
    light.range = static_cast<float>(from.range);
    if (!from.color.empty()) {
        light.color = glm::vec3(from.color[0], from.color[1], from.color[2]);
    }
    if (from.type == "spot") {
        light.kind = LightKind::kSpot;
        read_cone(from.spot, pointer + "/spot", context, light);
    } else if (from.type == "point") {
        light.kind = LightKind::kPoint;
    } else if (from.type != "directional") {
        context.warn(pointer + "/type",
                     fmt::format("unknown type '{}'; the light is off", from.type.substr(0, 40)));
        light.intensity = 0.0f;
    }
    return light;
}

}  // namespace

void read_cameras_and_lights(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.cameras.size(); ++i) {
        const Json& json = context.doc["cameras"][i];
        if (json.contains("perspective") && json.contains("orthographic")) {
            context.warn(fmt::format("/cameras/{}", i),
                         "both perspective and orthographic; read as its type says");
        }
        scene.cameras.push_back(
            read_camera(context.model.cameras[i], fmt::format("/cameras/{}", i), context));
    }
    for (size_t i = 0; i < context.model.lights.size(); ++i) {
        const std::string pointer = fmt::format("/extensions/KHR_lights_punctual/lights/{}", i);
        scene.lights.push_back(read_light(context.model.lights[i], pointer, context));
    }
}

}  // namespace vellus::asset::detail
