#include "faults/fault.h"

namespace plumbline::faults {

pipeline::Stages Fault::stages() const {
  Table table = production();
  apply(table);
  return stages_of(table);
}

}  // namespace plumbline::faults
