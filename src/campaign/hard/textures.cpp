// Textures: small images of every size, whose borders and levels many pixels meet.
#include <fmt/format.h>

#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

constexpr std::string_view kWraps[] = {"repeat", "mirrored_repeat", "clamp_to_edge", "clamp_to_border"};

std::string_view wrap(Builder& b) { return kWraps[b.choose.count(0, 3)]; }

struct MadeImage {
  Object image;
  int width = 1, height = 1;  ///< texels
};

MadeImage texels(Builder& b) {
  const int width = b.choose.count(1, 5), height = b.choose.count(1, 5);
  std::vector<std::string> rows;
  for (int i = 0; i < height; ++i) rows.push_back(rgba_list(b, static_cast<std::size_t>(width)));
  return {Object("texels", json_array(rows)), width, height};
}

MadeImage image(Builder& b) {
  Choices& c = b.choose;
  const std::string_view kind =
      c.word({"texels", "texels", "checker", "gradient", "bricks", "uv_grid", "noise", "noise"});
  if (kind == "texels") return texels(b);
  const int width = static_cast<int>(c.of({1, 2, 3, 4, 5, 7, 8, 16, 33, 64}));
  const int height = c.chance(50) ? width : static_cast<int>(c.of({1, 2, 3, 4, 5, 7, 8, 16, 33, 64}));
  Object out;
  out.put("width", width).put("height", height);
  const bool of_cells = kind == "checker" || kind == "bricks" || kind == "uv_grid";
  if (of_cells && c.chance(80)) out.put("columns", c.count(1, width)).put("rows", c.count(1, height));
  if ((kind == "checker" || kind == "bricks") && c.chance(80)) out.put("colors", rgba_list(b, 2));
  if (kind == "gradient" && c.chance(80)) out.put("colors", rgba_list(b, 4));
  if (kind == "noise" && c.chance(80)) out.put("seed", c.count(0, 9999));
  return {Object(kind, out.text()), width, height};
}

int levels(const MadeImage& of) {
  int out = 1;
  for (int side = of.width > of.height ? of.width : of.height; side > 1; side /= 2) ++out;
  return out;
}

}  // namespace

void add_textures(Builder& b) {
  Choices& c = b.choose;
  const int count = c.count(1, 2);
  for (int i = 0; i < count; ++i) {
    const MadeImage of = image(b);
    Object out("image", of.image.text());
    std::string_view format = "rgba";
    if (c.chance(50)) {
      format = c.word({"alpha", "luminance", "luminance_alpha", "intensity", "rgb", "rgba"});
      out.put_word("format", format);
    }
    if (c.chance(15)) out.put_word("texels", c.word({"unorm8", "float32", "float32"}));
    if (c.chance(80)) {
      out.put_word("min", c.word({"nearest", "linear", "nearest_mipmap_nearest", "linear_mipmap_nearest",
                                  "nearest_mipmap_linear", "linear_mipmap_linear"}));
    }
    if (c.chance(60)) out.put_word("mag", c.word({"nearest", "linear"}));
    if (c.chance(70)) {
      const std::string_view s = wrap(b), t = wrap(b);
      out.put_word("wrap_s", s).put_word("wrap_t", t);
    }
    if (c.chance(30)) out.put_numbers("border", rgba(b));
    if (c.chance(20)) out.put("lod_bias", c.of({-16, -1, -0.5, 0.5, 1, 16, c.number(-2, 2)}));
    if (c.chance(15)) {
      const double low = c.of({-1000, 0, 0.5, 1, 2});
      out.put("min_lod", low).put("max_lod", low + c.of({0, 0.25, 1, 3}));
    }
    if (c.chance(15)) {
      const int base = c.count(0, levels(of) - 1);
      out.put("base_level", base).put("max_level", base + c.count(0, 3));
    }
    const std::string name = fmt::format("t{}", b.texture_names.size());
    b.textures.put(name, out);
    b.texture_names.push_back(name);
    b.decal_fits.push_back(format == "rgb" || format == "rgba");
  }
}

Object draw_texture(Builder& b) {
  Choices& c = b.choose;
  if (b.texture_names.empty()) add_textures(b);
  const auto which = static_cast<std::size_t>(c.count(0, static_cast<int>(b.texture_names.size()) - 1));
  Object out("name", json_string(b.texture_names[which]));
  if (c.chance(70)) {
    const std::string_view environment = c.word({"replace", "modulate", "blend", "add", "decal"});
    out.put_word("environment", environment == "decal" && !b.decal_fits[which] ? "replace" : environment);
    if (c.chance(50)) out.put_numbers("color", rgba(b));
  }
  return out;
}

}  // namespace plumbline::hard
