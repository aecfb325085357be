// The pipeline's stage functions as a table of pointers: a fault puts a function of its own in the place of one, and
// what draws by the table is compiled once for all faults.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render.h"

namespace plumbline::faults {

/// The fragment half, for one pixel at a time. As in FragmentStages (fragment.h), which says what each is.
struct FragmentTable {
  pipeline::AttributeSetup (*attribute_setup)(const WindowTriangle<float>&);
  pipeline::Places (*places)(glm::ivec2 sample);
  pipeline::PixelBounds (*bounds)(const WindowTriangle<float>&);
  pipeline::Edges (*edges)(const WindowTriangle<float>&);
  std::vector<glm::ivec2> (*thin_pixels)(const WindowTriangle<float>&, glm::ivec2 origin, int size);
  bool (*coverage)(const pipeline::TriangleSetup<>&, const pipeline::Pixels<float>&);
  bool (*scissor)(const Scissor&, const pipeline::Pixels<float>&);
  pipeline::DepthSetup (*depth_setup)(const WindowTriangle<float>&, const pipeline::DepthState&);
  float (*depth)(const pipeline::TriangleSetup<>&, const pipeline::Pixels<float>&);
  bool (*depth_passes)(DepthFunc, float incoming, float stored);
  pipeline::Color<float> (*attributes)(const pipeline::TriangleSetup<>&, const pipeline::AttributeSetup&,
                                       const pipeline::Pixels<float>&);
  pipeline::FilteredTexel<float> (*texture)(const pipeline::TextureSetup&, const pipeline::TexCoords<float>&,
                                            const pipeline::Gradients<float>&);
  pipeline::Color<float> (*shade)(const pipeline::Color<float>&);
  pipeline::Color<float> (*shade_surface)(const pipeline::Surface&, bool front,
                                          const pipeline::SurfaceAttributes<float>&);
  bool (*alpha_passes)(const AlphaTest&, float alpha, float scale);
  bool (*stencil_test)(const StencilFace&, bool alive, bool nearer, std::uint8_t* at);
  pipeline::Color<float> (*merge)(const pipeline::Color<float>&, float scale);
  pipeline::Color<float> (*blend)(const Blend&, const pipeline::Color<float>& source,
                                  const pipeline::Color<float>& stored, float scale);
  pipeline::Color<float> (*logic)(LogicOp, const pipeline::Color<float>& source, const pipeline::Color<float>& stored,
                                  float scale);
  Merge (*merge_state)(const Merge& of_draw);
  bool operator==(const FragmentTable&) const = default;
};

struct Table {
  pipeline::GeometryStages geometry;
  FragmentTable fragment;
  pipeline::ResolveStage resolve;
  bool operator==(const Table&) const = default;
};

/// The pipeline's own functions.
Table production();
/// The pipeline with these functions.
pipeline::Stages stages_of(const Table& table);

}  // namespace plumbline::faults
