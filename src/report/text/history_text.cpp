#include "report/text/history_text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace plumbline::report {

using check::PixelFragment;
using check::PixelHistory;

namespace {

constexpr std::size_t kLabel = 12, kColumn = 32;

// The text in lines of a column's width, broken at spaces where there are any.
std::vector<std::string> wrapped(std::string text) {
  std::vector<std::string> lines;
  while (text.size() > kColumn) {
    std::size_t at = text.rfind(' ', kColumn);
    if (at == std::string::npos || at == 0) at = kColumn;
    lines.push_back(text.substr(0, at));
    text.erase(0, text[at] == ' ' ? at + 1 : at);
  }
  lines.push_back(text);
  return lines;
}

// A label, and beside it a cell for each renderer, as many lines as the longest takes.
std::string row(const std::string& label, const std::vector<std::string>& cells) {
  std::vector<std::vector<std::string>> columns;
  std::size_t height = 1;
  for (const std::string& cell : cells) {
    columns.push_back(wrapped(cell));
    height = std::max(height, columns.back().size());
  }
  std::string out;
  for (std::size_t i = 0; i < height; ++i) {
    std::string line = fmt::format("  {:<{}}", i == 0 ? label : "", kLabel);
    for (const auto& column : columns) line += fmt::format("{:<{}}", i < column.size() ? column[i] : "", kColumn + 2);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string numbers(const glm::dvec4& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z, v.w); }

std::string depth_text(const FrameFormat& frame, double z) {
  const double scale = depth_scale(frame.depth);
  return scale > 0 ? fmt::format("{:.9g} = code {:.10g}", z, z * scale) : fmt::format("{:.9g}", z);
}

std::string color_text(const FrameFormat& frame, const glm::vec4& color) {
  const double scale = color_scale(frame.color);
  const glm::dvec4 codes = glm::dvec4(color) * scale;
  if (scale == 0) return numbers(glm::dvec4(color));
  return fmt::format("{} = codes {:.6g} {:.6g} {:.6g} {:.6g}", numbers(glm::dvec4(color)), codes.x, codes.y, codes.z,
                     codes.w);
}

// Reasons, each said once.
class Footnotes {
 public:
  std::string unsupported(const std::string& renderer, const std::string& reason) {
    const std::string text = renderer + ": " + reason;
    auto at = std::ranges::find(texts_, text);
    if (at == texts_.end()) at = texts_.insert(texts_.end(), text);
    return fmt::format("unsupported [{}]", at - texts_.begin() + 1);
  }
  std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < texts_.size(); ++i) out += fmt::format("  [{}] {}\n", i + 1, texts_[i]);
    return out;
  }

 private:
  std::vector<std::string> texts_;
};

// A primitive, and which of its fragments at the pixel, where it has several.
using Key = std::pair<std::uint32_t, std::size_t>;

std::vector<Key> keys_of(const PixelHistory& history) {
  std::vector<Key> out;
  for (const PixelFragment& f : history.fragments) {
    const bool again = !out.empty() && out.back().first == f.primitive;
    out.emplace_back(f.primitive, again ? out.back().second + 1 : 0);
  }
  return out;
}

const PixelFragment* find(const PixelHistory& history, const Key& key) {
  const std::vector<Key> keys = keys_of(history);
  const auto at = std::ranges::find(keys, key);
  return at == keys.end() ? nullptr : &history.fragments[static_cast<std::size_t>(at - keys.begin())];
}

class Block {
 public:
  Block(const Scene& scene, const std::vector<PixelHistory>& renderers, Footnotes& notes)
      : scene_(scene), renderers_(renderers), notes_(notes) {}

  std::string head() const {
    std::vector<std::string> names;
    for (const PixelHistory& h : renderers_) names.push_back(h.renderer);
    return row("", names);
  }

  std::string primitive(const Key& key, std::size_t draw_index) {
    const DrawRange range = draw_ranges(scene_)[draw_index];
    const Draw& draw = scene_.draws[draw_index];
    std::string out = fmt::format("primitive {}{}: number {} of mesh {}, draw {}\n", key.first,
                                  key.second == 0 ? "" : fmt::format(" ({} more)", key.second),
                                  key.first - range.first_primitive, draw.mesh, draw_index);
    out += fields(key, "covered", "fragments", [](const PixelFragment& f) -> std::optional<std::string> {
      const char* side = f.front ? "front" : "back";
      if (!f.held_depth) return fmt::format("would be, {}", side);  // culled, or outside its box
      return f.triangle ? fmt::format("yes, {}, window triangle {}", side, *f.triangle) : fmt::format("yes, {}", side);
    });
    out += fields(key, "depth", "depth", [&](const PixelFragment& f) -> std::optional<std::string> {
      if (!f.depth) return {};
      return depth_text(scene_.frame, *f.depth);
    });
    out += fields(key, "color", "color", [](const PixelFragment& f) { return four(f.color); });
    for (const Varying v : kAllVaryings) {
      if (is_back(v) || !carries(scene_, draw, v)) continue;
      out += fields(key, std::string(name_of(v)), "color", [&](const PixelFragment& f) -> std::optional<std::string> {
        for (const auto& [varying, value] : f.varyings) {
          if (varying == v) return numbers(value);
        }
        return {};
      });
    }
    if (draw.texture) {
      out += fields(key, "texel", "texel", [](const PixelFragment& f) { return four(f.texel); });
      out += fields(key, "lod", "lod", [](const PixelFragment& f) -> std::optional<std::string> {
        if (!f.lod) return {};
        return fmt::format("{:.6g}", *f.lod);
      });
    }
    out += fields(key, "shaded", "shaded", [](const PixelFragment& f) { return four(f.shaded); });
    out += fields(key, "fate", "fragments", [](const PixelFragment& f) -> std::optional<std::string> {
      return fmt::format("{}{}{}", name_of(f.fate), f.why.empty() ? "" : ": ", f.why);
    });
    return out;
  }

  std::string frame() {
    const FrameFormat& format = scene_.frame;
    std::string out = "frame\n";
    out += frames("color", [&](const PixelHistory& h) -> std::optional<std::string> {
      if (!h.color) return {};
      return color_text(format, *h.color);
    });
    out += frames("depth", [&](const PixelHistory& h) -> std::optional<std::string> {
      if (!h.depth) return {};
      return depth_text(format, *h.depth);
    });
    if (format.stencil != StencilFormat::none && format.antialias.kind == Antialias::Kind::none) {
      out += frames("stencil", [](const PixelHistory& h) -> std::optional<std::string> {
        if (!h.stencil) return {};
        return std::to_string(*h.stencil);
      });
    }
    for (const PixelHistory& h : renderers_) {
      for (const std::string& note : h.notes) out += fmt::format("  {}: {}\n", h.renderer, note);
      for (const LegalAnswer& a : h.legal) {
        const std::string what = a.primitive == kBackground ? "background" : fmt::format("primitive {}", a.primitive);
        const std::string color = h.legal_colors ? "" : ", " + legal_color(a);
        out += fmt::format("  {}: legal here: {}, depth [{:.9g}, {:.9g}]{}\n", h.renderer, what, a.z_lo, a.z_hi, color);
      }
      if (h.legal_colors) out += fmt::format("  {}: legal here: {}\n", h.renderer, between(*h.legal_colors));
    }
    return out;
  }

 private:
  std::string legal_color(const LegalAnswer& a) const {
    const double scale = color_scale(scene_.frame.color);
    if (scale > 0 ? !(a.color_bound < 1) : !std::isfinite(a.color_bound)) return "any colour";
    return fmt::format("colour {} before rounding, within {:.2g}{}", color_text(scene_.frame, a.color),
                       scale > 0 ? a.color_bound * scale : a.color_bound, scale > 0 ? " codes" : "");
  }
  std::string between(const std::pair<glm::vec4, glm::vec4>& colors) const {
    if (!std::isfinite(colors.first.x)) return "any colour: it is open which fragments make it";
    return fmt::format("colour {} to {} before rounding", color_text(scene_.frame, colors.first),
                       color_text(scene_.frame, colors.second));
  }
  static std::optional<std::string> four(const std::optional<glm::dvec4>& v) {
    if (!v) return {};
    return numbers(*v);
  }

  std::string fields(const Key& key, const std::string& label, const std::string& lack, auto tell) {
    std::vector<std::string> cells;
    for (const PixelHistory& h : renderers_) {
      const PixelFragment* f = find(h, key);
      const std::optional<std::string> text = f == nullptr ? std::nullopt : tell(*f);
      const auto reason = h.lacks.find(f == nullptr ? "fragments" : lack);
      if (text) {
        cells.push_back(*text);
      } else if (!h.absent.empty()) {
        cells.push_back(notes_.unsupported(h.renderer, h.absent));
      } else if (reason != h.lacks.end()) {
        cells.push_back(notes_.unsupported(h.renderer, reason->second));
      } else {
        cells.push_back(label == "covered" ? "no" : "-");
      }
    }
    return row(label, cells);
  }

  std::string frames(const char* label, auto tell) {
    std::vector<std::string> cells;
    for (const PixelHistory& h : renderers_) {
      const std::optional<std::string> text = tell(h);
      const std::string reason = h.absent.empty() ? fmt::format("it shows no {} of the frame", label) : h.absent;
      cells.push_back(text ? *text : notes_.unsupported(h.renderer, reason));
    }
    return row(label, cells);
  }

  const Scene& scene_;
  const std::vector<PixelHistory>& renderers_;
  Footnotes& notes_;
};

}  // namespace

std::string history_text(const Scene& scene, const check::History& history) {
  const FrameFormat& frame = scene.frame;
  std::string out = fmt::format("pixel {},{} of {} x {}, rows from the {}\n", history.pixel.x, history.pixel.y,
                                frame.width, frame.height, rows_from_top(scene.dialect) ? "top" : "bottom");
  Footnotes notes;
  for (std::size_t i = 0; i < history.samples.size(); ++i) {
    const check::SampleHistory& sample = history.samples[i];
    if (!history.resolved.empty()) {
      out += fmt::format("\nsample {} of 0 to {}: pixel {},{} of pass {}\n", i, history.samples.size() - 1,
                         sample.pixel.x, sample.pixel.y, sample.pass);
    }
    Block block(scene, sample.renderers, notes);
    out += block.head();
    std::set<std::tuple<Key, std::size_t>> primitives;
    for (const PixelHistory& h : sample.renderers) {
      const std::vector<Key> keys = keys_of(h);
      for (std::size_t k = 0; k < keys.size(); ++k) primitives.emplace(keys[k], h.fragments[k].draw);
    }
    for (const auto& [key, draw] : primitives) out += block.primitive(key, draw);
    if (primitives.empty()) out += "no fragment reaches it\n";
    out += block.frame();
  }
  if (!history.resolved.empty()) {
    Block block(scene, history.resolved, notes);
    out += "\nall samples\n" + block.head() + block.frame();
  }
  return out + notes.text();
}

}  // namespace plumbline::report
