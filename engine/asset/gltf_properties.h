#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

// The parts of the glTF 2.0 JSON schema that this engine reads, as one table.
namespace vellus::asset::detail {

enum class Kind : uint8_t { kBoolean, kInteger, kNumber, kString, kObject, kIndex, kIndexMap };
enum class Shape : uint8_t { kOne, kMany };
enum class Need : uint8_t { kOptional, kRequired };

constexpr double kFloatMax = std::numeric_limits<float>::max();
constexpr double kIntMax = std::numeric_limits<int32_t>::max();
constexpr double kExactMax = 9007199254740991.0;

/// One property of objects of type `owner`. `target` is the type of a nested object or the
/// collection an index points into; `length` is an exact array length (0: any); `clamp` moves a
/// number into its range instead of refusing it.
struct Property {
    std::string_view owner;
    std::string_view name;
    Kind kind = Kind::kInteger;
    Shape shape = Shape::kOne;
    Need need = Need::kOptional;
    std::string_view target{};
    double min = -kFloatMax;
    double max = kFloatMax;
    size_t length = 0;
    bool clamp = false;
};

constexpr auto kOne = Shape::kOne;
constexpr auto kMany = Shape::kMany;
constexpr auto kOptional = Need::kOptional;
constexpr auto kRequired = Need::kRequired;

// clang-format off
constexpr Property kProperties[] = {
    {"glTF", "asset", Kind::kObject, kOne, kRequired, "asset"},
    {"glTF", "scene", Kind::kIndex, kOne, kOptional, "scenes"},
    {"glTF", "extensionsUsed", Kind::kString, kMany},
    {"glTF", "extensionsRequired", Kind::kString, kMany},
    {"glTF", "accessors", Kind::kObject, kMany, kOptional, "accessor"},
    {"glTF", "animations", Kind::kObject, kMany, kOptional, "animation"},
    {"glTF", "buffers", Kind::kObject, kMany, kOptional, "buffer"},
    {"glTF", "bufferViews", Kind::kObject, kMany, kOptional, "bufferView"},
    {"glTF", "cameras", Kind::kObject, kMany, kOptional, "camera"},
    {"glTF", "images", Kind::kObject, kMany, kOptional, "image"},
    {"glTF", "materials", Kind::kObject, kMany, kOptional, "material"},
    {"glTF", "meshes", Kind::kObject, kMany, kOptional, "mesh"},
    {"glTF", "nodes", Kind::kObject, kMany, kOptional, "node"},
    {"glTF", "samplers", Kind::kObject, kMany, kOptional, "sampler"},
    {"glTF", "scenes", Kind::kObject, kMany, kOptional, "scene"},
    {"glTF", "skins", Kind::kObject, kMany, kOptional, "skin"},
    {"glTF", "textures", Kind::kObject, kMany, kOptional, "texture"},
    {"glTF", "extensions", Kind::kObject, kOne, kOptional, "rootExtensions"},
    {"asset", "version", Kind::kString, kOne, kRequired},
    {"asset", "minVersion", Kind::kString},
    {"accessor", "bufferView", Kind::kIndex, kOne, kOptional, "bufferViews"},
    {"accessor", "byteOffset", Kind::kInteger, kOne, kOptional, "", 0, kExactMax},
    {"accessor", "componentType", Kind::kInteger, kOne, kRequired, "", 0, kIntMax},
    {"accessor", "normalized", Kind::kBoolean},
    {"accessor", "count", Kind::kInteger, kOne, kRequired, "", 1, kExactMax},
    {"accessor", "type", Kind::kString, kOne, kRequired},
    {"accessor", "min", Kind::kNumber, kMany},
    {"accessor", "max", Kind::kNumber, kMany},
    {"accessor", "sparse", Kind::kObject, kOne, kOptional, "sparse"},
    {"sparse", "count", Kind::kInteger, kOne, kRequired, "", 1, kIntMax},
    {"sparse", "indices", Kind::kObject, kOne, kRequired, "sparseIndices"},
    {"sparse", "values", Kind::kObject, kOne, kRequired, "sparseValues"},
    {"sparseIndices", "bufferView", Kind::kIndex, kOne, kRequired, "bufferViews"},
    {"sparseIndices", "byteOffset", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"sparseIndices", "componentType", Kind::kInteger, kOne, kRequired, "", 0, kIntMax},
    {"sparseValues", "bufferView", Kind::kIndex, kOne, kRequired, "bufferViews"},
    {"sparseValues", "byteOffset", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"buffer", "uri", Kind::kString},
    {"buffer", "byteLength", Kind::kInteger, kOne, kRequired, "", 1, kExactMax},
    {"bufferView", "buffer", Kind::kIndex, kOne, kRequired, "buffers"},
    {"bufferView", "byteOffset", Kind::kInteger, kOne, kOptional, "", 0, kExactMax},
    {"bufferView", "byteLength", Kind::kInteger, kOne, kRequired, "", 1, kExactMax},
    {"bufferView", "byteStride", Kind::kInteger, kOne, kOptional, "", 4, 252},
    {"bufferView", "target", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"image", "uri", Kind::kString},
    {"image", "mimeType", Kind::kString},
    {"image", "bufferView", Kind::kIndex, kOne, kOptional, "bufferViews"},
    {"texture", "sampler", Kind::kIndex, kOne, kOptional, "samplers"},
    {"texture", "source", Kind::kIndex, kOne, kOptional, "images"},
    {"sampler", "magFilter", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"sampler", "minFilter", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"sampler", "wrapS", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"sampler", "wrapT", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"material", "pbrMetallicRoughness", Kind::kObject, kOne, kOptional, "pbr"},
    {"material", "normalTexture", Kind::kObject, kOne, kOptional, "textureInfo"},
    {"material", "occlusionTexture", Kind::kObject, kOne, kOptional, "textureInfo"},
    {"material", "emissiveTexture", Kind::kObject, kOne, kOptional, "textureInfo"},
    {"material", "emissiveFactor", Kind::kNumber, kMany, kOptional, "", 0, kFloatMax, 3},
    {"material", "alphaMode", Kind::kString},
    {"material", "alphaCutoff", Kind::kNumber, kOne, kOptional, "", 0, kFloatMax},
    {"material", "doubleSided", Kind::kBoolean},
    {"pbr", "baseColorFactor", Kind::kNumber, kMany, kOptional, "", 0, 1, 4, true},
    {"pbr", "baseColorTexture", Kind::kObject, kOne, kOptional, "textureInfo"},
    {"pbr", "metallicFactor", Kind::kNumber, kOne, kOptional, "", 0, 1, 0, true},
    {"pbr", "roughnessFactor", Kind::kNumber, kOne, kOptional, "", 0, 1, 0, true},
    {"pbr", "metallicRoughnessTexture", Kind::kObject, kOne, kOptional, "textureInfo"},
    {"textureInfo", "index", Kind::kIndex, kOne, kRequired, "textures"},
    {"textureInfo", "texCoord", Kind::kInteger, kOne, kOptional, "", 0, kIntMax},
    {"textureInfo", "scale", Kind::kNumber},
    {"textureInfo", "strength", Kind::kNumber},
    {"mesh", "primitives", Kind::kObject, kMany, kRequired, "primitive"},
    {"mesh", "weights", Kind::kNumber, kMany},
    {"primitive", "attributes", Kind::kIndexMap, kOne, kRequired, "accessors"},
    {"primitive", "indices", Kind::kIndex, kOne, kOptional, "accessors"},
    {"primitive", "material", Kind::kIndex, kOne, kOptional, "materials"},
    {"primitive", "mode", Kind::kInteger, kOne, kOptional, "", 0, 6},
    {"primitive", "targets", Kind::kIndexMap, kMany, kOptional, "accessors"},
    {"node", "camera", Kind::kIndex, kOne, kOptional, "cameras"},
    {"node", "children", Kind::kIndex, kMany, kOptional, "nodes"},
    {"node", "skin", Kind::kIndex, kOne, kOptional, "skins"},
    {"node", "mesh", Kind::kIndex, kOne, kOptional, "meshes"},
    {"node", "matrix", Kind::kNumber, kMany, kOptional, "", -kFloatMax, kFloatMax, 16},
    {"node", "rotation", Kind::kNumber, kMany, kOptional, "", -kFloatMax, kFloatMax, 4},
    {"node", "scale", Kind::kNumber, kMany, kOptional, "", -kFloatMax, kFloatMax, 3},
    {"node", "translation", Kind::kNumber, kMany, kOptional, "", -kFloatMax, kFloatMax, 3},
    {"node", "weights", Kind::kNumber, kMany},
    {"node", "extensions", Kind::kObject, kOne, kOptional, "nodeExtensions"},
    {"scene", "nodes", Kind::kIndex, kMany, kOptional, "nodes"},
    {"skin", "inverseBindMatrices", Kind::kIndex, kOne, kOptional, "accessors"},
    {"skin", "skeleton", Kind::kIndex, kOne, kOptional, "nodes"},
    {"skin", "joints", Kind::kIndex, kMany, kRequired, "nodes"},
    {"animation", "channels", Kind::kObject, kMany, kRequired, "channel"},
    {"animation", "samplers", Kind::kObject, kMany, kRequired, "animationSampler"},
    {"channel", "sampler", Kind::kInteger, kOne, kRequired, "", 0, kIntMax},
    {"channel", "target", Kind::kObject, kOne, kRequired, "channelTarget"},
    {"channelTarget", "node", Kind::kIndex, kOne, kOptional, "nodes"},
    {"channelTarget", "path", Kind::kString, kOne, kRequired},
    {"animationSampler", "input", Kind::kIndex, kOne, kRequired, "accessors"},
    {"animationSampler", "output", Kind::kIndex, kOne, kRequired, "accessors"},
    {"animationSampler", "interpolation", Kind::kString},
    {"camera", "type", Kind::kString, kOne, kRequired},
    {"camera", "perspective", Kind::kObject, kOne, kOptional, "perspective"},
    {"camera", "orthographic", Kind::kObject, kOne, kOptional, "orthographic"},
    {"perspective", "yfov", Kind::kNumber, kOne, kRequired},
    {"perspective", "znear", Kind::kNumber, kOne, kRequired},
    {"perspective", "zfar", Kind::kNumber},
    {"perspective", "aspectRatio", Kind::kNumber},
    {"orthographic", "xmag", Kind::kNumber, kOne, kRequired},
    {"orthographic", "ymag", Kind::kNumber, kOne, kRequired},
    {"orthographic", "zfar", Kind::kNumber, kOne, kRequired},
    {"orthographic", "znear", Kind::kNumber, kOne, kRequired},
    {"rootExtensions", "KHR_lights_punctual", Kind::kObject, kOne, kOptional, "punctual"},
    {"punctual", "lights", Kind::kObject, kMany, kRequired, "light"},
    {"light", "type", Kind::kString, kOne, kRequired},
    {"light", "color", Kind::kNumber, kMany, kOptional, "", 0, kFloatMax, 3},
    {"light", "intensity", Kind::kNumber, kOne, kOptional, "", 0, kFloatMax},
    {"light", "range", Kind::kNumber, kOne, kOptional, "", 0, kFloatMax},
    {"light", "spot", Kind::kObject, kOne, kOptional, "spot"},
    {"spot", "innerConeAngle", Kind::kNumber, kOne, kOptional, "", 0, kFloatMax},
    {"spot", "outerConeAngle", Kind::kNumber, kOne, kOptional, "", 0, kFloatMax},
    {"nodeExtensions", "KHR_lights_punctual", Kind::kObject, kOne, kOptional, "nodeLight"},
    {"nodeLight", "light", Kind::kIndex, kOne, kRequired, "lights"},
};
// clang-format on

}  // namespace vellus::asset::detail
