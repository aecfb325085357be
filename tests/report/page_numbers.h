// What src/report/text/numbers.h packs, unpacked: as a page's script does it, written down a second time.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace plumbline::report {

inline std::string inflated(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int known = 0;
  for (const char c : base64.substr(0, base64.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    known += 6;
    if (known < 8) continue;
    known -= 8;
    bytes += static_cast<char>(bits >> known & 0xff);
  }
  std::string out(std::size_t{1} << 22, '\0');
  uLongf size = out.size();
  if (uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size()) != Z_OK)
    throw std::runtime_error("not deflated, or of more than 4 MiB");
  out.resize(size);
  return out;
}

/// `base`: the values that side["base"] names.
inline std::vector<std::uint32_t> unpacked(const nlohmann::json& side, const std::vector<std::uint32_t>& base = {}) {
  const std::string bytes = inflated(side["data"].get<std::string>());
  const std::size_t width = side["bytes"].get<std::size_t>(), channels = side["channels"].get<std::size_t>();
  std::vector<std::uint32_t> out(bytes.size() / width);
  for (std::size_t b = 0; b < width; ++b) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[b * out.size() + i])) << (8 * b);
  }
  const std::uint32_t all = width == 4 ? ~0u : (1u << (8 * width)) - 1;
  for (std::size_t i = channels; i < out.size(); ++i) out[i] += out[i - channels];
  const bool based = side.contains("base") && !side["base"].is_null();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (out[i] + (based ? base.at(i) : 0)) & all;
  return out;
}

}  // namespace plumbline::report
