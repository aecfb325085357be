#include "state.h"

#include <array>

#include <draw_frag.h>  // of gpu/draw.glsl, made by glslangValidator
#include <draw_vert.h>

namespace {

vk::raii::ShaderModule make_module(const Device& device, const std::uint32_t* code, std::size_t bytes) {
  return {device.device, vk::ShaderModuleCreateInfo{.codeSize = bytes, .pCode = code}};
}

vk::raii::DescriptorSetLayout make_set(const Device& device) {
  constexpr auto kBoth = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
  const std::array bindings = {
      vk::DescriptorSetLayoutBinding{0, vk::DescriptorType::eUniformBuffer, 1, kBoth},
      vk::DescriptorSetLayoutBinding{1, vk::DescriptorType::eCombinedImageSampler, 1, kBoth},
  };
  return {device.device,
          vk::DescriptorSetLayoutCreateInfo{.bindingCount = bindings.size(), .pBindings = bindings.data()}};
}

vk::raii::PipelineLayout make_layout(const Device& device, const vk::raii::DescriptorSetLayout& set) {
  const vk::DescriptorSetLayout plain = *set;
  return {device.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &plain}};
}

constexpr const char* kCompares = "never|less|equal|less_equal|greater|not_equal|greater_equal|always";
constexpr const char* kFactors =
    "zero|one|source_color|one_minus_source_color|destination_color|one_minus_destination_color|source_alpha|"
    "one_minus_source_alpha|destination_alpha|one_minus_destination_alpha|constant_color|one_minus_constant_color|"
    "constant_alpha|one_minus_constant_alpha|source_alpha_saturate";

// The enumerator whose place in Vulkan's enumeration is the word's place among `words`.
template <class E, class... Path>
E chosen(const PlScene* scene, const char* words, const char* format, Path... path) {
  return static_cast<E>(pl_choice(scene, words, format, path...));
}

vk::StencilOpState stencil_face(const PlScene* scene, int draw, const char* face) {
  const auto op = [&](const char* when) {
    return chosen<vk::StencilOp>(scene, "keep|zero|replace|increment|decrement|invert|increment_wrap|decrement_wrap",
                                 "draws.%d.stencil.%s.%s", draw, face, when);
  };
  const auto number = [&](const char* what) {
    return static_cast<std::uint32_t>(pl_number(scene, "draws.%d.stencil.%s.%s", draw, face, what));
  };
  return {.failOp = op("fail"),
          .passOp = op("pass"),
          .depthFailOp = op("depth_fail"),
          .compareOp = chosen<vk::CompareOp>(scene, kCompares, "draws.%d.stencil.%s.func", draw, face),
          .compareMask = number("mask"),
          .writeMask = number("write_mask"),
          .reference = number("reference")};
}

vk::PipelineDepthStencilStateCreateInfo depth_stencil(const PlScene* scene, int draw) {
  vk::PipelineDepthStencilStateCreateInfo out{
      .depthTestEnable = true,
      .depthWriteEnable = pl_number(scene, "draws.%d.depth_mask", draw) != 0,
      .depthCompareOp = chosen<vk::CompareOp>(scene, kCompares, "draws.%d.depth_func", draw)};
  if (pl_has(scene, "draws.%d.stencil", draw)) {
    out.stencilTestEnable = true;
    out.front = stencil_face(scene, draw, "front");
    out.back = stencil_face(scene, draw, "back");
  }
  return out;
}

vk::PipelineColorBlendAttachmentState blend_of(const PlScene* scene, int draw) {
  vk::PipelineColorBlendAttachmentState out;
  for (int c = 0; c < 4; ++c) {
    if (pl_number(scene, "draws.%d.color_mask.%d", draw, c) != 0) {
      out.colorWriteMask |= static_cast<vk::ColorComponentFlagBits>(1 << c);
    }
  }
  // A logic op is in the place of blending (OpenGL 2.1 specification, 4.1.10).
  if (!pl_has(scene, "draws.%d.blend", draw) || pl_has(scene, "draws.%d.logic_op", draw)) return out;
  const auto factor = [&](const char* of, const char* which) {
    return chosen<vk::BlendFactor>(scene, kFactors, "draws.%d.blend.%s.%s", draw, of, which);
  };
  const auto equation = [&](const char* of) {
    return chosen<vk::BlendOp>(scene, "add|subtract|reverse_subtract|min|max", "draws.%d.blend.%s.equation", draw, of);
  };
  out.blendEnable = true;
  out.srcColorBlendFactor = factor("rgb", "source");
  out.dstColorBlendFactor = factor("rgb", "destination");
  out.colorBlendOp = equation("rgb");
  out.srcAlphaBlendFactor = factor("alpha", "source");
  out.dstAlphaBlendFactor = factor("alpha", "destination");
  out.alphaBlendOp = equation("alpha");
  return out;
}

vk::PipelineRasterizationStateCreateInfo rasterization(const PlScene* scene, int draw) {
  const auto mode = [&](const char* face) {
    return chosen<vk::PolygonMode>(scene, "fill|line|point", "draws.%d.%s_mode", draw, face);
  };
  if (mode("front") != mode("back")) pl_unsupported("polygon modes that differ by face");
  return {.depthClampEnable = pl_number(scene, "frame.depth_clamp") != 0,
          .polygonMode = mode("front"),
          .cullMode =
              vk::CullModeFlags(static_cast<std::uint32_t>(pl_choice(scene, "none|front|back", "draws.%d.cull", draw))),
          .frontFace = vk::FrontFace::eClockwise,  // row 0 is the lowest: Vulkan's y runs the other way
          .depthBiasEnable = true,
          .depthBiasConstantFactor = static_cast<float>(pl_number(scene, "draws.%d.polygon_offset.units", draw)),
          .depthBiasSlopeFactor = static_cast<float>(pl_number(scene, "draws.%d.polygon_offset.factor", draw)),
          .lineWidth = static_cast<float>(pl_number(scene, "draws.%d.line_width", draw))};
}

vk::Rect2D scissor_of(const PlScene* scene, int draw) {
  double box[4] = {0, 0, pl_number(scene, "frame.width"), pl_number(scene, "frame.height")};
  if (pl_has(scene, "draws.%d.scissor", draw)) pl_numbers(scene, box, 4, "draws.%d.scissor", draw);
  return {{static_cast<std::int32_t>(box[0]), static_cast<std::int32_t>(box[1])},
          {static_cast<std::uint32_t>(box[2]), static_cast<std::uint32_t>(box[3])}};
}

}  // namespace

Targets targets_of(const PlScene* scene) {
  constexpr vk::Format kColors[] = {vk::Format::eR8G8B8A8Unorm, vk::Format::eR16G16B16A16Unorm,
                                    vk::Format::eR32G32B32A32Sfloat};
  constexpr double kColorCodes[] = {255, 65535, 0}, kDepthCodes[] = {65535, 16777215, 0};
  constexpr vk::Format kDepths[] = {vk::Format::eD16Unorm, vk::Format::eD24UnormS8Uint, vk::Format::eD32SfloatS8Uint};
  const int color = pl_choice(scene, "rgba8|rgba16|rgba32f", "frame.color");
  const int depth = pl_choice(scene, "z16|z24|z32f", "frame.depth");
  const bool wants_stencil = !pl_is(scene, "none", "frame.stencil");
  if (depth == 0 && wants_stencil) pl_unsupported("z16 with stencil");
  Targets out{kColors[color], kDepths[depth], vk::ImageAspectFlagBits::eDepth, kColorCodes[color], kDepthCodes[depth]};
  if (depth != 0) out.depth_aspect |= vk::ImageAspectFlagBits::eStencil;
  return out;
}

Shaders::Shaders(const Device& device)
    : vertex(make_module(device, draw_vert, sizeof draw_vert)),
      fragment(make_module(device, draw_frag, sizeof draw_frag)),
      set(make_set(device)),
      layout(make_layout(device, set)) {}

vk::raii::Pipeline make_pipeline(const Device& device, const Shaders& shaders, const PlScene* scene, int draw,
                                 const Targets& targets) {
  const std::array stages = {
      vk::PipelineShaderStageCreateInfo{
          .stage = vk::ShaderStageFlagBits::eVertex, .module = *shaders.vertex, .pName = "main"},
      vk::PipelineShaderStageCreateInfo{
          .stage = vk::ShaderStageFlagBits::eFragment, .module = *shaders.fragment, .pName = "main"},
  };
  const vk::VertexInputBindingDescription binding{0, kVertexFloats * sizeof(float), vk::VertexInputRate::eVertex};
  std::array<vk::VertexInputAttributeDescription, kVertexFloats / 4> attributes;
  for (std::uint32_t i = 0; i < attributes.size(); ++i) {
    attributes[i] = {i, 0, vk::Format::eR32G32B32A32Sfloat, static_cast<std::uint32_t>(i * 4 * sizeof(float))};
  }
  const vk::PipelineVertexInputStateCreateInfo input{.vertexBindingDescriptionCount = 1,
                                                     .pVertexBindingDescriptions = &binding,
                                                     .vertexAttributeDescriptionCount = attributes.size(),
                                                     .pVertexAttributeDescriptions = attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{
      .topology =
          chosen<vk::PrimitiveTopology>(scene, "points|lines|line strips|triangles", "draws.%d.topology", draw)};
  double range[2];
  pl_numbers(scene, range, 2, "draws.%d.depth_range", draw);
  const vk::Viewport viewport{0,
                              0,
                              static_cast<float>(pl_number(scene, "frame.width")),
                              static_cast<float>(pl_number(scene, "frame.height")),
                              static_cast<float>(range[0]),
                              static_cast<float>(range[1])};
  const vk::Rect2D scissor = scissor_of(scene, draw);
  const vk::PipelineViewportDepthClipControlCreateInfoEXT gl_depth{.negativeOneToOne = true};
  const vk::PipelineViewportStateCreateInfo viewports{
      .pNext = &gl_depth, .viewportCount = 1, .pViewports = &viewport, .scissorCount = 1, .pScissors = &scissor};
  vk::PipelineRasterizationLineStateCreateInfoEXT lines{.lineRasterizationMode =
                                                            vk::LineRasterizationModeEXT::eBresenham};
  const vk::PipelineRasterizationDepthClipStateCreateInfoEXT clip{
      .pNext = &lines, .depthClipEnable = pl_number(scene, "frame.depth_clamp") == 0};
  vk::PipelineRasterizationStateCreateInfo raster = rasterization(scene, draw);
  raster.pNext = &clip;
  const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
  const vk::PipelineDepthStencilStateCreateInfo depth = depth_stencil(scene, draw);
  const vk::PipelineColorBlendAttachmentState attachment = blend_of(scene, draw);
  vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &attachment};
  if (pl_has(scene, "draws.%d.blend", draw)) {
    for (int c = 0; c < 4; ++c)
      blend.blendConstants[c] = static_cast<float>(pl_number(scene, "draws.%d.blend.color.%d", draw, c));
  }
  if (pl_has(scene, "draws.%d.logic_op", draw)) {
    if (targets.color_codes == 0) pl_unsupported("logic op of float colours");
    blend.logicOpEnable = true;
    blend.logicOp = chosen<vk::LogicOp>(scene,
                                        "clear|and|and_reverse|copy|and_inverted|noop|xor|or|nor|equivalent|invert|or_"
                                        "reverse|copy_inverted|or_inverted|"
                                        "nand|set",
                                        "draws.%d.logic_op", draw);
  }
  const vk::PipelineRenderingCreateInfo formats{
      .colorAttachmentCount = 1,
      .pColorAttachmentFormats = &targets.color,
      .depthAttachmentFormat = targets.depth,
      .stencilAttachmentFormat =
          targets.depth_aspect & vk::ImageAspectFlagBits::eStencil ? targets.depth : vk::Format()};
  return {device.device, nullptr,
          vk::GraphicsPipelineCreateInfo{.pNext = &formats,
                                         .stageCount = stages.size(),
                                         .pStages = stages.data(),
                                         .pVertexInputState = &input,
                                         .pInputAssemblyState = &assembly,
                                         .pViewportState = &viewports,
                                         .pRasterizationState = &raster,
                                         .pMultisampleState = &one_sample,
                                         .pDepthStencilState = &depth,
                                         .pColorBlendState = &blend,
                                         .layout = *shaders.layout}};
}

vk::raii::Sampler make_sampler(const Device& device, const PlScene* scene, int texture) {
  const int min = pl_choice(scene,
                            "nearest|linear|nearest_mipmap_nearest|linear_mipmap_nearest|nearest_mipmap_linear|"
                            "linear_mipmap_linear",
                            "textures.%d.min", texture);
  const auto wrap = [&](const char* axis) {
    return chosen<vk::SamplerAddressMode>(scene, "repeat|mirrored_repeat|clamp_to_edge|clamp_to_border",
                                          "textures.%d.wrap_%s", texture, axis);
  };
  vk::SamplerCustomBorderColorCreateInfoEXT border{};
  for (int c = 0; c < 4; ++c) {
    border.customBorderColor.float32[c] = static_cast<float>(pl_number(scene, "textures.%d.border.%d", texture, c));
  }
  const auto limit = [&](const char* which) {
    return static_cast<float>(pl_number(scene, "textures.%d.%s_lod", texture, which));
  };
  constexpr float kOneLevel = 0.25f;  // Vulkan has no filter of one level: the specification says what stands for it
  return {device.device, vk::SamplerCreateInfo{
                             .pNext = &border,
                             .magFilter = chosen<vk::Filter>(scene, "nearest|linear", "textures.%d.mag", texture),
                             .minFilter = min % 2 == 1 ? vk::Filter::eLinear : vk::Filter::eNearest,
                             .mipmapMode = min >= 4 ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
                             .addressModeU = wrap("s"),
                             .addressModeV = wrap("t"),
                             .addressModeW = vk::SamplerAddressMode::eRepeat,
                             .minLod = min < 2 ? 0 : limit("min"),
                             .maxLod = min < 2 ? kOneLevel : limit("max"),
                             .borderColor = vk::BorderColor::eFloatCustomEXT}};
}
