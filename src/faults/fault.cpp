#include "faults/fault.h"

#include "pipeline/stages.h"

namespace plumbline::faults {

pipeline::Stages Fault::stages() const {
  pipeline::Stages stages = pipeline::production_stages();
  apply(stages);
  return stages;
}

}  // namespace plumbline::faults
