// One stage of the pipeline alone, on the records of a capture; and conversions of records from double to the
// pipeline's float (from float to double: pipeline/recorder.h).
#pragma once

#include "capture/capture.h"
#include "pipeline/frame.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Runs the stage (any but resolve) on what `in` holds of the stages before it (Renderer::run_stage). Replaces the
/// records of `out` by the stage's, and sets the stage's planes. Where `in` has no lights, the scene's are used. Throws
/// std::invalid_argument, naming the records of `in` that do not fit.
void run_stage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out);

/// Records rounded to float.
Matrices<float> narrow(const Matrices<double>& from);
Vertex<float> narrow(const Vertex<double>& from);

/// Copies colour, depth and stencil of the frame into `to`. Codes of colour and depth become code / largest code,
/// [0,1]; floats and stencil values stay.
void copy_planes(const Frame& frame, const FrameFormat& format, Planes& to);

/// Attributes of vertex `i` (records.lit and the varyings); polygon `i` of records.polygons; triangle `i` of
/// records.triangles. Rounded to float; a varying that the records lack is 0. Only triangle_at() checks `i`
/// (std::out_of_range).
Attributes attributes_at(const Records<double>& records, std::size_t i);
Polygon polygon_at(const Records<double>& records, std::size_t i);
ShadedTriangle triangle_at(const Records<double>& records, std::size_t i);

}  // namespace plumbline::pipeline
