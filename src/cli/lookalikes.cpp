// plumb diagnose --picture: what a picture alone can tell. Each known fault draws the scene, and those whose picture is
// nearest to the one given are named.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "capture/files/image_file.h"
#include "cli/commands.h"
#include "cli/options/renderers.h"

namespace plumbline::cli {

namespace {

using Picture = Plane<glm::vec4>;  // the first row at the bottom

constexpr float kCode = 1.0f / 255;

Picture drawn(const Scene& scene, const std::string& fault) {
  Request request;
  request.planes = WantedPlanes::picture;
  Picture out = make_candidate(fault)->capture(scene, request).planes.color;
  return rows_from_top(scene.dialect) ? upside_down(out) : out;
}

// Pixels of which red, green or blue is more than a code of eight bits off. No number is off.
std::size_t pixels_apart(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::vec3 p = glm::clamp(glm::vec3(a.values()[i]), 0.0f, 1.0f), q(b.values()[i]);
    const glm::vec3 off = glm::abs(p - glm::clamp(q, 0.0f, 1.0f));
    count +=
        off.x <= 1.5f * kCode && off.y <= 1.5f * kCode && off.z <= 1.5f * kCode && !std::isnan(q.x + q.y + q.z) ? 0 : 1;
  }
  return count;
}

template <class Change>
Picture changed(const Picture& from, Change change) {
  Picture out = from;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) out(x, y) = change(x, y);
  }
  return out;
}

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

struct Lookalike {
  std::size_t apart;
  std::string name, says;
};

// What happens to a right picture on its way into a file.
std::vector<Lookalike> of_files(const Picture& right, const Picture& given) {
  const auto mirrored = [&](int x, int y) { return right(right.width() - 1 - x, y); };
  const auto swapped = [&](int x, int y) { return glm::vec4(right(x, y).b, right(x, y).g, right(x, y).r, 1); };
  const auto srgb = [&](int x, int y) {
    const glm::vec4 c = glm::clamp(right(x, y), 0.0f, 1.0f);
    return glm::vec4(encoded(c.r), encoded(c.g), encoded(c.b), 1);
  };
  return {
      {pixels_apart(given, upside_down(right)), "file.rows_reversed", "the rows are written from the other end"},
      {pixels_apart(given, changed(right, mirrored)), "file.mirrored", "the columns are written from the other end"},
      {pixels_apart(given, changed(right, swapped)), "file.bgr", "red and blue are swapped"},
      {pixels_apart(given, changed(right, srgb)), "file.srgb", "colours are encoded as sRGB once more"}};
}

}  // namespace

int diagnose_picture(const DiagnoseOptions& o) {
  const Scene scene = o.scene_arguments.load(o.scene);
  require_budget(scene, plane_bytes(scene), Request{}.memory_budget);
  const Picture given = read_image(o.picture), right = drawn(scene, "");
  if (given.width() != right.width() || given.height() != right.height()) {
    throw std::runtime_error(fmt::format("{}: expected a picture of the scene's {} x {} pixels, found one of {} x {}",
                                         o.picture, right.width(), right.height(), given.width(), given.height()));
  }
  const std::size_t apart = pixels_apart(given, right), all = given.size();
  fmt::print("{}: {} of {} pixels are more than 1/255 from ours\n", o.picture, apart, all);
  if (apart == 0) return kHolds;
  std::vector<Lookalike> nearer = of_files(right, given);
  for (const FaultInfo& fault : fault_infos()) {
    const std::string name(fault.name);
    nearer.push_back({pixels_apart(given, drawn(scene, name)), name, std::string(fault.changes)});
  }
  std::erase_if(nearer, [&](const Lookalike& l) { return l.apart >= apart; });
  std::ranges::stable_sort(nearer, {}, &Lookalike::apart);
  if (nearer.empty()) fmt::print("no known fault draws a picture that is nearer\n");
  constexpr std::size_t kShown = 8;
  for (const Lookalike& l : std::span(nearer).first(std::min(nearer.size(), kShown))) {
    fmt::print("{:>8} {:<36} {}\n", l.apart, l.name, l.says);
  }
  if (!nearer.empty()) fmt::print("columns: pixels that differ, fault, its effect; --capture FOLDER names the stage\n");
  return kDiffers;
}

}  // namespace plumbline::cli
