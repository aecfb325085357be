#include "learn/prober.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "capture/by_conventions.h"

namespace plumbline::learn {

Planes Prober::draw(const Scene& scene) {
  Scene probe = scene;
  for (Draw& draw : probe.draws) draw.depth_func = depth_func;
  Capture left = captured(probe);
  if (left.planes.color.empty()) throw Unsupported("it leaves no planes.color");
  to_dialect(learned.conventions, left);
  if (std::ranges::find(learned.pictures, scene.name, &ProbePicture::name) == learned.pictures.end())
    learned.pictures.push_back({scene.name, left.planes.color});
  return std::move(left.planes);
}

Planes Prober::draw_with_depths(const Scene& scene) {
  Planes out = draw(scene);
  if (out.depth.empty()) throw Unsupported("it leaves no planes.depth");
  return out;
}

Capture Prober::captured(const Scene& probe) {
  try {
    return renderer_.capture(probe, Request{});
  } catch (const RendererFailed& e) {
    throw RendererFailed(fmt::format("{}: {}", probe.name, e.what()));
  }
}

void Prober::found(const ConventionWords& words, std::string_view value, std::string evidence) {
  LearnedRow row{std::string(words.name), std::string(value), std::move(evidence)};
  const auto earlier = std::ranges::find(learned.rows, words.name, &LearnedRow::name);
  if (earlier != learned.rows.end())
    *earlier = std::move(row);
  else
    learned.rows.push_back(std::move(row));
}

void Prober::open(const ConventionWords& words, std::string why) {
  learned.rows.push_back({std::string(words.name), "open", std::move(why)});
  learned.conventions.open.emplace_back(words.name);
}

bool Prober::is_open(std::string_view name) const {
  return std::ranges::find(learned.conventions.open, name) != learned.conventions.open.end();
}

bool Prober::open_if_any_open(const ConventionWords& words, std::initializer_list<std::string_view> conventions) {
  const auto lacking = std::ranges::find_if(conventions, [&](std::string_view name) { return is_open(name); });
  if (lacking == conventions.end()) return false;
  open(words, fmt::format("{} is open", *lacking));
  return true;
}

bool Prober::open_if_colors_are_not_linear(const ConventionWords& words) {
  if (not_linear.empty()) return false;
  open(words, not_linear);
  return true;
}

void Prober::fits_none(const ConventionWords& words, const std::string& evidence) {
  open(words, evidence);
  learned.rows.back().value = "none fits";
  unexplained(fmt::format("{}: {}", words.name, evidence));
}

ConventionWords words_of(std::string_view name) {
  std::optional<ConventionWords> out;
  const auto take = [&](const ConventionWords& words, auto) {
    if (words.name == name) out = words;
  };
  take(kSampleWords, nullptr), take(kOffsetWords, nullptr), take(kFloatOffsetWords, nullptr);
  each_choice(take);
  each_number_of_bits(take);
  if (!out) throw std::logic_error(fmt::format("no convention {}", name));
  return *out;
}

}  // namespace plumbline::learn
