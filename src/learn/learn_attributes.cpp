// Clipping at the near and far plane, interpolation, fog factors, and the provoking vertex.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"
#include "learn/ramps.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kFrameSize = 64;

// Wall that goes from w = 2 at the left to w = 16 at the right, from one grey to another.
Scene receding_wall(const char* name, float left, float right) {
  Scene scene = probe_frame(name, kFrameSize, kFrameSize);
  scene.projection = Perspective{90, 1, 100};
  const auto at = [](double x, double y, double w, float grey) {
    return ProbeCorner{{x * w, y * w, w}, {grey, grey, grey, 1}, {}};
  };
  add_triangles(scene, quad({at(-1, -1, 2, left), at(1, -1, 16, right), at(1, 1, 16, right), at(-1, 1, 2, left)}));
  return scene;
}
// Share of the right corners in an attribute of the wall's pixels at column x.
struct Shares {
  double affine, perspective;
};
Shares shares_at(int x, const C& conventions) {
  const double s = (x + conventions.sample.x) / kFrameSize;
  return {s, (s / 16) / ((1 - s) / 2 + s / 16)};
}
// True: the colour at column x is `grey`, to within 2 codes plus the change of a ramp over 0.3 column.
bool is_grey(const Plane<glm::vec4>& color, int x, double grey) {
  constexpr double kMost = 2.0 / 255 + 0.3 / kFrameSize;
  const glm::dvec3 off = glm::abs(glm::dvec3(color(x, kFrameSize / 2)) - grey);
  return off.r < kMost && off.g < kMost && off.b < kMost;
}

// First and last white column of a row; none: last < first.
struct Columns {
  int first = kFrameSize, last = -1;
};
Columns white_columns(const Plane<glm::vec4>& color, int row) {
  Columns out;
  for (int x = 0; x < kFrameSize; ++x) {
    if (is_white(color(x, row))) out.first = std::min(out.first, x), out.last = std::max(out.last, x);
  }
  return out;
}

bool is_near_to(int column, int expected) { return std::abs(column - expected) <= 1; }

// The depths at the ends of white columns, where depths go from -1/2 at the left to 3/2 at the right.
std::string depths_drawn(const Columns& c) {
  if (c.last < c.first) return "none is drawn: triangles that reach beyond a plane are left out";
  return fmt::format("those from {:.2f} to {:.2f} are drawn", -0.5 + 2.0 * c.first / kFrameSize,
                     -0.5 + 2.0 * (c.last + 1) / kFrameSize);
}

}  // namespace

// A plane of depths from -1/2 at the left to 3/2 at the right. Of its two triangles one has two corners before the near
// plane, the other one: between the planes, the lower row lies in the former, the upper row in the latter.
void learn_clipping(Prober& prober) {
  constexpr int kLower = kFrameSize / 8, kUpper = 7 * kFrameSize / 8;
  const ConventionWords volume = words_of("clip_depth"), planes = words_of("depth_planes");
  Scene scene = probe_frame("clipping", kFrameSize, kFrameSize);
  add_triangles(
      scene,
      quad({{{{0, 0, -0.5}}, {{kFrameSize, 0, 1.5}}, {{kFrameSize, kFrameSize, 1.5}}, {{0, kFrameSize, -0.5}}}}));
  const Planes left = prober.draw(scene);
  const Columns columns = white_columns(left.color, kLower), others = white_columns(left.color, kUpper);
  const auto [first, last] = columns;
  const bool tested = prober.depth_func != DepthFunc::always;  // depths beyond the cleared one, 1, then fail
  std::string evidence = "of depths from -0.5 to 1.5 " + depths_drawn(columns);
  if (first <= last && !left.depth.empty())
    evidence += fmt::format(", and left as {:.2f} to {:.2f}", left.depth(first, kLower), left.depth(last, kLower));
  C& c = prober.learned.conventions;
  const bool near_cut = is_near_to(first, kFrameSize / 4) || is_near_to(first, kFrameSize / 2),
             ends_at_far = is_near_to(last, 3 * kFrameSize / 4 - 1), far_cut = ends_at_far && (near_cut || !tested);
  const bool known = (near_cut || is_near_to(first, 0)) && (ends_at_far || is_near_to(last, kFrameSize - 1));
  const bool are_alike = is_near_to(first, others.first) && is_near_to(last, others.last);
  if (!known || !are_alike) {
    prober.fits_none(volume, are_alike ? evidence : evidence + "; in another triangle " + depths_drawn(others));
    return prober.open(planes, "the view volume is open");
  }
  const auto depth = [&](int column) { return left.depth(column, kUpper); };
  // At depths of -0.5 and -0.25.
  const bool is_clamped = near_cut || left.depth.empty() || std::abs(depth(0) - depth(kFrameSize / 8)) < 1e-3;
  // False: pixels at depths 0.25 and 0.75 are left alike, as by a renderer with one depth for the whole rectangle.
  const bool varies =
      near_cut || left.depth.empty() || std::abs(depth(3 * kFrameSize / 8) - depth(5 * kFrameSize / 8)) > 0.4;
  if (near_cut && is_near_to(first, kFrameSize / 2)) c.clip_depth = C::ClipDepth::zero_to_w;
  prober.found(volume, name_of(c.clip_depth), near_cut ? evidence : "nothing is cut off before the near plane");
  if (!varies) return prober.fits_none(planes, "depths are one along the rectangle: " + evidence);
  if (!is_clamped)
    return prober.fits_none(planes, "depths before the near plane are neither cut nor clamped: " + evidence);
  c.depth_planes = near_cut || far_cut ? C::DepthPlanes::cut : C::DepthPlanes::clamped;
  if (near_cut != far_cut)
    prober.unexplained(fmt::format("the {} plane cuts, the {} does not", near_cut ? "near" : "far",
                                   near_cut ? "far plane" : "near plane"));
  prober.found(planes, name_of(c.depth_planes), evidence);
}

namespace {

// The interpolation that explains the wall's greys, which go from black at the left to white at the right.
struct FoundInterpolation {
  C::Interpolation value;
  std::size_t pixels;
  bool explains() const { return pixels * 10 >= kFrameSize * 9; }
};
FoundInterpolation interpolation_of(Prober& prober, const Scene& wall) {
  const Plane<glm::vec4> color = prober.draw(wall).color;
  std::size_t perspective = 0, affine = 0;
  for (int x = 0; x < kFrameSize; ++x) {
    const Shares share = shares_at(x, prober.learned.conventions);
    perspective += is_grey(color, x, share.perspective), affine += is_grey(color, x, share.affine);
  }
  if (perspective >= affine) return {C::Interpolation::perspective, perspective};
  return {C::Interpolation::affine, affine};
}

// The wall with a texture from black to white in place of its colours.
Scene textured_wall() {
  Scene out = receding_wall("texture_interpolation", 1, 1);
  Texture texture;
  TextureLevel level;
  level.width = 64, level.height = 1;
  for (int i = 0; i < level.width; ++i) level.texels.emplace_back(glm::vec3((4 * static_cast<float>(i) + 2) / 255), 1);
  texture.levels = {level};
  texture.format = TextureFormat::rgb;
  texture.sampler.min = MinFilter::nearest, texture.sampler.mag = MagFilter::nearest;
  out.textures.push_back(std::move(texture));
  Mesh& mesh = out.meshes[0];
  const auto [left, right] = std::ranges::minmax(mesh.positions, {}, &glm::vec3::x);
  for (std::size_t i = 0; i < mesh.texcoords.size(); ++i)
    mesh.texcoords[i] = {mesh.positions[i].x < (left.x + right.x) / 2 ? 0.0f : 1.0f, 0.5f};
  out.draws[0].texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  return out;
}

// How the wall's texture is interpolated; nullopt: the renderer does not draw it so that it tells.
std::optional<FoundInterpolation> texture_interpolation(Prober& prober) {
  Scene scene = textured_wall();
  for (const TextureEnvironment environment : {TextureEnvironment::replace, TextureEnvironment::modulate}) {
    scene.draws[0].texture->environment = environment;
    try {
      const FoundInterpolation found = interpolation_of(prober, scene);
      return found.explains() ? std::optional(found) : std::nullopt;  // the texture's probes show why
    } catch (const Unsupported&) {
    }
  }
  return std::nullopt;
}

}  // namespace

// Without a texture, other attributes are taken to be interpolated in perspective, as colours are. But affine colours
// say nothing of other attributes.
void learn_interpolation(Prober& prober) {
  const ConventionWords words = words_of("interpolation"), of_colors = words_of("color_interpolation");
  if (prober.open_if_any_open(words, {"color_encoding", kSampleWords.name}) ||
      prober.open_if_colors_are_not_linear(words))
    return;
  C& c = prober.learned.conventions;
  const FoundInterpolation colors = interpolation_of(prober, receding_wall("interpolation", 0, 1));
  const std::string evidence = fmt::format("{} of {} pixels", colors.pixels, kFrameSize);
  if (!colors.explains()) return prober.fits_none(words, evidence + " at most are explained");
  const std::optional<FoundInterpolation> texture = texture_interpolation(prober);
  const bool is_unknown = !texture && colors.value == C::Interpolation::affine;
  if (is_unknown) {
    prober.open(words, "colours are affine, and no texture is drawn that shows other attributes");
  } else {
    const FoundInterpolation& others = texture ? *texture : colors;
    c.interpolation = others.value;
    prober.found(words, name_of(c.interpolation), fmt::format("{} of {} pixels", others.pixels, kFrameSize));
  }
  if (colors.value != c.interpolation) {
    c.color_interpolation =
        colors.value == C::Interpolation::affine ? C::ColorInterpolation::affine : C::ColorInterpolation::perspective;
  }
  prober.found(of_colors, name_of(c.color_interpolation), evidence);
}

// White wall in black fog. Factors of fragments and those interpolated between the wall's ends differ by up to 34
// codes, those of |z_eye| and of |p_eye| by up to 23.
void learn_fog(Prober& prober) {
  constexpr float kDensity = 0.125f;
  const ConventionWords words = words_of("fog_factor");
  C& c = prober.learned.conventions;
  if (prober.open_if_any_open(words, {"color_encoding", kSampleWords.name, "interpolation"})) return;
  if (prober.open_if_colors_are_not_linear(words)) return;
  Scene scene = receding_wall("fog_factor", 1, 1);
  scene.draws[0].fog = Fog{.mode = Fog::Mode::exp, .color = glm::vec3(0), .density = kDensity};
  const Plane<glm::vec4> color = prober.draw(scene).color;
  const auto factor = [](double distance) { return std::exp(-double{kDensity} * distance); };
  struct Counted {
    C::FogFactor factor;
    C::FogDistance distance;
    std::size_t pixels = 0;
  };
  using enum C::FogFactor;
  using enum C::FogDistance;
  std::array<Counted, 4> counted{
      {{per_fragment, eye_plane}, {per_vertex, eye_plane}, {per_fragment, eye_radial}, {per_vertex, eye_radial}}};
  for (int x = 0; x < kFrameSize; ++x) {
    const Shares shares = shares_at(x, c);
    const double share = c.interpolation == C::Interpolation::affine ? shares.affine : shares.perspective;
    const double plane = 2 + 14 * share, radial = std::hypot(plane, 18 * share - 2);  // x_eye from -2 to 16
    for (Counted& by : counted) {
      const bool is_radial = by.distance == eye_radial;
      const double of_end = is_radial ? std::numbers::sqrt3 : 1, near = factor(2 * of_end), far = factor(16 * of_end);
      const double of_fragment = factor(is_radial ? radial : plane);
      by.pixels += is_grey(color, x, by.factor == per_fragment ? of_fragment : glm::mix(near, far, share));
    }
  }
  const Counted& most = *std::ranges::max_element(counted, {}, &Counted::pixels);
  const std::string evidence = fmt::format("{} of {} pixels", most.pixels, kFrameSize);
  if (most.pixels * 10 < kFrameSize * 9) return prober.fits_none(words, evidence + " at most are explained");
  c.fog_factor = most.factor, c.fog_distance = most.distance;
  prober.found(words, name_of(c.fog_factor), evidence);
  prober.found(words_of("fog_distance"), name_of(c.fog_distance), evidence);
}

// Unsnapped and snapped corners give a ramp's pixel colours on either side of the middle between two codes.
void learn_corners(Prober& prober) {
  constexpr int kRamps = 16;
  const ConventionWords words = words_of("attribute_corners");
  const C& c = prober.learned.conventions;
  if (c.subpixel_bits == C::kFloat) return prober.found(words, "as_they_are", "positions are not snapped");
  if (prober.open_if_any_open(words, {"color_rounding", "sample"})) return;
  if (c.color_encoding != C::Encoding::linear) return prober.open(words, "another encoding of colours hides it");
  const RampPixel pixel = pixel_of_ramp(c);
  const double above = off_grid(c), by_corners_at = pixel.from_start - above;  // [pixels]
  // Colours stay in [0, 1] between the ramp's ends, and at the pixel as the corners as they are extrapolate to it.
  const double lowest = std::min(0.0, by_corners_at), highest = std::max(2.0, by_corners_at);
  const double rise = std::min(115.0, 230 / (highest - lowest)),  // [codes a pixel]
      half_way = pixel.from_start - above / 2,
               middle =
                   std::floor(4 + rise * (half_way - lowest)) + 0.5 + middle_of(c.color_rounding);  // between two codes
  // Ends of ramp i. Where colours of vertices are codes, each ramp rises by another number of codes.
  const bool are_codes = c.vertex_colors == C::ColorNumbers::in_codes;
  const auto ends = [&](int i) {
    const double first = middle + i - rise * half_way, last = first + 2 * rise;
    return are_codes ? glm::dvec2(std::round(first), std::round(last) - i) / 255.0 : glm::dvec2(first, last) / 255.0;
  };
  Scene scene = probe_frame("attribute_corners", kFrameSize, 4);
  std::vector<std::array<ProbeCorner, 3>> triangles;
  for (int i = 0; i < kRamps; ++i) {
    const double from = 4 * i + 1 + above, first = ends(i).x, last = ends(i).y;
    const auto at = [&](double x, double y, double grey) {
      return ProbeCorner{{x, y, kFlatDepth}, glm::vec4(glm::vec3(static_cast<float>(grey)), 1), {}};
    };
    for (const auto& t : quad({at(from, 0, first), at(from + 2, 0, last), at(from + 2, 4, last), at(from, 4, first)}))
      triangles.push_back(t);
  }
  add_triangles(scene, triangles);
  const Plane<glm::vec4> color = prober.draw(scene).color;
  // The codes of a value; half a code may go either way.
  const auto codes_of = [&](double v) {
    return std::pair(rounded(c.color_rounding, v - 1e-3), rounded(c.color_rounding, v + 1e-3));
  };
  std::size_t lower = 0, upper = 0, told = 0;
  for (int i = 0; i < kRamps; ++i) {
    const double code = std::round(255 * static_cast<double>(color(4 * i + 1 + pixel.column, pixel.row).r));
    const double first = 255 * ends(i).x, slope = 255 * (ends(i).y - ends(i).x) / 2;
    const auto by_corners = codes_of(first + slope * (pixel.from_start - above)),
               by_grid = codes_of(first + slope * pixel.from_start);
    if (by_corners == by_grid) continue;
    const auto is_of = [&](const std::pair<double, double>& codes) {
      return code == codes.first || code == codes.second ? 1u : 0u;
    };
    ++told, lower += is_of(by_corners), upper += is_of(by_grid);
  }
  const std::string evidence = fmt::format("{} of {} ramps", std::max(lower, upper), told);
  if (told < 2 || std::max(lower, upper) + 1 < told)
    return prober.open(words, evidence + " at most go by one of the two");
  prober.learned.conventions.attribute_corners = upper > lower ? C::Corners::snapped : C::Corners::as_they_are;
  prober.found(words, name_of(prober.learned.conventions.attribute_corners), evidence);
}

// Two flat triangles, one of each winding: counter-clockwise below the diagonal, clockwise above it. Beside them the
// colours of their first and last corner, as the renderer encodes them.
void learn_provoking_vertex(Prober& prober) {
  const ConventionWords words = words_of("provoking_vertex");
  Scene scene = probe_frame("provoking_vertex", 32, 16);
  constexpr float first = 0.2f, last = 1;
  const auto grey = [](float v) { return glm::vec4(glm::vec3(v), 1); };
  const auto of_corner = [&](double x, double y) {
    return std::array<ProbeCorner, 3>{
        {{{x, y, kFlatDepth}, grey(first)}, {{16, 0, kFlatDepth}, grey(0.5f)}, {{0, 16, kFlatDepth}, grey(last)}}};
  };
  const std::array triangles = {of_corner(0, 0), of_corner(16, 16)};
  add_triangles(scene, triangles).shading = Shading::flat;
  add_triangles(scene, rectangle({16, 0}, {24, 16}, kFlatDepth, grey(first)));
  add_triangles(scene, rectangle({24, 0}, {32, 16}, kFlatDepth, grey(last)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  const float left = color(4, 4).g, turned = color(12, 12).g, of_first = color(18, 8).g, of_last = color(26, 8).g;
  if (left == 0 && turned == 0) return prober.open(words, "flat triangles do not cover their pixels 4, 4 and 12, 12");
  const auto is = [](float drawn, float v) { return std::abs(drawn - v) < 1.5f / 255; };
  std::string evidence = fmt::format("a flat triangle of 0.2, 0.5 and 1 is drawn in {:.2g}", left);
  const bool agree = turned == 0 || is(turned, left);  // 0: it is not drawn
  if (!agree) evidence += fmt::format(", a clockwise one in {:.2g}", turned);
  if (!agree || is(of_first, of_last) || (!is(left, of_first) && !is(left, of_last)))
    return prober.fits_none(words, evidence);
  prober.learned.conventions.provoking_vertex = is(left, of_last) ? C::Provoking::last : C::Provoking::first;
  prober.found(words, name_of(prober.learned.conventions.provoking_vertex), evidence);
}

}  // namespace plumbline::learn
