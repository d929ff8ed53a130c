#include "modules/hair/cards/card_file.h"

#include <algorithm>
#include <set>

#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "engine/asset/json_fields.h"
#include "modules/hair/cards/card_columns.h"

namespace vellus::hair {

namespace {

constexpr float kFarthest = 1e6f;

/// VELLUS_cards as the file says it.
struct CardsExtension {
    bool ribbons = false;
    bool colored = true;
    bool root_at_bottom = false;
    float depth_range = 0.0f;
    std::optional<glm::vec3> color;
    std::string tangent;
    std::string depth;
    std::string root;
    std::string strand;
    std::string fibres;
};

Result<CardsExtension> parse_extension(const std::string& json, const std::string& where) {
    const auto parsed = asset::parse_json(json, where);
    if (!parsed) return parsed.error();
    asset::JsonFields fields(*parsed, where);
    CardsExtension cards;
    fields.boolean("ribbons", cards.ribbons);
    fields.boolean("colored", cards.colored);
    fields.boolean("root_at_bottom", cards.root_at_bottom);
    fields.number("depth_range", 0.0, 1.0, cards.depth_range);
    if (fields.has("color")) {
        double color[3] = {};
        fields.numbers("color", 0.0, 1.0, color);
        cards.color = glm::vec3(color[0], color[1], color[2]);
    }
    fields.text("tangent", cards.tangent);
    fields.text("depth", cards.depth);
    fields.text("root", cards.root);
    fields.text("strand", cards.strand);
    fields.text("fibres", cards.fibres);
    if (fields.error()) return *fields.error();
    return cards;
}

glm::dmat4 world_of(const asset::SceneAsset& scene, uint32_t node) {
    glm::dmat4 world(1.0);
    for (; node != asset::kNone; node = scene.nodes[node].parent) {
        const asset::Node& n = scene.nodes[node];
        glm::dmat4 local = glm::mat4_cast(glm::dquat(n.rotation));
        for (int axis = 0; axis < 3; ++axis) local[axis] *= static_cast<double>(n.scale[axis]);
        local[3] = glm::dvec4(glm::dvec3(n.translation), 1.0);
        world = local * world;
    }
    return world;
}

/// Reads meshes and the one texture they share.
class Reader {
  public:
    Reader(const asset::SceneAsset& scene, const std::filesystem::path& path)
        : scene_(scene), path_(path) {}

    Result<CardGroom> read() {
        for (uint32_t node = 0; node < scene_.nodes.size(); ++node) {
            if (auto done = add_node(node); !done) return done.error();
        }
        if (cards_.triangles.empty()) {
            return error("holds no triangles", "export the cards as a triangle mesh");
        }
        if (auto checked = check_mesh(); !checked) return checked.error();
        if (auto maps = read_maps(); !maps) return maps.error();
        derive_columns(cards_);
        if (extension_.root.empty()) cards_.atlas.parameter.clear();
        if (extension_.strand.empty()) cards_.atlas.strand.clear();
        if (extension_.fibres.empty()) cards_.atlas.fibres.clear();
        return std::move(cards_);
    }

  private:
    [[nodiscard]] Error error(const std::string& what, const std::string& remedy) const {
        return Error{what, path_.string(), remedy};
    }

    Result<void> add_node(uint32_t index) {
        const asset::Node& node = scene_.nodes[index];
        if (node.mesh == asset::kNone) return {};
        for (const asset::Extension& extension : node.extensions) {
            if (extension.name != kCardsExtensionName) continue;
            auto parsed =
                parse_extension(extension.json, fmt::format("{}: node {} '{}', {}", path_.string(),
                                                            index, node.name, kCardsExtensionName));
            if (!parsed) return parsed.error();
            extension_ = *parsed;
        }
        const glm::dmat4 world = world_of(scene_, index);
        for (const asset::Primitive& primitive : scene_.meshes[node.mesh].primitives) {
            if (primitive.topology != asset::Topology::kTriangles) continue;
            if (primitive.texcoords.empty()) {
                return error(
                    fmt::format("mesh of node {} '{}' has no TEXCOORD_0", index, node.name),
                    "unwrap the cards onto their texture");
            }
            take_material(primitive.material == asset::kNone
                              ? asset::Material{}
                              : scene_.materials[primitive.material]);
            add_primitive(primitive, world);
        }
        return {};
    }

    void take_material(const asset::Material& material) {
        images_.insert(material.base_color_image);
        const auto factor = glm::clamp(glm::vec3(material.base_color), 0.0f, 1.0f);
        if (factor != glm::vec3(1.0f)) cards_.color = factor;
    }

    void add_primitive(const asset::Primitive& primitive, const glm::dmat4& world) {
        const auto first = static_cast<uint32_t>(cards_.points.size());
        for (size_t i = 0; i < primitive.positions.size(); ++i) {
            cards_.points.emplace_back(world * glm::dvec4(glm::dvec3(primitive.positions[i]), 1.0));
            cards_.uvs.push_back(primitive.texcoords[i]);
        }
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            cards_.triangles.emplace_back(first + primitive.indices[i],
                                          first + primitive.indices[i + 1],
                                          first + primitive.indices[i + 2]);
        }
    }

    Result<void> check_mesh() {
        for (const glm::vec3& p : cards_.points) {
            if (glm::all(glm::lessThan(glm::abs(p), glm::vec3(kFarthest)))) continue;
            return error("a vertex is not finite or farther than 1e6 m", "export it again");
        }
        cards_.ribbons = extension_.ribbons;
        if (cards_.ribbons) return check_ribbons();
        if (!extension_.root_at_bottom) return {};
        for (glm::vec2& uv : cards_.uvs) uv.y = 1.0f - uv.y;
        flip_ = true;
        return {};
    }

    Result<void> check_ribbons() const {
        bool good = cards_.points.size() % 3 == 0;
        for (const glm::uvec3& t : cards_.triangles) {
            const glm::uvec3 rows = t / 3U;
            const uint32_t low = std::min({rows.x, rows.y, rows.z});
            const uint32_t high = std::max({rows.x, rows.y, rows.z});
            good = good && high == low + 1 && glm::all(glm::notEqual(t % 3U, glm::uvec3(2)));
        }
        if (good) return {};
        return error("says ribbons, but is not made of rows of three vertices",
                     "remove \"ribbons\" from VELLUS_cards: the mesh was edited");
    }

    Result<void> read_maps() {
        const uint32_t image = *images_.begin();
        if (images_.size() != 1) {
            return error(fmt::format("uses {} base colour textures", images_.size()),
                         "put all cards on one atlas");
        }
        if (image == asset::kNone) {
            return error("has no base colour texture that can be read" +
                             (scene_.warnings.empty() ? "" : ": " + scene_.warnings.front()),
                         "give the cards a material whose base colour texture has the opacity in "
                         "its alpha");
        }
        take_color(scene_.images[image]);
        if (extension_.color) cards_.color = extension_.color;
        const Result<void> steps[] = {
            read_map("tangent", extension_.tangent,
                     [this](size_t i, glm::u8vec4 p) { cards_.atlas.tangent[i] = p; }),
            read_map("depth", extension_.depth,
                     [this](size_t i, glm::u8vec4 p) { cards_.atlas.depth[i] = p.x; }),
            read_map("root", extension_.root,
                     [this](size_t i, glm::u8vec4 p) { cards_.atlas.parameter[i] = p.x; }),
            read_map("strand", extension_.strand,
                     [this](size_t i, glm::u8vec4 p) {
                         cards_.atlas.strand[i] = static_cast<uint16_t>(p.x << 8U | p.y);
                     }),
            read_map("fibres", extension_.fibres,
                     [this](size_t i, glm::u8vec4 p) { cards_.atlas.fibres[i] = p.x; }),
        };
        for (const auto& step : steps) {
            if (!step) return step;
        }
        cards_.depth_range = cards_.ribbons ? 0.0f : extension_.depth_range;
        return {};
    }

    /// Texel of the atlas that pixel i of an image becomes.
    [[nodiscard]] size_t texel(size_t i) const {
        if (!flip_) return i;
        const size_t width = cards_.atlas.width;
        return (cards_.atlas.height - 1 - i / width) * width + i % width;
    }

    void take_color(const asset::Image& image) {
        CardAtlas& atlas = cards_.atlas;
        atlas.width = image.width;
        atlas.height = image.height;
        atlas.opacity.resize(atlas.texels());
        atlas.depth.assign(atlas.texels(), 128);
        atlas.parameter.assign(atlas.texels(), 0);
        atlas.tangent.assign(atlas.texels(), glm::u8vec3(128, 255, 128));
        atlas.strand.assign(atlas.texels(), 0);
        atlas.fibres.assign(atlas.texels(), 0);
        if (extension_.colored) atlas.color.resize(atlas.texels());
        for (size_t i = 0; i < atlas.texels(); ++i) {
            atlas.opacity[texel(i)] = image.rgba[4 * i + 3];
            if (!extension_.colored) continue;
            atlas.color[texel(i)] = {image.rgba[4 * i], image.rgba[4 * i + 1],
                                     image.rgba[4 * i + 2]};
        }
    }

    /// Calls `take(texel, pixel)` for every pixel of a map, where the file names one.
    template <class Take>
    Result<void> read_map(const char* field, const std::string& name, const Take& take) {
        if (name.empty()) return {};
        const std::filesystem::path file = path_.parent_path() / name;
        const std::string where = fmt::format("{}, {} of {}", file.string(), field, path_.string());
        const auto image = asset::load_image(file);
        if (!image) return Error{image.error().what, where, image.error().remedy};
        const CardAtlas& atlas = cards_.atlas;
        if (image->width != atlas.width || image->height != atlas.height) {
            return Error{fmt::format("is {} x {}, the base colour texture {} x {}", image->width,
                                     image->height, atlas.width, atlas.height),
                         where, "give all maps of the cards one size"};
        }
        for (size_t i = 0; i < atlas.texels(); ++i) {
            const uint8_t* p = &image->rgba[4 * i];
            take(texel(i), glm::u8vec4(p[0], p[1], p[2], p[3]));
        }
        return {};
    }

    const asset::SceneAsset& scene_;
    const std::filesystem::path& path_;
    CardsExtension extension_;
    std::set<uint32_t> images_;
    CardGroom cards_;
    bool flip_ = false;
};

}  // namespace

bool holds_cards(const asset::SceneAsset& scene) {
    bool triangles = false;
    for (const asset::Mesh& mesh : scene.meshes) {
        for (const asset::Primitive& primitive : mesh.primitives) {
            if (primitive.topology == asset::Topology::kLines ||
                primitive.topology == asset::Topology::kLineStrip) {
                return false;
            }
            triangles = triangles || primitive.topology == asset::Topology::kTriangles;
        }
    }
    return triangles;
}

bool says_cards(const asset::SceneAsset& scene) {
    const auto named = [](const asset::Extension& e) { return e.name == kCardsExtensionName; };
    return std::ranges::any_of(scene.nodes, [&](const asset::Node& node) {
        return std::ranges::any_of(node.extensions, named);
    });
}

Result<CardGroom> cards_from_scene(const asset::SceneAsset& scene,
                                   const std::filesystem::path& path) {
    return Reader(scene, path).read();
}

Result<std::optional<CardGroom>> find_cards(const std::filesystem::path& path) {
    if (path.extension() != ".gltf" && path.extension() != ".glb")
        return std::optional<CardGroom>();
    const auto scene = asset::load_gltf(path);
    if (!scene) return scene.error();
    if (!holds_cards(*scene)) return std::optional<CardGroom>();
    auto cards = cards_from_scene(*scene, path);
    if (!cards) return cards.error();
    return std::optional<CardGroom>(std::move(*cards));
}

Result<CardGroom> load_cards(const std::filesystem::path& path) {
    const auto scene = asset::load_gltf(path);
    if (!scene) return scene.error();
    return cards_from_scene(*scene, path);
}

}  // namespace vellus::hair
