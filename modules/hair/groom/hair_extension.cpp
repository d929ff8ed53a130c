#include "modules/hair/groom/hair_extension.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/asset/json_fields.h"
#include "modules/hair/groom/groom.h"

namespace vellus::hair {

namespace {

using asset::JsonFields;

constexpr double kFarthest = 1e9;
constexpr double kMostPigment = 100.0;

void read_vec3(JsonFields& fields, std::string_view name, double low, double high,
               glm::dvec3& value) {
    std::array<double, 3> numbers = {value.x, value.y, value.z};
    fields.numbers(name, low, high, numbers);
    value = {numbers[0], numbers[1], numbers[2]};
}

void read_color(JsonFields& fields, std::string_view name, glm::vec3& color) {
    glm::dvec3 wide = color;
    read_vec3(fields, name, 0.0, 1.0, wide);
    color = glm::vec3(wide);
}

void read_transform(JsonFields& fields, HairExtension& hair) {
    fields.boolean("upright", hair.upright);
    fields.object("transform", [&](JsonFields& transform) {
        read_vec3(transform, "translation", -kFarthest, kFarthest, hair.translation);
        read_vec3(transform, "scale", 1e-6, 1e6, hair.scale);
        std::array<double, 4> xyzw = {hair.rotation.x, hair.rotation.y, hair.rotation.z,
                                      hair.rotation.w};
        transform.numbers("rotation", -1.0, 1.0, xyzw);
        const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
        if (glm::length(rotation) < 0.5) {
            return transform.fail("rotation", "has no direction",
                                  "give a unit quaternion x, y, z, w");
        }
        hair.rotation = glm::normalize(rotation);
    });
}

/// Base colour from pigments, given as amounts or as the two sliders.
void read_melanin(JsonFields& fields, glm::vec3& color) {
    fields.object("melanin", [&](JsonFields& pigments) {
        const bool amounts = pigments.has("eumelanin") || pigments.has("pheomelanin");
        const bool sliders = pigments.has("melanin") || pigments.has("redness");
        Melanin melanin{.eumelanin = 0.0f, .pheomelanin = 0.0f};
        float slider = 0.5f;
        float redness = 0.0f;
        pigments.number("eumelanin", 0.0, kMostPigment, melanin.eumelanin);
        pigments.number("pheomelanin", 0.0, kMostPigment, melanin.pheomelanin);
        pigments.number("melanin", 0.0, 1.0, slider);
        pigments.number("redness", 0.0, 1.0, redness);
        if (amounts == sliders) {
            return pigments.fail("melanin", amounts ? "both ways are given" : "no amount is given",
                                 "give eumelanin and pheomelanin, or melanin and redness");
        }
        color = melanin_color(amounts ? melanin : melanin_from_sliders(slider, redness));
    });
}

void read_colors(JsonFields& fields, HairMaterial& material) {
    if (fields.has("base_color") && fields.has("melanin")) {
        fields.fail("melanin", "is given beside base_color", "keep one of the two");
    }
    const bool colored = fields.has("base_color") || fields.has("melanin");
    read_color(fields, "base_color", material.base_color);
    read_melanin(fields, material.base_color);
    material.tip_color = material.base_color;
    fields.object("root_to_tip", [&](JsonFields& gradient) {
        read_color(gradient, "tip_color", material.tip_color);
        gradient.number("start", 0.0, 0.999, material.gradient_start);
    });
    fields.number("color_variation", 0.0, 1.0, material.color_variation);
    material.use_groom_colors = !colored;
    fields.boolean("use_groom_colors", material.use_groom_colors);
}

void read_material(JsonFields& fields, HairMaterial& material) {
    fields.object("material", [&](JsonFields& inner) {
        read_colors(inner, material);
        inner.number("specular", 0.0, 4.0, material.specular);
        inner.number("roughness", 0.0, 1.0, material.roughness);
        inner.number("scatter", 0.0, 4.0, material.scatter);
        inner.number("shift", -0.2, 0.2, material.shift);
        inner.number("alpha", 0.0, 1.0, material.alpha);
        inner.number("eta", 1.1, 3.0, material.eta);
        inner.number("azimuthal", 0.5, 2.0, material.azimuthal);
    });
}

void read_width(JsonFields& fields, HairWidth& width) {
    fields.object("width", [&](JsonFields& inner) {
        inner.number("root", kThinnestStrand, kThickestStrand, width.root);
        inner.number("tip_scale", 0.0, 1.0, width.tip_scale);
        double tip = width.root * width.tip_scale;
        inner.number("tip", 0.0, kThickestStrand, tip);
        if (!inner.has("tip")) return;
        if (inner.has("tip_scale")) {
            return inner.fail("tip", "is given beside tip_scale", "keep one of the two");
        }
        if (!inner.has("root")) return inner.fail("tip", "is given without root", "add root");
        if (tip > width.root) {
            return inner.fail("tip", fmt::format("is {}, wider than root", tip),
                              fmt::format("give a number from 0 to {}", width.root));
        }
        width.tip_scale = static_cast<float>(tip / width.root);
    });
}

void read_techniques(JsonFields& fields, TechniqueIds& ids) {
    fields.object("techniques", [&](JsonFields& inner) {
        inner.text("opacity", ids.opacity);
        inner.text("shadow", ids.shadow);
        inner.text("scattering", ids.scattering);
        inner.text("multiple", ids.multiple);
        inner.text("environment", ids.environment);
    });
}

void read_binding(JsonFields& fields, std::optional<HairBindingChoice>& binding) {
    fields.object("binding", [&](JsonFields& inner) {
        HairBindingChoice& choice = binding.emplace();
        inner.index_or_text("mesh", choice.node, choice.name);
        if (!choice.node && choice.name.empty()) {
            inner.fail("mesh", "is missing or empty",
                       "give the index or the name of a node with a mesh");
        }
    });
}

void read_cards(JsonFields& fields, std::optional<CardsChoice>& cards) {
    fields.object("cards", [&](JsonFields& inner) {
        CardsChoice& choice = cards.emplace();
        double count = choice.count;
        double texels = choice.max_texels;
        inner.number("count", 0.0, 65536.0, count);
        inner.number("texels_per_metre", 0.0, 1e6, choice.texels_per_metre);
        inner.number("max_texels", 256.0, 1U << 27U, texels);
        choice.count = static_cast<uint32_t>(count);
        choice.max_texels = static_cast<uint32_t>(texels);
    });
}

}  // namespace

glm::dmat4 HairExtension::transform() const {
    return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1.0), scale);
}

Result<HairExtension> parse_hair_extension(std::string_view json, const std::string& where) {
    const auto parsed = asset::parse_json(json, where);
    if (!parsed) return parsed.error();
    JsonFields fields(*parsed, where);
    HairExtension hair;
    fields.text("groom", hair.groom);
    if (hair.groom.empty()) {
        fields.fail("groom", "is missing or empty", "name a .hair, .tfx, .gltf or .glb file");
    }
    read_transform(fields, hair);
    read_width(fields, hair.width);
    read_material(fields, hair.material);
    read_techniques(fields, hair.techniques);
    read_cards(fields, hair.cards);
    read_binding(fields, hair.binding);
    fields.object("motion", [&](JsonFields& inner) { read_motion(inner, hair.motion.emplace()); });
    if (fields.error()) return *fields.error();
    hair.warnings = fields.unknown_fields();
    return hair;
}

}  // namespace vellus::hair
