// One stage of the pipeline alone, on the records of a capture; and what these records, in double, are in the pipeline's
// own float (the other way round: pipeline/recorder.h).
#pragma once

#include "capture/capture.h"
#include "pipeline/frame.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Adds the stage's records and planes to `out`, made of what `in` holds of the stages before (Renderer::run_stage).
/// Throws std::invalid_argument naming the records that do not fit. Not of resolve.
void run_stage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out);

Matrices<float> narrow(const Matrices<double>& from);
Vertex<float> narrow(const Vertex<double>& from);

/// Colour, depth and stencil of the frame into `to`; in [0,1], where their format is one of codes.
void copy_planes(const Frame& frame, const FrameFormat& format, Planes& to);

/// Number `i` of records.vertices with the attributes beside it; of records.polygons.polygons; of records.triangles.
Attributes attributes_at(const Records<double>& records, std::size_t i);
Polygon polygon_at(const Records<double>& records, std::size_t i);
ShadedTriangle triangle_at(const Records<double>& records, std::size_t i);

}  // namespace plumbline::pipeline
