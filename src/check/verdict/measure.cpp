#include "check/verdict/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace plumbline::check {

namespace {

constexpr std::size_t kMostPlaces = 1u << 16;

std::size_t bucket(double diff) {
  if (diff == 0) return 0;
  if (!std::isfinite(diff)) return 19;
  return static_cast<std::size_t>(std::clamp(std::ilogb(diff) + 13, 1, 18));
}

}  // namespace

std::string to_string(const Place& place) {
  std::string out;
  if (place.x >= 0) out = fmt::format("pixel {},{}", place.x, place.y);
  if (place.record >= 0) {
    const char* what = place.of_primitive ? "primitive" : "record";
    out += fmt::format("{}{} {}", out.empty() ? "" : " ", what, place.record);
  }
  if (*place.field != '\0') out += fmt::format("{}{}", out.empty() ? "" : " ", place.field);
  return out;
}

double difference(double a, double b) {
  if (a == b) return 0;
  const double d = std::abs(a - b);
  return std::isfinite(a) && std::isfinite(b) ? d : kInfinite;
}

void Meter::value(double diff, double tolerance, const Place& place, double candidate, double reference,
                  double allowance) {
  if (!(diff >= 0)) diff = kInfinite;
  if (!(tolerance >= 0) || !std::isfinite(tolerance + allowance)) tolerance = allowance = 0;
  const double beyond = std::max(diff - allowance, 0.0);
  if (beyond > tolerance && !why_.empty() && std::isfinite(diff)) {
    if (!item_disputed_ && place.x >= 0) m_.disputed_at.emplace_back(place.x, place.y);
    item_disputed_ = true;
    if (diff <= m_.dispute.difference) return;
    m_.dispute = {place, candidate, reference, diff, tolerance + allowance};
    m_.reason = why_;
    return;
  }
  item_difference_ = std::max(item_difference_, diff);
  if (beyond > tolerance && !item_differs_ && place.x >= 0 && m_.differing_at.size() < kMostPlaces)
    m_.differing_at.emplace_back(place.x, place.y);
  if (beyond > tolerance) item_differs_ = true;
  if (diff == 0) return;
  const double ratio = beyond == 0 ? 0 : tolerance > 0 ? beyond / tolerance : kInfinite;
  if (ratio > m_.max_ratio || (ratio == m_.max_ratio && diff > m_.worst.difference)) {
    m_.max_ratio = ratio;
    m_.worst = {place, candidate, reference, diff, tolerance + allowance};
  }
}

void Meter::item() {
  ++m_.items;
  if (item_differs_) ++m_.differing;
  if (item_ambiguous_) ++m_.ambiguous;
  if (item_disputed_) ++m_.disputed;
  m_.max_difference = std::max(m_.max_difference, item_difference_);
  ++m_.histogram[bucket(item_difference_)];
  item_difference_ = 0;
  item_differs_ = item_ambiguous_ = item_disputed_ = false;
  why_.clear();
}

void Meter::missing(std::uint64_t items, const Place& place, std::size_t candidate, std::size_t reference) {
  for (std::uint64_t i = 0; i < items; ++i) {
    value(kInfinite, 0, place, static_cast<double>(candidate), static_cast<double>(reference));
    item();
  }
}

std::string to_string(const Worst& w, std::string_view expected, std::string_view unit) {
  std::string out = fmt::format("{}: {:.9g}, {} {:.9g}", to_string(w.place), w.candidate, expected, w.reference);
  if (std::isfinite(w.difference))
    out += fmt::format(", {:.4g} {} apart, tolerance {:.4g}", w.difference, unit, w.tolerance);
  return out;
}

Measurement mismatch(std::string unit, std::string why, std::uint64_t items) {
  Measurement m;
  m.unit = std::move(unit);
  m.mismatch = std::move(why);
  m.items = m.differing = std::max<std::uint64_t>(items, 1);
  m.max_difference = m.max_ratio = m.worst.difference = kInfinite;
  m.histogram[19] = m.items;
  return m;
}

}  // namespace plumbline::check
