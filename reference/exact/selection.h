// Which records a request asks for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "capture/renderer.h"
#include "reference/exact/surface.h"

namespace plumbline::exact {

/// A request, made ready to be asked per fragment.
class Selection {
 public:
  Selection(const Scene& scene, const Request& request);

  bool primitive(std::uint32_t number) const;
  /// fragments(): whether records of stages 5 to 10 are asked for. pixel(): whether those of this pixel are.
  bool fragments() const { return bytes_per_fragment() > 0; }
  bool pixel(int x, int y) const { return pixels_.empty() || pixels_(x, y) != 0; }
  std::size_t bytes_per_fragment() const;

  struct Fragment {
    Covered covered;
    double depth;
    glm::dvec4 color;  ///< the interpolated one
    Fours fours;
    Texel<double> texel;
    glm::dvec4 shaded;
    bool drawn;
  };
  /// Appends a fragment to those of the records that are asked for.
  void add(const Fragment& fragment, Records<double>& out) const;
  void reserve(std::size_t fragments, Records<double>& out) const;

  /// Takes what is not asked for out of the records of stages 0 to 4.
  void prune(Records<double>& records) const;

 private:
  void prune_primitives(Records<double>& records) const;

  const Request& request_;
  Plane<std::uint8_t> pixels_;  // empty: all
  bool textured_;
  std::vector<Varying> varyings_;  // that fragments carry
};

/// The bytes that the records of stages 0 to 4 take.
std::size_t geometry_bytes(const Records<double>& records);

}  // namespace plumbline::exact
