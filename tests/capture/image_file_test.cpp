// Image files: values, rows, straight alpha, and clear errors.
#include "capture/files/image_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/atomic_path.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

class ImageFile : public TestFolder {
 protected:
  template <class Act>
  void refused(Act act, const std::string& file, const std::string& text) {
    try {
      act();
      ADD_FAILURE() << "not refused: " << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
};

/// 3 x 2, every pixel another; row 0 is the bottom.
Plane<glm::vec4> make_plane() {
  Plane<glm::vec4> plane(3, 2);
  plane(0, 0) = {0, 0, 0, 1};
  plane(1, 0) = {1, 0.5f, 0.25f, 0.5f};  // straight alpha: stays as it is
  plane(2, 0) = {10 / 255.0f, 20 / 255.0f, 30 / 255.0f, 0};
  plane(0, 1) = {1, 0, 0, 1};
  plane(1, 1) = {0, 1, 0, 1};
  plane(2, 1) = {254.49f / 255, 254.51f / 255, 0.49f / 255, 0.51f / 255};
  return plane;
}

TEST_F(ImageFile, PngHoldsRoundedCodes) {
  write_image(root_ / "a.png", make_plane());
  const Plane<glm::vec4> back = read_image(root_ / "a.png");
  ASSERT_EQ(back.width(), 3);
  ASSERT_EQ(back.height(), 2);
  const auto code = [](int r, int g, int b, int a) { return glm::vec4(glm::dvec4(r, g, b, a) / 255.0); };
  EXPECT_EQ(back(0, 0), code(0, 0, 0, 255));
  EXPECT_EQ(back(1, 0), code(255, 128, 64, 128));
  EXPECT_EQ(back(2, 0), code(10, 20, 30, 0));
  EXPECT_EQ(back(0, 1), code(255, 0, 0, 255));
  EXPECT_EQ(back(1, 1), code(0, 255, 0, 255));
  EXPECT_EQ(back(2, 1), code(254, 255, 0, 1));
}

TEST_F(ImageFile, EveryCodeSurvives) {
  Plane<glm::vec4> plane(256, 1);
  for (int i = 0; i < 256; ++i) plane(i, 0) = glm::vec4(glm::dvec4(i, 255 - i, i / 2, i) / 255.0);
  write_image(root_ / "a.png", plane);
  EXPECT_EQ(read_image(root_ / "a.png").values(), plane.values());
}

TEST_F(ImageFile, TgaHoldsTheSameCodesAsPng) {
  write_image(root_ / "a.png", make_plane());
  write_image(root_ / "a.tga", make_plane());
  EXPECT_EQ(read_image(root_ / "a.tga").values(), read_image(root_ / "a.png").values());
  Plane<glm::vec4> plane(256, 3);
  for (int i = 0; i < 768; ++i)
    plane(i % 256, i / 256) = glm::vec4(glm::dvec4(i % 256, 255 - i % 256, i / 3, 255 - i / 3) / 255.0);
  write_image(root_ / "b.tga", plane);
  EXPECT_EQ(read_image(root_ / "b.tga").values(), plane.values());
}

TEST_F(ImageFile, PpmHoldsTheCodesOfRedGreenAndBlue) {
  write_image(root_ / "a.png", make_plane());
  write_image(root_ / "a.ppm", make_plane());
  const Plane<glm::vec4> is = read_image(root_ / "a.ppm"), expected = read_image(root_ / "a.png");
  ASSERT_EQ(is.size(), expected.size());
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is.values()[i], glm::vec4(glm::vec3(expected.values()[i]), 1)) << i;
  }
  EXPECT_EQ(encode_ppm("a.ppm", Plane<glm::vec4>(1, 2, {1, 0, 0.2f, 0})),
            std::string("P6\n1 2\n255\n\xff\0\x33\xff\0\x33", 17));
  EXPECT_EQ(encode_ppm("a.ppm", Plane<glm::vec4>(1, 1, {1, 0, 0.5f, 0}), ColorFormat::rgba12),
            std::string("P6\n1 1\n4095\n\x0f\xff\0\0\x08\0", 18))
      << "the high byte first";
}

TEST_F(ImageFile, EveryTwelveBitCodeSurvives) {
  Plane<glm::vec4> plane(4096, 1);
  for (int i = 0; i < 4096; ++i) plane(i, 0) = glm::vec4(glm::dvec4(i, 4095 - i, i / 2, i) / 4095.0);
  for (const char* file : {"a.png", "a.ppm"}) {
    write_file(root_ / file, encode_image(file, plane, ColorFormat::rgba12));
    const Plane<glm::vec4> back = read_image(root_ / file);
    for (int i = 0; i < 4096; ++i) {
      const int channels = std::string(file) == "a.png" ? 4 : 3;
      for (int c = 0; c < channels; ++c) {
        ASSERT_EQ(std::round(back(i, 0)[c] * 4095), std::round(plane(i, 0)[c] * 4095)) << file << " " << i;
        ASSERT_NEAR(back(i, 0)[c], plane(i, 0)[c], 1 / 65535.0) << file << " " << i;
      }
    }
  }
  Plane<glm::vec4> odd(1, 1, {-1, 7, kNan, 409.5f / 4095});
  EXPECT_EQ(encode_ppm("a.ppm", odd, ColorFormat::rgba12), std::string("P6\n1 1\n4095\n\0\0\x0f\xff\0\0", 18));
}

TEST_F(ImageFile, EverySixteenBitCodeSurvives) {
  Plane<glm::vec4> plane(256, 256);
  for (int i = 0; i < 65536; ++i) plane(i % 256, i / 256) = glm::vec4(glm::dvec4(i, 65535 - i, i / 2, i) / 65535.0);
  for (const char* file : {"a.png", "a.exr"}) {
    write_file(root_ / file, encode_image(file, plane, ColorFormat::rgba16));
    EXPECT_EQ(read_image(root_ / file).values(), plane.values()) << file;
  }
  // Its own reader takes 65535 of 65535 for 65534: the bytes themselves.
  const std::string ppm = encode_image("a.ppm", plane, ColorFormat::rgba16), header = "P6\n256 256\n65535\n";
  ASSERT_EQ(ppm.size(), header.size() + 6 * 65536);
  for (int i = 0; i < 65536; ++i) {
    const std::size_t row = 255 - static_cast<std::size_t>(i) / 256,
                      at = header.size() + 6 * (256 * row + static_cast<std::size_t>(i) % 256);
    const auto code = [&](std::size_t channel) {
      const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(ppm[at + 2 * channel + k]); };
      return 256 * byte(0) + byte(1);
    };
    ASSERT_EQ(code(0), i);
    ASSERT_EQ(code(1), 65535 - i);
  }
  EXPECT_EQ(encode_ppm("a.ppm", Plane<glm::vec4>(1, 1, {1, 0, 0.5f, 0}), ColorFormat::rgba16),
            std::string("P6\n1 1\n65535\n\xff\xff\0\0\x80\0", 19));
  refused([] { encode_image("a.tga", make_plane(), ColorFormat::rgba16); }, "a.tga", "the frame (rgba16) more");
}

TEST_F(ImageFile, TgaHoldsNoTwelveBits) {
  const auto say = [&](auto act) {
    refused(act, "a.tga",
            "TGA holds 8 bits a channel, the frame (rgba12) more: expected a file name ending in .png, .ppm or .exr");
  };
  say([] { encode_image("a.tga", make_plane(), ColorFormat::rgba12); });
  say([] { encode_tga("a.tga", make_plane(), ColorFormat::rgba12); });
  say([] { require_image_name("a.tga", ColorFormat::rgba12); });
  for (const char* file : {"a.png", "a.ppm", "a.exr"}) EXPECT_NO_THROW(require_image_name(file, ColorFormat::rgba12));
  refused([] { encode_ppm("a.ppm", {}); }, "a.ppm", "empty");
  refused([] { encode_tga("a.tga", {}); }, "a.tga", "empty");
  refused([] { encode_ppm("a.tga", make_plane()); }, "a.tga", ".ppm");
  refused([] { encode_tga("a.ppm", make_plane()); }, "a.ppm", ".tga");
}

TEST_F(ImageFile, PngClampsWhatHasNoCode) {
  Plane<glm::vec4> plane(1, 1, {-1, 7, kNan, kInf});
  write_image(root_ / "a.png", plane);
  EXPECT_EQ(read_image(root_ / "a.png")(0, 0), glm::vec4(0, 1, 0, 1));
}

/// The only test of what is up that does not go through read_image, which flips as well: a file made elsewhere, 1 x 2
/// (grey, uncompressed), white on top of black.
TEST_F(ImageFile, TheTopRowIsTheLast) {
  const unsigned char pgm[] = {'P', '5', '\n', '1', ' ', '2', '\n', '2', '5', '5', '\n', 255, 0};
  std::ofstream(root_ / "a.pgm", std::ios::binary).write(reinterpret_cast<const char*>(pgm), sizeof pgm);
  const Plane<glm::vec4> plane = read_image(root_ / "a.pgm");
  EXPECT_EQ(plane(0, 1), glm::vec4(1));
  EXPECT_EQ(plane(0, 0), glm::vec4(0, 0, 0, 1));
}

TEST_F(ImageFile, ExrHoldsFloatsBitForBit) {
  Plane<glm::vec4> plane = make_plane();
  plane(1, 1) = {kNan, kInf, -kInf, -0.0f};
  plane(2, 1) = {1e30f, -1e-40f, 0.1f, 0.3f};
  write_image(root_ / "a.exr", plane);
  const Plane<glm::vec4> back = read_image(root_ / "a.exr");
  ASSERT_EQ(back.size(), plane.size());
  EXPECT_EQ(std::memcmp(back.values().data(), plane.values().data(), plane.size() * sizeof(glm::vec4)), 0);
}

TEST_F(ImageFile, DepthExrHoldsFloats) {
  Plane<double> plane(2, 2);
  plane(0, 0) = 0.1;
  plane(1, 0) = 1;
  plane(0, 1) = 1e-10;
  plane(1, 1) = static_cast<double>(kNan);
  write_file(root_ / "z.exr", encode_depth_exr("z.exr", plane));
  const Plane<glm::vec4> back = read_image(root_ / "z.exr");
  EXPECT_EQ(back(0, 0), glm::vec4(0.1f, 0.1f, 0.1f, 1));
  EXPECT_EQ(back(1, 0).r, 1);
  EXPECT_EQ(back(0, 1).r, 1e-10f);
  EXPECT_TRUE(std::isnan(back(1, 1).r));
  const std::string bytes = test::text_of(root_ / "z.exr");
  const char channels[] = "channels\0chlist\0\x13\0\0\0Z\0\x02\0\0\0";  // one channel, "Z", of type 2 (FLOAT)
  EXPECT_NE(bytes.find(std::string(channels, sizeof channels - 1)), bytes.npos);
}

TEST_F(ImageFile, ChoosesByEndingAndLeavesNothingBehind) {
  write_image(root_ / "a.PNG", make_plane());
  write_image(root_ / "a.exr", make_plane());
  write_image(root_ / "a.exr", make_plane());  // over the old one
  EXPECT_EQ(read_image(root_ / "a.exr").values(), make_plane().values());
  refused([&] { write_image(root_ / "a.jpg", make_plane()); }, "a.jpg",
          "expected a file name ending in .png, .tga, .ppm or .exr");
  refused([&] { write_image(root_ / "a", make_plane()); }, "/a", ".ppm or .exr");
  refused([&] { encode_exr("a.png", make_plane()); }, "a.png", ".exr");
  refused([&] { encode_png("a.exr", make_plane()); }, "a.exr", ".png");
  refused([&] { encode_depth_exr("z.png", {1, 1}); }, "z.png", ".exr");
  refused([&] { encode_depth_exr("z.exr", {}); }, "z.exr", "empty");
  refused([&] { require_image_name("a.tif"); }, "a.tif", ".ppm or .exr");
  refused([&] { require_depth_name("z.png"); }, "z.png", ".exr");
  EXPECT_NO_THROW(require_image_name("A.PNG"));
  EXPECT_NO_THROW(require_depth_name("no/such/folder/z.exr"));
  refused([&] { write_image(root_ / "none/a.png", make_plane()); }, "none/a.png",
          "cannot be written: No such file or directory");
  refused([&] { write_image(root_ / "e.png", {}); }, "e.png", "empty");
  fs::create_directories(root_ / "folder.png");
  refused([&] { write_image(root_ / "folder.png", make_plane()); }, "folder.png", "cannot be written: Is a directory");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(root_)) ++entries;
  EXPECT_EQ(entries, 3u);
}

TEST_F(ImageFile, RefusesWhatIsNoImage) {
  refused([&] { read_image(root_ / "none.png"); }, "none.png", "found none");
  test::write_text(root_ / "text.png", "not an image");
  refused([&] { read_image(root_ / "text.png"); }, "text.png", "cannot be read");
  write_image(root_ / "a.png", Plane<glm::vec4>(64, 64, glm::vec4(0.3f)));
  fs::resize_file(root_ / "a.png", fs::file_size(root_ / "a.png") / 2);
  refused([&] { read_image(root_ / "a.png"); }, "a.png", "cannot be read");
  write_image(root_ / "a.exr", Plane<glm::vec4>(64, 64, glm::vec4(0.3f)));
  fs::resize_file(root_ / "a.exr", fs::file_size(root_ / "a.exr") / 2);
  refused([&] { read_image(root_ / "a.exr"); }, "a.exr", "cannot be read");
}

}  // namespace
}  // namespace plumbline
