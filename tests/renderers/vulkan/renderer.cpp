// Vulkan as plumb runs it: by plumbline's kit, each scene becomes draws of a frame without a window.
#include <cmath>
#include <cstring>
#include <vector>

#include "device.h"
#include "kit/plumbline.h"
#include "state.h"

namespace {

constexpr double kMostVertices = 1'000'000;

// As draw.glsl has it.
struct Uniforms {
  float environment_color[4], fog_color[4], fog_range[4];
  std::int32_t fog_mode, environment, texture_format, separate_specular, alpha_func;
  float alpha_reference, point_size, lod_bias;
};

Uniforms uniforms_of(const PlScene* s, int i) {
  Uniforms out{};
  const auto number = [&](const char* path) { return static_cast<float>(pl_number(s, "draws.%d.%s", i, path)); };
  out.alpha_func = 7;
  out.point_size = number("point_size");
  out.separate_specular = number("lit") != 0 && pl_number(s, "light_model.separate_specular") != 0;
  if (pl_has(s, "draws.%d.fog", i)) {
    out.fog_mode = 1 + pl_choice(s, "linear|exp|exp2", "draws.%d.fog.mode", i);
    for (int c = 0; c < 3; ++c) out.fog_color[c] = static_cast<float>(pl_number(s, "draws.%d.fog.color.%d", i, c));
    out.fog_range[0] = number("fog.density"), out.fog_range[1] = number("fog.start"),
    out.fog_range[2] = number("fog.end");
  }
  if (pl_has(s, "draws.%d.texture", i)) {
    const int k = static_cast<int>(number("texture.texture"));
    out.environment = 1 + pl_choice(s, "replace|modulate|decal|blend|add", "draws.%d.texture.environment", i);
    out.texture_format = pl_choice(s, "alpha|luminance|luminance_alpha|intensity|rgb|rgba", "textures.%d.format", k);
    out.lod_bias = static_cast<float>(pl_number(s, "textures.%d.lod_bias", k));
    for (int c = 0; c < 4; ++c) {
      out.environment_color[c] = static_cast<float>(pl_number(s, "draws.%d.texture.color.%d", i, c));
    }
  }
  if (pl_has(s, "draws.%d.alpha_test", i)) {
    out.alpha_func = pl_choice(s, "never|less|equal|less_equal|greater|not_equal|greater_equal|always",
                               "draws.%d.alpha_test.func", i);
    out.alpha_reference = number("alpha_test.reference");
  }
  return out;
}

// The corners of all primitives, one after the other: a flat one has its last corner's colours.
Buffer corners_of(const Device& device, const PlScene* s, int i, std::uint32_t& count) {
  const int mesh = static_cast<int>(pl_number(s, "draws.%d.mesh", i));
  const auto first = static_cast<std::size_t>(pl_number(s, "draws.%d.first_vertex", i));
  const auto primitives = static_cast<std::uint32_t>(pl_number(s, "draws.%d.primitives", i));
  const int of_each = 1 + pl_choice(s, "points|lines|triangles", "draws.%d.topology", i);
  const bool flat = pl_is(s, "flat", "draws.%d.shading", i);
  const std::uint32_t* indices = pl_uints(s, NULL, "meshes.%d.indices", mesh);
  const float* p_clip = pl_floats(s, NULL, "vertex.p_clip");
  const float* p_eye = pl_floats(s, NULL, "vertex.p_eye");
  const float* texcoords = pl_floats(s, NULL, "meshes.%d.texcoords", mesh);
  const float* color = pl_floats(s, NULL, "light.color");
  const auto or_else = [&](const char* name, const float* other) {
    const float* found = pl_floats(s, NULL, "varyings.%s.vertices.value", name);
    return found != NULL ? found : other;
  };
  const float *back = or_else("back_color", color), *second = or_else("secondary", color);
  const float* colors[] = {color, back, second, or_else("back_secondary", second)};
  count = primitives * static_cast<std::uint32_t>(of_each);
  if (count > kMostVertices) pl_unsupported("more than a million corners");
  Buffer out = make_buffer(device, count * kVertexFloats * sizeof(float), vk::BufferUsageFlagBits::eVertexBuffer);
  auto* to = reinterpret_cast<float*>(out.bytes);
  for (std::uint32_t n = 0; n < primitives; ++n) {
    for (int k = 0; k < of_each; ++k, to += kVertexFloats) {
      const std::size_t at = indices[3 * n + k], lit = first + indices[3 * n + (flat ? of_each - 1 : k)];
      std::memcpy(to, p_clip + 4 * (first + at), 4 * sizeof(float));
      for (int c = 0; c < 4; ++c) std::memcpy(to + 4 * (c + 1), colors[c] + 4 * lit, 4 * sizeof(float));
      to[20] = texcoords != NULL ? texcoords[2 * at] : 0, to[21] = texcoords != NULL ? texcoords[2 * at + 1] : 0;
      to[22] = p_eye[4 * (first + at) + 2], to[23] = 0;
    }
  }
  return out;
}

struct Texture {
  Image image;
  vk::raii::Sampler sampler = nullptr;
};

// The levels that the texture's state lets be sampled; of no texture one texel.
Texture make_texture(const Device& device, const PlScene* s, int k) {
  const int all = static_cast<int>(pl_number(s, "textures.%d.levels", k));
  const int base = std::min(static_cast<int>(pl_number(s, "textures.%d.base_level", k)), all - 1);
  const int last = std::max(base, std::min(static_cast<int>(pl_number(s, "textures.%d.max_level", k)), all - 1));
  const auto side = [&](int level, int axis) {
    return static_cast<std::uint32_t>(pl_number(s, "textures.%d.levels.%d.%d", k, level, axis));
  };
  Texture out;
  out.image = make_image(
      device,
      {vk::Format::eR32G32B32A32Sfloat, side(base, 0), side(base, 1), static_cast<std::uint32_t>(last - base + 1),
       vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, vk::ImageAspectFlagBits::eColor});
  out.sampler = make_sampler(device, s, k);
  std::vector<Buffer> staged;
  for (int level = base; level <= last; ++level) {
    std::size_t floats = 0;
    const float* texels = pl_floats(s, &floats, "textures.%d.%d", k, level);
    staged.push_back(make_buffer(device, floats * sizeof(float), vk::BufferUsageFlagBits::eTransferSrc));
    std::memcpy(staged.back().bytes, texels, floats * sizeof(float));
  }
  run(device, [&](const vk::raii::CommandBuffer& to) {
    using L = vk::ImageLayout;
    change_layout(to, out.image, vk::ImageAspectFlagBits::eColor, L::eUndefined, L::eTransferDstOptimal);
    for (int level = base; level <= last; ++level) {
      const vk::BufferImageCopy copy{
          .imageSubresource = {vk::ImageAspectFlagBits::eColor, static_cast<std::uint32_t>(level - base), 0, 1},
          .imageExtent = {side(level, 0), side(level, 1), 1}};
      to.copyBufferToImage(*staged[level - base].buffer, *out.image.image, L::eTransferDstOptimal, copy);
    }
    change_layout(to, out.image, vk::ImageAspectFlagBits::eColor, L::eTransferDstOptimal, L::eShaderReadOnlyOptimal);
  });
  return out;
}

struct Draw {
  Buffer uniforms, corners;
  std::uint32_t count = 0;
  vk::raii::DescriptorSet set = nullptr;
  vk::raii::Pipeline pipeline = nullptr;
};

Draw make_draw(const Device& device, const Shaders& shaders, const PlScene* s, int i, const Targets& targets,
               const vk::raii::DescriptorPool& pool, const std::vector<Texture>& textures) {
  Draw out;
  const Uniforms uniforms = uniforms_of(s, i);
  out.uniforms = make_buffer(device, sizeof uniforms, vk::BufferUsageFlagBits::eUniformBuffer);
  std::memcpy(out.uniforms.bytes, &uniforms, sizeof uniforms);
  out.corners = corners_of(device, s, i, out.count);
  out.pipeline = make_pipeline(device, shaders, s, i, targets);
  const vk::DescriptorSetLayout layout = *shaders.set;
  vk::raii::DescriptorSets sets(
      device.device,
      vk::DescriptorSetAllocateInfo{.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &layout});
  out.set = std::move(sets.front());
  const bool textured = uniforms.environment != 0;
  const Texture& texture =
      textured ? textures[static_cast<std::size_t>(pl_number(s, "draws.%d.texture.texture", i))] : textures.back();
  const vk::DescriptorBufferInfo buffer{*out.uniforms.buffer, 0, sizeof uniforms};
  const vk::DescriptorImageInfo image{*texture.sampler, *texture.image.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  const vk::WriteDescriptorSet writes[] = {{.dstSet = *out.set,
                                            .dstBinding = 0,
                                            .descriptorCount = 1,
                                            .descriptorType = vk::DescriptorType::eUniformBuffer,
                                            .pBufferInfo = &buffer},
                                           {.dstSet = *out.set,
                                            .dstBinding = 1,
                                            .descriptorCount = 1,
                                            .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                            .pImageInfo = &image}};
  device.device.updateDescriptorSets(writes, nullptr);
  return out;
}

void require_drawable(const PlScene* s) {
  if (pl_number(s, "frame.sample.0") != 0 || pl_number(s, "frame.sample.1") != 0)
    pl_unsupported("samples off the centre");
  for (int i = 0; i < static_cast<int>(pl_number(s, "draws")); ++i) {
    if (pl_number(s, "draws.%d.lit", i) != 0 && pl_is(s, "phong", "draws.%d.shading", i))
      pl_unsupported("light per fragment");
  }
}

// A texture of one white texel, for draws without one.
Texture make_blank(const Device& device) {
  Texture out;
  out.image = make_image(device, {vk::Format::eR32G32B32A32Sfloat, 1, 1, 1, vk::ImageUsageFlagBits::eSampled,
                                  vk::ImageAspectFlagBits::eColor});
  out.sampler = vk::raii::Sampler(device.device, vk::SamplerCreateInfo{});
  run(device, [&](const vk::raii::CommandBuffer& to) {
    change_layout(to, out.image, vk::ImageAspectFlagBits::eColor, vk::ImageLayout::eUndefined,
                  vk::ImageLayout::eShaderReadOnlyOptimal);
  });
  return out;
}

double depth_of(const std::byte* bytes, std::size_t pixel, const Targets& targets) {
  if (targets.depth_codes == 65535) return reinterpret_cast<const std::uint16_t*>(bytes)[pixel] / targets.depth_codes;
  if (targets.depth_codes == 0) return reinterpret_cast<const float*>(bytes)[pixel];
  return (reinterpret_cast<const std::uint32_t*>(bytes)[pixel] & 0xffffff) / targets.depth_codes;
}

float color_of(const std::byte* bytes, std::size_t at, const Targets& targets) {
  if (targets.color_codes == 255) return static_cast<float>(std::to_integer<int>(bytes[at]) / targets.color_codes);
  if (targets.color_codes == 0) return reinterpret_cast<const float*>(bytes)[at];
  return static_cast<float>(reinterpret_cast<const std::uint16_t*>(bytes)[at] / targets.color_codes);
}

void draw_scene(const PlScene* s, PlCapture* out) {
  static const Device device;
  static const Shaders shaders(device);
  require_drawable(s);
  const Targets targets = targets_of(s);
  const auto width = static_cast<std::uint32_t>(out->width), height = static_cast<std::uint32_t>(out->height);
  const std::size_t pixels = std::size_t{width} * height;
  const int count = static_cast<int>(pl_number(s, "draws"));
  std::vector<Texture> textures;
  for (int k = 0; k < static_cast<int>(pl_number(s, "textures")); ++k) textures.push_back(make_texture(device, s, k));
  textures.push_back(make_blank(device));
  const auto many = static_cast<std::uint32_t>(count);
  const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformBuffer, many},
                                          {vk::DescriptorType::eCombinedImageSampler, many}};
  const vk::raii::DescriptorPool pool(
      device.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  .maxSets = many,
                                                  .poolSizeCount = 2,
                                                  .pPoolSizes = sizes});
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) draws.push_back(make_draw(device, shaders, s, i, targets, pool, textures));

  using U = vk::ImageUsageFlagBits;
  using L = vk::ImageLayout;
  const auto kColor = vk::ImageAspectFlagBits::eColor;
  const Image color =
      make_image(device, {targets.color, width, height, 1, U::eColorAttachment | U::eTransferSrc, kColor});
  const Image depth = make_image(
      device, {targets.depth, width, height, 1, U::eDepthStencilAttachment | U::eTransferSrc, targets.depth_aspect});
  const Buffer colors = make_buffer(device, 16 * pixels, vk::BufferUsageFlagBits::eTransferDst);
  const Buffer depths = make_buffer(device, 4 * pixels, vk::BufferUsageFlagBits::eTransferDst);
  vk::ClearValue clear_color, clear_depth;
  for (int c = 0; c < 4; ++c)
    clear_color.color.float32[c] = static_cast<float>(pl_number(s, "frame.clear_color.%d", c));
  clear_depth.depthStencil =
      vk::ClearDepthStencilValue{static_cast<float>(pl_number(s, "frame.clear_depth")),
                                 static_cast<std::uint32_t>(pl_number(s, "frame.clear_stencil"))};
  const vk::RenderingAttachmentInfo to_color{.imageView = *color.view,
                                             .imageLayout = L::eGeneral,
                                             .loadOp = vk::AttachmentLoadOp::eClear,
                                             .storeOp = vk::AttachmentStoreOp::eStore,
                                             .clearValue = clear_color};
  const vk::RenderingAttachmentInfo to_depth{.imageView = *depth.view,
                                             .imageLayout = L::eGeneral,
                                             .loadOp = vk::AttachmentLoadOp::eClear,
                                             .storeOp = vk::AttachmentStoreOp::eStore,
                                             .clearValue = clear_depth};
  const bool stencil = static_cast<bool>(targets.depth_aspect & vk::ImageAspectFlagBits::eStencil);
  run(device, [&](const vk::raii::CommandBuffer& to) {
    change_layout(to, color, kColor, L::eUndefined, L::eGeneral);
    change_layout(to, depth, targets.depth_aspect, L::eUndefined, L::eGeneral);
    to.beginRendering({.renderArea = {{0, 0}, {width, height}},
                       .layerCount = 1,
                       .colorAttachmentCount = 1,
                       .pColorAttachments = &to_color,
                       .pDepthAttachment = &to_depth,
                       .pStencilAttachment = stencil ? &to_depth : nullptr});
    for (const Draw& draw : draws) {
      to.bindPipeline(vk::PipelineBindPoint::eGraphics, *draw.pipeline);
      to.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *shaders.layout, 0, *draw.set, nullptr);
      to.bindVertexBuffers(0, *draw.corners.buffer, vk::DeviceSize{0});
      to.draw(draw.count, 1, 0, 0);
    }
    to.endRendering();
    change_layout(to, color, kColor, L::eGeneral, L::eTransferSrcOptimal);
    change_layout(to, depth, targets.depth_aspect, L::eGeneral, L::eTransferSrcOptimal);
    vk::BufferImageCopy copy{.imageSubresource = {kColor, 0, 0, 1}, .imageExtent = {width, height, 1}};
    to.copyImageToBuffer(*color.image, L::eTransferSrcOptimal, *colors.buffer, copy);
    copy.imageSubresource.aspectMask = vk::ImageAspectFlagBits::eDepth;
    to.copyImageToBuffer(*depth.image, L::eTransferSrcOptimal, *depths.buffer, copy);
  });

  std::vector<float> rgba(4 * pixels);
  std::vector<double> z(pixels);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = color_of(colors.bytes, i, targets);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = depth_of(depths.bytes, i, targets);
  pl_color(out, rgba.data());
  pl_depth(out, z.data());
}

}  // namespace

int main(int argc, char** argv) { return pl_main(argc, argv, "Vulkan", draw_scene); }
