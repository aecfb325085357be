#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "scene/mesh/import/mesh_check.h"
#include "scene/mesh/import/refuse.h"

namespace plumbline {
namespace {

// Numbers of the file are little-endian; so are those of every machine that plumbline runs on.
static_assert(std::endian::native == std::endian::little);

template <std::size_t N>
std::array<std::uint32_t, N> numbers(std::string_view bytes, std::size_t at) {
  std::array<std::uint32_t, N> out;
  if (at + sizeof out > bytes.size()) {
    refuse("a whole binary glTF file", fmt::format("its end at byte {} of {}", bytes.size(), at + sizeof out));
  }
  std::memcpy(out.data(), bytes.data() + at, sizeof out);
  return out;
}

}  // namespace

void check_glb(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) refuse("a binary glTF file, beginning with glTF", "another beginning");
  const auto [version, length] = numbers<2>(bytes, 4);
  if (version != 2) refuse("binary glTF of version 2", fmt::format("version {}", version));
  if (length > bytes.size()) {
    refuse(fmt::format("a length of at most {} bytes in the header, the file's", bytes.size()),
           fmt::format("{}", length));
  }
  std::size_t at = 12;
  do {
    const std::size_t size = numbers<2>(bytes, at)[0], left = bytes.size() - (at += 8);
    if (size > left) refuse(fmt::format("a chunk of at most {} bytes at byte {}", left, at), fmt::format("{}", size));
    at += (size + 3) / 4 * 4;
  } while (at < length);
}

}  // namespace plumbline
