// Records of a capture, in double, as the pipeline's own, in float. (The other way round: pipeline/recorder.h.)
#pragma once

#include <vector>

#include "capture/capture.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

Matrices<float> narrow(const Matrices<double>& from);
std::vector<LightSource<float>> narrow(const std::vector<LightSource<double>>& from);
Vertex<float> narrow(const Vertex<double>& from);
inline Color<float> narrow(const Vec4<double>& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a)};
}

/// Number `i` of records.vertices with the attributes beside it; of records.polygons.polygons; of records.triangles.
Attributes attributes_at(const Records<double>& records, std::size_t i);
Polygon polygon_at(const Records<double>& records, std::size_t i);
ShadedTriangle triangle_at(const Records<double>& records, std::size_t i);

}  // namespace plumbline::pipeline
