#include "report/text/comparison_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace plumbline::report {

using Json = nlohmann::ordered_json;

Json json_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

Json worst_json(const check::Worst& worst) {
  Json out{{"place", check::to_string(worst.place)},
           {"candidate", json_number(worst.candidate)},
           {"reference", json_number(worst.reference)},
           {"difference", json_number(worst.difference)},
           {"tolerance", json_number(worst.tolerance)}};
  if (worst.place.x >= 0) out["pixel"] = {worst.place.x, worst.place.y};
  return out;
}

Json comparison_json(const check::Comparison& c) {
  const check::Measurement& m = c.measurement;
  Json out{{"scene", c.scene},
           {"reference", c.judge.reference},
           {"kind", name_of(c.judge.kind)},
           {"title", title_of(c.judge)},
           {"stage", name_of(c.stage)},
           {"outcome", name_of(c.outcome)},
           {"pixels", m.items},
           {"differing", m.differing},
           {"ambiguous", m.ambiguous},
           {"max_difference", json_number(m.max_difference)},
           {"unit", m.unit},
           {"worst", m.max_difference > 0 ? worst_json(m.worst) : Json(nullptr)},
           {"disputed", m.disputed},
           {"max_ratio", json_number(m.max_ratio)},
           {"histogram", m.histogram}};
  if (m.disputed > 0) {
    out["dispute"] = worst_json(m.dispute);
    out["dispute"]["reason"] = m.reason;
  }
  if (!c.ledger_row.empty()) out["ledger"] = c.ledger_row;
  if (!c.note.empty()) out["note"] = c.note;
  return out;
}

}  // namespace plumbline::report
