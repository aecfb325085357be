// Textures as the scene has them: components by format, levels, images by formula, and from files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "capture/files/image_file.h"
#include "scene/file/scene_file.h"
#include "scene/texture/texture_file.h"
#include "scene/texture/texture_images.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

Texture texture_of(TextureLevel image, TexelType type = TexelType::float32,
                   TextureFormat format = TextureFormat::rgba) {
  Texture texture;
  texture.format = format;
  texture.type = type;
  set_levels(texture, std::move(image));
  return texture;
}

TextureLevel row_of(std::vector<float> greys) {
  TextureLevel level{static_cast<int>(greys.size()), 1, {}};
  for (const float g : greys) level.texels.emplace_back(g, 0, 0, 1);
  return level;
}

TEST(TextureLevels, ComponentsAreThoseOfTable321) {
  const glm::vec4 rgba(0.1f, 0.2f, 0.3f, 0.4f);
  EXPECT_EQ(source_components(TextureFormat::alpha, rgba), glm::vec4(0, 0, 0, 0.4f));
  EXPECT_EQ(source_components(TextureFormat::luminance, rgba), glm::vec4(0.1f, 0.1f, 0.1f, 1));
  EXPECT_EQ(source_components(TextureFormat::luminance_alpha, rgba), glm::vec4(0.1f, 0.1f, 0.1f, 0.4f));
  EXPECT_EQ(source_components(TextureFormat::intensity, rgba), glm::vec4(0.1f));
  EXPECT_EQ(source_components(TextureFormat::rgb, rgba), glm::vec4(0.1f, 0.2f, 0.3f, 1));
  EXPECT_EQ(source_components(TextureFormat::rgba, rgba), rgba);
}

TEST(TextureLevels, EachIsHalfOfTheOneAboveRoundedDown) {
  const Texture texture = texture_of(make_noise(20, 7, 1));
  const std::vector<glm::ivec2> sizes = {{20, 7}, {10, 3}, {5, 1}, {2, 1}, {1, 1}};
  ASSERT_EQ(texture.levels.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(texture.levels[i].width, sizes[i].x);
    EXPECT_EQ(texture.levels[i].height, sizes[i].y);
    EXPECT_EQ(texture.levels[i].texels.size(), static_cast<std::size_t>(sizes[i].x * sizes[i].y));
  }
}

TEST(TextureLevels, ATexelIsTheMeanOfThoseThatItLiesOn) {
  const Texture even = texture_of(row_of({0, 1, 0.25f, 0.75f}));
  EXPECT_EQ(even.levels[1].texels[0].r, 0.5f);
  EXPECT_EQ(even.levels[1].texels[1].r, 0.5f);
  // 5 texels on 2: the middle one counts half for each, (0 + 1 + 0.5 * 0.5) / 2.5
  const Texture odd = texture_of(row_of({0, 1, 0.5f, 1, 1}));
  EXPECT_EQ(odd.levels[1].texels[0].r, 0.5f);
  EXPECT_EQ(odd.levels[1].texels[1].r, 0.9f);
  // and then 2 on 1
  EXPECT_FLOAT_EQ(odd.levels[2].texels[0].r, 0.7f);
}

TEST(TextureLevels, CodesAreRoundedAtEachLevel) {
  const Texture texture = texture_of(row_of({0.1f, 1.5f, 0, 1 / 255.0f}), TexelType::unorm8);
  EXPECT_EQ(texture.levels[0].texels[0].r, 26 / 255.0f);  // 25.5 and a little
  EXPECT_EQ(texture.levels[0].texels[1].r, 1);
  EXPECT_EQ(texture.levels[1].texels[0].r, 141 / 255.0f);  // (26 + 255) / 2 = 140.5
  EXPECT_EQ(texture.levels[1].texels[1].r, 1 / 255.0f);    // 0.5
  const Texture floats = texture_of(row_of({0.1f, 1.5f}));
  EXPECT_EQ(floats.levels[0].texels[1].r, 1.5f);
  EXPECT_EQ(floats.levels[1].texels[0].r, 0.8f);
}

TEST(TextureLevels, LastLevelIsThatOfTheImageOrTheLimit) {
  Texture texture = texture_of(make_noise(8, 2, 1));
  EXPECT_EQ(last_level(texture), 3);
  texture.sampler.max_level = 2;
  EXPECT_EQ(last_level(texture), 2);
}

TEST(TextureImages, ACheckersCellsAreWhereTheTexelsCentresSay) {
  const TextureLevel c = make_checker(3, 2, 2, 1, {glm::vec4(0), glm::vec4(1)});
  // The centres 0.5, 1.5, 2.5 of 3 in two cells of 1.5: the middle one is on the border, and of the second.
  EXPECT_EQ(c.texels, (std::vector<glm::vec4>{glm::vec4(0), glm::vec4(1), glm::vec4(1), glm::vec4(0), glm::vec4(1),
                                              glm::vec4(1)}));
}

TEST(TextureImages, AGradientIsItsColoursAtTheCornerTexels) {
  const TextureLevel g =
      make_gradient(3, 3, {glm::vec4(0), glm::vec4(1, 0, 0, 0), glm::vec4(1), glm::vec4(0, 1, 0, 0)});
  EXPECT_EQ(g.at(0, 0), glm::vec4(0));
  EXPECT_EQ(g.at(2, 0), glm::vec4(1, 0, 0, 0));
  EXPECT_EQ(g.at(2, 2), glm::vec4(1));
  EXPECT_EQ(g.at(0, 2), glm::vec4(0, 1, 0, 0));
  EXPECT_EQ(g.at(1, 1), glm::vec4(0.5f, 0.5f, 0.25f, 0.25f));
}

TEST(TextureImages, BricksAreLaidInBond) {
  const glm::vec4 b(1), m(0);
  const TextureLevel wall = make_bricks(8, 4, 2, 2, b, m);
  const auto row = [&](int y) {
    std::string text;
    for (int x = 0; x < 8; ++x) text += wall.at(x, y) == b ? 'b' : '.';
    return text;
  };
  EXPECT_EQ(row(0), "........");
  EXPECT_EQ(row(1), ".bbb.bbb");
  EXPECT_EQ(row(2), "........");
  EXPECT_EQ(row(3), "bb.bbb.b");
}

TEST(TextureImages, NoiseIsTheSameEverywhereAndAnotherByTheSeed) {
  const TextureLevel a = make_noise(64, 64, 1), b = make_noise(64, 64, 2);
  EXPECT_EQ(a.texels, make_noise(64, 64, 1).texels);
  EXPECT_NE(a.texels, b.texels);
  glm::dvec4 mean(0);
  for (const glm::vec4& t : a.texels) mean += glm::dvec4(t) / 4096.0;
  // Of 4096 uniform numbers the mean's deviation is 0.29 / 64: five of them
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean[c], 0.5, 0.0226);
}

class TextureFile : public TestFolder {
 protected:
  std::string failure(const std::string& name, std::size_t most = kMostTexels) const {
    try {
      load_texture_image(root_ / name, most);
    } catch (const TextureError& error) {
      const std::string what = error.what();
      return what.substr(what.find(": ") + 2);
    }
    return "";
  }
};

Plane<glm::vec4> small_plane() {
  Plane<glm::vec4> plane(2, 2, glm::vec4(0));
  plane(0, 0) = {1, 0, 0, 1};
  plane(1, 0) = {0, 1, 0, 0.2f};
  plane(0, 1) = {0, 0, 1, 0.4f};
  plane(1, 1) = {0.6f, 0.8f, 1, 0};
  return plane;
}

TEST_F(TextureFile, TheLowestRowIsTheFirst) {
  for (const char* name : {"a.png", "a.tga", "a.exr"}) {
    write_image(root_ / name, small_plane());
    const TextureImage image = load_texture_image(root_ / name, kMostTexels);
    EXPECT_EQ(image.channels, 4) << name;
    EXPECT_EQ(image.rgba.width, 2);
    EXPECT_EQ(image.rgba.at(0, 0), glm::vec4(1, 0, 0, 1)) << name;
    EXPECT_EQ(image.rgba.at(1, 0), glm::vec4(0, 1, 0, 51 / 255.0f)) << name;
    EXPECT_EQ(image.rgba.at(1, 1), glm::vec4(0.6f, 0.8f, 1, 0)) << name;  // nothing is multiplied by alpha
  }
}

TEST_F(TextureFile, WhatIsNoNumberIsRefused) {
  Plane<glm::vec4> plane = small_plane();
  plane(1, 0).g = std::numeric_limits<float>::quiet_NaN();
  write_image(root_ / "nan.exr", plane);
  EXPECT_EQ(failure("nan.exr"), "expected finite numbers up to +-65504, found nan in channel 1 of texel 1, 0");
  plane(1, 0).g = std::numeric_limits<float>::infinity();
  write_image(root_ / "inf.exr", plane);
  EXPECT_EQ(failure("inf.exr"), "expected finite numbers up to +-65504, found inf in channel 1 of texel 1, 0");
}

TEST_F(TextureFile, TooLargeOrTruncatedIsRefused) {
  write_image(root_ / "a.png", small_plane());
  EXPECT_EQ(failure("a.png", 3), "expected at most 16384 texels a side, and 3 more in all, found 2 x 2");
  const std::string bytes = test::text_of(root_ / "a.png");
  test::write_text(root_ / "cut.png", bytes.substr(0, bytes.size() - 30));
  EXPECT_EQ(failure("cut.png").substr(0, 39), "expected an image that is whole, found ");
}

TEST_F(TextureFile, ASceneHasItsTexturesAndTheDrawsNameThem) {
  write_image(root_ / "a.png", small_plane());
  test::write_text(root_ / "scene.json", R"({"description": "d", "textures": {
    "b": {"image": {"file": "a.png"}, "min": "linear", "wrap_t": "mirrored_repeat", "border": [0, 1, 0, 1]},
    "a": {"image": {"noise": {}}, "format": "luminance"}},
    "defaults": {"texture": {"name": "b", "environment": "decal"}},
    "draws": [{"mesh": {"quad": {}}}, {"mesh": {"globe": {"slices": 4, "stacks": 3}},
              "texture": {"name": "a", "environment": "modulate"}}]})");
  const Scene scene = load_scene(root_ / "scene.json");
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[1].name, "b");
  EXPECT_EQ(scene.textures[1].format, TextureFormat::rgba);
  EXPECT_EQ(scene.textures[1].sampler.min, MinFilter::linear);
  EXPECT_EQ(scene.textures[1].sampler.wrap_s, Wrap::repeat);
  EXPECT_EQ(scene.textures[1].sampler.wrap_t, Wrap::mirrored_repeat);
  EXPECT_EQ(scene.draws[0].texture->texture, 1u);
  EXPECT_EQ(scene.draws[0].texture->environment, TextureEnvironment::decal);
  EXPECT_EQ(scene.draws[1].texture->texture, 0u);
  EXPECT_EQ(scene.draws[1].texture->environment, TextureEnvironment::modulate);
  EXPECT_EQ(scene.meshes[0].texcoords, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const Mesh& globe = scene.meshes[1];
  ASSERT_EQ(globe.texcoords.size(), globe.positions.size());
  for (std::size_t i = 0; i < globe.positions.size(); ++i) {  // the seam's two vertices are one place
    if (globe.texcoords[i].s == 1) {
      EXPECT_EQ(globe.positions[i], globe.positions[i - 4]);
      EXPECT_EQ(globe.texcoords[i - 4].s, 0);
    }
  }
  for (const glm::uvec3& t : globe.triangles) {  // none reaches around
    const auto [low, high] = std::minmax({globe.texcoords[t.x].s, globe.texcoords[t.y].s, globe.texcoords[t.z].s});
    EXPECT_EQ(high - low, 0.25f);
  }
}

TEST_F(TextureFile, AMeshFilesTextureCoordinatesCome) {
  test::write_text(root_ / "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 2 0.25\nvt 0 1\nf 1/1 2/2 3/3\n");
  test::write_text(root_ / "scene.json", R"({"description": "d", "textures": {"a": {"image": {"noise": {}}}},
    "draws": [{"mesh": {"file": "t.obj"}, "texture": {"name": "a"}}]})");
  const Scene scene = load_scene(root_ / "scene.json");
  EXPECT_EQ(scene.meshes[0].texcoords, (std::vector<glm::vec2>{{0, 0}, {2, 0.25f}, {0, 1}}));
}

}  // namespace
}  // namespace plumbline
