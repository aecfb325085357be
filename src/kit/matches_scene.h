// GoogleTest matcher: a frame shows a scene, by the judgement of plumbline's references.
//
//   plumbline::DrawnFrame frame = plumbline::frame_of_bytes(320, 180, rgba);   // or floats, and depth
//   EXPECT_THAT(frame, plumbline::MatchesScene("triangle.json"));
//
// One header, C++17, for tests that link GoogleMock. The program plumb is that of the environment's PLUMBLINE_PLUMB,
// else of CMake's target plumbline::kit, else the one in PATH. MIT licence.
#ifndef PLUMBLINE_MATCHES_SCENE_H
#define PLUMBLINE_MATCHES_SCENE_H

#if defined(__cplusplus) && __cplusplus < 201703L
#error "plumbline/matches_scene.h: expected C++17 or later"
#endif

#include <sys/wait.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace plumbline {

/// A frame that a renderer drew. Row 0 is the lowest; of a scene whose frame says rows_from_top, the uppermost.
struct DrawnFrame {
  int width = 0, height = 0;
  std::vector<float> color;   ///< [height, width, 4]: red, green, blue and alpha in [0,1]
  std::vector<double> depth;  ///< [height, width]: window z in [0,1]; empty: not judged
};

/// Frame of 8-bit colours; `rgba`: [height, width, 4] bytes, not read where the size is below 1 x 1: MatchesScene()
/// then throws.
inline DrawnFrame frame_of_bytes(int width, int height, const std::uint8_t* rgba) {
  DrawnFrame frame{width, height, {}, {}};
  if (width < 1 || height < 1) return frame;
  const std::size_t values = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < values; ++i) frame.color.push_back(static_cast<float>(rgba[i]) / 255.0F);
  return frame;
}

inline void PrintTo(const DrawnFrame& frame, std::ostream* out) {
  *out << "a frame of " << frame.width << " x " << frame.height << " pixels, "
       << (frame.depth.empty() ? "without depth" : "with depth");
}

/// Matcher of a DrawnFrame. The message of a mismatch is that of `plumb diagnose`: the first stage that is wrong, with
/// numbers and pixels. A page with pictures is written to plumbline_pages/TEST/SCENE in the working directory, to
/// SCENE.1 after one failure of the test, SCENE.2 after two. Throws std::runtime_error where the frame cannot be judged
/// (no such scene, another size, an antialiased scene, no plumb): neither the matcher nor its Not() passes.
class SceneMatcher {
 public:
  using is_gtest_matcher = void;
  explicit SceneMatcher(const std::filesystem::path& scene) : scene_(found(scene)) {}

  bool MatchAndExplain(const DrawnFrame& frame, std::ostream* out) const {
    const Folder folder;
    write(frame, folder.path);
    const std::filesystem::path capture = folder.path / "capture";
    const std::string judge = quoted(plumb()) + " diagnose " + quoted(scene_) + " --capture " + quoted(capture);
    auto [code, text] = run(judge);
    for (std::size_t at = 0; (at = text.find(capture.string(), at)) != text.npos;)
      text.replace(at, capture.string().size(), "the frame");  // its folder is removed
    if ((code != 0 && code != 1) || text.find(" stages judged\n") == std::string::npos) {
      throw std::runtime_error("MatchesScene(" + scene_.string() + ") was not judged: " + plumb() +
                               " (PLUMBLINE_PLUMB), exit code " + std::to_string(code) + ": " + text);
    }
    if (out != nullptr && code == 1) {
      const auto [ended, with_page] = run(judge + " --report " + quoted(page()));
      *out << "which differs:\n"
           << (ended == 1 ? with_page : text + with_page);  // no page can be written: the finding, and why
    }
    return code == 0;
  }
  void DescribeTo(std::ostream* out) const { *out << "shows the scene " << scene_.string(); }
  void DescribeNegationTo(std::ostream* out) const { *out << "does not show the scene " << scene_.string(); }

 private:
  // Temporary folder; the destructor removes it.
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::error_code error;
      std::string name = (std::filesystem::temp_directory_path(error) / "plumbline.XXXXXX").string();
      if (error) {
        const char* const named = std::getenv("TMPDIR");
        throw std::runtime_error(std::string("TMPDIR: expected a folder for temporary files, found \"") +
                                 (named == nullptr ? "" : named) + "\": " + error.message());
      }
      if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
      path = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };

  // Relative to the working directory, or else in plumbline's suite.
  static std::filesystem::path found(const std::filesystem::path& scene) {
#ifdef PLUMBLINE_SCENES
    const std::filesystem::path of_suite = std::filesystem::path(PLUMBLINE_SCENES) / scene;
    if (!std::filesystem::exists(scene) && std::filesystem::exists(of_suite)) return of_suite;
#endif
    return std::filesystem::absolute(scene);
  }

  // Folder of the page, another for each test, scene and failure.
  std::filesystem::path page() const {
    std::string test = "no test", scene = scene_.stem().string();
    if (const testing::TestInfo* const now = testing::UnitTest::GetInstance()->current_test_info()) {
      test = std::string(now->test_suite_name()) + "." + now->name();
      if (const int failures = now->result()->total_part_count(); failures > 0) scene += "." + std::to_string(failures);
    }
    for (char& c : test) c = c == '/' ? '_' : c;  // of a parameterised test
    return std::filesystem::absolute("plumbline_pages") / test / scene;
  }

  static std::string plumb() {
    const char* const named = std::getenv("PLUMBLINE_PLUMB");
    if (named != nullptr && *named != '\0') return named;
#ifdef PLUMBLINE_PLUMB
    return PLUMBLINE_PLUMB;
#else
    return "plumb";
#endif
  }

  // A shell's word for the path.
  static std::string quoted(const std::filesystem::path& path) {
    std::string out = "'";
    for (const char c : path.string()) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
  }

  // The exit code, and what was printed.
  static std::pair<int, std::string> run(const std::string& command) {
    std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error(command + ": cannot be run");
    std::string text;
    std::array<char, 4096> part{};
    for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
  }

  // One array of the capture; `shape` as JSON has it.
  template <class T>
  static std::string array(const std::filesystem::path& folder, const std::string& name, const char* dtype,
                           const std::vector<T>& values, const std::string& shape) {
    std::ofstream file(folder / (name + ".bin"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
    if (!file.flush()) throw std::runtime_error((folder / name).string() + ": cannot be written");
    return "{\"name\": \"" + name + "\", \"dtype\": \"" + dtype + "\", \"shape\": [" + shape + "], \"file\": \"" +
           name + ".bin\"}";
  }

  // The frame as a capture folder (src/kit/README.md).
  static void write(const DrawnFrame& frame, const std::filesystem::path& folder) {
    const std::size_t pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    if (frame.width < 1 || frame.height < 1 || frame.color.size() != 4 * pixels ||
        (!frame.depth.empty() && frame.depth.size() != pixels)) {
      throw std::runtime_error("MatchesScene: a frame of " + std::to_string(frame.width) + " x " +
                               std::to_string(frame.height) +
                               " pixels: expected at least 1 x 1, 4 numbers of colour a pixel, and of depth 1 or none;"
                               " found " +
                               std::to_string(frame.color.size()) + " and " + std::to_string(frame.depth.size()));
    }
    const std::filesystem::path capture = folder / "capture";
    std::filesystem::create_directory(capture);
    const std::string size = std::to_string(frame.height) + ", " + std::to_string(frame.width);
    std::string arrays = array(capture, "planes.color", "f32", frame.color, size + ", 4");
    if (!frame.depth.empty()) arrays += ", " + array(capture, "planes.depth", "f64", frame.depth, size);
    std::ofstream manifest(capture / "manifest.json");
    manifest << "{\"format\": \"plumbline capture\", \"version\": 1, \"renderer\": \"the frame\", \"width\": "
             << std::to_string(frame.width) << ", \"height\": " << std::to_string(frame.height)
             << ", \"byte_order\": \"little\", \"arrays\": [" << arrays << "]}\n";
    if (!manifest.flush()) throw std::runtime_error((capture / "manifest.json").string() + ": cannot be written");
  }

  std::filesystem::path scene_;
};

/// Matcher by a scene file (src/scene/README.md): relative to the working directory, or of plumbline's suite.
inline SceneMatcher MatchesScene(const std::filesystem::path& scene) { return SceneMatcher(scene); }

}  // namespace plumbline

#endif
