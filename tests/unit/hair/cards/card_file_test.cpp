#include "modules/hair/cards/card_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <glm/gtc/color_space.hpp>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "modules/hair/cards/build_cards.h"
#include "tests/support/own_folder.h"
#include "tests/unit/hair/cards/card_strands.h"

namespace vellus::hair {
namespace {

class CardFileTest : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& name) { return folder_.path() / name; }

    void write(const std::string& name, const std::string& text) {
        ASSERT_TRUE(write_file(file(name), std::string_view(text)));
    }
    /// A PNG whose pixel i is `pixel(i)`.
    template <class Pixel>
    void write_png(const std::string& name, uint32_t width, uint32_t height, const Pixel& pixel) {
        asset::Image image{.width = width, .height = height, .rgba = {}};
        for (uint32_t i = 0; i < width * height; ++i) {
            const glm::u8vec4 value = pixel(i);
            for (int c = 0; c < 4; ++c) image.rgba.push_back(value[c]);
        }
        ASSERT_TRUE(asset::save_png(file(name), image));
    }
    /// Two quads as an artist's program writes them: one buffer, one material, no extension but
    /// `extension`.
    void write_artist_mesh(const std::string& name, const std::string& extension,
                           const std::string& image = "hair.png",
                           const std::string& material = "") {
        std::vector<float> values;
        for (int card = 0; card < 2; ++card) {
            const auto x = static_cast<float>(card);
            for (const auto& [u, v] :
                 {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 1.0f}}) {
                values.insert(values.end(), {x + 0.5f * u, -v, 0.0f});
            }
        }
        for (int card = 0; card < 2; ++card) {
            values.insert(values.end(), {0, 0, 1, 0, 0, 1, 1, 1});
        }
        std::ofstream bin(file("mesh.bin"), std::ios::binary);
        bin.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(4 * values.size()));
        const uint16_t indices[] = {0, 2, 1, 1, 2, 3, 4, 6, 5, 5, 6, 7};
        bin.write(reinterpret_cast<const char*>(indices), sizeof(indices));
        bin.close();
        write(name,
              R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
                  "nodes":[{"mesh":0,"translation":[0,1,0])" +
                  extension + R"(}],
                  "images":[{"uri":")" +
                  image + R"("}],"textures":[{"source":0}],
                  "materials":[{"pbrMetallicRoughness":{)" +
                  material + R"("baseColorTexture":{"index":0}}}],
                  "meshes":[{"primitives":[{"material":0,"indices":2,
                      "attributes":{"POSITION":0,"TEXCOORD_0":1,"NORMAL":3}}]}],
                  "buffers":[{"uri":"mesh.bin","byteLength":184}],
                  "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},
                      {"buffer":0,"byteOffset":96,"byteLength":64},
                      {"buffer":0,"byteOffset":160,"byteLength":24}],
                  "accessors":[
                      {"bufferView":0,"componentType":5126,"count":8,"type":"VEC3",
                       "min":[0,-1,0],"max":[1.5,0,0]},
                      {"bufferView":1,"componentType":5126,"count":8,"type":"VEC2"},
                      {"bufferView":2,"componentType":5123,"count":12,"type":"SCALAR"},
                      {"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"}]})");
    }
    std::string failure(const std::string& name) {
        const auto cards = load_cards(file(name));
        EXPECT_FALSE(cards);
        return cards ? std::string() : cards.error().message();
    }

  private:
    vellus::test::OwnFolder folder_{"cards"};
};

glm::u8vec4 half_clear(uint32_t i) {
    return {200, 100, 50, i % 2 == 0 ? 255 : 0};
}

TEST_F(CardFileTest, WhatIsWrittenReadsBackTheSame) {
    Groom groom;
    for (uint32_t i = 0; i < 5; ++i) {
        test::add_lock(groom, {.root = {0.05f * static_cast<float>(i), 0.3f, 0}, .bend = 0.05f}, 20,
                       i + 1);
    }
    for (const bool colored : {false, true}) {
        if (colored) {
            for (size_t i = 0; i < groom.points.size(); ++i) {
                groom.colors.emplace_back(0.2f, 0.1f + 0.001f * static_cast<float>(i % 500), 0.1f,
                                          1.0f);
            }
        } else {
            groom.default_color = glm::vec3(0.7f, 0.4f, 0.123456f);
            groom.has_default_color = true;
        }
        auto built = build_cards(test::strands_of(groom, 0.0005f), {.cards = 10});
        ASSERT_TRUE(built);
        const CardGroom& cards = built->cards;
        EXPECT_EQ(cards.atlas.color.empty(), !colored);
        EXPECT_EQ(cards.color.has_value(), !colored);
        ASSERT_TRUE(save_cards(cards, file("lock.gltf")));
        auto loaded = load_cards(file("lock.gltf"));
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_TRUE(loaded->ribbons);
        EXPECT_EQ(loaded->points, cards.points);
        EXPECT_EQ(loaded->uvs, cards.uvs);
        EXPECT_EQ(loaded->triangles, cards.triangles);
        EXPECT_EQ(loaded->card_begin, cards.card_begin);
        EXPECT_EQ(loaded->parameters, cards.parameters);
        EXPECT_EQ(loaded->atlas.opacity, cards.atlas.opacity);
        EXPECT_EQ(loaded->atlas.depth, cards.atlas.depth);
        EXPECT_EQ(loaded->atlas.parameter, cards.atlas.parameter);
        EXPECT_EQ(loaded->atlas.tangent, cards.atlas.tangent);
        EXPECT_EQ(loaded->atlas.strand, cards.atlas.strand);
        EXPECT_EQ(loaded->atlas.fibres, cards.atlas.fibres);
        EXPECT_EQ(loaded->atlas.color, cards.atlas.color);
        EXPECT_EQ(loaded->color, cards.color);
    }
}

TEST_F(CardFileTest, CardsHaveTheColorOfTheirMaterial) {
    write_png("hair.png", 4, 8, half_clear);
    write_artist_mesh("plain.gltf", "");
    const auto plain = load_cards(file("plain.gltf"));
    ASSERT_TRUE(plain) << plain.error().message();
    EXPECT_FALSE(plain->color);
    const glm::vec3 texture = glm::convertSRGBToLinear(glm::vec3(200, 100, 50) / 255.0f);
    EXPECT_LT(glm::distance(*mean_color(*plain), texture), 1e-5f);

    write_artist_mesh("tinted.gltf", "", "hair.png", R"("baseColorFactor":[0.5,0.25,1,1],)");
    const auto tinted = load_cards(file("tinted.gltf"));
    ASSERT_TRUE(tinted) << tinted.error().message();
    EXPECT_EQ(tinted->color, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_LT(glm::distance(*mean_color(*tinted), texture * glm::vec3(0.5f, 0.25f, 1.0f)), 1e-5f);
}

TEST_F(CardFileTest, AnArtistsMeshNeedsNoMoreThanOpacity) {
    write_png("hair.png", 4, 8, half_clear);
    write_artist_mesh("artist.gltf", "");
    auto cards = load_cards(file("artist.gltf"));
    ASSERT_TRUE(cards) << cards.error().message();
    EXPECT_FALSE(cards->ribbons);
    EXPECT_EQ(cards->card_count(), 2u);
    EXPECT_EQ(cards->triangles.size(), 4u);
    EXPECT_EQ(cards->points[0], glm::vec3(0, 1, 0));
    EXPECT_EQ(cards->atlas.opacity[0], 255);
    EXPECT_EQ(cards->atlas.opacity[1], 0);
    EXPECT_EQ(cards->atlas.color[5], glm::u8vec3(200, 100, 50));
    for (size_t i = 0; i < cards->points.size(); ++i) {
        EXPECT_EQ(cards->parameters[i], cards->uvs[i].y == 0.0f ? 0 : 65535);
        const glm::uvec4 frame = cards->frames[i];
        const glm::vec3 along = cards->points[frame.y] - cards->points[frame.x];
        const glm::vec3 across = cards->points[frame.w] - cards->points[frame.z];
        EXPECT_LT(along.y, -0.5f) << "down the texture is down the card";
        EXPECT_GT(across.x, 0.3f);
    }
}

TEST_F(CardFileTest, AnArtistsMapsAreRead) {
    write_png("hair.png", 4, 8, half_clear);
    write_png("flow.png", 4, 8, [](uint32_t i) { return glm::u8vec4(i, 200, 128, 255); });
    write_png("depth.png", 4, 8, [](uint32_t i) { return glm::u8vec4(glm::u8vec3(i), 255); });
    write_png("ids.png", 4, 8, [](uint32_t i) { return glm::u8vec4(1, i, 0, 255); });
    write_artist_mesh("artist.gltf",
                      R"(,"extensions":{"VELLUS_cards":{"tangent":"flow.png","depth":"depth.png",
                          "strand":"ids.png","depth_range":0.01,"root_at_bottom":true}})");
    auto cards = load_cards(file("artist.gltf"));
    ASSERT_TRUE(cards) << cards.error().message();
    EXPECT_FLOAT_EQ(cards->depth_range, 0.01f);
    // The root is at the bottom of these textures, so they come turned over: the last row is first.
    EXPECT_EQ(cards->atlas.tangent[0], glm::u8vec3(28, 200, 128));
    EXPECT_EQ(cards->atlas.depth[1], 29);
    EXPECT_EQ(cards->atlas.strand[2], 256 + 30);
    EXPECT_TRUE(cards->atlas.parameter.empty());
    EXPECT_EQ(cards->parameters[0], 65535);
}

TEST_F(CardFileTest, BadTexturesAndMeshesAreNamed) {
    write_artist_mesh("no_image.gltf", "", "missing.png");
    EXPECT_NE(failure("no_image.gltf").find("base colour texture"), std::string::npos);

    write_png("hair.png", 4, 8, half_clear);
    write_png("small.png", 2, 2, half_clear);
    write_artist_mesh("size.gltf", R"(,"extensions":{"VELLUS_cards":{"depth":"small.png"}})");
    const std::string size = failure("size.gltf");
    EXPECT_NE(size.find("2 x 2"), std::string::npos) << size;
    EXPECT_NE(size.find("small.png"), std::string::npos) << size;

    write_artist_mesh("gone.gltf", R"(,"extensions":{"VELLUS_cards":{"tangent":"gone.png"}})");
    EXPECT_NE(failure("gone.gltf").find("gone.png, tangent of "), std::string::npos);

    write_artist_mesh("range.gltf", R"(,"extensions":{"VELLUS_cards":{"depth_range":-1}})");
    EXPECT_NE(failure("range.gltf").find("depth_range"), std::string::npos);

    write_artist_mesh("ribbons.gltf", R"(,"extensions":{"VELLUS_cards":{"ribbons":true}})");
    EXPECT_NE(failure("ribbons.gltf").find("rows of three"), std::string::npos);

    write("broken.png", "this is no picture");
    write_artist_mesh("broken.gltf", "", "broken.png");
    EXPECT_NE(failure("broken.gltf").find("broken.gltf"), std::string::npos);

    write("empty.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]})");
    EXPECT_NE(failure("empty.gltf").find("no triangles"), std::string::npos);

    EXPECT_FALSE(save_cards(CardGroom{}, file("none.gltf")));
    EXPECT_FALSE(save_cards(CardGroom{}, file("none.hair")));
}

}  // namespace
}  // namespace vellus::hair
