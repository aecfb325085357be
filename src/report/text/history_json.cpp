#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/text/comparison_json.h"
#include "report/text/history_text.h"

namespace plumbline::report {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return json_number(value); }
Json number(const glm::dvec4& v) { return {number(v.x), number(v.y), number(v.z), number(v.w)}; }
Json number(const glm::vec4& v) { return number(glm::dvec4(v)); }
Json number(std::uint8_t v) { return static_cast<int>(v); }
Json number(std::uint32_t v) { return v; }
Json number(bool v) { return v; }
template <class T>
Json number(const std::optional<T>& v) {
  return v ? number(*v) : Json(nullptr);
}

Json pixel(glm::ivec2 p) { return {p.x, p.y}; }

Json fragment(const check::PixelFragment& f) {
  Json varyings = Json::object();
  for (const auto& [varying, value] : f.varyings) varyings[std::string(name_of(varying))] = number(value);
  return {{"primitive", f.primitive},
          {"draw", f.draw},
          {"triangle", number(f.triangle)},
          {"front", f.front},
          {"depth", number(f.depth)},
          {"color", number(f.color)},
          {"varyings", varyings},
          {"texel", number(f.texel)},
          {"lod", number(f.lod)},
          {"shaded", number(f.shaded)},
          {"drawn", number(f.drawn)},
          {"fate", name_of(f.fate)},
          {"why", f.why},
          {"held_depth", number(f.held_depth)},
          {"held_stencil", number(f.held_stencil)}};
}

Json renderer(const check::PixelHistory& h) {
  Json fragments = Json::array(), legal = Json::array();
  for (const check::PixelFragment& f : h.fragments) fragments.push_back(fragment(f));
  for (const LegalAnswer& a : h.legal) {
    legal.push_back({{"primitive", a.primitive},
                     {"depth", {a.z_lo, a.z_hi}},
                     {"stencil", number(a.stencil)},
                     {"color", number(a.color)},
                     {"color_bound", number(a.color_bound)}});
  }
  Json colors(nullptr);
  if (h.legal_colors) colors = {{"low", number(h.legal_colors->first)}, {"high", number(h.legal_colors->second)}};
  return {{"renderer", h.renderer},
          {"absent", h.absent.empty() ? Json(nullptr) : Json(h.absent)},
          {"fragments", fragments},
          {"lacks", h.lacks},
          {"frame", {{"color", number(h.color)}, {"depth", number(h.depth)}, {"stencil", number(h.stencil)}}},
          {"notes", h.notes},
          {"legal", legal},
          {"legal_colors", colors}};
}

Json renderers(const std::vector<check::PixelHistory>& histories) {
  Json out = Json::array();
  for (const check::PixelHistory& h : histories) out.push_back(renderer(h));
  return out;
}

}  // namespace

std::string history_json(const Scene& scene, const check::History& history) {
  Json samples = Json::array();
  for (const check::SampleHistory& s : history.samples) {
    samples.push_back({{"pass", s.pass}, {"pixel", pixel(s.pixel)}, {"renderers", renderers(s.renderers)}});
  }
  const Json out{{"scene", scene.name},
                 {"pixel", pixel(history.pixel)},
                 {"samples", samples},
                 {"resolved", renderers(history.resolved)}};
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumbline::report
