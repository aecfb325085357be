#include "check/diagnose/history.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture/by_conventions.h"
#include "capture/fragment_outcomes.h"
#include "check/judge/refusal.h"
#include "check/judge/stage_inputs.h"
#include "scene/antialias.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

bool holds(const Draw& draw, glm::ivec2 p) { return !draw.scissor || draw.scissor->holds(p.x, p.y); }

// The scene without culling, and without scissor boxes that exclude one of the pixels.
Scene without_culling(Scene scene, std::span<const glm::ivec2> pixels) {
  for (Draw& draw : scene.draws) {
    draw.cull = Cull::none;
    if (!std::ranges::all_of(pixels, [&](glm::ivec2 p) { return holds(draw, p); })) draw.scissor.reset();
  }
  return scene;
}

bool leaves_out(const Scene& scene, std::span<const glm::ivec2> pixels) {
  return std::ranges::any_of(scene.draws, [&](const Draw& draw) {
    return draw.cull != Cull::none || !std::ranges::all_of(pixels, [&](glm::ivec2 p) { return holds(draw, p); });
  });
}

std::vector<PixelFragment> fragments_at(const Scene& scene, const Records<double>& r, glm::ivec2 pixel) {
  const DrawIndex draws(scene);
  const std::size_t all = r.covered.size();
  std::vector<PixelFragment> out;
  for (std::size_t i = 0; i < all; ++i) {
    if (glm::ivec2(r.covered[i].x, r.covered[i].y) != pixel) continue;
    if (r.covered[i].triangle >= r.triangles.size()) throw RendererFailed("a fragment of no window triangle");
    const WindowTriangle<double>& triangle = r.triangles[r.covered[i].triangle];
    PixelFragment& f = out.emplace_back();
    f.primitive = triangle.primitive;
    const auto number = draws.of_primitive(f.primitive);
    if (!number)
      throw RendererFailed(fmt::format("a fragment of primitive {}, which the scene does not have", f.primitive));
    f.draw = *number;
    if (triangle.corners > 0) f.triangle = r.covered[i].triangle;
    f.front = triangle.front;
    const Draw& draw = scene.draws[f.draw];
    if (r.depth.size() == all) f.depth = r.depth[i];
    if (r.attributes.size() == all) f.color = r.attributes[i].color;
    for (const Varying v : kAllVaryings) {
      if (is_back(v) || !carries(scene, draw, v) || r.varyings[v].fragments.size() != all) continue;
      f.varyings.emplace_back(v, r.varyings[v].fragments[i]);
    }
    if (draw.texture && r.texels.size() == all) {
      f.texel = r.texels[i].color;
      if (!std::isnan(r.texels[i].lod)) f.lod = r.texels[i].lod;
    }
    if (r.shaded.size() == all) f.shaded = r.shaded[i].color;
    if (r.drawn.size() == all) f.drawn = r.drawn[i].drawn;
  }
  return out;
}

// A test of a fragment, with its comparison as text.
struct Test {
  Fate fate;
  bool passes;
  std::string text;
};

std::string compared(const char* what, CompareFunc func, const std::string& a, const std::string& b) {
  constexpr std::array<const char*, 8> kSigns = {"never", "<", "==", "<=", ">", "!=", ">=", "always"};
  const char* sign = kSigns[static_cast<std::size_t>(func)];
  if (func == CompareFunc::never || func == CompareFunc::always) return fmt::format("{} {} ({}, {})", what, sign, a, b);
  return fmt::format("{} {} {} {}", what, a, sign, b);
}

std::string in_codes(double value, double scale) {
  return scale > 0 ? fmt::format("{:.0f}", std::nearbyint(std::clamp(value, 0.0, 1.0) * scale))
                   : fmt::format("{:.9g}", value);
}

// The pixel, as the fragments that came before have left it.
struct Held {
  double depth;
  std::optional<std::uint8_t> stencil;
};

std::vector<Test> tests_of(const Scene& scene, glm::ivec2 pixel, const PixelFragment& f, Held& held) {
  const Draw& draw = scene.draws[f.draw];
  std::vector<Test> out;
  if (draw.scissor) {
    const Scissor& s = *draw.scissor;
    out.push_back({Fate::scissor, holds(draw, pixel),
                   fmt::format("in the box from {},{} to below {},{}", s.x, s.y, s.x + s.width, s.y + s.height)});
  }
  if (draw.alpha_test && f.shaded) {
    const double scale = color_scale(scene.frame.color), a = f.shaded->a, reference = draw.alpha_test->reference;
    out.push_back({Fate::alpha, alpha_outcomes(*draw.alpha_test, scene.frame.color, a, a).may_pass,
                   compared("alpha", draw.alpha_test->func, in_codes(a, scale), in_codes(reference, scale))});
  }
  const bool arrives = std::ranges::all_of(out, &Test::passes);
  bool passes_depth = f.drawn.value_or(true);
  std::optional<Test> depth;
  if (f.depth) {
    const double z = depth_in_format(scene.frame.depth, *f.depth), scale = depth_scale(scene.frame.depth);
    passes_depth = outcomes(draw.depth_func, z, z, held.depth).may_pass;
    depth = {Fate::depth, passes_depth,
             compared("depth", draw.depth_func, in_codes(z, scale), in_codes(held.depth, scale))};
  }
  if (draw.stencil && held.stencil) {
    const StencilFace& face = f.front ? draw.stencil->front : draw.stencil->back;
    const std::uint8_t before = *held.stencil;
    std::string text =
        compared("stencil", face.func, std::to_string(face.reference & face.mask), std::to_string(before & face.mask));
    const bool passes = stencil_passes(face, before);
    if (arrives) held.stencil = stencil_after(face, passes_depth, before);
    if (face.mask != 0xff) text += fmt::format(" under mask {}", face.mask);
    if (held.stencil != before) text += fmt::format(" (then {} becomes {})", before, *held.stencil);
    out.push_back({Fate::stencil, passes, std::move(text)});
  }
  if (depth) out.push_back(std::move(*depth));
  return out;
}

void tell_fate(const Scene& scene, glm::ivec2 pixel, PixelFragment& f, Held& held) {
  f.held_depth = held.depth;
  f.held_stencil = held.stencil;
  const std::vector<Test> tests = tests_of(scene, pixel, f, held);
  const auto failed = std::ranges::find(tests, false, &Test::passes);
  std::vector<std::string> passed;
  for (const Test& t : tests) {
    if (t.passes && t.fate != Fate::scissor) passed.push_back(t.text);
  }
  const bool is_drawn = f.drawn.value_or(failed == tests.end());
  if (is_drawn) {
    f.fate = Fate::overwritten;  // until it is known to be the last
    f.why = fmt::format("{}", fmt::join(passed, ", "));
    if (failed != tests.end()) f.why += fmt::format("{}though not {}", f.why.empty() ? "" : ", ", failed->text);
    if (f.depth && scene.draws[f.draw].merge.depth_mask) held.depth = depth_in_format(scene.frame.depth, *f.depth);
  } else if (failed != tests.end()) {
    f.fate = failed->fate;
    f.why = "not " + failed->text;
    if (f.fate == Fate::depth && tests.size() > 1 && failed != tests.begin() && (failed - 1)->fate == Fate::stencil) {
      f.why += ", " + (failed - 1)->text;
    }
  } else {
    f.fate = Fate::discarded;
    f.why = fmt::format("passes, and is not drawn: {}", fmt::join(passed, ", "));
  }
}

std::string goes_over(const Merge& merge) {
  if (merge.logic_op) return "is combined with it";
  if (merge.blend) return "is blended with it";
  return glm::all(merge.color_mask) ? "replaces it" : "replaces what its colour mask lets through";
}

void tell_fates(const Scene& scene, const Planes& planes, glm::ivec2 pixel, PixelHistory& history) {
  const FrameFormat& frame = scene.frame;
  Held held{depth_in_format(frame.depth, frame.clear_depth), {}};
  if (frame.stencil != StencilFormat::none) held.stencil = frame.clear_stencil;
  PixelFragment* last = nullptr;
  std::size_t arrived = 0;
  for (PixelFragment& f : history.fragments) {
    if (f.fate == Fate::culled || f.fate == Fate::scissor) continue;
    ++arrived;
    tell_fate(scene, pixel, f, held);
    if (f.fate != Fate::overwritten) continue;
    if (last != nullptr) {
      last->why += fmt::format("{}primitive {} {}", last->why.empty() ? "" : "; ", f.primitive,
                               goes_over(scene.draws[f.draw].merge));
    }
    last = &f;
  }
  if (last != nullptr) last->fate = Fate::winner;
  if (history.lacks.contains("fragments")) return;
  const auto note = [&](const char* what, const auto& theirs, const auto& frames) {
    if (theirs != frames) {
      history.notes.push_back(fmt::format("by its fragments the {} is {}, by its frame {}", what, theirs, frames));
    }
  };
  const std::int32_t winner = last == nullptr ? kBackground : static_cast<std::int32_t>(last->primitive);
  if (!planes.count.empty()) note("count", arrived, std::size_t{planes.count(pixel.x, pixel.y)});
  if (history.lacks.contains("drawn")) return;
  if (!planes.id.empty()) note("winner", winner, planes.id(pixel.x, pixel.y));
  const bool in_format = !history.depth || depth_in_format(frame.depth, *history.depth) == *history.depth;
  if (!in_format) {  // OpenGL has no 8 bits
    history.notes.push_back("its depths are of another format than the scene's, by which they are compared here");
  } else if (history.depth && !history.lacks.contains("depth")) {
    note("depth", held.depth, *history.depth);
  }
  if (history.stencil && held.stencil) note("stencil value", *held.stencil, *history.stencil);
}

// Adds the fragments of `all` (drawn without culling and scissor boxes) that `fragments` lacks, as culled or scissored.
void add_left_out(const Scene& scene, glm::ivec2 pixel, std::vector<PixelFragment> all,
                  std::vector<PixelFragment>& fragments) {
  const std::size_t arrived = fragments.size();
  for (PixelFragment& f : all) {
    const auto known = [&](const PixelFragment& g) { return g.primitive == f.primitive && g.front == f.front; };
    if (std::any_of(fragments.begin(), fragments.begin() + static_cast<std::ptrdiff_t>(arrived), known)) continue;
    const Draw& draw = scene.draws[f.draw];
    if (!holds(draw, pixel)) {
      const Scissor& s = *draw.scissor;
      f.fate = Fate::scissor;
      f.why = fmt::format("not in the box from {},{} to below {},{}", s.x, s.y, s.x + s.width, s.y + s.height);
    } else if (draw.cull != Cull::none) {
      const bool culls_front = draw.cull == Cull::front;
      f.fate = Fate::culled;
      f.why = fmt::format("{}it faces the {}, {} faces are culled", f.front == culls_front ? "" : "though ",
                          f.front ? "front" : "back", culls_front ? "front" : "back");
    } else {
      continue;
    }
    f.drawn = false;
    f.triangle.reset();  // that number is of the other drawing
    fragments.push_back(std::move(f));
  }
  std::ranges::stable_sort(fragments, {}, &PixelFragment::primitive);
}

// Fills `lacks`: fields that the renderer does not hand out, with the reason from `info`, or else `why`.
void name_lacks(const Scene& scene, const RendererInfo& info, PixelHistory& history) {
  const auto lack = [&](const char* field, Stage stage, std::string_view why, auto has) {
    const auto of = [&](const PixelFragment& f) { return has(f); };
    if (std::ranges::all_of(history.fragments, of)) return;
    history.lacks[field] = info[stage].shows || info[stage].reason.empty() ? std::string(why) : info[stage].reason;
  };
  const auto textured = [&](const PixelFragment& f) { return scene.draws[f.draw].texture.has_value(); };
  lack("depth", Stage::depth, "it tells no depth of single fragments",
       [](const auto& f) { return f.depth.has_value(); });
  lack("color", Stage::attributes, kOnlyShaded, [](const auto& f) { return f.color.has_value(); });
  lack("texel", Stage::texture, "it tells no texel of single fragments",
       [&](const auto& f) { return f.texel.has_value() || !textured(f); });
  lack("lod", Stage::texture, "it tells no level of detail",
       [&](const auto& f) { return f.lod.has_value() || !textured(f); });
  lack("shaded", Stage::shade, "it tells no colour of single fragments",
       [](const auto& f) { return f.shaded.has_value(); });
  lack("drawn", Stage::visibility, "it does not tell which fragments are drawn",
       [](const auto& f) { return f.drawn.has_value(); });
}

void read_frame(const Planes& planes, glm::ivec2 pixel, PixelHistory& out) {
  const auto inside = [&](const auto& plane) { return pixel.x < plane.width() && pixel.y < plane.height(); };
  if (inside(planes.color)) out.color = planes.color(pixel.x, pixel.y);
  if (inside(planes.depth)) out.depth = planes.depth(pixel.x, pixel.y);
  if (inside(planes.stencil)) out.stencil = planes.stencil(pixel.x, pixel.y);
}

PixelHistory history_of(const Scene& scene, const RendererInfo& info, const Capture& drawn, const Capture* all,
                        glm::ivec2 pixel) {
  PixelHistory out;
  out.renderer = info.name;
  out.fragments = fragments_at(scene, drawn.records, pixel);
  const bool none = !drawn.planes.count.empty() && drawn.planes.count(pixel.x, pixel.y) == 0;
  if (out.fragments.empty() && !none) {
    out.lacks["fragments"] = info[Stage::coverage].shows || info[Stage::coverage].reason.empty()
                                 ? "it hands out no fragments of single pixels"
                                 : info[Stage::coverage].reason;
  }
  if (all != nullptr) add_left_out(scene, pixel, fragments_at(scene, all->records, pixel), out.fragments);
  read_frame(drawn.planes, pixel, out);
  if (!drawn.legal.empty()) {
    const auto legal = drawn.legal.at(pixel.x, pixel.y);
    out.legal.assign(legal.begin(), legal.end());
    if (!drawn.legal.color_lo.empty())
      out.legal_colors = {drawn.legal.color_lo(pixel.x, pixel.y), drawn.legal.color_hi(pixel.x, pixel.y)};
  }
  name_lacks(scene, info, out);
  tell_fates(scene, drawn.planes, pixel, out);
  return out;
}

// Calls ask(); where the renderer is missing or fails, puts a PixelHistory with the reason at each of the pixels.
void account(const Reference& r, std::size_t pixels, auto ask, auto put) {
  const std::optional<Refusal> refusal =
      r.renderer == nullptr ? Refusal{Outcome::missing, "not built in"} : refusal_of(ask);
  for (std::size_t i = 0; i < pixels && refusal; ++i) {
    PixelHistory none;
    none.renderer = r.name;
    none.absent = fmt::format("{}: {}", name_of(refusal->outcome), refusal->why);
    put(i, std::move(none));
  }
}

// `conventions`: by which the reference draws the pass; the candidate draws it as it is. Legal answers, and all of an
// oracle that is no referee, come by conventions from the pass as it is given; records and planes from that which the
// conventions alter.
std::vector<PixelHistory> histories(const Scene& given, const Reference& r, const Conventions& conventions,
                                    const std::vector<glm::ivec2>& pixels) {
  const SceneByConventions seen(given, conventions);
  const Scene& pass = *seen;
  std::vector<PixelHistory> out(pixels.size());
  const auto ask = [&] {
    const RendererInfo info = r.renderer->info();
    Request request;
    request.records = kFragmentStages;
    if (info[Stage::coverage].runs) request.records.add(Stage::window);  // it has such triangles
    request.pixels = pixels;
    request.conventions = conventions;
    const bool is_oracle = info.legal && !is_referee(info);
    const Scene& drawn_pass = is_oracle ? given : pass;
    Capture drawn = r.renderer->capture(drawn_pass, request);
    std::optional<Capture> all;
    if (leaves_out(pass, pixels)) all = r.renderer->capture(without_culling(drawn_pass, pixels), request);
    if (info.legal)
      drawn.legal = r.renderer->capture(given, {.legal = true, .pixels = pixels, .conventions = conventions}).legal;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      out[i] = history_of(pass, info, drawn, all ? &*all : nullptr, pixels[i]);
      out[i].renderer = r.name;
    }
  };
  account(r, pixels.size(), ask, [&](std::size_t i, PixelHistory h) { out[i] = std::move(h); });
  return out;
}

PixelHistory resolved(const Scene& scene, const Reference& r, glm::ivec2 pixel) {
  PixelHistory out;
  out.renderer = r.name;
  account(
      r, 1, [&] { read_frame(r.renderer->capture(scene, Request{}).planes, pixel, out); },
      [&](std::size_t, PixelHistory h) { out = std::move(h); });
  return out;
}

}  // namespace

std::string_view name_of(Fate fate) {
  constexpr std::array<std::string_view, 8> kNames = {"culled", "scissor",   "alpha",       "stencil",
                                                      "depth",  "discarded", "overwritten", "winner"};
  return kNames[static_cast<std::size_t>(fate)];
}

History pixel_history(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                      glm::ivec2 pixel) {
  const FrameFormat& frame = scene.frame;
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame.width || pixel.y >= frame.height) {
    throw std::invalid_argument(fmt::format("pixel {},{}: expected one of the frame's {} x {}, from 0,0 to {},{}",
                                            pixel.x, pixel.y, frame.width, frame.height, frame.width - 1,
                                            frame.height - 1));
  }
  std::vector<Reference> asked = {{candidate.info().name, &candidate}};
  asked.insert(asked.end(), references.begin(), references.end());
  History out{pixel, {}, {}};
  for (const PixelSample& s : samples_of(frame.antialias)) {
    out.samples.push_back({s.pass, frame.antialias.factor * pixel + s.offset, {}});
  }
  const std::vector<Scene> passes = passes_of(scene);
  for (const Reference& r : asked) {
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
      std::vector<glm::ivec2> pixels;
      for (const SampleHistory& s : out.samples) {
        if (s.pass == pass) pixels.push_back(s.pixel);
      }
      const Conventions by = r.renderer == &candidate ? Conventions() : candidate.info().conventions;
      std::vector<PixelHistory> of_pass = histories(passes[pass], r, by, pixels);
      auto next = of_pass.begin();
      for (SampleHistory& s : out.samples) {
        if (s.pass == pass) s.renderers.push_back(std::move(*next++));
      }
    }
    if (frame.antialias.kind != Antialias::Kind::none) out.resolved.push_back(resolved(scene, r, pixel));
  }
  return out;
}

}  // namespace plumbline::check
