#include "report/page/diagnosis_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/page/stage_pictures.h"
#include "report/page/viewer_data.h"
#include "report/page/web_files.h"
#include "report/text/diagnosis_text.h"
#include "report/text/safe_text.h"

namespace plumbline::report {

namespace {

using Json = nlohmann::ordered_json;

// Budget of one scene: some 512 x 512 pixels of noise in every picture.
constexpr std::size_t kBytes = std::size_t{16} << 20;

// The row that a view begins at: of the first different stage, exact's from the candidate's own records before others.
Json first_row(const check::Diagnosis& diagnosis, const std::vector<check::Comparison>& rows) {
  Json out = nullptr;
  for (std::size_t i = 0; diagnosis.first && i < rows.size(); ++i) {
    if (rows[i].stage != *diagnosis.first || rows[i].outcome != check::Outcome::different) continue;
    if (out.is_null() || check::judges_alone(rows[i])) out = i;
  }
  return out;
}

std::string view_json(const Pictured& p, const check::Diagnosis& diagnosis) {
  const bool resolved = antialiased(p.scene);
  std::vector<check::Comparison> rows = diagnosis.verdict.comparisons;
  std::erase_if(rows, [&](const check::Comparison& c) { return (c.stage == Stage::resolve) != resolved; });
  const Viewed viewed{p.title,
                      p.scene.frame.width,
                      p.scene.frame.height,
                      rows_from_top(p.scene.dialect),
                      {"drawn", "expected"},
                      stage_layers(p.scene, p.mine, p.expected)};
  return fmt::format("{{\"first\": {}, \"view\": {}}}", first_row(diagnosis, rows).dump(),
                     viewer_json(viewed, rows, 1, kBytes));
}

std::string drawing(const Pictured& p) {
  const std::string svg = positions_drawing(p.scene, p.mine, p.expected);
  if (svg.empty()) return {};
  return fmt::format(
      "<h2>positions: {}</h2>\n<p>Window triangles: expected in green, drawn in red where they lie elsewhere. At most "
      "10,000, those that differ first.</p>\n{}",
      escaped(p.title), svg);
}

}  // namespace

void write_diagnosis_page(PageFolder& folder, const Scene& scene, const check::Diagnosis& diagnosis,
                          std::span<const Pictured> pictured, std::string_view more) {
  std::string body = fmt::format(
      "<header class=bar><h1>{}</h1><div id=tools class=set style=\"margin-left: auto\"></div></header>\n<main>\n"
      "<p>{}</p>\n<pre tabindex=0>{}</pre>\n",
      escaped(scene.name), escaped(scene.description), escaped(diagnosis_text(diagnosis)));
  if (!more.empty()) body += fmt::format("<pre tabindex=0>{}</pre>\n", escaped(more));
  body += "<div id=views></div>\n";
  std::string views;
  for (const Pictured& p : pictured) {
    views += (views.empty() ? "" : ",\n") + view_json(p, diagnosis);
    body += drawing(p);
  }
  const std::string script =
      web_files({"dom.js", "planes.js", "difference.js", "viewer.js", "rows.js", "scene_view.js", "diagnosis_page.js"});
  folder.commit(scene.name + ": diagnosis", web_file("viewer.css"),
                fmt::format("{}</main>\n<script type=\"application/json\" id=\"diagnosis\">{{\"stages\": {}, "
                            "\"views\": [\n{}]}}</script>\n<script>\n{}</script>\n",
                            body, Json(kStageNames).dump(), in_script(views), script));
}

}  // namespace plumbline::report
