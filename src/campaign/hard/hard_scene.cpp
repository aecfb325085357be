#include "campaign/hard/hard_scene.h"

#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

constexpr std::string_view kModes[] = {"fill", "line", "point"};

// How polygons are lit, culled and drawn.
void add_surface_state(Builder& b, Object& draw, bool textured) {
  Choices& c = b.choose;
  if (c.chance(85)) draw.put("material", material(b));
  if (c.chance(20)) draw.put("back_material", material(b));
  if (c.chance(55)) draw.put("lit", c.chance(90) ? "false" : "true");
  if (c.chance(30)) {
    draw.put_word("color_material",
                  c.word({"none", "ambient", "diffuse", "ambient_and_diffuse", "specular", "emission"}));
  }
  if (c.chance(30)) draw.put_word("normals", c.word({"normalize", "rescale", "as_they_are"}));
  if (c.chance(50)) draw.put_word("shading", c.word({"flat", "flat", "gouraud", "phong", "phong"}));
  if (c.chance(30)) draw.put_word("cull", c.word({"none", "back", "back", "front"}));
  if (c.chance(20)) draw.put("fog", fog(b));
  if (textured && c.chance(70)) {
    draw.put("texture", draw_texture(b));
  } else if (c.chance(15)) {
    const std::string_view front = kModes[c.count(0, 2)], back = kModes[c.count(0, 2)];
    draw.put_word("front_mode", front).put_word("back_mode", back);
    b.has_line_or_point |= front != "fill" || back != "fill";
  }
}

Object draw(Builder& b) {
  Choices& c = b.choose;
  const HardMesh of = mesh(b);
  Object out("mesh", of.text);
  if (of.made) out.put("transforms", place_made(b));
  add_surface_state(b, out, of.textured);
  if (of.line_or_point || out.has("front_mode")) {
    if (c.chance(60)) out.put("line_width", c.of({1, 2, 3, 4, 7, 16}));
    if (c.chance(60)) out.put("point_size", c.of({1, 2, 3, 5, 8, 64}));
  }
  add_fragment_state(b, out);
  return out;
}

}  // namespace

std::string hard_scene(campaign::Choices choices, const std::string& description) {
  Builder b(std::move(choices));
  Choices& c = b.choose;
  b.dialect = c.word({"gl", "gl", "gl", "gl", "gl", "gl", "gl", "gzrender", "games101", "tinyrenderer"});
  b.color_format = c.word({"rgba8", "rgba8", "rgba8", "rgba12", "rgba16", "rgba32f"});
  b.has_stencil = c.chance(25);
  choose_view(b);
  const Object onto = projection(b);
  Object defaults;
  if (c.chance(10)) defaults.put("fog", fog(b));
  if (c.chance(10)) defaults.put("material", material(b));
  std::vector<Object> draws;
  const int count = static_cast<int>(c.of({1, 1, 2, 2, 3, 4}));
  for (int i = 0; i < count; ++i) draws.push_back(draw(b));

  Object scene;
  scene.put("description", json_string(description));
  if (c.chance(5)) scene.put("version", "1");
  if (b.dialect != "gl" || c.chance(50)) scene.put("dialect", json_string(b.dialect));
  scene.put("frame", frame(b));
  scene.put("camera", camera(b));
  scene.put("projection", onto);
  if (c.chance(70)) scene.put("ambient", json_numbers(rgb(b)));
  const Object model = light_model(b);
  if (!model.empty()) scene.put("light_model", model);
  scene.put("lights", lights(b));
  if (!b.textures.empty()) scene.put("textures", b.textures);
  if (!defaults.empty()) scene.put("defaults", defaults);
  scene.put("draws", json_lines(draws));
  return scene.lines();
}

}  // namespace plumbline::hard
