// Values for every key of the scene format: what the tests of the schema read scenes of.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace plumbline::test {

using Members = std::map<std::string, std::string>;  // key and value, as JSON

inline std::string object(const Members& members) {
  std::string text;
  for (const auto& [key, value] : members) text += (text.empty() ? "\"" : ", \"") + key + "\": " + value;
  return "{" + text + "}";
}

/// One of the schema's objects: good values for all of its keys (of alternatives, each good alone), and where in a
/// scene it stands, as the "$" of `scene`.
struct Sample {
  std::string definition;  ///< empty: the scene
  std::string scene;
  Members members;
};

inline const std::string kTexture = R"("textures": {"t": {"image": {"noise": {}}}}, )";
inline const std::string kTop = R"({"description": "d", "draws": [{"mesh": {"cube": {}}}])";
inline const std::string kInTop = kTop + ", ";
inline const std::string kInDraw = R"({"description": "d", )" + kTexture + R"("draws": [{"mesh": {"cube": {}}, )";
inline std::string in_mesh(const std::string& kind) {
  return R"({"description": "d", "draws": [{"mesh": {")" + kind + R"(": $}}]})";
}
inline std::string in_textures(const std::string& texture) { return kTop + R"(, "textures": {"t": )" + texture + "}}"; }
inline std::string in_image(const std::string& kind) { return in_textures(R"({"image": {")" + kind + R"(": $}})"); }
inline const Members kCells = {{"width", "4"}, {"height", "3"}, {"columns", "2"}, {"rows", "3"}};
inline const Members kSides = {{"left", "-1"}, {"right", "1"}, {"bottom", "-1"},
                               {"top", "1"},   {"near", "1"},  {"far", "2"}};
inline const Members kCoordinates = {{"left", "-1"}, {"right", "1"}, {"bottom", "-1"},
                                     {"top", "1"},   {"near", "1"},  {"far", "-2"}};
inline const Members kState = {{"transforms", "[]"},
                               {"material", "{}"},
                               {"back_material", "{}"},
                               {"lit", "true"},
                               {"color_material", "\"diffuse\""},
                               {"normals", "\"rescale\""},
                               {"shading", "\"flat\""},
                               {"cull", "\"none\""},
                               {"front_mode", "\"fill\""},
                               {"back_mode", "\"fill\""},
                               {"line_width", "16"},
                               {"point_size", "64"},
                               {"depth_func", "\"less\""},
                               {"depth_range", "[1, 0]"},
                               {"polygon_offset", "{}"},
                               {"alpha_test", R"({"func": "less"})"},
                               {"stencil", "{}"},
                               {"fog", R"({"exp": {"density": 1}})"},
                               {"scissor", "[0, 0, 1, 1]"},
                               {"depth_mask", "true"},
                               {"blend", "{}"},
                               {"logic_op", "\"xor\""},
                               {"color_mask", "[true, true, true, false]"},
                               {"texture", R"({"name": "t"})"}};
inline const Members kTerm = {
    {"source", "\"source_alpha_saturate\""}, {"destination", "\"zero\""}, {"equation", "\"min\""}};
inline const Members kStencil = {{"func", "\"less\""}, {"reference", "1"},         {"mask", "255"},
                                 {"fail", "\"keep\""}, {"depth_fail", "\"zero\""}, {"pass", "\"invert\""},
                                 {"write_mask", "7"}};
inline const std::string kThree = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]", kWhite = "[1, 1, 1, 1]";

inline Members with(Members members, const std::string& key, const std::string& value) {
  members[key] = value;
  return members;
}

inline const std::vector<Sample> kSchemaSamples = {
    {"",
     "$",
     {{"$schema", "\"s\""},
      {"version", "1"},
      {"include", "[\"empty.part.json\"]"},
      {"description", "\"d\""},
      {"dialect", "\"gl\""},
      {"frame", "{}"},
      {"camera", "{}"},
      {"projection", R"({"perspective": {"fov_y": 9, "near": 1, "far": 2}})"},
      {"ambient", "[0, 0, 0]"},
      {"light_model", "{}"},
      {"lights", "[]"},
      {"textures", "{}"},
      {"defaults", "{}"},
      {"draws", R"([{"mesh": {"cube": {}}}])"}}},
    {"frame",
     kInTop + R"("frame": $})",
     {{"width", "3"},
      {"height", "3"},
      {"color", "\"rgba8\""},
      {"depth", "\"z16\""},
      {"clear_color", kWhite},
      {"clear_depth", "1"},
      {"stencil", "\"s8\""},
      {"clear_stencil", "255"},
      {"antialias", R"({"samples": 4})"}}},
    {"polygon_offset", kInDraw + R"("polygon_offset": $}]})", {{"factor", "1"}, {"units", "-2"}}},
    {"alpha_test", kInDraw + R"("alpha_test": $}]})", {{"func", "\"less\""}, {"reference", "0.5"}}},
    {"stencil", kInDraw + R"("stencil": $}], "frame": {"stencil": "s8"}})", with(kStencil, "back", "{}")},
    {"stencil_back", kInDraw + R"("stencil": {"back": $}}], "frame": {"stencil": "s8"}})", kStencil},
    {"antialias",
     kInTop + R"("frame": {"antialias": $}})",
     {{"samples", "4"}, {"supersample", "8"}, {"taps", "\"gzrender\""}}},
    {"camera", kInTop + R"("camera": $})", {{"eye", "[1, 2, 3]"}, {"center", "[0, 0, 0]"}, {"up", "[0, 1, 0]"}}},
    {"projection",
     kInTop + R"("projection": $})",
     {{"perspective", R"({"fov_y": 9, "near": 1, "far": 2})"},
      {"orthographic", object(kSides)},
      {"frustum", object(kSides)}}},
    {"perspective", kInTop + R"("projection": {"perspective": $}})", {{"fov_y", "9"}, {"near", "1"}, {"far", "2"}}},
    {"orthographic", kInTop + R"("projection": {"orthographic": $}})", kSides},
    {"frustum", kInTop + R"("projection": {"frustum": $}})", kSides},
    {"games101_projection",
     kInTop + R"("dialect": "games101", "projection": $})",
     {{"perspective", R"({"fov_y": 9, "near": -1, "far": -2})"}, {"orthographic", object(kCoordinates)}}},
    {"games101_perspective",
     kInTop + R"("dialect": "games101", "projection": {"perspective": $}})",
     {{"fov_y", "9"}, {"near", "-1"}, {"far", "-2"}}},
    {"games101_orthographic", kInTop + R"("dialect": "games101", "projection": {"orthographic": $}})", kCoordinates},
    {"gzrender_projection", kInTop + R"("dialect": "gzrender", "projection": $})", {{"x_pi", R"({"fov": 9})"}}},
    {"x_pi", kInTop + R"("dialect": "gzrender", "projection": {"x_pi": $}})", {{"fov", "9"}}},
    {"tinyrenderer_projection", kInTop + R"("dialect": "tinyrenderer", "projection": $})", {{"pinhole", "{}"}}},
    {"pinhole", kInTop + R"("dialect": "tinyrenderer", "projection": {"pinhole": $}})", {{"c", "2"}}},
    {"light",
     kInTop + R"("lights": [$]})",
     {{"point", "[0, 0, 0]"},
      {"ambient", "[0, 0, 0]"},
      {"diffuse", "[0, 0, 0]"},
      {"specular", "[0, 0, 0]"},
      {"attenuation", "[1, 0, 0]"},
      {"spot", R"({"direction": [0, 0, 1], "cutoff": 9})"}}},
    {"spot",
     kInTop + R"("lights": [{"point": [0, 0, 0], "spot": $}]})",
     {{"direction", "[0, 0, 1]"}, {"cutoff", "9"}, {"exponent", "2"}}},
    {"light_model",
     kInTop + R"("light_model": $})",
     {{"local_viewer", "true"}, {"specular", "\"reflection\""}, {"sides", "\"flip\""}, {"separate_specular", "true"}}},
    {"material",
     kInDraw + R"("material": $}]})",
     {{"ambient", kWhite}, {"diffuse", kWhite}, {"specular", kWhite}, {"emission", kWhite}, {"shininess", "3"}}},
    {"texture",
     in_textures("$"),
     {{"image", R"({"noise": {}})"},
      {"format", "\"rgb\""},
      {"texels", "\"float32\""},
      {"min", "\"linear\""},
      {"mag", "\"nearest\""},
      {"wrap_s", "\"repeat\""},
      {"wrap_t", "\"clamp_to_edge\""},
      {"border", kWhite},
      {"lod_bias", "1"},
      {"min_lod", "-1"},
      {"max_lod", "2"},
      {"base_level", "1"},
      {"max_level", "3"}}},
    {"image",
     in_textures(R"({"image": $})"),
     {{"file", "\"image.tga\""},
      {"texels", "[[" + kWhite + "]]"},
      {"checker", "{}"},
      {"gradient", "{}"},
      {"bricks", "{}"},
      {"uv_grid", "{}"},
      {"noise", "{}"}}},
    {"checker", in_image("checker"), with(kCells, "colors", "[" + kWhite + ", " + kWhite + "]")},
    {"bricks", in_image("bricks"), with(kCells, "colors", "[" + kWhite + ", " + kWhite + "]")},
    {"gradient",
     in_image("gradient"),
     {{"width", "3"}, {"height", "2"}, {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + ", " + kWhite + "]"}}},
    {"uv_grid", in_image("uv_grid"), kCells},
    {"noise", in_image("noise"), {{"width", "3"}, {"height", "2"}, {"seed", "7"}}},
    {"draw_texture",
     kInDraw + R"("texture": $}]})",
     {{"name", "\"t\""}, {"environment", "\"blend\""}, {"color", kWhite}}},
    {"fog",
     kInDraw + R"("fog": $}]})",
     {{"exp", R"({"density": 1})"}, {"exp2", R"({"density": 1})"}, {"linear", R"({"start": 1, "end": 2})"}}},
    {"linear_fog", kInDraw + R"("fog": {"linear": $}}]})", {{"color", "[1, 1, 1]"}, {"start", "1"}, {"end", "2"}}},
    {"exponential_fog", kInDraw + R"("fog": {"exp": $}}]})", {{"color", "[1, 1, 1]"}, {"density", "1"}}},
    {"blend", kInDraw + R"("blend": $}]})", with(with(kTerm, "alpha", "{}"), "color", kWhite)},
    {"blend_alpha", kInDraw + R"("blend": {"alpha": $}}]})", kTerm},
    {"transform",
     kInDraw + R"("transforms": [$]}]})",
     {{"translate", "[0, 0, 0]"}, {"rotate", R"({"degrees": 1, "axis": [0, 0, 1]})"}, {"scale", "[1, 1, 1]"}}},
    {"rotate", kInDraw + R"("transforms": [{"rotate": $}]}]})", {{"degrees", "1"}, {"axis", "[0, 0, 1]"}}},
    {"defaults", kInTop + kTexture + R"("frame": {"stencil": "s8"}, "defaults": $})", kState},
    {"draw", R"({"description": "d", "frame": {"stencil": "s8"}, )" + kTexture + R"("draws": [$]})",
     with(kState, "mesh", R"({"cube": {}})")},
    {"mesh",
     R"({"description": "d", "draws": [{"mesh": $}]})",
     {{"file", "\"mesh.obj\""},
      {"triangle", "{\"positions\": " + kThree + "}"},
      {"triangles", "{\"positions\": " + kThree + ", \"indices\": [[0, 1, 2]]}"},
      {"lines", R"({"positions": [[0, 0, 0], [1, 0, 0]], "indices": [[0, 1]]})"},
      {"points", R"({"positions": [[0, 0, 0]]})"},
      {"quad", "{}"},
      {"grid", R"({"columns": 1, "rows": 1})"},
      {"cube", "{}"},
      {"uv_sphere", R"({"slices": 3, "stacks": 2})"},
      {"globe", R"({"slices": 3, "stacks": 2})"},
      {"icosphere", R"({"subdivisions": 0})"},
      {"torus_knot", R"({"segments": 9, "sides": 3})"},
      {"revolution", R"({"profile": [[1, 0], [1, 1], [1, 2], [1, 3]], "steps": 1, "slices": 3})"},
      {"soup", R"({"triangles": 1, "seed": 0, "extent": 1, "size": 1})"}}},
    {"triangle",
     in_mesh("triangle"),
     {{"positions", kThree},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [0, 1]]"}}},
    {"triangles",
     in_mesh("triangles"),
     {{"positions", kThree},
      {"indices", "[[0, 1, 2]]"},
      {"normals", "[[0, 0, 1], [0, 1, 0], [0.707, 0, -0.707]]"},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [0, 1]]"}}},
    {"lines",
     in_mesh("lines"),
     {{"positions", "[[0, 0, 0], [1, 0, 0]]"},
      {"indices", "[[1, 0]]"},
      {"colors", "[" + kWhite + ", " + kWhite + "]"}}},
    {"points", in_mesh("points"), {{"positions", "[[0, 0, 0]]"}, {"colors", "[" + kWhite + "]"}}},
    {"quad",
     in_mesh("quad"),
     {{"positions", "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]"},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [1, 1], [0, 1]]"}}},
    {"grid", in_mesh("grid"), {{"columns", "1"}, {"rows", "1"}}},
    {"cube", in_mesh("cube"), {}},
    {"uv_sphere", in_mesh("uv_sphere"), {{"slices", "3"}, {"stacks", "2"}}},
    {"globe", in_mesh("globe"), {{"slices", "3"}, {"stacks", "2"}}},
    {"icosphere", in_mesh("icosphere"), {{"subdivisions", "0"}}},
    {"torus_knot", in_mesh("torus_knot"), {{"p", "2"}, {"q", "3"}, {"tube", "0.1"}, {"segments", "9"}, {"sides", "3"}}},
    {"revolution",
     in_mesh("revolution"),
     {{"profile", "[[1, 0], [1, 1], [1, 2], [1, 3]]"}, {"steps", "1"}, {"slices", "3"}}},
    {"soup", in_mesh("soup"), {{"triangles", "1"}, {"seed", "0"}, {"extent", "1"}, {"size", "1"}}},
};

}  // namespace plumbline::test
