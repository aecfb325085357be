// Which records a request asks for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "stages/renderer.h"

namespace plumbline::exact {

/// A request, made ready to be asked per fragment.
class Selection {
 public:
  Selection(const Scene& scene, const Request& request);

  bool primitive(std::uint32_t number) const;
  /// Whether any fragment's records (stages 5 to 10) are asked for, and of the pixel's.
  bool fragments() const { return bytes_per_fragment() > 0; }
  bool pixel(int x, int y) const { return pixels_.empty() || pixels_(x, y) != 0; }
  std::size_t bytes_per_fragment() const;

  /// Appends a fragment to those of the records that are asked for.
  void add(const Covered& covered, double depth, const glm::dvec4& color, bool drawn, Records<double>& out) const;
  void reserve(std::size_t fragments, Records<double>& out) const;

  /// Takes what is not asked for out of the records of stages 0 to 4.
  void prune(Records<double>& records) const;

 private:
  const Request& request_;
  Plane<std::uint8_t> pixels_;  // empty: all
};

/// The bytes that the records of stages 0 to 4 take.
std::size_t geometry_bytes(const Records<double>& records);

}  // namespace plumbline::exact
