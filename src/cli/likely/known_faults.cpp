#include "cli/likely/known_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "cli/likely/misread_states.h"

namespace plumbline::cli {

namespace {

void encode(glm::vec4& color) {
  for (int i = 0; i < 3; ++i)
    color[i] = static_cast<float>(srgb_encoded(std::clamp(static_cast<double>(color[i]), 0.0, 1.0)));
}

// visit(color, depth) of each pixel; depth is null where the frame has none.
template <class Visit>
auto of_pixels(Visit visit) {
  return [visit](ColorAndDepth& frame) {
    for (std::size_t i = 0; i < frame.color.size(); ++i)
      visit(frame.color.values()[i], frame.depth.empty() ? nullptr : &frame.depth.values()[i]);
  };
}

// Frame whose pixel (x, y) is pixel from(x, y) of the right frame, cleared where from(x, y) lies outside.
template <class From>
auto rearranged(glm::vec4 clear_color, double clear_depth, From from) {
  return [=](ColorAndDepth& frame) {
    const ColorAndDepth right = frame;
    const int width = frame.color.width(), height = frame.color.height();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const glm::ivec2 p = from(x, y, width, height);
        const bool is_inside = p.x >= 0 && p.y >= 0 && p.x < width && p.y < height;
        frame.color(x, y) = is_inside ? right.color(p.x, p.y) : clear_color;
        if (!frame.depth.empty()) frame.depth(x, y) = is_inside ? right.depth(p.x, p.y) : clear_depth;
      }
    }
  };
}

std::string side_of(int x, int y) {
  const std::string_view across = x == 0 ? "" : x < 0 ? "left" : "right", up = y == 0 ? "" : y < 0 ? "down" : "up";
  return fmt::format("{}{}{}", across, x != 0 && y != 0 ? " and " : "", up);
}

// Viewports one pixel off, and samples half a pixel off, in eight directions.
void add_neighbours(const FrameFormat& frame, std::vector<KnownFault>& out) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const auto moved = [=](int x, int y, int, int) { return glm::ivec2(x - dx, y - dy); };
      out.push_back({.stage = "window",
                     .name = "window.one_pixel_off",
                     .says = "the picture lies one pixel too far " + side_of(dx, dy),
                     .of_frame = rearranged(frame.clear_color, frame.clear_depth, moved)});
      out.push_back(
          {.stage = "window",
           .name = "window.sample_off_centre",
           .says = "samples are not pixels' centres: the picture lies half a pixel too far " + side_of(dx, dy),
           .of_scene = [=](Scene& s) { s.frame.pass.shift += 0.5 * glm::dvec2(dx, dy); }});
    }
  }
}

// Reverses the order of the depth functions, and clears depth to the other end, 1 - clear_depth.
void keep_farthest(Scene& scene) {
  scene.frame.clear_depth = 1 - scene.frame.clear_depth;
  for (Draw& draw : scene.draws) {
    using enum DepthFunc;
    DepthFunc& f = draw.depth_func;
    f = f == less            ? greater
        : f == less_equal    ? greater_equal
        : f == greater       ? less
        : f == greater_equal ? less_equal
                             : f;
  }
}

// Faults of writing a right frame to a file.
void add_files(const FrameFormat& frame, std::vector<KnownFault>& out) {
  const auto add = [&](const char* name, const char* says, std::function<void(ColorAndDepth&)> change) {
    out.push_back({.stage = "file", .name = name, .says = says, .of_frame = std::move(change)});
  };
  const auto change_depth = [](auto change) {
    return of_pixels([change](glm::vec4&, double* z) {
      if (z != nullptr) *z = change(*z);
    });
  };
  add("file.rows_reversed", "the rows are written from the other end",
      rearranged({}, 0, [](int x, int y, int, int height) { return glm::ivec2(x, height - 1 - y); }));
  add("file.mirrored", "the columns are written from the other end",
      rearranged({}, 0, [](int x, int y, int width, int) { return glm::ivec2(width - 1 - x, y); }));
  if (frame.width == frame.height) {
    add("file.transposed", "rows and columns change places: an array is indexed [x, y]",
        rearranged({}, 0, [](int x, int y, int, int) { return glm::ivec2(y, x); }));
  }
  add("file.bgr", "red and blue are swapped",
      of_pixels([](glm::vec4& color, double*) { std::swap(color.r, color.b); }));
  add("file.green_of_red", "red is written for green, too",
      of_pixels([](glm::vec4& color, double*) { color.g = color.r; }));
  add("file.blue_of_green", "green is written for blue, too",
      of_pixels([](glm::vec4& color, double*) { color.b = color.g; }));
  add("file.depth_of_ndc", "depths are in [-1, 1], those of normalized device coordinates",
      change_depth([](double z) { return 2 * z - 1; }));
  add("file.background_at_0", "the background has depth 0",
      change_depth([frame](double z) { return is_clear_depth(frame, z) ? 0 : z; }));
  add("file.depth_reversed", "depths are 1 at the near plane and 0 at the far one",
      change_depth([](double z) { return 1 - z; }));
}

// Faults that encode colours: before rounding to codes where fragments replace the stored colour, else after it.
void add_encodings(std::vector<KnownFault>& out) {
  const auto add = [&](const char* name, const char* says, void (*encode_color)(glm::vec4&)) {
    out.push_back({.stage = "file",
                   .name = name,
                   .says = says,
                   .of_scene =
                       [](Scene& s) {
                         if (colors_replace(s)) s.frame.color = ColorFormat::rgba32f;
                       },
                   .of_frame = of_pixels([=](glm::vec4& color, double*) { encode_color(color); })});
  };
  add("file.srgb", "colours are encoded as sRGB once more", encode);
  add("file.gamma", "colours are raised to 1/2.2", [](glm::vec4& color) {
    for (int i = 0; i < 3; ++i) color[i] = std::pow(std::clamp(color[i], 0.0f, 1.0f), 1 / 2.2f);
  });
}

// Faults that cull back faces, or front faces, in draws that cull none.
void add_culls(std::vector<KnownFault>& out) {
  const auto add = [&](const char* name, const char* says, Cull cull) {
    out.push_back({.stage = "window", .name = name, .says = says, .of_scene = [cull](Scene& s) {
                     for (Draw& draw : s.draws) draw.cull = draw.cull == Cull::none ? cull : draw.cull;
                   }});
  };
  add("window.back_culled", "back faces are culled, though no face is to be", Cull::back);
  add("window.front_culled", "front faces are culled, though no face is to be", Cull::front);
}

// Faults of scanline rasterizers that several stages show, in their coverage, depths and attributes.
void add_scanlines(std::vector<KnownFault>& out) {
  const auto add = [&](const char* stage, const char* name, const char* says, std::vector<std::string> of_stages) {
    out.push_back({.stage = stage, .name = name, .says = says, .of_stages = std::move(of_stages)});
  };
  add("coverage", "coverage.edges_begin_at_lower_corner",
      "in its first row an edge has the x, depth and attributes of its lower corner",
      {"coverage.edges_not_advanced", "depth.edges_not_advanced", "attributes.edges_not_advanced"});
  add("coverage", "coverage.edges_begin_at_upper_corner",
      "in its first row an edge has the x, depth and attributes of its upper corner",
      {"coverage.edges_not_advanced_down", "depth.edges_not_advanced_down", "attributes.edges_not_advanced_down"});
  add("depth", "depth.spans_begin_at_their_end", "a span's first pixel has the depth and attributes of the span's end",
      {"depth.spans_not_advanced", "attributes.spans_not_advanced"});
  add("depth", "depth.values_of_left_sides", "depths and attributes are those of the middle of pixels' left sides",
      {"depth.at_left_side", "attributes.at_left_side"});
}

KnownFault alpha_not_written(const FrameFormat& frame) {
  const float cleared = frame.clear_color.a;
  return {.stage = "merge",
          .name = "merge.alpha_not_written",
          .says = "alpha is as it was cleared",
          .of_frame = of_pixels([cleared](glm::vec4& color, double*) { color.a = cleared; })};
}

KnownFault codes_for_numbers() {
  return {.stage = "file",
          .name = "file.codes_for_numbers",
          .says = "colours are codes, from 0 to 255, where numbers from 0 to 1 are expected",
          .of_frame = of_pixels([](glm::vec4& color, double*) { color *= 255.0f; })};
}

// Whether a frame of 8 bits holds colours beyond 1 that may be codes. (A float frame may hold any.)
bool may_hold_codes(const FrameFormat& frame, const Plane<glm::vec4>& color) {
  constexpr float kLeastCode = 15;
  const auto is_code = [](const glm::vec4& c) { return std::max({c.r, c.g, c.b}) >= kLeastCode; };
  return frame.color == ColorFormat::rgba8 && std::ranges::any_of(color.values(), is_code);
}

// Depths that are 1/w, as the conventions' depth range turns them.
KnownFault depth_of_inv_w(Conventions::DepthRange range) {
  KnownFault out{.stage = "depth",
                 .name = "depth.of_inv_w",
                 .says = "depths are 1/w: the largest is kept, and 0 is cleared to",
                 .of_scene = keep_farthest,
                 .of_stages = {"window.z_of_inv_w"}};
  if (range == Conventions::DepthRange::one_to_zero) {
    out.of_frame = of_pixels([](glm::vec4&, double* z) {
      if (z != nullptr) *z = 1 - *z;
    });
  }
  return out;
}

// Faults that change the finished frame, or draw a changed scene.
std::vector<KnownFault> of_pictures(const FrameFormat& frame) {
  std::vector<KnownFault> out;
  add_files(frame, out);
  add_encodings(out);
  add_culls(out);
  add_neighbours(frame, out);
  add_scanlines(out);
  out.push_back({.stage = "visibility",
                 .name = "visibility.farthest_kept",
                 .says = "the depth test is turned round, and the depth cleared to the other end",
                 .of_scene = keep_farthest});
  return out;
}

constexpr std::string_view kOtherSide = ", or to another side";

// Faults that conventions may declare by mistake.
constexpr std::array<std::string_view, 3> kLifted = {"merge.truncated", "depth.truncated", "coverage.top_for_bottom"};

// Fault whose corners lie in the declared whole pixels. Frames are drawn with samples at centres: borders of pixels
// that are sampled at corners become centres. Empty: there is none.
std::string_view declared_snapping(const Conventions& c) {
  using enum Conventions::Rounding;
  const glm::dvec2 part = glm::fract(c.sample);
  const bool at_centre = part == glm::dvec2(0.5), at_corner = part == glm::dvec2(0);
  if (!settles_grid(c) || c.subpixel_bits != 0 || c.attribute_corners != Conventions::Corners::snapped) return {};
  if (!(at_centre || at_corner) || subpixel_rounding(c, 0) == up) return {};
  if (c.subpixel_rounding == nearest) return at_centre ? "window.nearest_pixels" : "window.nearest_centres";
  if (subpixel_rounding(c, 1) == down) return at_centre ? "window.whole_pixels" : "window.whole_centres";
  return at_centre ? "window.whole_pixels_from_top" : "window.whole_centres_from_top";
}

// Faults that draw what the conventions declare of the scene.
std::vector<std::string_view> declared_faults(const Scene& scene, const Conventions& c) {
  using enum Conventions::TieRule;
  std::vector<std::string_view> out;
  if (c.color_rounding == Conventions::Rounding::down) out.push_back("merge.truncated");
  if (c.depth_rounding == Conventions::Rounding::down) out.push_back("depth.truncated");
  // The fault interpolates all attributes alike: colours alone, where the scene has no texture.
  const Conventions::Interpolation of_all = textured(scene) ? c.interpolation : interpolation_of_colors(c);
  if (of_all == Conventions::Interpolation::affine) out.push_back("attributes.affine");
  if (c.fog_distance == Conventions::FogDistance::eye_radial) out.push_back("shade.fog_radial");
  if (c.tie_rule == inclusive) out.push_back("coverage.inclusive_edges");
  if (c.tie_rule == exclusive) out.push_back("notes.000.strict_edges");
  if (c.tie_rule == left_top) out.push_back("coverage.top_for_bottom");
  if (const std::string_view snapping = declared_snapping(c); !snapping.empty()) out.push_back(snapping);
  return out;
}

bool is_among(std::string_view fault, std::span<const std::string_view> faults) {
  return std::ranges::find(faults, fault) != faults.end();
}

// Lack of `fault`, one of kLifted, where the conventions declare it.
KnownFault not_as_declared(const FaultInfo& fault) {
  const std::string stage(fault.stage);
  const bool is_of_ties = stage == "coverage";
  const char* drawn = is_of_ties ? "left and lower edges own their samples, not left and upper ones"
                                 : "rounded to the nearest code, not down";
  return {.stage = stage,
          .name = stage + (is_of_ties ? ".left_bottom" : ".to_nearest"),
          .says = fmt::format("{}, as the conventions declare: run plumb learn again", drawn),
          .lifts = std::string(fault.name)};
}

// True: the conventions, declared and not open, are of frames without the fault.
bool is_contradicted(const std::string_view fault, const Conventions& conventions) {
  const bool of_rows = fault == "file.rows_reversed" || fault == "window.y_flipped",
             of_depths = fault == "file.depth_of_ndc" || fault == "file.depth_reversed";
  if (!(of_rows || of_depths) || conventions == undeclared()) return false;
  return !leaves_open(conventions, of_rows ? "rows" : "depth_range");
}

}  // namespace

bool is_of(const StageSet& stages, const KnownFault& f) {
  const bool is_of_window = f.name.starts_with("matrices.viewport") || f.name == "matrices.depth_range_not_mapped";
  const std::string_view stage = is_of_window ? "window" : f.stage == "file" ? "merge" : std::string_view(f.stage);
  const auto at = std::ranges::find(kStageNames, stage);
  return at != kStageNames.end() && stages.has(static_cast<Stage>(at - kStageNames.begin()));
}

bool makes_wrong(const StageSet& stages, const KnownFault& f) {
  constexpr std::array<std::string_view, 5> kOfLight = {"vertex.not_renormalised", "shade.texture_ignored",
                                                        "shade.texture_stays", "shade.fog_ignored", "shade.fog_stays"};
  return is_of(stages, f) || (stages.has(Stage::vertex) && f.name == "visibility.draws_reversed") ||
         (stages.has(Stage::light) && is_among(f.name, kOfLight));
}

std::vector<KnownFault> picture_faults() {
  const FrameFormat square;
  std::vector<KnownFault> all = of_pictures(square), out;
  all.push_back(alpha_not_written(square));
  all.push_back(codes_for_numbers());
  all.push_back(depth_of_inv_w(Conventions::DepthRange::zero_to_one));
  for (const FaultInfo& fault : fault_infos()) {
    if (is_among(fault.name, kLifted)) all.push_back(not_as_declared(fault));
  }
  std::ranges::move(misread_states(), std::back_inserter(all));
  for (KnownFault& fault : all) {
    const auto same = std::ranges::find(out, fault.name, &KnownFault::name);
    if (same == out.end()) {
      out.push_back(std::move(fault));
    } else if (!same->says.ends_with(kOtherSide)) {
      same->says += kOtherSide;
    }
  }
  return out;
}

std::vector<KnownFault> known_faults(const Scene& scene, const GivenFrame& given) {
  std::vector<KnownFault> out;
  const std::vector<std::string_view> declared = declared_faults(scene, given.conventions);
  const std::span<const std::uint8_t> legal = given.is_legal.values();
  const bool is_all_legal = !legal.empty() && std::ranges::all_of(legal, [](std::uint8_t l) { return l != 0; });
  for (const FaultInfo& fault : fault_infos()) {  // a wrong declaration comes before faults that draw the same frame
    const bool is_declared = is_among(fault.name, kLifted) && is_among(fault.name, declared);
    if (is_declared && !is_all_legal) out.push_back(not_as_declared(fault));
  }
  if (may_hold_codes(scene.frame, given.color)) out.push_back(codes_for_numbers());
  std::ranges::move(of_pictures(scene.frame), std::back_inserter(out));
  out.push_back(depth_of_inv_w(given.conventions.depth_range));
  std::ranges::move(misread_states(scene), std::back_inserter(out));
  for (const FaultInfo& fault : fault_infos()) {
    if (is_among(fault.name, declared)) continue;
    const std::string name(fault.name);
    out.push_back(
        {.stage = std::string(fault.stage), .name = name, .says = std::string(fault.changes), .of_stages = {name}});
  }
  // Faults that alter alpha come before alpha that is not written.
  if (given.has_alpha) out.push_back(alpha_not_written(scene.frame));
  std::erase_if(out, [&](const KnownFault& f) { return is_of(given.right, f) && !makes_wrong(given.wrong, f); });
  for (KnownFault& f : out) {
    f.is_contradicted = is_contradicted(f.name, given.conventions);
    if (f.is_contradicted) f.says += "; the conventions declare otherwise: run plumb learn again";
  }
  return out;
}

ColorAndDepth draw_with(std::span<const KnownFault* const> faults, const Scene& scene, const Conventions& conventions,
                        CutAt cut_at) {
  Scene changed = scene;
  std::vector<std::string> of_stages;
  for (const std::string_view declared :
       declared_faults(scene, conventions)) {  // first: a fault of the same stage stays
    const bool is_lifted = std::ranges::any_of(faults, [&](const KnownFault* f) { return f->lifts == declared; });
    if (!is_lifted) of_stages.emplace_back(declared);
  }
  for (const KnownFault* f : faults) {
    if (f->of_scene) f->of_scene(changed);
    of_stages.insert(of_stages.end(), f->of_stages.begin(), f->of_stages.end());
  }
  Request request;
  request.planes = WantedPlanes::picture;
  Planes planes = make_candidate(of_stages, cut_at)->capture(changed, request).planes;
  if (conventions.color_encoding == Conventions::Encoding::srgb) std::ranges::for_each(planes.color.values(), encode);
  ColorAndDepth out{std::move(planes.color), std::move(planes.depth)};
  for (const KnownFault* f : faults) {
    if (f->of_frame) f->of_frame(out);
  }
  return out;
}

}  // namespace plumbline::cli
