// A draw's state in the export as a pipeline and a sampler of Vulkan.
#pragma once

#include "device.h"
#include "kit/plumbline.h"

struct Targets {
  vk::Format color, depth;
  vk::ImageAspectFlags depth_aspect;  // with stencil or without
  double color_codes, depth_codes;    // 0: float
};
// Throws what the kit throws where the device has no such format.
Targets targets_of(const PlScene* scene);

struct Shaders {
  explicit Shaders(const Device& device);
  vk::raii::ShaderModule vertex, fragment;
  vk::raii::DescriptorSetLayout set;
  vk::raii::PipelineLayout layout;
};

// Floats of a vertex as shaders read it: six vectors of four.
inline constexpr std::uint32_t kVertexFloats = 24;

vk::raii::Pipeline make_pipeline(const Device& device, const Shaders& shaders, const PlScene* scene, int draw,
                                 const Targets& targets);
vk::raii::Sampler make_sampler(const Device& device, const PlScene* scene, int texture);
