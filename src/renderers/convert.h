// Records of a capture, in double, as the pipeline's own, in float (the other way round: pipeline/recorder.h); and a
// frame as planes of a capture.
#pragma once

#include <vector>

#include "capture/capture.h"
#include "pipeline/frame.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

Matrices<float> narrow(const Matrices<double>& from);
Vertex<float> narrow(const Vertex<double>& from);

/// Colour, depth and stencil of the frame into `to`; in [0,1], where their format is one of codes.
void copy_planes(const Frame& frame, const FrameFormat& format, Planes& to);

/// Number `i` of records.vertices with the attributes beside it; of records.polygons.polygons; of records.triangles.
Attributes attributes_at(const Records<double>& records, std::size_t i);
Polygon polygon_at(const Records<double>& records, std::size_t i);
ShadedTriangle triangle_at(const Records<double>& records, std::size_t i);

}  // namespace plumbline::pipeline
