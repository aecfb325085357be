// Selection of the records that a request asks for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "capture/renderer.h"
#include "reference/exact/surface.h"

namespace plumbline::exact {

/// A request, indexed for look-ups per fragment. The request has to outlive the selection.
class Selection {
 public:
  Selection(const Scene& scene, const Request& request);

  /// True if records of the primitive are requested.
  bool primitive(std::uint32_t number) const;
  /// True if records of stages 5 to 10 are requested: fragments(): at any pixel; pixel(): at this pixel.
  bool fragments() const { return bytes_ > 0; }
  bool pixel(int x, int y) const { return pixels_.empty() || pixels_(x, y) != 0; }
  std::size_t bytes_per_fragment() const { return bytes_; }

  struct Fragment {
    Covered covered;
    double depth;
    glm::dvec4 color;  ///< the interpolated one
    Fours fours;
    Texel<double> texel;
    glm::dvec4 shaded;
    bool drawn;
  };
  /// Appends a fragment to the requested records of stages 5 to 10.
  void add(const Fragment& fragment, Records<double>& out) const;
  void reserve(std::size_t fragments, Records<double>& out) const;

  /// Removes stages and primitives that are not requested from the records of stages 0 to 4.
  void prune(Capture& geometry) const;

 private:
  void prune_primitives(Records<double>& records) const;

  const Request& request_;
  Plane<std::uint8_t> pixels_;  // empty: all
  bool textured_;
  std::vector<Varying> varyings_;  // that fragments carry
  std::size_t bytes_;              // of one fragment's records
};

/// Memory of the records of stages 0 to 4 [bytes].
std::size_t geometry_bytes(const Capture& capture);

}  // namespace plumbline::exact
