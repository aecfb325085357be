// A Vulkan device without a window: memory, images, and commands that are waited for.
#pragma once

#include <cstddef>
#include <functional>

#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

struct Device {
  Device();  // the first processor without a GPU: lavapipe; without one, the first at all
  vk::raii::Context context;
  vk::raii::Instance instance;
  vk::raii::PhysicalDevice physical;
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool commands;
};

struct Buffer {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Buffer buffer = nullptr;
  std::byte* bytes = nullptr;  // mapped
};
Buffer make_buffer(const Device& device, std::size_t bytes, vk::BufferUsageFlags usage);

struct ImageShape {
  vk::Format format;
  std::uint32_t width, height, levels;
  vk::ImageUsageFlags usage;
  vk::ImageAspectFlags aspect;
};
struct Image {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Image image = nullptr;
  vk::raii::ImageView view = nullptr;
};
Image make_image(const Device& device, const ImageShape& shape);

// Records commands, and waits until they have run.
void run(const Device& device, const std::function<void(const vk::raii::CommandBuffer&)>& record);

// Brings all levels of an image into another layout, after all commands before.
void change_layout(const vk::raii::CommandBuffer& to, const Image& image, vk::ImageAspectFlags aspect,
                   vk::ImageLayout from, vk::ImageLayout into);
