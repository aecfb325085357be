#include "campaign/ordinary/ordinary_scene.h"

#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

void choose_dialect(Builder& b) {
  b.dialect = b.choose.word({"gl", "gl", "gl", "gl", "gl", "gzrender", "games101", "tinyrenderer"});
  b.greater_is_nearer = b.dialect == "games101" || b.dialect == "tinyrenderer";
  if (b.dialect == "tinyrenderer") b.reach = 1;
}

// Opaque draws, then effects, then translucent draws: the order of tutorials.
void add_draws(Builder& b) {
  Choices& c = b.choose;
  if (c.chance(12)) add_triangles(b);
  if (c.chance(60)) add_floor(b);
  if (c.chance(20)) add_wall(b);
  if (c.chance(85)) add_solids(b);
  if (c.chance(18)) add_lines(b);
  if (c.chance(14)) add_points(b);
  if (c.chance(12)) add_wireframe(b);
  if (c.chance(8)) add_decal(b);
  if (c.chance(6)) add_mirror(b);
  if (c.chance(6)) add_shadow(b);
  if (c.chance(4)) add_outline(b);
  if (c.chance(6)) add_cut_out(b);
  if (c.chance(5)) add_oddity(b);
  if (c.chance(14)) add_glass(b);
  if (c.chance(6)) add_glow(b);
  if (c.chance(4)) add_inset(b);
  if (b.draws.empty()) add_triangles(b);
}

Object defaults(Builder& b) {
  Object out;
  if (b.choose.chance(30)) out.put("fog", fog(b));
  if (b.choose.chance(15)) out.put("material", material(b));
  if (b.choose.chance(8)) out.put_word("shading", b.choose.word({"flat", "phong"}));
  if (b.choose.chance(8)) out.put_word("cull", b.choose.word({"back", "back", "front"}));
  if (b.choose.chance(3)) out.put_word("normals", b.choose.word({"rescale", "as_they_are"}));
  return out;
}

}  // namespace

std::string ordinary_scene(campaign::Choices choices, const std::string& description) {
  Builder b(std::move(choices));
  choose_dialect(b);
  const Object seen = camera(b), onto = projection(b);
  b.is_lit = b.choose.chance(85);
  const std::string lamps = lights(b);
  const Object model = light_model(b), all = defaults(b);
  add_draws(b);

  Object scene;
  scene.put("description", json_string(description));
  scene.put("dialect", json_string(b.dialect));
  scene.put("frame", frame(b));
  scene.put("camera", seen);
  scene.put("projection", onto);
  if (b.choose.chance(70)) {
    const double grey = b.choose.number(0, 0.4);
    scene.put("ambient", json_numbers({grey, grey, b.choose.chance(50) ? grey : b.choose.number(0, 0.4)}));
  }
  if (!model.empty()) scene.put("light_model", model);
  if (b.is_lit) scene.put("lights", lamps);
  if (!b.textures.empty()) scene.put("textures", b.textures);
  if (!all.empty()) scene.put("defaults", all);
  scene.put("draws", json_lines(b.draws));
  return scene.lines();
}

}  // namespace plumbline::ordinary
