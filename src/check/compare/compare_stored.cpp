#include "check/compare/compare_stored.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture/capture_columns.h"

namespace plumbline::check {

namespace {

using Channel = StoredImage::Channel;
using Pairs = std::vector<std::pair<const Channel*, const Channel*>>;

StoredComparison row(std::string what, Measurement m, double codes = 0, std::string note = "") {
  Comparison c = judged("", "", Stage::merge, std::move(m), nullptr, std::move(note));
  return {std::move(what), c.outcome, std::move(c.measurement), codes, std::move(c.note)};
}

// Difference in values. Codes are subtracted as integers, so that one step is 1/(2^n - 1), rounded once.
double difference_of(double a, double scale_a, double b, double scale_b) {
  if (!std::isfinite(a) || !std::isfinite(b)) return difference(a, b);
  if (scale_a == scale_b) return std::abs(a - b) / scale_a;
  return std::abs(a * scale_b - b * scale_a) / (scale_a * scale_b);
}

Pairs pairs_of(const StoredImage& a, const StoredImage& b) {
  Pairs out;
  const bool one_each = a.channels.size() == 1 && b.channels.size() == 1;
  if (one_each || std::ranges::equal(a.channels, b.channels, {}, &Channel::name, &Channel::name)) {
    for (std::size_t i = 0; i < a.channels.size(); ++i) out.emplace_back(&a.channels[i], &b.channels[i]);
    return out;
  }
  for (const Channel& channel : a.channels) {
    const auto is_other = [&](const Channel& other) {
      return other.name == channel.name && std::ranges::find(out, &other, &Pairs::value_type::second) == out.end();
    };
    const auto other = std::ranges::find_if(b.channels, is_other);
    if (other != b.channels.end()) out.emplace_back(&channel, &*other);
  }
  return out;
}

void add_pixel(Meter& meter, const Channel& a, const Channel& b, int x, int y, double tolerance) {
  const double v = a.values(x, y), w = b.values(x, y);
  meter.value(difference_of(v, a.scale, w, b.scale), tolerance, {x, y, -1, ""}, v / a.scale, w / b.scale);
}

std::string names_of(const StoredImage& image) {
  std::vector<std::string> names;
  for (const Channel& channel : image.channels) names.push_back(channel.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string text_of(const StoredImage::Window& w) {
  return fmt::format("{} x {} at {},{}", w.width, w.height, w.x, w.y);
}

std::string note_of(const Channel& a, const Channel& b) {
  std::string out;
  if (a.name != b.name) out = fmt::format("{} against {}", a.name, b.name);
  std::size_t both = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    both += std::isnan(a.values.values()[i]) && std::isnan(b.values.values()[i]) ? 1 : 0;
  }
  if (both > 0) out += fmt::format("{}{} NaN in both", out.empty() ? "" : "; ", both);
  return out;
}

// ---- captures

template <class T>
void add_value(Meter& meter, const T& a, const T& b, double tolerance, const Place& place) {
  if constexpr (std::is_floating_point_v<T>) {
    meter.value(difference(a, b), tolerance, place, a, b);
  } else if constexpr (std::is_integral_v<T>) {
    add_integers(meter, a, b, place);
  } else {
    for (int i = 0; i < T::length(); ++i) add_value(meter, a[i], b[i], tolerance, place);
  }
}

class ArrayComparison {
 public:
  /// Without the columns that a side leaves out.
  ArrayComparison(const Capture& a, const Capture& b, double tolerance)
      : left_out_a_(a.derived), left_out_b_(b.derived), tolerance_(tolerance) {}

  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& a, const std::vector<Record>& b) {
    if (!in_both(group.name, a.size(), b.size(), "records")) return;
    columns.each([&](const auto& c) { column(group.name, a, b, c); });
  }

  template <class T>
  void plane(Handed of, const Plane<T>& a, const Plane<T>& b) {
    if (!in_both(of.name, a.size(), b.size(), "pixels")) return;
    rows.push_back(row(std::string(of.name), compare_planes(a, b, "", [&](Meter& meter, int x, int y) {
                         add_value(meter, a(x, y), b(x, y), tolerance_, {x, y, -1, ""});
                       })));
  }

  std::vector<StoredComparison> rows;

 private:
  bool in_both(std::string_view name, std::size_t a, std::size_t b, const char* items) {
    if ((a == 0) == (b == 0)) return a != 0;
    const std::string note =
        fmt::format("{} holds {} {}, {} none", a == 0 ? "B" : "A", a + b, items, a == 0 ? "A" : "B");
    rows.push_back({std::string(name), Outcome::missing, {}, 0, note});
    return false;
  }

  template <class Record, class C>
  void column(std::string_view group, const std::vector<Record>& a, const std::vector<Record>& b, const C& column) {
    const std::string name = fmt::format("{}.{}", group, column.name);
    if (left_out_a_.contains(name) || left_out_b_.contains(name)) {
      in_both(name, left_out_a_.contains(name) ? 0 : a.size(), left_out_b_.contains(name) ? 0 : b.size(), "records");
      return;
    }
    if (a.size() != b.size()) {
      const std::string why = fmt::format("{} records against {}", a.size(), b.size());
      rows.push_back(row(name, mismatch("", why, std::max(a.size(), b.size()))));
      return;
    }
    Meter meter("");
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t k = 0; k < kPerRecord<C>; ++k) {
        const Place place{-1, -1, static_cast<std::int64_t>(i), column.name.data()};  // a literal
        add_value(meter, column.at(a[i], k), column.at(b[i], k), tolerance_, place);
      }
      meter.item();
    }
    rows.push_back(row(name, meter.done()));
  }

  const std::set<std::string>&left_out_a_, &left_out_b_;
  double tolerance_;
};

}  // namespace

std::vector<StoredComparison> compare_images(const StoredImage& a, const StoredImage& b, double tolerance) {
  const std::uint64_t pixels = a.channels.at(0).values.size();
  std::vector<StoredComparison> out;
  const auto apart = [&](const char* what, const std::string& mine, const std::string& theirs) {
    if (mine != theirs) out.push_back(row(what, mismatch("", fmt::format("{} against {}", mine, theirs), pixels)));
  };
  apart("size", fmt::format("{} x {}", a.data.width, a.data.height),
        fmt::format("{} x {}", b.data.width, b.data.height));
  if (out.empty()) apart("data window", text_of(a.data), text_of(b.data));
  if (out.empty()) apart("display window", text_of(a.display), text_of(b.display));
  if (!out.empty()) return out;
  const Pairs pairs = pairs_of(a, b);
  if (pairs.size() != a.channels.size() || pairs.size() != b.channels.size())
    apart("channels", names_of(a), names_of(b));
  if (pairs.size() > 1) {
    const Plane<double>&size_a = a.channels[0].values, &size_b = b.channels[0].values;
    out.push_back(row("pixels", compare_planes(size_a, size_b, "", [&](Meter& meter, int x, int y) {
                        for (const auto& pair : pairs) add_pixel(meter, *pair.first, *pair.second, x, y, tolerance);
                      })));
  }
  for (const auto& pair : pairs) {
    const auto &p = *pair.first, &q = *pair.second;
    Measurement m = compare_planes(p.values, q.values, "",
                                   [&](Meter& meter, int x, int y) { add_pixel(meter, p, q, x, y, tolerance); });
    out.push_back(row(p.name, std::move(m), p.scale == q.scale && p.scale > 1 ? p.scale : 0, note_of(p, q)));
  }
  return out;
}

std::vector<StoredComparison> compare_captures(const Capture& a, const Capture& b, double tolerance) {
  ArrayComparison arrays(a, b, tolerance);
  if (a.width != b.width || a.height != b.height) {
    const std::string why = fmt::format("{} x {} against {} x {}", a.width, a.height, b.width, b.height);
    arrays.rows.push_back(row("frame", mismatch("", why, 1)));
  }
  visit_capture(arrays, a, b);
  return std::move(arrays.rows);
}

Plane<glm::vec4> amplified_difference(const StoredImage& a, const StoredImage& b, std::optional<double> amplify) {
  const Pairs pairs = pairs_of(a, b);
  if (a.data != b.data || a.display != b.display || pairs.empty()) return {};
  Plane<Vec3<double>> differences(a.data.width, a.data.height);
  double largest = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto& [p, q] = pairs[c];
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const double d = difference_of(p->values.values()[i], p->scale, q->values.values()[i], q->scale);
      if (std::isfinite(d)) largest = std::max(largest, d);
      Vec3<double>& to = differences.values()[i];
      const bool own = pairs.size() >= 3 && c < 3;
      if (own) to[static_cast<int>(c)] = std::max(to[static_cast<int>(c)], d);
      if (!own) to = glm::max(to, Vec3<double>(d));
    }
  }
  const double factor = amplify.value_or(largest > 0 ? 1 / largest : 1);
  Plane<glm::vec4> out(a.data.width, a.data.height, glm::vec4(1));
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      out.values()[i][c] = static_cast<float>(std::min(differences.values()[i][c] * factor, 1.0));
    }
  }
  return out;
}

}  // namespace plumbline::check
