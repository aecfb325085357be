// Between the pipeline's floats and the doubles of a capture.
#pragma once

#include "capture/renderer.h"
#include "pipeline/attributes.h"

namespace plumbline::pipeline {

/// Copies the records of stages 0 to 4 that the request names, of the primitives that it names.
void widen_geometry(const Records<float>& from, const Request& request, Records<double>& to);

/// The bytes that those copies take, if all primitives are named.
std::size_t widened_bytes(const Records<float>& from, const Request& request);

/// Stages 0 to 4 (each value was a float before, or is rounded to one now).
Records<float> narrow(const Records<double>& from);
WindowTriangle<float> narrow(const WindowTriangle<double>& from);
std::vector<LightSource<float>> narrow(const std::vector<LightSource<double>>& from);

inline Vec4<double> widen(const Color<float>& c) { return {c.r, c.g, c.b, c.a}; }
inline Color<float> color_of(const Vec4<double>& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a)};
}

}  // namespace plumbline::pipeline
