#include "report/diagnosis_page.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/diagnosis_text.h"
#include "report/stage_pictures.h"

namespace plumbline::report {

namespace {

constexpr std::string_view kStyle = R"(
pre { font: 12px/1.35 ui-monospace, monospace; overflow-x: auto; padding: .6em; border: 1px solid #8886; }
h2.wrong::after { content: " wrong"; color: #d33232; }
figure { vertical-align: top; }
.slider { position: relative; display: inline-block; --cut: 50%; }
.slider img { display: block; }
.slider img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--cut)); }
.slider::after { content: ""; position: absolute; top: 0; bottom: 0; left: var(--cut); border-left: 1px solid #d33232; }
input[type=range] { display: block; width: 100%; margin: 2px 0 0; }
svg { border: 1px solid #8888; background: #0003; overflow: hidden; }
svg path { fill: none; stroke-width: 1px; vector-effect: non-scaling-stroke; stroke-linecap: round; }
svg .same { stroke: #8889; } svg .expected { stroke: #2a9d4a; } svg .mine { stroke: #d33232; }
)";

// At most 300 pixels a side; small frames in whole multiples of their pixels.
int shown_width(const Scene& scene) {
  const int side = std::max(scene.frame.width, scene.frame.height);
  return side > 300 ? 300 * scene.frame.width / side : scene.frame.width * (300 / side);
}

class Page {
 public:
  Page(PageFolder& folder, const Scene& scene) : folder_(folder), scene_(scene), width_(shown_width(scene)) {}

  std::string body;

  void add(const StagePicture& picture) {
    const std::string mine = file(picture, "ours", picture.mine);
    const std::string expected = file(picture, "expected", picture.expected);
    const std::string differences = file(picture, "differences", picture.differences);
    if (picture.name != name_of(picture.stage)) body += fmt::format("<h3>{}</h3>\n", escaped(picture.name));
    body += fmt::format("<p>{}</p>\n", escaped(picture.says));
    if (!mine.empty() && !expected.empty()) {
      body += fmt::format(
          "<figure><div class=slider>{}{}</div><input type=range min=0 max=100 value=50 aria-label=\"ours or "
          "expected\" "
          "oninput=\"this.previousSibling.style.setProperty('--cut', this.value + '%')\">"
          "<figcaption>ours | expected</figcaption></figure>\n",
          image(mine, "ours"), image(expected, "expected"));
    }
    figure(mine, "ours");
    figure(expected, "expected");
    figure(differences, picture.differing == 0
                            ? "no pixel differs"
                            : fmt::format("{} pixels differ, by {:.3g} at most", picture.differing, picture.largest));
  }
  void add_drawing(const std::string& svg) {
    if (svg.empty()) return;
    body += fmt::format(
        "<h3>positions</h3>\n<p>window triangles, expected in green, ours in red where it is elsewhere; of many, "
        "5000</p>\n"
        "<figure style=\"width:{}px\">{}</figure>\n",
        2 * width_, svg);
  }
  void commit(const std::string& title) { folder_.commit(title, kStyle, body); }

 private:
  std::string file(const StagePicture& picture, const char* side, const Plane<glm::vec4>& plane) {
    if (plane.empty()) return {};
    const std::string name = file_name(fmt::format("{}-{}.png", picture.name, side));
    folder_.write_picture(name, rows_from_top(scene_.dialect) ? upside_down(plane) : plane);
    return name;
  }
  std::string image(const std::string& name, std::string_view alt) const {
    return fmt::format("<img src=\"{}\" alt=\"{}\" width={}>", name, alt, width_);
  }
  void figure(const std::string& name, const std::string& caption) {
    if (name.empty()) return;
    body += fmt::format("<figure><a href=\"{}\">{}</a><figcaption>{}</figcaption></figure>\n", name,
                        image(name, caption), caption);
  }

  PageFolder& folder_;
  const Scene& scene_;
  int width_;
};

}  // namespace

void write_diagnosis_page(PageFolder& folder, const Scene& scene, const check::Diagnosis& diagnosis,
                          const Capture& mine, const Capture& expected, std::string_view more) {
  Page page(folder, scene);
  page.body = fmt::format("<h1>{}</h1>\n<p>{}</p>\n<pre>{}</pre>\n", escaped(scene.name), escaped(scene.description),
                          escaped(diagnosis_text(diagnosis)));
  if (!more.empty()) page.body += fmt::format("<pre>{}</pre>\n", escaped(more));
  const std::vector<StagePicture> pictures = stage_pictures(scene, mine, expected);
  const std::string drawing = positions_drawing(scene, mine, expected);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const bool has_drawing = stage == Stage::window && !drawing.empty();
    const bool wrong = std::ranges::count(diagnosis.wrong, stage) > 0;
    if (!wrong && !has_drawing && std::ranges::count(pictures, stage, &StagePicture::stage) == 0) continue;
    page.body += fmt::format("<h2{}>{}</h2>\n", wrong ? " class=wrong" : "", name_of(stage));
    if (has_drawing) page.add_drawing(drawing);
    for (const StagePicture& picture : pictures) {
      if (picture.stage == stage) page.add(picture);
    }
  }
  page.commit(scene.name + ": diagnosis");
}

}  // namespace plumbline::report
