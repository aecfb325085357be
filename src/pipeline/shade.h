// Stage 9: the fragment's colour, from its attributes.
#pragma once

#include "pipeline/attributes.h"

namespace plumbline::pipeline {

/// The interpolated vertex colour.
template <class R>
Color<R> shade(const Color<R>& attributes) {
  return attributes;
}

}  // namespace plumbline::pipeline
