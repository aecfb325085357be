#include "report/html_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "stages/image_file.h"

namespace plumbline::report {

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; }
body { font: 14px/1.4 system-ui, sans-serif; margin: 2em; max-width: 100em; }
h1 { font-size: 1.4em; } h2 { font-size: 1.1em; margin-top: 2em; }
figure { display: inline-block; margin: 0 1em 1em 0; }
img { image-rendering: pixelated; width: 256px; height: auto; border: 1px solid #8888; }
figcaption { font-size: 12px; }
table { border-collapse: collapse; font-size: 12px; }
th, td { text-align: left; padding: 1px 10px 1px 0; white-space: nowrap; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.different td, tr.failed td, tr.missing td { background: #d3323233; }
tr.dispute td { background: #d3a03233; }
tr.unsupported td { opacity: .55; }
)";

// The page's own list of its files; the first line says whose it is.
constexpr const char* kList = "plumb-report.txt";
constexpr std::string_view kListHead = "This page was made by plumb check, and may be replaced by it. Its files:";

std::set<std::filesystem::path> files_of_page(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  std::ifstream in(folder / kList);
  std::string line;
  if (!std::getline(in, line) || line != kListHead) return files;
  while (std::getline(in, line)) files.insert(line);
  return files;
}

// The length of the UTF-8 sequence that the text begins with; 0: none, or one that UTF-8 forbids.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool no_character = (byte(0) == 0xed && byte(1) > 0x9f) || (byte(0) == 0xf4 && byte(1) > 0x8f);
  return overlong || no_character ? 0 : length;
}

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view one = text.substr(0, std::max<std::size_t>(length, 1));
    switch (one[0]) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += length == 0 ? "\xef\xbf\xbd" : one;  // U+FFFD: what was no character
    }
    text.remove_prefix(one.size());
  }
  return out;
}

// A relative path that any file system takes and a link may hold as it is.
std::string file_name(std::string_view text) {
  std::string out;
  for (char c : text) {
    const bool hidden = c == '.' && (out.empty() || out.back() == '/');  // ".." as well
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '/';
    out += plain && !hidden ? c : '_';
  }
  return out;
}

// |a - b| per channel, times 8, so that a small difference is seen; opaque. White where one side is not finite.
Plane<glm::vec4> difference_picture(const Plane<glm::vec4>& a, const Plane<glm::vec4>& b) {
  Plane<glm::vec4> out(a.width(), a.height());
  for (std::size_t i = 0; i < out.size(); ++i) {
    glm::vec4 d(1);
    for (int c = 0; c < 3; ++c) {
      const double diff = check::difference(a.values()[i][c], b.values()[i][c]);
      d[c] = std::isfinite(diff) ? static_cast<float>(std::min(8 * diff, 1.0)) : 1.0f;
    }
    out.values()[i] = d;
  }
  return out;
}

std::string row(const check::Comparison& c) {
  const check::Measurement& m = c.measurement;
  const check::Worst* worst = check::shown(c);
  const std::string largest = worst != nullptr ? fmt::format("{:.4g} {}", worst->difference, m.unit)
                              : m.items > 0    ? "0"
                                               : "";
  return fmt::format(
      "<tr class=\"{}\"><td>{}<td>{}<td>{}<td class=number>{}<td class=number>{}<td class=number>{}<td "
      "class=number>{}<td class=number>{}<td>{}</tr>\n",
      name_of(c.outcome), escaped(c.reference), name_of(c.stage), name_of(c.outcome), m.items, m.differing, m.ambiguous,
      escaped(largest), worst != nullptr ? fmt::format("{:.4g}", worst->tolerance) : "", escaped(check::remark(c)));
}

}  // namespace

HtmlReport::HtmlReport(const std::filesystem::path& folder) : name_(folder), folder_(folder) {
  require_writable_folder(name_, files_of_page(name_));
  folder_.make_folder();
}

// Scenes of two folders may have one name.
std::string HtmlReport::free_folder(const std::string& scene) {
  const std::string name = file_name(scene);
  std::string free = name;
  for (int i = 2; !folders_.insert(free).second; ++i) free = fmt::format("{}-{}", name, i);
  return free;
}

void HtmlReport::write_file(const std::string& name, std::string_view bytes) {
  folder_.write_inside(name, bytes);
  files_ += name + "\n";
}

void HtmlReport::add(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
                     const check::Drawn& drawn, const Scene& scene) {
  const std::string scene_folder = free_folder(verdict.scene);
  const auto picture = [&](const Plane<glm::vec4>& plane, const std::string& name, const std::string& caption) {
    if (plane.empty()) return;
    const std::string file = fmt::format("{}/{}.png", scene_folder, file_name(name));
    write_file(file, encode_png(file, rows_from_top(scene.dialect) ? upside_down(plane) : plane));
    body_ += fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=lazy></a>"
        "<figcaption>{1}</figcaption></figure>\n",
        file, escaped(caption));
  };
  body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n", scene_folder, escaped(verdict.scene),
                       escaped(scene.description));
  const Plane<glm::vec4>& ours = drawn.candidate.planes.color;
  picture(ours, "ours", "ours");
  for (std::size_t i = 0; i < references.size() && i < drawn.references.size(); ++i) {
    const Plane<glm::vec4>& theirs = drawn.references[i].planes.color;
    picture(theirs, references[i].name, references[i].name);
    if (ours.size() != theirs.size() || ours.width() != theirs.width()) continue;
    picture(difference_picture(ours, theirs), references[i].name + "-difference",
            "ours - " + references[i].name + ", times 8");
  }
  body_ +=
      "<table><tr><th>reference<th>stage<th>outcome<th>pixels<th>differing<th>ambiguous<th>largest<th>tolerance"
      "<th>worst</tr>\n";
  for (const check::Comparison& c : verdict.comparisons) body_ += row(c);
  body_ += "</table>\n";
}

void HtmlReport::write(const std::string& summary) {
  write_file("index.html", fmt::format("<!doctype html>\n<html lang=en><meta charset=utf-8><title>plumbline</title>\n"
                                       "<style>{}</style>\n<h1>plumbline check</h1>\n<p>{}</p>\n{}</html>\n",
                                       kStyle, escaped(summary), body_));
  folder_.write_inside(kList, fmt::format("{}\n{}\n{}", kListHead, kList, files_));
  require_writable_folder(name_, files_of_page(name_));  // the run was long
  folder_.commit();
}

}  // namespace plumbline::report
