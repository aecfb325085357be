#include "device.h"

#include <array>
#include <stdexcept>

namespace {

vk::raii::Instance make_instance(const vk::raii::Context& context) {
  const vk::ApplicationInfo application{.apiVersion = VK_API_VERSION_1_3};
  return {context, vk::InstanceCreateInfo{.pApplicationInfo = &application}};
}

vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance) {
  vk::raii::PhysicalDevices all(instance);
  if (all.empty()) throw std::runtime_error("no Vulkan device: mesa-vulkan-drivers has lavapipe");
  for (vk::raii::PhysicalDevice& one : all) {
    if (one.getProperties().deviceType == vk::PhysicalDeviceType::eCpu) return std::move(one);
  }
  return std::move(all.front());
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical) {
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = 0, .queueCount = 1, .pQueuePriorities = &priority};
  const std::array extensions = {VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME, VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME,
                                 VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME, VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME};
  vk::PhysicalDeviceLineRasterizationFeaturesEXT lines{.bresenhamLines = true};
  vk::PhysicalDeviceCustomBorderColorFeaturesEXT borders{
      .pNext = &lines, .customBorderColors = true, .customBorderColorWithoutFormat = true};
  vk::PhysicalDeviceDepthClipEnableFeaturesEXT clip_enable{.pNext = &borders, .depthClipEnable = true};
  vk::PhysicalDeviceDepthClipControlFeaturesEXT clip_control{.pNext = &clip_enable, .depthClipControl = true};
  vk::PhysicalDeviceVulkan13Features of_1_3{.pNext = &clip_control, .synchronization2 = true, .dynamicRendering = true};
  const vk::PhysicalDeviceFeatures2 features{.pNext = &of_1_3,
                                             .features = {.logicOp = true,
                                                          .depthClamp = true,
                                                          .depthBiasClamp = true,
                                                          .fillModeNonSolid = true,
                                                          .wideLines = true,
                                                          .largePoints = true}};
  return {physical, vk::DeviceCreateInfo{.pNext = &features,
                                         .queueCreateInfoCount = 1,
                                         .pQueueCreateInfos = &queue,
                                         .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                         .ppEnabledExtensionNames = extensions.data()}};
}

// Memory that the processor sees, which a device on the processor always has.
vk::raii::DeviceMemory allocate(const Device& device, const vk::MemoryRequirements& need) {
  constexpr auto kSeen = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
  const vk::PhysicalDeviceMemoryProperties memory = device.physical.getMemoryProperties();
  for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if ((need.memoryTypeBits >> type & 1) == 0 || (memory.memoryTypes[type].propertyFlags & kSeen) != kSeen) continue;
    return {device.device, vk::MemoryAllocateInfo{.allocationSize = need.size, .memoryTypeIndex = type}};
  }
  throw std::runtime_error("the Vulkan device has no memory that the processor sees");
}

}  // namespace

Device::Device()
    : instance(make_instance(context)),
      physical(choose(instance)),
      device(make_device(physical)),
      queue(device, 0, 0),
      commands(device, vk::CommandPoolCreateInfo{.queueFamilyIndex = 0}) {}

Buffer make_buffer(const Device& device, std::size_t bytes, vk::BufferUsageFlags usage) {
  Buffer out;
  out.buffer =
      vk::raii::Buffer(device.device, vk::BufferCreateInfo{.size = std::max<std::size_t>(bytes, 1), .usage = usage});
  out.memory = allocate(device, out.buffer.getMemoryRequirements());
  out.buffer.bindMemory(*out.memory, 0);
  out.bytes = static_cast<std::byte*>(out.memory.mapMemory(0, VK_WHOLE_SIZE));
  return out;
}

Image make_image(const Device& device, const ImageShape& shape) {
  Image out;
  out.image = vk::raii::Image(device.device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                                                 .format = shape.format,
                                                                 .extent = {shape.width, shape.height, 1},
                                                                 .mipLevels = shape.levels,
                                                                 .arrayLayers = 1,
                                                                 .usage = shape.usage});
  out.memory = allocate(device, out.image.getMemoryRequirements());
  out.image.bindMemory(*out.memory, 0);
  out.view = vk::raii::ImageView(device.device,
                                 vk::ImageViewCreateInfo{.image = *out.image,
                                                         .viewType = vk::ImageViewType::e2D,
                                                         .format = shape.format,
                                                         .subresourceRange = {shape.aspect, 0, shape.levels, 0, 1}});
  return out;
}

void run(const Device& device, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  const vk::raii::CommandBuffers buffers(
      device.device, vk::CommandBufferAllocateInfo{.commandPool = *device.commands, .commandBufferCount = 1});
  const vk::raii::CommandBuffer& buffer = buffers.front();
  buffer.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(buffer);
  buffer.end();
  const vk::CommandBuffer plain = *buffer;
  const vk::SubmitInfo submitted{.commandBufferCount = 1, .pCommandBuffers = &plain};
  device.queue.submit(submitted);
  device.queue.waitIdle();
}

void change_layout(const vk::raii::CommandBuffer& to, const Image& image, vk::ImageAspectFlags aspect,
                   vk::ImageLayout from, vk::ImageLayout into) {
  constexpr auto kAll = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
  const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                        .srcAccessMask = kAll,
                                        .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                        .dstAccessMask = kAll,
                                        .oldLayout = from,
                                        .newLayout = into,
                                        .image = *image.image,
                                        .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}};
  to.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}
