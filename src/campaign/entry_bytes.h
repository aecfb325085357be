// Serialisation of an entry's fields, all but the scene, by a byte archive (base/byte_archive.h).
#pragma once

#include "base/byte_archive.h"
#include "campaign/entry.h"

namespace plumbline::campaign {

template <class Archive>
void visit(Archive& archive, Signature& s) {
  visit_all(archive, s.stage, s.cause, s.reference);
}
template <class Archive>
void visit(Archive& archive, Entry& e) {
  visit_all(archive, e.found, e.disputes, e.unable, e.states, e.milliseconds);
}

}  // namespace plumbline::campaign
