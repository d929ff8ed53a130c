#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/image_seeds.h"
#include "tests/unit/asset/glb_builder.h"
#include "tests/unit/asset/scene_invariants.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    // A small allowance: a fuzzer must not need gigabytes to find out that limits hold.
    const vellus::asset::GltfLimits limits{.fixed_bytes = uint64_t{1} << 24U,
                                           .multiple = 64,
                                           .image_pixels = 1U << 20U,
                                           .node_depth = 64};
    const auto scene = vellus::asset::load_gltf_bytes(
        {reinterpret_cast<const std::byte*>(data), size}, "", limits);
    vellus::fuzz::require(scene ? vellus::asset::test::broken_promise(*scene).empty()
                                : !scene.error().remedy.empty());
    return 0;
}

namespace {

/// A triangle strip with everything a primitive can have, in a skinned and animated scene.
vellus::asset::test::Bytes skinned_scene() {
    vellus::asset::test::GlbBuilder b;
    b.view<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    b.view<int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, 4);
    b.view<uint16_t>({0, 0, 65535, 0, 0, 65535, 65535, 65535});
    b.view<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    b.view<uint8_t>({255, 0, 0, 0, 128, 127, 0, 0, 0, 255, 0, 0, 255, 0, 0, 0});
    b.view<uint16_t>({0, 1, 2, 3});
    b.view<float>({0, 0.5f, 1});
    b.view<float>(std::vector<float>(36, 0.5f));
    b.view<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const auto png = *vellus::asset::encode_png(vellus::fuzz::small_image());
    b.view(png);
    return b.glb(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5120,"normalized":true,"count":4,"type":"VEC3"},
{"bufferView":2,"componentType":5123,"normalized":true,"count":4,"type":"VEC2"},
{"bufferView":3,"componentType":5121,"count":4,"type":"VEC4"},
{"bufferView":4,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},
{"bufferView":5,"componentType":5123,"count":4,"type":"SCALAR"},
{"bufferView":6,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":7,"componentType":5126,"count":3,"type":"VEC4"},
{"bufferView":7,"componentType":5126,"count":9,"type":"VEC3"},
{"bufferView":8,"componentType":5126,"count":2,"type":"MAT4"},
{"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":5,"componentType":5123},"values":{"bufferView":0}}},
{"bufferView":7,"componentType":5126,"count":3,"type":"SCALAR"}],
"meshes":[{"weights":[0.5],"primitives":[{"mode":5,"indices":5,"material":0,
"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"JOINTS_0":3,"WEIGHTS_0":4},"targets":[{"POSITION":10}]}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"baseColorTexture":{"index":0},"roughnessFactor":0.5},
"emissiveFactor":[1,1,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":2}},"alphaMode":"MASK"}],
"textures":[{"source":0,"sampler":0}],"samplers":[{}],"images":[{"bufferView":9,"mimeType":"image/png"}],
"skins":[{"joints":[1,2],"inverseBindMatrices":9,"skeleton":1}],
"nodes":[{"mesh":0,"skin":0,"weights":[0.25],"children":[1]},{"translation":[0,1,0],"children":[2]},{"rotation":[0,0,0,1],"scale":[1,2,1]}],
"scenes":[{"nodes":[0],"extensions":{"X_environment":{"file":"a.exr"}}}],"scene":0,
"animations":[{"samplers":[{"input":6,"output":7},{"input":6,"output":8,"interpolation":"CUBICSPLINE"},{"input":6,"output":11,"interpolation":"STEP"}],
"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},{"sampler":1,"target":{"node":2,"path":"translation"}},
{"sampler":2,"target":{"node":0,"path":"weights"}}]}])");
}

/// A .gltf without geometry files: cameras, lights, matrices, data URIs, line strips.
std::string text_scene() {
    return R"({"asset":{"version":"2.0","minVersion":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36,"byteStride":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":0,"_LENGTH":0},"mode":3}]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01,"zfar":100}},
{"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":9}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":40,"color":[1,0.5,0.25],"spot":{"outerConeAngle":0.4}},
{"type":"directional"},{"type":"point","range":3}]}},
"nodes":[{"camera":0,"extensions":{"KHR_lights_punctual":{"light":0},"X_hair":{"file":"a.hair"}}},
{"matrix":[1,0,0,0,0,0,-1,0,0,1,0,0,1,2,3,1],"mesh":0,"children":[0]}],"scenes":[{"nodes":[1]}]})";
}

}  // namespace

std::vector<vellus::fuzz::Bytes> vellus::fuzz::fuzz_seeds() {
    const std::string text = text_scene();
    return {to_seed(skinned_scene()), to_seed(std::as_bytes(std::span(text)))};
}
