#include "learn/learn.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumbline::learn {

namespace {

struct Probe {
  void (*find)(Prober&);
  std::vector<std::string_view> names;  ///< of the conventions that it finds
};

// Probes in the order in which they build upon each other, after learn_rows().
const std::vector<Probe>& probes() {
  static const std::vector<Probe> all = {
      {learn_clipping, {"clip_depth", "depth_planes"}},
      {learn_depths, {"depth_range", "depth_format", "depth_rounding"}},
      {learn_grid, {kSampleWords.name, "subpixel_bits", "subpixel_rounding", "window_y"}},
      {learn_ties, {"tie_rule"}},
      {learn_colors, {"color_rounding", "color_encoding"}},
      {learn_interpolation, {"interpolation", "color_interpolation"}},
      {learn_vertex_colors, {"vertex_colors"}},
      {learn_corners, {"attribute_corners"}},
      {learn_depth_corners, {"depth_corners"}},
      {learn_depth_arithmetic, {"depth_arithmetic"}},
      {learn_depth_of, {"depth_of"}},
      {learn_edge_steps, {"edge_bits"}},
      {learn_provoking_vertex, {"provoking_vertex"}},
      {learn_alpha, {"alpha"}},
      {learn_alpha_test, {"alpha_test"}},
      {learn_fragment_colors, {"fragment_colors"}},
      {learn_blending, {"blending"}},
      {learn_fog, {"fog_factor", "fog_distance"}},
      {learn_offset_unit, {kOffsetWords.name}},
      {learn_float_offset_unit, {kFloatOffsetWords.name}},
      {learn_weights, {"texture_bits"}},
      {learn_levels, {"level_of_detail"}},
      {learn_magnification, {"magnified"}},
      {learn_half_way, {"half_way_level"}},
  };
  return all;
}

// learn_rows(), by the first depth function that the renderer supports; all later probes use that function.
void learn_rows_by_any(Prober& prober) {
  std::string refused;
  for (const DepthFunc func : {DepthFunc::always, DepthFunc::less_equal, DepthFunc::less}) {
    prober.depth_func = func;
    try {
      learn_rows(prober);
      if (!refused.empty()) prober.learned.rows.push_back({"depth_func", std::string(name_of(func)), refused});
      return;
    } catch (const Unsupported& e) {
      if (func == DepthFunc::less) throw;
      refused += refused.empty() ? "of the probes; " : "; ";
      refused += fmt::format("{} is unsupported: {}", name_of(func), e.what());
    }
  }
}

// Opens those of the probe's conventions that have no row yet.
void leave_open(Prober& prober, const Probe& probe, const std::string& why) {
  const std::vector<LearnedRow>& rows = prober.learned.rows;
  for (const std::string_view name : probe.names) {
    if (std::ranges::find(rows, name, &LearnedRow::name) == rows.end()) prober.open(words_of(name), why);
  }
}

// Arithmetic that no depth shows, or that none of the declared ones explains, which is a finding: attributes are
// interpolated in it, too, and the arithmetic of the largest errors is taken.
void leave_arithmetic_wide(Learned& learned) {
  const auto is_unknown = [](const LearnedRow& row) {
    return row.name == "depth_arithmetic" && (row.value == "open" || row.value == "none fits");
  };
  if (std::ranges::any_of(learned.rows, is_unknown))
    learned.conventions.depth_arithmetic = Conventions::DepthArithmetic::in_float_from_origin;
}

}  // namespace

Learned learn(Renderer& renderer) {
  constexpr int kMostFailures = 3;  // each may take the whole time limit
  Prober prober(renderer);
  learn_rows_by_any(prober);
  int failures = 0;
  for (const Probe& probe : probes()) {
    if (prober.sees_nothing || failures == kMostFailures) {
      leave_open(prober, probe,
                 prober.sees_nothing ? "nothing is seen of the first probe" : "the program failed on three probes");
      continue;
    }
    try {
      probe.find(prober);
      leave_open(prober, probe, fmt::format("{} is open", probe.names.front()));
    } catch (const Unsupported& e) {
      leave_open(prober, probe, e.what());
    } catch (const RendererFailed& e) {
      ++failures;
      const std::string said = e.what(), line = said.substr(0, said.find('\n'));  // without the end of its stderr
      leave_open(prober, probe, line);
      prober.unexplained(line);
    }
  }
  leave_arithmetic_wide(prober.learned);
  for (const char* words : {"polygons' cuts", "lines and points", "places of samples"}) {
    prober.learned.rows.push_back({words, "open", "pictures of triangles do not show it"});
  }
  return std::move(prober.learned);
}

std::string learned_text(const Learned& learned) {
  std::size_t of_names = 18, of_values = 14;
  for (const LearnedRow& row : learned.rows) {
    of_names = std::max(of_names, row.name.size());
    of_values = std::max(of_values, row.value.size());
  }
  std::string out = fmt::format("{:<{}} {:<{}} {}\n", "convention", of_names, "found", of_values, "evidence");
  for (const LearnedRow& row : learned.rows)
    out += fmt::format("{:<{}} {:<{}} {}\n", row.name, of_names, row.value, of_values, row.evidence);
  for (const std::string& line : not_accepted(learned.conventions)) out += fmt::format("{}\n", line);
  return out;
}

}  // namespace plumbline::learn
