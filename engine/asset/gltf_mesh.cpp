#include <numeric>

#include "engine/asset/gltf_context.h"
#include "engine/asset/gltf_geometry.h"

// glTF 2.0 specification, chapter 3.7 (meshes, skinned meshes, morph targets).
namespace vellus::asset::detail {
namespace {

constexpr const char* kExportAgain = "export it again";
using Attributes = std::map<std::string, int>;

std::optional<int> find(const Attributes& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

/// Attribute `name` as vectors of N floats, as many as there are positions; empty where the file
/// has none.
template <int N>
std::vector<glm::vec<N, float>> read_attribute(Context& context, const Attributes& attributes,
                                               const std::string& name, size_t count,
                                               const std::string& pointer) {
    const auto accessor = find(attributes, name);
    if (!accessor) {
        return {};
    }
    const std::string place = fmt::format("{}/{}", pointer, name);
    if (accessor_count(context, *accessor) != count) {
        refuse(
            place,
            fmt::format("{} elements for {} positions", accessor_count(context, *accessor), count),
            kExportAgain);
    }
    const std::vector<float> floats = read_floats(context, *accessor, N, place);
    context.charge(count, sizeof(float) * N, place);
    std::vector<glm::vec<N, float>> result(count);
    std::memcpy(result.data(), floats.data(), floats.size() * sizeof(float));
    return result;
}

/// COLOR_0 has three or four components.
std::vector<glm::vec4> read_colors(Context& context, const Attributes& attributes, size_t count,
                                   const std::string& pointer) {
    const auto accessor = find(attributes, "COLOR_0");
    std::vector<glm::vec4> colors;
    if (accessor && accessor_components(context, *accessor) == 3) {
        const auto rgb = read_attribute<3>(context, attributes, "COLOR_0", count, pointer);
        context.charge(count, sizeof(glm::vec4), pointer);
        for (const glm::vec3& color : rgb) {
            colors.emplace_back(color, 1.0f);
        }
    } else {
        colors = read_attribute<4>(context, attributes, "COLOR_0", count, pointer);
    }
    size_t clamped = 0;
    for (glm::vec4& color : colors) {
        const glm::vec4 inside = glm::clamp(color, 0.0f, 1.0f);
        clamped += inside != color ? 1U : 0U;
        color = inside;
    }
    if (clamped > 0) {
        context.warn(pointer + "/COLOR_0", fmt::format("{} colours clamped to 0..1", clamped));
    }
    return colors;
}

/// The custom attribute _THICKNESS, one float.
std::vector<float> read_thickness(Context& context, const Attributes& attributes, size_t count,
                                  const std::string& pointer) {
    const auto values = read_attribute<1>(context, attributes, "_THICKNESS", count, pointer);
    std::vector<float> thickness;
    thickness.reserve(values.size());
    for (const auto& value : values) thickness.push_back(value.x);
    return thickness;
}

/// Custom attributes and further colours. What cannot be read is left out, for glTF leaves their
/// meaning to whoever wrote them.
void read_columns(Context& context, const Attributes& attributes, const std::string& pointer,
                  Primitive& primitive) {
    constexpr int kMostComponents = 4;
    for (const auto& [name, accessor] : attributes) {
        const bool custom = name.starts_with('_') && name != "_THICKNESS";
        const bool color = name.starts_with("COLOR_") && name != "COLOR_0";
        const int components = accessor_components(context, accessor);
        if (!(custom || color) || components > kMostComponents) continue;
        const std::string place = fmt::format("{}/{}", pointer, name.substr(0, 40));
        if (accessor_count(context, accessor) != primitive.positions.size()) {
            context.warn(place, "not one element per position; left out");
            continue;
        }
        try {
            primitive.columns.push_back({name, static_cast<uint32_t>(components),
                                         read_floats(context, accessor, components, place)});
        } catch (const Refusal& refusal) {
            context.warn(place, refusal.error.what + "; left out");
        }
    }
}

/// All sets JOINTS_n and WEIGHTS_n, reduced to the four strongest influences of each vertex.
void read_influences(Context& context, const Attributes& attributes, const std::string& pointer,
                     Primitive& primitive) {
    const size_t count = primitive.positions.size();
    InfluenceSets sets;
    for (int set = 0;; ++set) {
        const auto joints = find(attributes, fmt::format("JOINTS_{}", set));
        const auto weights = find(attributes, fmt::format("WEIGHTS_{}", set));
        if (!joints && !weights) {
            break;
        }
        if (!joints || !weights) {
            refuse(fmt::format("{}/JOINTS_{}", pointer, set),
                   "joints without weights, or the reverse", kExportAgain);
        }
        const std::string place = fmt::format("{}/JOINTS_{}", pointer, set);
        if (accessor_count(context, *joints) != count) {
            refuse(place,
                   fmt::format("{} elements for {} positions", accessor_count(context, *joints),
                               count),
                   kExportAgain);
        }
        sets.joints.push_back(read_unsigned(context, *joints, 4, place));
        sets.weights.push_back(
            read_attribute<4>(context, attributes, fmt::format("WEIGHTS_{}", set), count, pointer));
    }
    if (sets.joints.empty()) {
        return;
    }
    context.charge(count, sizeof(glm::u16vec4) + sizeof(glm::vec4), pointer);
    const InfluenceRepairs repairs = reduce_influences(sets, primitive);
    if (repairs.joint_too_large) {
        refuse(pointer + "/JOINTS_0", "a joint index above 65535", "use fewer joints");
    }
    if (repairs.dropped > 0) {
        context.warn(pointer,
                     fmt::format("{} vertices have more than four influences; the strongest kept",
                                 repairs.dropped));
    }
    if (repairs.weights > 0) {
        context.warn(
            pointer,
            fmt::format("weights of {} vertices repaired: negative, zero, or not summing to 1",
                        repairs.weights));
    }
}

void read_morph_targets(Context& context, const tinygltf::Primitive& from,
                        const std::string& pointer, Primitive& primitive) {
    for (size_t t = 0; t < from.targets.size(); ++t) {
        const std::string place = fmt::format("{}/targets/{}", pointer, t);
        const size_t count = primitive.positions.size();
        MorphTarget target;
        target.positions = read_attribute<3>(context, from.targets[t], "POSITION", count, place);
        if (!primitive.normals.empty()) {
            target.normals = read_attribute<3>(context, from.targets[t], "NORMAL", count, place);
        }
        for (const auto& [name, accessor] : from.targets[t]) {
            if (!from.attributes.contains(name)) {
                context.warn(fmt::format("{}/{}", place, name),
                             "moves an attribute the mesh does not have; left out");
            }
        }
        primitive.morph_targets.push_back(std::move(target));
    }
}

std::vector<uint32_t> read_indices(Context& context, const tinygltf::Primitive& from,
                                   size_t vertices, const std::string& pointer) {
    if (from.indices < 0) {
        context.charge(vertices, sizeof(uint32_t), pointer);
        std::vector<uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0U);
        return indices;
    }
    std::vector<uint32_t> indices = read_unsigned(context, from.indices, 1, pointer + "/indices");
    for (size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertices) {
            refuse(
                pointer + "/indices",
                fmt::format("index {} is {}, but there are {} vertices", i, indices[i], vertices),
                kExportAgain);
        }
    }
    return indices;
}

void warn_about_attributes(Context& context, const Attributes& attributes,
                           const std::string& pointer) {
    for (const auto& [name, accessor] : attributes) {
        const bool integer_positions =
            (name == "POSITION" || name == "NORMAL") && !accessor_is_float(context, accessor);
        const auto& used = context.model.extensionsUsed;
        if (integer_positions &&
            std::find(used.begin(), used.end(), "KHR_mesh_quantization") == used.end()) {
            context.warn(fmt::format("{}/{}", pointer, name),
                         "integers without KHR_mesh_quantization");
        }
        const std::string stem = name.substr(0, name.find('_'));
        const bool known = name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
                           stem == "TEXCOORD" || stem == "COLOR" || stem == "JOINTS" ||
                           stem == "WEIGHTS";
        if (!known && !name.starts_with('_')) {
            context.warn(fmt::format("{}/{}", pointer, name.substr(0, 40)),
                         "no attribute of glTF; left out");
        }
    }
}

/// Nothing for a primitive without positions.
std::optional<Primitive> read_primitive(Context& context, const tinygltf::Primitive& from,
                                        const std::string& pointer) {
    const std::string place = pointer + "/attributes";
    warn_about_attributes(context, from.attributes, place);
    const auto positions = find(from.attributes, "POSITION");
    if (!positions) {
        context.warn(place, "no POSITION; primitive left out");
        return std::nullopt;
    }
    const size_t count = accessor_count(context, *positions);
    Primitive primitive;
    primitive.positions = read_attribute<3>(context, from.attributes, "POSITION", count, place);
    primitive.normals = read_attribute<3>(context, from.attributes, "NORMAL", count, place);
    primitive.texcoords = read_attribute<2>(context, from.attributes, "TEXCOORD_0", count, place);
    primitive.colors = read_colors(context, from.attributes, count, place);
    primitive.thickness = read_thickness(context, from.attributes, count, place);
    read_columns(context, from.attributes, place, primitive);
    read_influences(context, from.attributes, place, primitive);
    read_morph_targets(context, from, pointer, primitive);
    primitive.indices = read_indices(context, from, count, pointer);
    primitive.material = to_index(from.material);
    context.charge(primitive.indices.size(), 3 * sizeof(uint32_t), pointer);
    const size_t left_over = assemble(from.mode, primitive);
    if (left_over > 0) {
        context.warn(pointer,
                     fmt::format("{} indices do not make a whole primitive; left out", left_over));
    }
    if (primitive.topology == Topology::kTriangles) {
        if (primitive.normals.empty()) {
            context.charge(primitive.indices.size(), vertex_bytes(primitive), pointer);
            separate_vertices(primitive);
        }
        const size_t repaired = complete_normals(primitive);
        if (repaired > 0) {
            context.warn(place + "/NORMAL",
                         fmt::format("{} normals without length replaced", repaired));
        }
    }
    return primitive;
}

Mesh read_mesh(Context& context, const tinygltf::Mesh& from, const std::string& pointer) {
    Mesh mesh;
    mesh.name = from.name;
    for (size_t p = 0; p < from.primitives.size(); ++p) {
        if (from.primitives[p].targets.size() != from.primitives[0].targets.size()) {
            refuse(pointer + "/primitives", "primitives with different numbers of morph targets",
                   kExportAgain);
        }
        auto primitive = read_primitive(context, from.primitives[p],
                                        fmt::format("{}/primitives/{}", pointer, p));
        if (primitive) {
            mesh.primitives.push_back(std::move(*primitive));
        }
    }
    const size_t targets = from.primitives.empty() ? 0 : from.primitives[0].targets.size();
    mesh.morph_weights.assign(from.weights.begin(), from.weights.end());
    if (!from.weights.empty() && from.weights.size() != targets) {
        context.warn(pointer + "/weights",
                     fmt::format("{} weights for {} morph targets", from.weights.size(), targets));
    }
    mesh.morph_weights.resize(targets, 0.0f);
    return mesh;
}

}  // namespace

void read_meshes(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.meshes.size(); ++i) {
        scene.meshes.push_back(
            read_mesh(context, context.model.meshes[i], fmt::format("/meshes/{}", i)));
    }
}

}  // namespace vellus::asset::detail
