// Capture folders: what is written comes back bit for bit, and nothing broken is read.
#include "capture/files/capture_folder.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>

#include "base/atomic_path.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// Fills numbers with all sorts of bits: NaN with a payload, infinities, -0, denormals, and plain ones.
class Filler {
 public:
  double real() {
    ++n_;
    switch (n_ % 7) {
      case 0: return std::bit_cast<double>(0x7ff8'0000'dead'beefu);
      case 1: return -std::numeric_limits<double>::infinity();
      case 2: return -0.0;
      case 3: return std::numeric_limits<double>::denorm_min();
      default: return n_ * 1.1;
    }
  }
  template <int N, class T>
  void fill(glm::vec<N, T>& v) {
    for (int i = 0; i < N; ++i) v[i] = static_cast<T>(real());
  }
  template <int C, int R, class T>
  void fill(glm::mat<C, R, T>& m) {
    for (int i = 0; i < C; ++i) fill(m[i]);
  }

 private:
  int n_ = 0;
};

constexpr int kWidth = 5, kHeight = 3;

Capture make_capture() {
  Filler f;
  Capture c;
  c.renderer = "test";
  c.version = "1 \"quoted\" \xc3\xa4";
  c.width = kWidth;
  c.height = kHeight;
  Records<double>& r = c.records;
  r.matrices.resize(2);
  for (auto& m : r.matrices) {
    f.fill(m.model_view), f.fill(m.projection), f.fill(m.normal), f.fill(m.win_scale), f.fill(m.win_translate);
  }
  r.lights.resize(3);
  for (auto& l : r.lights) f.fill(l.p_eye), f.fill(l.spot_eye);
  r.vertices.resize(4);
  for (auto& v : r.vertices) f.fill(v.p_eye), f.fill(v.p_clip), f.fill(v.n_eye);
  r.lit.resize(4);
  for (auto& l : r.lit) f.fill(l.color);
  r.polygons.vertices.resize(7);
  for (std::size_t i = 0; i < 7; ++i) {
    auto& v = r.polygons.vertices[i];
    f.fill(v.p_clip), f.fill(v.color), v.cut = i % 3 == 1;
  }
  r.polygons.polygons = {{0, 0, 4}, {0xfffffffeu, 4, 3}};
  r.triangles.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    auto& t = r.triangles[i];
    t.primitive = i * 1000003u;
    t.front = i == 1;
    t.corners = 3 - i;
    for (int k = 0; k < 3; ++k) {
      auto& v = t.v[static_cast<std::size_t>(k)];
      f.fill(v.p_win), f.fill(v.color);
      v.inv_w = f.real();
      v.snapped = {-static_cast<int>(i) * 256 - k, std::numeric_limits<int>::min() + k};
    }
  }
  r.covered = {{0, 0, 0}, {2, kWidth - 1, kHeight - 1}};
  r.depth = {f.real(), f.real()};
  r.attributes.resize(2);
  for (auto& a : r.attributes) f.fill(a.color);
  r.texels.resize(2);
  for (auto& t : r.texels) f.fill(t.color), t.lod = f.real();
  r.shaded.resize(2);
  for (auto& s : r.shaded) f.fill(s.color);
  r.drawn = {{true}, {false}};
  for (const Varying v : kAllVaryings) {
    VaryingColumns<double>& columns = r.varyings[v];
    columns.vertices.resize(4), columns.clipped.resize(7), columns.triangles.resize(3), columns.fragments.resize(2);
    for (auto& four : columns.vertices) f.fill(four);
    for (auto& four : columns.clipped) f.fill(four);
    for (auto& corners : columns.triangles) {
      for (auto& four : corners) f.fill(four);
    }
    for (auto& four : columns.fragments) f.fill(four);
  }
  c.planes.count = {kWidth, kHeight, 0xffffffffu};
  c.planes.id_sum = {kWidth, kHeight, 0xfedcba9876543210u};
  c.planes.id = {kWidth, kHeight, kBackground};
  c.planes.stencil = {kWidth, kHeight, 0xfe};
  c.planes.texel = {kWidth, kHeight};
  for (auto& p : c.planes.texel.values()) f.fill(p);
  c.planes.shaded = {kWidth, kHeight};
  for (auto& p : c.planes.shaded.values()) f.fill(p);
  c.planes.color = {kWidth, kHeight};
  for (auto& p : c.planes.color.values()) f.fill(p);
  c.planes.depth = {kWidth, kHeight};
  for (auto& z : c.planes.depth.values()) z = f.real();
  c.planes.count(1, 2) = 12;  // rows are not columns
  return c;
}

class CaptureFolder : public TestFolder {
 protected:
  /// A good capture's folder. Made once: what was harmed since is written again, for making files takes longest.
  fs::path mended() {
    const fs::path folder = root_ / "harmed";
    if (good_.empty()) {
      write_capture(make_capture(), folder);
      for (const fs::path& file : fs::directory_iterator(folder)) good_[file.filename()] = test::text_of(file);
    }
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.is_symlink() || !good_.contains(entry.path().filename())) {
        fs::remove_all(entry.path());
      }
    }
    for (const auto& [name, bytes] : good_) {
      if (!fs::exists(folder / name) || test::text_of(folder / name) != bytes) test::write_text(folder / name, bytes);
    }
    return folder;
  }
  /// Reads a good capture's folder after `harm`; the message must hold every text.
  void refused(const std::function<void(const fs::path&)>& harm, const std::vector<std::string>& texts) {
    const fs::path folder = mended();
    harm(folder);
    try {
      read_capture(folder);
      ADD_FAILURE() << "not refused: " << texts.front();
    } catch (const CaptureError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(folder.string()), what.npos) << what;
      for (const std::string& text : texts) EXPECT_NE(what.find(text), what.npos) << text << "\n" << what;
    }
  }
  /// After one piece of the manifest was replaced.
  void refused_manifest(const std::string& from, const std::string& to, const std::vector<std::string>& texts) {
    refused(
        [&](const fs::path& folder) {
          std::string text = test::text_of(folder / "manifest.json");
          std::erase_if(text, [](char c) { return c == '\n' || c == ' '; });
          const std::string squeezed = "plumblinecapture";
          text.replace(text.find(squeezed), squeezed.size(), "plumbline capture");
          const std::size_t at = text.find(from);
          ASSERT_NE(at, text.npos) << from << "\n" << text;
          test::write_text(folder / "manifest.json", text.replace(at, from.size(), to));
        },
        texts);
  }
  /// After one element of an array was overwritten.
  template <class T>
  void refused_value(const std::string& array, std::size_t index, T value, const std::vector<std::string>& texts) {
    refused(
        [&](const fs::path& folder) {
          std::string bytes = test::text_of(folder / (array + ".bin"));
          ASSERT_LE((index + 1) * sizeof(T), bytes.size());
          std::memcpy(bytes.data() + index * sizeof(T), &value, sizeof(T));
          test::write_text(folder / (array + ".bin"), bytes);
        },
        texts);
  }

  std::map<fs::path, std::string> good_;
};

/// Every file of two folders is the same, byte for byte.
void expect_same_files(const fs::path& a, const fs::path& b, std::size_t count) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(a)) {
    std::ifstream x(entry.path(), std::ios::binary), y(b / entry.path().filename(), std::ios::binary);
    ASSERT_TRUE(y) << entry.path();
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(x), {}), std::string(std::istreambuf_iterator<char>(y), {}))
        << entry.path();
    ++files;
  }
  EXPECT_EQ(files, count);
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0;
}

TEST_F(CaptureFolder, ComesBackBitForBit) {
  const Capture a = make_capture();
  write_capture(a, root_ / "a");
  const Capture b = read_capture(root_ / "a");
  EXPECT_EQ(b.renderer, a.renderer);
  EXPECT_EQ(b.version, a.version);
  EXPECT_EQ(b.width, kWidth);
  EXPECT_EQ(b.height, kHeight);
  // Types without padding whole; the others member by member.
  EXPECT_TRUE(same_bits(a.records.matrices, b.records.matrices));
  EXPECT_TRUE(same_bits(a.records.lights, b.records.lights));
  EXPECT_TRUE(same_bits(a.records.vertices, b.records.vertices));
  EXPECT_TRUE(same_bits(a.records.lit, b.records.lit));
  EXPECT_TRUE(same_bits(a.records.polygons.polygons, b.records.polygons.polygons));
  EXPECT_TRUE(same_bits(a.records.covered, b.records.covered));
  EXPECT_TRUE(same_bits(a.records.depth, b.records.depth));
  EXPECT_TRUE(same_bits(a.records.attributes, b.records.attributes));
  EXPECT_TRUE(same_bits(a.records.texels, b.records.texels));
  EXPECT_TRUE(same_bits(a.records.shaded, b.records.shaded));
  EXPECT_TRUE(same_bits(a.records.drawn, b.records.drawn));
  for (const Varying v : kAllVaryings) {
    EXPECT_TRUE(same_bits(a.records.varyings[v].vertices, b.records.varyings[v].vertices));
    EXPECT_TRUE(same_bits(a.records.varyings[v].clipped, b.records.varyings[v].clipped));
    EXPECT_TRUE(same_bits(a.records.varyings[v].triangles, b.records.varyings[v].triangles));
    EXPECT_TRUE(same_bits(a.records.varyings[v].fragments, b.records.varyings[v].fragments));
  }
  ASSERT_EQ(b.records.polygons.vertices.size(), a.records.polygons.vertices.size());
  for (std::size_t i = 0; i < a.records.polygons.vertices.size(); ++i) {
    const auto &x = a.records.polygons.vertices[i], &y = b.records.polygons.vertices[i];
    EXPECT_EQ(std::memcmp(&x.p_clip, &y.p_clip, sizeof x.p_clip), 0);
    EXPECT_EQ(std::memcmp(&x.color, &y.color, sizeof x.color), 0);
    EXPECT_EQ(x.cut, y.cut);
  }
  ASSERT_EQ(b.records.triangles.size(), a.records.triangles.size());
  for (std::size_t i = 0; i < a.records.triangles.size(); ++i) {
    const auto &x = a.records.triangles[i], &y = b.records.triangles[i];
    EXPECT_EQ(std::memcmp(x.v.data(), y.v.data(), sizeof x.v), 0);
    EXPECT_EQ(x.primitive, y.primitive);
    EXPECT_EQ(x.front, y.front);
    EXPECT_EQ(x.corners, y.corners);
  }
  EXPECT_TRUE(same_bits(a.planes.count.values(), b.planes.count.values()));
  EXPECT_TRUE(same_bits(a.planes.id_sum.values(), b.planes.id_sum.values()));
  EXPECT_TRUE(same_bits(a.planes.id.values(), b.planes.id.values()));
  EXPECT_TRUE(same_bits(a.planes.stencil.values(), b.planes.stencil.values()));
  EXPECT_TRUE(same_bits(a.planes.texel.values(), b.planes.texel.values()));
  EXPECT_TRUE(same_bits(a.planes.shaded.values(), b.planes.shaded.values()));
  EXPECT_TRUE(same_bits(a.planes.color.values(), b.planes.color.values()));
  EXPECT_TRUE(same_bits(a.planes.depth.values(), b.planes.depth.values()));
  EXPECT_EQ(b.planes.count(1, 2), 12u);

  write_capture(b, root_ / "b");
  expect_same_files(root_ / "a", root_ / "b", 1 + 7 + 3 + 1 + 3 + 3 + 7 + 3 + 1 + 1 + 2 + 1 + 1 + 9 + 4 * kVaryings);
}

TEST_F(CaptureFolder, LeavesOutWhatWasNotCaptured) {
  Capture a;
  a.renderer = "test";
  a.width = 2;
  a.height = 1;
  a.planes.depth = {2, 1, 0.25};
  a.records.depth = {0.5};  // a stage's records alone
  write_capture(a, root_ / "a");
  const Capture b = read_capture(root_ / "a");
  EXPECT_EQ(b.planes.depth.values(), a.planes.depth.values());
  EXPECT_EQ(b.records.depth, a.records.depth);
  EXPECT_TRUE(b.planes.color.empty());
  EXPECT_TRUE(b.records.triangles.empty());
}

TEST_F(CaptureFolder, ReplacesACaptureAndNothingElse) {
  Capture a = make_capture();
  write_capture(a, root_ / "deep/er/a/");
  a.renderer = "second";
  a.records = {};
  write_capture(a, root_ / "deep/er/a");
  EXPECT_EQ(read_capture(root_ / "deep/er/a").renderer, "second");
  EXPECT_FALSE(fs::exists(root_ / "deep/er/a/depth.value.bin"));
  fs::create_directories(root_ / "empty");
  write_capture(a, root_ / "empty");
  EXPECT_EQ(read_capture(root_ / "empty").renderer, "second");

  fs::create_directories(root_ / "mine");
  test::write_text(root_ / "mine/thesis.txt", "text");
  EXPECT_THROW(write_capture(a, root_ / "mine"), OutputError);
  EXPECT_THROW(write_capture(a, root_ / "mine/thesis.txt"), OutputError);
  EXPECT_THROW(write_capture(a, root_ / "mine/thesis.txt/a"), OutputError);
  EXPECT_EQ(test::text_of(root_ / "mine/thesis.txt"), "text");
  test::write_text(root_ / "empty/notes.txt", "text");  // beside a capture's files
  EXPECT_THROW(write_capture(a, root_ / "empty"), OutputError);
  EXPECT_THROW(require_writable_capture(root_ / "empty"), OutputError);
  EXPECT_EQ(test::text_of(root_ / "empty/notes.txt"), "text");
  test::write_text(root_ / "mine/manifest.json", R"({"name": "a web app's"})");
  fs::remove(root_ / "mine/thesis.txt");
  EXPECT_THROW(write_capture(a, root_ / "mine"), OutputError);
  EXPECT_NO_THROW(require_writable_capture(root_ / "none/yet"));
  EXPECT_FALSE(fs::exists(root_ / "none")) << "asking writes nothing";
  for (const auto& entry : fs::recursive_directory_iterator(root_)) {
    EXPECT_NE(entry.path().filename().string().front(), '.') << "left behind: " << entry.path();
  }
}

TEST_F(CaptureFolder, RefusesBrokenManifests) {
  EXPECT_THROW(read_capture(root_ / "none"), CaptureError);
  refused([](const fs::path& f) { fs::remove(f / "manifest.json"); }, {"manifest.json", "no such file"});
  refused([](const fs::path& f) { fs::resize_file(f / "manifest.json", 300); }, {"manifest.json", "expected JSON"});
  refused_manifest(R"("format":"plumbline capture",)", R"("format":"plumbline export","draws":[],)", {"/format"});
  refused_manifest(R"("format":"plumbline capture",)", "", {"/format", "missing"});
  refused_manifest(R"("version":1)", R"("version":2)", {"/version", "expected 1"});
  refused_manifest(R"("little")", R"("big")", {"/byte_order", "\"little\""});
  refused_manifest(R"("width":5)", R"("width":0)", {"/width", "from 1 to 16384"});
  refused_manifest(R"("width":5)", R"("width":6)", {"planes.count", "[3, 6]"});
  refused_manifest(R"("height":3)", R"("height":-3)", {"/height", "from 1 to 16384"});
  refused_manifest(R"("height":3)", R"("height":1e999)", {"/height", "a finite number"});
  refused_manifest(R"("arrays":[)", R"("arrays":[3,)", {"/arrays/0", "an object"});
  refused_manifest(R"("arrays":[)", R"("arrays":[{},)", {"/arrays/0/name", "missing"});
  refused_manifest(R"("arrays":[)",
                   R"("arrays":[{"name":"depth.z","dtype":"f64","shape":[1],"file":"depth.value.bin"},)",
                   {"/arrays/0/name", "depth.z"});
  refused_manifest(R"("name":"vertex.p_clip")", R"("name":"vertex.p_eye")", {"each name once"});
  refused_manifest(R"("dtype":"f64")", R"("dtype":"u32")", {"/dtype", "matrices.model_view", "\"f64\""});
  refused_manifest(R"("dtype":"f64")", R"("dtype":"complex")", {"/dtype", "matrices.model_view"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[2,16])", {"/shape", "matrices.model_view", "[2, 4, 4]"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[2,4,3])", {"/shape", "matrices.model_view"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[-2,4,4])", {"/shape/0", "an integer from 0"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[])", {"/shape", "an array of 1 to 4"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[1,4,4])",
                   {"matrices.model_view.bin", "array matrices.model_view", "256 bytes"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[9223372036854775807,4,4])",
                   {"array matrices.model_view", "256 bytes"});
  refused_manifest(R"("shape":[2,4,4])", R"("shape":[144115188075855874,4,4])",
                   {"array matrices.model_view", "256 bytes"});
  refused_manifest(R"("file":"depth.value.bin")", R"("file":"../depth.value.bin")", {"/file", "without a folder"});
  refused_manifest(R"("file":"depth.value.bin")", R"("file":"/etc/passwd")", {"/file", "without a folder"});
  refused_manifest(R"("file":"depth.value.bin")", R"("file":"..")", {"/file", "without a folder"});
  refused_manifest(R"("file":"depth.value.bin")", R"("file":"none.bin")",
                   {"none.bin", "array depth.value", "found none"});
  refused_manifest(R"("name":"light.color")", R"("name":"vertex.n")", {"vertex.n"});
}

TEST_F(CaptureFolder, RefusesBrokenFiles) {
  for (const char* name : {"window.snapped.bin", "planes.color.bin", "coverage.x.bin"}) {
    const std::string array = std::string(name).substr(0, std::string(name).size() - 4);
    refused([&](const fs::path& f) { fs::remove(f / name); }, {name, "array " + array, "expected a file"});
    refused([&](const fs::path& f) { fs::resize_file(f / name, fs::file_size(f / name) - 1); },
            {name, "array " + array});
    refused([&](const fs::path& f) { fs::resize_file(f / name, fs::file_size(f / name) * 2); },
            {name, "array " + array});
    refused([&](const fs::path& f) { fs::resize_file(f / name, fs::file_size(f / name) + 1); },
            {name, "array " + array});
    refused([&](const fs::path& f) { fs::resize_file(f / name, 0); }, {name, "array " + array, "found 0 bytes"});
    refused([&](const fs::path& f) { fs::remove(f / name), fs::create_directory(f / name); }, {name, "array " + array});
  }
}

TEST_F(CaptureFolder, RefusesArraysThatDoNotGoTogether) {
  Capture c = make_capture();
  const auto refused_capture = [&](const std::vector<std::string>& texts) {
    write_capture(c, root_ / "c");
    try {
      read_capture(root_ / "c");
      ADD_FAILURE() << "not refused: " << texts.front();
    } catch (const CaptureError& error) {
      for (const std::string& text : texts)
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
    c = make_capture();
  };
  c.records.lit.pop_back();
  refused_capture({"arrays light.*", "vertex.*, 4, found 3"});
  c.records.depth.pop_back();
  refused_capture({"arrays depth.*", "coverage.*, 2, found 1"});
  c.records.attributes.emplace_back();
  refused_capture({"arrays attributes.*", "found 3"});
  c.records.shaded.emplace_back();
  refused_capture({"arrays shade.*", "found 3"});
  c.planes.id = {kHeight, kWidth};
  refused_capture({"planes.id", "[3, 5]"});
}

TEST_F(CaptureFolder, RefusesWhatPointsOutside) {
  refused_value<std::uint32_t>("clip.polygon.count", 0, 0, {"array clip.polygon.count", "element 0", "found 0"});
  refused_value<std::uint32_t>("window.corners", 1, 4, {"array window.corners", "element 1", "1 to 3, found 4"});
  refused_value<std::uint32_t>("window.corners", 0, 0, {"array window.corners", "element 0", "1 to 3, found 0"});
  refused_value<std::uint32_t>("clip.polygon.count", 1, 29, {"array clip.polygon.count", "element 1", "found 29"});
  refused_value<std::uint32_t>("clip.polygon.count", 1, 4, {"array clip.polygon.first", "element 1", "below 7"});
  refused_value<std::uint32_t>("clip.polygon.first", 1, 0xffffffffu, {"array clip.polygon.first", "element 1"});
  refused_value<std::uint32_t>("coverage.triangle", 1, 3, {"array coverage.triangle", "element 1", "below 3"});
  refused_value<std::uint16_t>("coverage.x", 0, kWidth, {"array coverage.x", "element 0", "below 5"});
  refused_value<std::uint16_t>("coverage.y", 1, kHeight, {"array coverage.y", "element 1", "below 3"});
  refused_value<std::uint8_t>("clip.cut", 3, 2, {"array clip.cut", "0 or 1"});
  refused_value<std::uint8_t>("window.front", 0, 255, {"array window.front", "0 or 1"});
}

}  // namespace
}  // namespace plumbline
