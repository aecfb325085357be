// Every pass of OpenGL's starts from one stated state: no scene leaves anything for the next.
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "scene/file/scene_file.h"
#include "tests/capture/differing_arrays.h"
#include "tests/cross/osmesa_scenes.h"
#include "tests/extent.h"
#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline::test {
namespace {

const std::string kSource = PLUMBLINE_SOURCE_DIR;
const std::string kFolder = kSource + "/reference/osmesa/";

/// The first group of each match.
std::set<std::string> found(const std::string& text, const char* pattern) {
  std::set<std::string> out;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) out.insert((*it)[1]);
  return out;
}

// Entry points that change no state, or an object's alone; and those of a pass' target.
const std::regex kStateless(
    "Attach.*|Create.*|Compile.*|Delete.*|Gen.*|Get.*|Link.*|ShaderSource|TransformFeedbackVaryings|Uniform1i|"
    "BufferData|TexImage.*|TexParameter.*|RenderbufferStorage|Framebuffer.*|CheckFramebufferStatus|"
    "Clear|Draw.*|Rectf|Finish|ReadPixels|BlitFramebuffer|(Begin|End).*|(Push|Pop).*|FeedbackBuffer|"
    "(Bind(Framebuffer|Renderbuffer))|Viewport|"
    ".*Pointer|EnableClientState|"                             // of arrays that are disabled
    "Load(Matrixf)|Frustum|Ortho|Rotated|Scaled|Translated");  // LoadIdentity undoes them

TEST(OsmesaDefaultState, SetsEveryStateThatIsSetAnywhere) {
  const std::string defaults = test::text_of(kFolder + "scene/default_state.cpp");
  const std::string functions = test::text_of(kFolder + "gl/gl.h");
  int setters = 0;
  for (const std::string& name : found(functions, R"(F\((\w+)\))")) {
    if (std::regex_match(name, kStateless)) continue;
    const std::string stem = std::regex_replace(name, std::regex("Separate$|v$"), "");  // forms of one function
    EXPECT_NE(defaults.find("gl." + stem), std::string::npos) << "gl" << name << " is set to no default";
    ++setters;
  }
  EXPECT_GT(setters, 40);

  std::set<std::string> names;
  for (const auto& file : std::filesystem::recursive_directory_iterator(kFolder)) {
    if (file.path().extension() != ".cpp" || file.path().stem() == "default_state") continue;
    names.merge(found(text_of(file.path()),
                      R"((?:Enable|Enable\w+|Lightf|Lightfv|LightModeli|LightModelfv|Fogi|Fogf|Fogfv)"
                      R"(|ClampColor|PixelStorei)\((?:name, |face, )?(GL_\w+))"));
  }
  for (const std::string& name : names) {
    EXPECT_NE(defaults.find(name), std::string::npos) << name << " is set to no default";
  }
  EXPECT_GT(names.size(), 40u);
}

// Mesa's glPopAttrib leaves the alpha's equation where rgb's is the default.
TEST(OsmesaDefaultState, ABlendEquationOfAlphaAloneIsNotLeft) {
  Scene scene = pixel_scene(8, 8), before = scene;
  for (const float z : {0.0f, 0.5f}) add(scene, rectangle(1, 1, 7, 7, z));
  add(before, rectangle(1, 1, 7, 7, 0)).merge.blend.emplace().alpha.equation = BlendEquation::subtract;
  const Request all{.records = StageSet::all()};
  const Capture fresh = make_opengl()->capture(scene, all);
  const auto used = make_opengl();
  used->capture(before, all);
  expect_same_captures(used->capture(scene, all), fresh);
}

struct Suite {
  std::vector<Scene> scenes;
  std::map<std::string, std::vector<std::size_t>> groups;  ///< numbers of scenes
  std::vector<std::string> group_of;
};

Suite read_suite() {
  Suite suite;
  for (const auto& file : suite_files()) {
    suite.group_of.push_back(file.parent_path().stem().string());
    suite.groups[suite.group_of.back()].push_back(suite.scenes.size());
    suite.scenes.push_back(load_scene(file, {}));
  }
  return suite;
}

std::optional<Capture> capture(Renderer& osmesa, const Scene& scene) {
  try {
    return osmesa.capture(scene, {.records = StageSet::all()});
  } catch (const Unsupported&) {
    return std::nullopt;
  }
}

// Each scene after a scene of each other group, another one for each.
TEST(OsmesaAfterEveryGroup, EachSceneDrawsWhatItDrawsInAFreshContext) {
  const Suite suite = read_suite();
  const std::size_t every = one_of(211);
  const auto used = make_opengl();
  std::size_t pair = 0, compared = 0;
  for (std::size_t i = 0; i < suite.scenes.size(); ++i) {
    std::optional<Capture> fresh;
    for (const auto& [group, members] : suite.groups) {
      if (group == suite.group_of[i] || pair++ % every != 0) continue;
      const Scene& before = suite.scenes[members[i % members.size()]];
      SCOPED_TRACE(suite.scenes[i].name + " after " + before.name);
      if (!fresh) fresh = capture(*make_opengl(), suite.scenes[i]);
      if (!fresh) break;
      capture(*used, before);
      const std::optional<Capture> after = capture(*used, suite.scenes[i]);
      ASSERT_TRUE(after);
      expect_same_captures(*after, *fresh);
      ++compared;
    }
  }
  EXPECT_GT(compared, 30u);
}

}  // namespace
}  // namespace plumbline::test
