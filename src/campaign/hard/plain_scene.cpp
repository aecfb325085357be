// Scenes of opaque, unlit triangles in the geometry of hard scenes: no alpha but 1, and nothing culled. Plain scenes
// are drawn by a depth test; so are inside scenes, in perspective, whose triangles no plane cuts; in flat scenes each
// draw has one colour, and a later draw lies over an earlier one.
#include "campaign/hard/builder.h"
#include "campaign/hard/hard_scene.h"

namespace plumbline::hard {
namespace {

Object plain_frame(Builder& b) {
  Object out;
  out.put("width", b.view.width).put("height", b.view.height);
  const std::string_view depth = b.one_color ? "z24" : b.choose.word({"z24", "z24", "z16", "z32f"});
  if (depth != "z24") out.put_word("depth", depth);
  if (b.choose.chance(60)) out.put_numbers("clear_color", rgba(b));
  return out;
}

Object plain_draw(Builder& b) {
  const HardMesh of = triangles_mesh(b);
  Object out("mesh", of.text);
  if (of.made) out.put("transforms", place_made(b));
  if (b.one_color || b.choose.chance(70)) out.put("material", Object("diffuse", json_numbers(rgba(b))));
  out.put("lit", "false");
  if (b.one_color) out.put_word("depth_func", "always");
  return out;
}

std::string scene_of_triangles(Builder& b, const std::string& description) {
  b.opaque = true;
  choose_view(b);
  const Object onto = projection(b);
  std::vector<Object> draws;
  const int count = static_cast<int>(b.choose.of({1, 1, 2, 2, 3, 4}));
  for (int i = 0; i < count; ++i) draws.push_back(plain_draw(b));

  Object scene;
  scene.put("description", json_string(description));
  scene.put("frame", plain_frame(b));
  scene.put("camera", camera(b));
  scene.put("projection", onto);
  scene.put("draws", json_lines(draws));
  return scene.lines();
}

}  // namespace

std::string plain_scene(campaign::Choices choices, const std::string& description) {
  Builder b(std::move(choices));
  return scene_of_triangles(b, description);
}

std::string inside_scene(campaign::Choices choices, const std::string& description) {
  Builder b(std::move(choices));
  b.view.clamps = true;
  return scene_of_triangles(b, description);
}

std::string flat_scene(campaign::Choices choices, const std::string& description) {
  Builder b(std::move(choices));
  b.one_color = true;
  return scene_of_triangles(b, description);
}

}  // namespace plumbline::hard
