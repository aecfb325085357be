#include "report/page/golden_page.h"
#include "report/text/safe_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::report {

namespace {

constexpr std::string_view kStyle = "img { width: 256px; }\n";

Plane<glm::vec4> grey(const Plane<double>& depth) {
  Plane<glm::vec4> out(depth.width(), depth.height());
  std::ranges::transform(depth.values(), out.values().begin(),
                         [](double z) { return glm::vec4(glm::vec3(static_cast<float>(z)), 1); });
  return out;
}

// Differing pixels are at least a quarter white, so that a difference in the last bit is visible.
Plane<glm::vec4> difference_of(const Plane<glm::vec4>& a, const Plane<glm::vec4>& b) {
  if (a.width() != b.width() || a.height() != b.height()) return {};
  Plane<glm::vec4> out(a.width(), a.height(), glm::vec4(0, 0, 0, 1));
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      const float mine = a.values()[i][c], theirs = b.values()[i][c];
      if (mine == theirs) continue;
      const float seen = std::clamp(0.25f + 4 * std::abs(mine - theirs), 0.25f, 1.0f);
      if (c == 3)
        out.values()[i] = glm::vec4(glm::max(glm::vec3(out.values()[i]), glm::vec3(seen)), 1);
      else
        out.values()[i][c] = seen;
    }
  }
  return out;
}

}  // namespace

void GoldenPage::add(const Scene& scene, const std::string& says, const check::GoldenDifference& d,
                     const check::Vouch& vouch) {
  const auto picture = [&](const Plane<glm::vec4>& plane, const std::string& name) {
    if (plane.empty()) return;
    const std::string file = fmt::format("{}/{}.png", file_name(scene.name), file_name(name));
    Plane<glm::vec4> opaque = rows_from_top(scene.dialect) ? upside_down(plane) : plane;
    for (glm::vec4& color : opaque.values()) color.a = 1;
    page_.write_picture(file, opaque);
    body_ += fmt::format("<figure><img src=\"{0}\" alt=\"{1}\" loading=lazy><figcaption>{1}</figcaption></figure>\n",
                         file, escaped(name));
  };
  body_ += fmt::format("<h2>{}: {}</h2>\n<p>{}</p>\n<pre>{}</pre>\n", escaped(scene.name), escaped(says),
                       escaped(scene.description), escaped(describe(d)));
  picture(d.golden.color, "old");
  picture(d.drawn.color, "new");
  if (d.color.differing > 0) picture(difference_of(d.golden.color, d.drawn.color), "difference");
  if (d.depth.differing > 0 || d.golden.depth.empty()) {
    picture(grey(d.golden.depth), "old depth");
    picture(grey(d.drawn.depth), "new depth");
    picture(difference_of(grey(d.golden.depth), grey(d.drawn.depth)), "difference of depth");
  }
  const auto list = [&](const char* what, const std::vector<std::string>& lines) {
    if (!lines.empty())
      body_ += fmt::format("<p>{}: {}</p>\n", what, escaped(fmt::format("{}", fmt::join(lines, "; "))));
  };
  list("refused", vouch.refusals);
  list("vouched for by", vouch.by);
  list("disputed", vouch.disputed);
}

void GoldenPage::write(const std::string& summary) {
  page_.commit("plumbline goldens", kStyle,
               fmt::format("<h1>plumbline goldens</h1>\n<p>{}</p>\n{}", escaped(summary), body_));
}

}  // namespace plumbline::report
