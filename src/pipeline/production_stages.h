// The pipeline's own stage functions: those of this folder and of the kernels.
#pragma once

#include "pipeline/stages.h"

namespace plumbline::pipeline {

Stages production_stages();

}  // namespace plumbline::pipeline
