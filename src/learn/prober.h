// Probe runner: draws probes with a renderer, and collects the conventions found.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "capture/conventions.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::learn {

/// One convention, and what shows it.
struct LearnedRow {
  std::string name;      ///< as in conventions.json
  std::string value;     ///< a word; "open": the renderer does not show it; "none fits": no value explains it
  std::string evidence;  ///< "768 of 768 colours", or the reason for "open"
};

/// A probe's picture, converted by the conventions found so far (to_dialect()).
struct ProbePicture {
  std::string name;
  Plane<glm::vec4> color;
};

struct Learned {
  Conventions conventions;
  std::vector<LearnedRow> rows;
  std::vector<ProbePicture> pictures;  ///< the first of each probe
};

class Prober {
 public:
  explicit Prober(Renderer& renderer) : renderer_(renderer) {}

  /// Colour and depth, by the conventions found so far. Throws as Renderer::capture, and Unsupported: no colour.
  Planes draw(const Scene& scene);

  /// draw(). Throws Unsupported where no depth is left.
  Planes draw_with_depths(const Scene& scene);
  Plane<double> draw_depths(const Scene& scene) { return draw_with_depths(scene).depth; }

  /// Adds a row: the convention's value was found. Replaces an earlier row of the convention.
  void found(const ConventionWords& words, std::string_view value, std::string evidence);
  /// Adds a row "open": the renderer does not show the convention.
  void open(const ConventionWords& words, std::string why);
  /// Adds a row "none fits", and a finding: no value of the convention explains what the renderer shows.
  void fits_none(const ConventionWords& words, const std::string& evidence);
  bool is_open(std::string_view name) const;
  /// Whether any of `conventions`, by which the probe of `words` goes, is open; if so, opens `words`, too.
  bool open_if_any_open(const ConventionWords& words, std::initializer_list<std::string_view> conventions);
  /// Whether colours are encoded, or in no known way 4 codes or more off linear; if so, opens `words`.
  bool open_if_colors_are_not_linear(const ConventionWords& words);
  /// Adds a finding that belongs to no single convention.
  void unexplained(std::string finding) { learned.conventions.unexplained.push_back(std::move(finding)); }

  Learned learned;
  /// Depth function of all draws of the probes. Where draws lie over each other, the later one is the nearer.
  DepthFunc depth_func = DepthFunc::always;
  /// Reason to skip probes of mixed colours; empty: colours are linear, or less than 4 codes off.
  std::string not_linear;
  /// The first probe's picture has one colour: no other probe is drawn.
  bool sees_nothing = false;

 private:
  Capture captured(const Scene& probe);  // names the probe where the renderer fails
  Renderer& renderer_;
};

/// The larger of `most` and |off|, where NaN is infinite.
inline double farther(double most, double off) {
  return std::isnan(off) ? std::numeric_limits<double>::infinity() : std::max(most, std::abs(off));
}

/// Words of the convention of that name (capture/conventions.h); throws std::logic_error for another name.
ConventionWords words_of(std::string_view name);

// The probes. Each finds its conventions, or leaves them open. They throw what Prober::draw() throws.
void learn_rows(Prober& prober);
void learn_clipping(Prober& prober);
void learn_depths(Prober& prober);
void learn_grid(Prober& prober);
void learn_depth_arithmetic(Prober& prober);
void learn_depth_of(Prober& prober);
void learn_edge_steps(Prober& prober);
void learn_ties(Prober& prober);
void learn_colors(Prober& prober);
void learn_interpolation(Prober& prober);
void learn_corners(Prober& prober);
void learn_depth_corners(Prober& prober);
void learn_provoking_vertex(Prober& prober);
void learn_alpha(Prober& prober);
void learn_alpha_test(Prober& prober);
void learn_blending(Prober& prober);
void learn_fog(Prober& prober);
void learn_offset_unit(Prober& prober);
void learn_float_offset_unit(Prober& prober);
void learn_weights(Prober& prober);
void learn_fragment_colors(Prober& prober);
void learn_vertex_colors(Prober& prober);
void learn_levels(Prober& prober);
void learn_magnification(Prober& prober);
void learn_half_way(Prober& prober);

}  // namespace plumbline::learn
