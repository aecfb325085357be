#include "scene/file/texture_json.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "scene/names.h"
#include "scene/texture/texture_file.h"
#include "scene/texture/texture_images.h"

namespace plumbline {
namespace {

struct Size {
  int width, height;
};

/// An image of known size that is not made yet: make() runs when all textures of the scene are known to fit together.
struct Image {
  Size size;
  std::function<TextureLevel()> make;
  int channels = 4;
};

void require_room(const JsonNode& node, Size size, std::size_t most_texels) {
  const std::size_t texels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  if (texels <= most_texels) return;
  const std::string left = most_texels == kMostTexels ? "" : fmt::format(", {} more beside the others", most_texels);
  node.refuse(fmt::format("at most {} texels in all of the scene's textures{}", kMostTexels, left),
              fmt::format("{} x {} = {}", size.width, size.height, texels));
}

/// "width" and "height" [texels], 64 where left out.
Size read_size(const JsonNode& node, std::size_t most_texels) {
  const auto side = [&](const char* key) {
    const auto n = node.find(key);
    return n ? static_cast<int>(n->integer(1, kLargestTexture)) : 64;
  };
  const Size size{side("width"), side("height")};
  require_room(node, size, most_texels);
  return size;
}

/// "columns" and "rows", where left out the smaller of 8 and the side in texels.
Size read_cells(const JsonNode& node, Size size) {
  const auto count = [&](const char* key, int texels) {
    const auto n = node.find(key);
    if (!n) return std::min(8, texels);
    const int cells = static_cast<int>(n->integer(1, kLargestTexture));
    if (cells > texels) n->refuse(fmt::format("at most one for each of the {} texels", texels));
    return cells;
  };
  return {count("columns", size.width), count("rows", size.height)};
}

template <std::size_t n>
std::array<glm::vec4, n> read_colors(const JsonNode& node, std::array<glm::vec4, n> colors) {
  if (const auto list = node.find("colors")) {
    const std::vector<JsonNode> given = list->elements(n, n);
    for (std::size_t i = 0; i < n; ++i) colors[i] = glm::vec4(given[i].vector<4>(0, 1));
  }
  return colors;
}

constexpr glm::vec4 kBlack(0, 0, 0, 1), kWhite(1);

Image read_checker(const JsonNode& node, std::size_t most_texels) {
  node.only({"width", "height", "columns", "rows", "colors"});
  const Size size = read_size(node, most_texels), cells = read_cells(node, size);
  const auto colors = read_colors<2>(node, {kBlack, kWhite});
  return {size, [=] { return make_checker(size.width, size.height, cells.width, cells.height, colors); }};
}

Image read_gradient(const JsonNode& node, std::size_t most_texels) {
  node.only({"width", "height", "colors"});
  const Size size = read_size(node, most_texels);
  const auto colors =
      read_colors<4>(node, {kBlack, glm::vec4(1, 0, 0, 1), glm::vec4(1, 1, 0, 1), glm::vec4(0, 1, 0, 1)});
  return {size, [=] { return make_gradient(size.width, size.height, colors); }};
}

Image read_bricks(const JsonNode& node, std::size_t most_texels) {
  node.only({"width", "height", "columns", "rows", "colors"});
  const Size size = read_size(node, most_texels), cells = read_cells(node, size);
  const auto colors = read_colors<2>(node, {glm::vec4(0.6f, 0.2f, 0.1f, 1), glm::vec4(0.8f, 0.8f, 0.7f, 1)});
  return {size, [=] { return make_bricks(size.width, size.height, cells.width, cells.height, colors[0], colors[1]); }};
}

Image read_uv_grid(const JsonNode& node, std::size_t most_texels) {
  node.only({"width", "height", "columns", "rows"});
  const Size size = read_size(node, most_texels), cells = read_cells(node, size);
  return {size, [=] { return make_uv_grid(size.width, size.height, cells.width, cells.height); }};
}

Image read_noise(const JsonNode& node, std::size_t most_texels) {
  node.only({"width", "height", "seed"});
  const Size size = read_size(node, most_texels);
  const auto given = node.find("seed");
  const std::uint32_t seed = given ? static_cast<std::uint32_t>(given->integer(0, UINT32_MAX)) : 1;
  return {size, [=] { return make_noise(size.width, size.height, seed); }};
}

Image made(TextureLevel level, int channels) {
  const Size size{level.width, level.height};
  return {size, [level = std::move(level)]() mutable { return std::move(level); }, channels};
}

/// Rows of texels, the first at t = 0.
Image read_texels(const JsonNode& node, std::size_t most_texels) {
  constexpr std::size_t kMostGiven = 64;
  TextureLevel out;
  for (const JsonNode& row : node.elements(1, kMostGiven)) {
    const std::vector<JsonNode> texels =
        out.height == 0 ? row.elements(1, kMostGiven)
                        : row.elements(static_cast<std::size_t>(out.width), static_cast<std::size_t>(out.width));
    out.width = static_cast<int>(texels.size());
    ++out.height;
    for (const JsonNode& texel : texels) out.texels.emplace_back(texel.vector<4>(0, 1));
  }
  require_room(node, {out.width, out.height}, most_texels);
  return made(std::move(out), 4);
}

Image read_image_file(const JsonNode& node, const AssetFolders& folders, std::size_t most_texels) {
  const std::filesystem::path file = folders.find(node, "an image file");
  try {
    TextureImage image = load_texture_image(file, most_texels);
    return made(std::move(image.rgba), image.channels);
  } catch (const TextureError& error) {
    node.refuse("an image file that can be used", error.what());
  }
}

Image read_image(const JsonNode& node, const AssetFolders& folders, std::size_t most_texels) {
  const std::string_view kind = node.one_of({"file", "texels", "checker", "gradient", "bricks", "uv_grid", "noise"});
  const JsonNode n = node[kind];
  if (kind == "file") return read_image_file(n, folders, most_texels);
  if (kind == "texels") return read_texels(n, most_texels);
  if (kind == "checker") return read_checker(n, most_texels);
  if (kind == "gradient") return read_gradient(n, most_texels);
  if (kind == "bricks") return read_bricks(n, most_texels);
  if (kind == "uv_grid") return read_uv_grid(n, most_texels);
  return read_noise(n, most_texels);
}

TextureFormat format_of_channels(int channels) {
  constexpr TextureFormat kFormats[] = {TextureFormat::luminance, TextureFormat::luminance_alpha, TextureFormat::rgb,
                                        TextureFormat::rgba};
  return kFormats[channels - 1];
}

Wrap read_wrap(const JsonNode& node) { return node.choice<Wrap>(kNamesOf<Wrap>); }

Sampler read_sampler(const JsonNode& node) {
  constexpr double kLod = 1000, kBias = 16;
  Sampler sampler;
  if (const auto n = node.find("min")) {
    sampler.min = n->choice<MinFilter>(kNamesOf<MinFilter>);
  }
  if (const auto n = node.find("mag")) {
    sampler.mag = n->choice<MagFilter>(kNamesOf<MagFilter>);
  }
  if (const auto n = node.find("wrap_s")) sampler.wrap_s = read_wrap(*n);
  if (const auto n = node.find("wrap_t")) sampler.wrap_t = read_wrap(*n);
  if (const auto n = node.find("border")) sampler.border = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("lod_bias")) sampler.lod_bias = static_cast<float>(n->number(-kBias, kBias));
  if (const auto n = node.find("min_lod")) sampler.min_lod = static_cast<float>(n->number(-kLod, kLod));
  if (const auto n = node.find("max_lod")) sampler.max_lod = static_cast<float>(n->number(-kLod, kLod));
  if (const auto n = node.find("base_level")) sampler.base_level = static_cast<int>(n->integer(0, 14));
  if (const auto n = node.find("max_level")) sampler.max_level = static_cast<int>(n->integer(0, 1000));
  if (sampler.max_lod < sampler.min_lod) {
    node["max_lod"].refuse(fmt::format("a number not less than min_lod, {}", sampler.min_lod));
  }
  if (sampler.max_level < sampler.base_level) {
    node["max_level"].refuse(fmt::format("an integer not less than base_level, {}", sampler.base_level));
  }
  return sampler;
}

/// A texture without levels, and the image that they are to be made of.
std::pair<Texture, Image> read_texture(const JsonNode& node, const AssetFolders& folders, std::size_t most_texels) {
  node.only({"image", "format", "texels", "min", "mag", "wrap_s", "wrap_t", "border", "lod_bias", "min_lod", "max_lod",
             "base_level", "max_level"});
  Texture texture;
  texture.sampler = read_sampler(node);
  Image image = read_image(node["image"], folders, most_texels);
  texture.format = format_of_channels(image.channels);
  if (const auto n = node.find("format")) {
    texture.format = n->choice<TextureFormat>(kNamesOf<TextureFormat>);
  }
  if (const auto n = node.find("texels")) {
    texture.type = n->choice<TexelType>(kNamesOf<TexelType>);
  }
  const int levels =
      static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(image.size.width, image.size.height))));
  if (texture.sampler.base_level >= levels) {
    node["base_level"].refuse(fmt::format("one of the {} levels that the image has", levels));
  }
  return {std::move(texture), std::move(image)};
}

}  // namespace

std::vector<Texture> read_textures(const JsonNode& node, const AssetFolders& folders) {
  constexpr std::size_t kMostTextures = 64;
  if (node.value().kind != JsonValue::Kind::object) node.refuse("an object");
  if (node.value().members.size() > kMostTextures) node.refuse(fmt::format("at most {} textures", kMostTextures));
  std::vector<Texture> textures;
  std::vector<Image> images;
  std::size_t left = kMostTexels;
  for (const auto& [name, value] : node.value().members) {
    auto [texture, image] = read_texture(node[name], folders, left);
    texture.name = name;
    left -= static_cast<std::size_t>(image.size.width) * static_cast<std::size_t>(image.size.height);
    textures.push_back(std::move(texture));
    images.push_back(std::move(image));
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    TextureLevel image = images[i].make();
    const bool grey_is_alpha = textures[i].format == TextureFormat::alpha && images[i].channels == 1;
    for (glm::vec4& texel : image.texels) texel.a = grey_is_alpha ? texel.r : texel.a;
    set_levels(textures[i], std::move(image));
  }
  return textures;
}

DrawTexture read_draw_texture(const JsonNode& node, const std::vector<Texture>& textures,
                              const std::optional<DrawTexture>& of_all) {
  node.only({"name", "environment", "color"});
  DrawTexture out = of_all.value_or(DrawTexture{});
  if (!of_all || node.find("name")) {
    const JsonNode name = node["name"];
    const auto it =
        std::find_if(textures.begin(), textures.end(), [&](const Texture& t) { return t.name == name.text(); });
    if (it == textures.end()) name.refuse("the name of one of the scene's textures");
    out.texture = static_cast<std::uint32_t>(it - textures.begin());
  }
  const auto environment = node.find("environment");
  if (environment) {
    out.environment = environment->choice<TextureEnvironment>(kNamesOf<TextureEnvironment>);
  }
  const TextureFormat format = textures[out.texture].format;
  if (out.environment == TextureEnvironment::decal && format != TextureFormat::rgb && format != TextureFormat::rgba) {
    (environment ? *environment : node)
        .refuse("decal with a texture of rgb or rgba alone: of others OpenGL leaves it undefined");
  }
  if (const auto n = node.find("color")) out.color = glm::vec4(n->vector<4>(0, 1));
  return out;
}

}  // namespace plumbline
