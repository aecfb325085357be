// Colours, materials, lights and fog.
#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

// Share in [0,1]: the exact value of a code, the middle between two codes, an end of the range, or any number.
double share(Builder& b) {
  return b.choose.of({0, 0, 1, 1, 0.5, 0.25, 1.0 / 255, 127.5 / 255, 254.5 / 255, b.choose.number(0, 1)});
}

double strength(Builder& b) { return b.choose.of({0, 0.5, 1, 1, 1, 2, 10, 1000}); }

Object spot(Builder& b) {
  Choices& c = b.choose;
  Object out;
  const double x = c.number(-1, 1), y = c.number(-1, 1);
  out.put_numbers("direction", {x, y, c.of({-1, -0.5, 1})});
  out.put("cutoff", c.of({0, 10.5, 20.5, 45, 60, 90, 90}));
  if (c.chance(70)) out.put("exponent", c.of({0, 0.5, 1, 7, 128}));
  return out;
}

Object light(Builder& b) {
  Choices& c = b.choose;
  Object out;
  const double x = c.number(-3, 3), y = c.number(-3, 3), z = c.number(-2, 4);
  const bool is_point = c.chance(60), nowhere = x == 0 && y == 0 && z == 0;
  out.put_numbers(is_point ? "point" : "directional", {x, y, nowhere ? 1 : z});
  if (is_point && c.chance(40)) {
    const double constant = c.of({0, 1, 1, 0.5}), linear = c.of({0, 0, 0.25, 1});
    out.put_numbers("attenuation", {constant, linear, constant == 0 && linear == 0 ? 0.5 : c.of({0, 0, 0.125, 1})});
  }
  if (is_point && c.chance(40)) out.put("spot", spot(b));
  for (const char* part : {"ambient", "diffuse", "specular"}) {
    if (c.chance(35)) out.put_numbers(part, {strength(b), strength(b), strength(b)});
  }
  return out;
}

}  // namespace

std::vector<double> rgb(Builder& b) { return {share(b), share(b), share(b)}; }
std::vector<double> rgba(Builder& b) {
  const double red = share(b), green = share(b), blue = share(b), alpha = share(b);
  return {red, green, blue, b.opaque ? 1 : alpha};
}

std::string rgba_list(Builder& b, std::size_t count) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(json_numbers(rgba(b)));
  return json_array(out);
}

Object material(Builder& b) {
  Choices& c = b.choose;
  Object out;
  if (c.chance(80)) out.put_numbers("diffuse", rgba(b));
  if (c.chance(40)) out.put_numbers("ambient", rgba(b));
  if (c.chance(40)) out.put_numbers("specular", rgba(b)).put("shininess", c.of({0, 1, 2.5, 20, 128}));
  if (c.chance(15)) out.put_numbers("emission", rgba(b));
  return out;
}

Object fog(Builder& b) {
  Choices& c = b.choose;
  const std::string_view kind = c.word({"linear", "linear", "exp", "exp2"});
  Object out;
  if (c.chance(80)) out.put_numbers("color", rgb(b));
  if (kind == "linear") {
    const double start = c.of({0, 1, -2, b.view.near, 4, 100}), length = c.of({1e-3, 1, 5, 20, -3, 1000});
    out.put("start", start).put("end", start + length);
  } else {
    out.put("density", c.of({0, 0.01, 0.1, 0.35, 1, 10}));
  }
  return Object(kind, out.text());
}

std::string lights(Builder& b) {
  std::vector<std::string> out;
  const int count = static_cast<int>(b.choose.of({0, 1, 1, 1, 2, 3, 8}));
  for (int i = 0; i < count; ++i) out.push_back(light(b).text());
  return json_array(out);
}

Object light_model(Builder& b) {
  Choices& c = b.choose;
  Object out;
  if (c.chance(40)) out.put("local_viewer", c.chance(80) ? "true" : "false");
  if (c.chance(30)) out.put_word("specular", c.word({"half_vector", "reflection"}));
  if (c.chance(40)) out.put_word("sides", c.word({"one", "two", "flip"}));
  if (c.chance(25)) out.put("separate_specular", c.chance(90) ? "true" : "false");
  return out;
}

}  // namespace plumbline::hard
