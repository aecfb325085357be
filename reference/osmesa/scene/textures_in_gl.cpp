#include "reference/osmesa/scene/textures_in_gl.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "capture/renderer.h"

namespace plumbline::osmesa {
namespace {

GLint internal_format(TextureFormat format, TexelType type) {
  const bool codes = type == TexelType::unorm8;
  switch (format) {
    case TextureFormat::alpha: return codes ? GL_ALPHA8 : GL_ALPHA32F_ARB;
    case TextureFormat::luminance: return codes ? GL_LUMINANCE8 : GL_LUMINANCE32F_ARB;
    case TextureFormat::luminance_alpha: return codes ? GL_LUMINANCE8_ALPHA8 : GL_LUMINANCE_ALPHA32F_ARB;
    case TextureFormat::intensity: return codes ? GL_INTENSITY8 : GL_INTENSITY32F_ARB;
    case TextureFormat::rgb: return codes ? GL_RGB8 : GL_RGB32F;
    case TextureFormat::rgba: return codes ? GL_RGBA8 : GL_RGBA32F;
  }
  return GL_RGBA8;
}

GLint gl_filter(MinFilter filter) {
  switch (filter) {
    case MinFilter::nearest: return GL_NEAREST;
    case MinFilter::linear: return GL_LINEAR;
    case MinFilter::nearest_mipmap_nearest: return GL_NEAREST_MIPMAP_NEAREST;
    case MinFilter::linear_mipmap_nearest: return GL_LINEAR_MIPMAP_NEAREST;
    case MinFilter::nearest_mipmap_linear: return GL_NEAREST_MIPMAP_LINEAR;
    case MinFilter::linear_mipmap_linear: return GL_LINEAR_MIPMAP_LINEAR;
  }
  return GL_NEAREST;
}

GLint gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat: return GL_REPEAT;
    case Wrap::mirrored_repeat: return GL_MIRRORED_REPEAT;
    case Wrap::clamp_to_edge: return GL_CLAMP_TO_EDGE;
    case Wrap::clamp_to_border: return GL_CLAMP_TO_BORDER;
  }
  return GL_REPEAT;
}

GLint gl_environment(TextureEnvironment environment) {
  switch (environment) {
    case TextureEnvironment::replace: return GL_REPLACE;
    case TextureEnvironment::modulate: return GL_MODULATE;
    case TextureEnvironment::decal: return GL_DECAL;
    case TextureEnvironment::blend: return GL_BLEND;
    case TextureEnvironment::add: return GL_ADD;
  }
  return GL_MODULATE;
}

}  // namespace

// Texture environments of the OpenGL 2.1 spec, tables 3.22 and 3.23, in GLSL.
std::string environment_of(const Scene& scene, const Draw& draw) {
  if (!draw.texture) return "";
  const TextureFormat format = scene.textures.at(draw.texture->texture).format;
  const bool has_color = format != TextureFormat::alpha, intensity = format == TextureFormat::intensity;
  const bool has_alpha = format != TextureFormat::luminance && format != TextureFormat::rgb;
  const char *rgb = "color.rgb", *alpha = "color.a * t.a";
  switch (draw.texture->environment) {
    case TextureEnvironment::replace:
      rgb = "t.rgb";
      alpha = "t.a";
      break;
    case TextureEnvironment::modulate: rgb = "color.rgb * t.rgb"; break;
    case TextureEnvironment::decal:
      rgb = format == TextureFormat::rgb ? "t.rgb" : "mix(color.rgb, t.rgb, t.a)";
      alpha = "color.a";
      break;
    case TextureEnvironment::blend:
      rgb = "mix(color.rgb, gl_TextureEnvColor[0].rgb, t.rgb)";
      if (intensity) alpha = "mix(color.a, gl_TextureEnvColor[0].a, t.a)";
      break;
    case TextureEnvironment::add:
      rgb = "clamp(color.rgb + t.rgb, 0.0, 1.0)";
      if (intensity) alpha = "clamp(color.a + t.a, 0.0, 1.0)";
      break;
  }
  return fmt::format("  vec4 t = texture2D(image, gl_TexCoord[0].st);\n  color = vec4({}, {});\n",
                     has_color ? rgb : "color.rgb", has_alpha ? alpha : "color.a");
}

TexturesInGl::TexturesInGl(const Gl& gl, const Scene& scene) : gl_(gl), scene_(scene), names_(scene.textures.size()) {
  const int largest = limit(gl, GL_MAX_TEXTURE_SIZE);
  gl.GenTextures(static_cast<GLsizei>(names_.size()), names_.data());
  try {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Texture& texture = scene.textures[i];
      if (texture.levels.at(0).width > largest || texture.levels[0].height > largest) {
        throw RendererFailed(fmt::format("OpenGL: a texture of {} x {} texels; its largest is {}",
                                         texture.levels[0].width, texture.levels[0].height, largest));
      }
      gl.BindTexture(GL_TEXTURE_2D, names_[i]);
      upload(texture);
      check(gl, "uploading a texture");
    }
  } catch (...) {
    gl.DeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
    throw;
  }
  gl.BindTexture(GL_TEXTURE_2D, 0);
}

TexturesInGl::~TexturesInGl() { gl_.DeleteTextures(static_cast<GLsizei>(names_.size()), names_.data()); }

void TexturesInGl::upload(const Texture& texture) const {
  const Sampler& s = texture.sampler;
  for (std::size_t i = 0; i < texture.levels.size(); ++i) {
    const TextureLevel& level = texture.levels[i];
    // GL takes the format's components from the source components: luminance and intensity from red, alpha from alpha.
    gl_.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), internal_format(texture.format, texture.type), level.width,
                   level.height, 0, GL_RGBA, GL_FLOAT, level.texels.data());
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, gl_filter(s.min));
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, s.mag == MagFilter::linear ? GL_LINEAR : GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(s.wrap_s));
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(s.wrap_t));
  gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, glm::value_ptr(s.border));
  gl_.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, s.lod_bias);
  gl_.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_LOD, s.min_lod);
  gl_.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_LOD, s.max_lod);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, s.base_level);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, s.max_level);
}

void TexturesInGl::set(const Draw& draw) const {
  if (!draw.texture) return gl_.Disable(GL_TEXTURE_2D);
  gl_.Enable(GL_TEXTURE_2D);
  gl_.BindTexture(GL_TEXTURE_2D, names_.at(draw.texture->texture));
  gl_.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, gl_environment(draw.texture->environment));
  gl_.TexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, glm::value_ptr(draw.texture->color));
}

void TexturesInGl::set_source(const Draw& draw) const {
  set(draw);
  gl_.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
}

}  // namespace plumbline::osmesa
