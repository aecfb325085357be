#include "reference/osmesa/scene/light_program.h"

#include <algorithm>

#include <fmt/format.h>

#include "reference/osmesa/scene/textures_in_gl.h"

namespace plumbline::osmesa {
namespace {

/// Macros AMBIENT(m), DIFFUSE(m)...: the colour of the material m, or the vertex colour where it replaces that colour.
std::string material_of(const Scene& scene, const Draw& draw) {
  const bool colors = !scene.meshes[draw.mesh].colors.empty();
  const auto define = [&](const char* name, const char* member, bool follows) {
    return fmt::format("#define {}(m) {}\n", name, colors && follows ? "color" : fmt::format("m.{}", member));
  };
  const ColorMaterial f = draw.color_material;
  const bool both = f == ColorMaterial::ambient_and_diffuse;
  return define("AMBIENT", "ambient", both || f == ColorMaterial::ambient) +
         define("DIFFUSE", "diffuse", both || f == ColorMaterial::diffuse) +
         define("SPECULAR", "specular", f == ColorMaterial::specular) +
         define("EMISSION", "emission", f == ColorMaterial::emission);
}

const char* normal_of(Normals normals) {
  switch (normals) {
    case Normals::normalize: return "normalize(gl_NormalMatrix * gl_Normal)";
    case Normals::rescale: return "gl_NormalScale * (gl_NormalMatrix * gl_Normal)";
    case Normals::as_they_are: return "gl_NormalMatrix * gl_Normal";
  }
  return "";
}

/// GLSL function share(): attenuation times cone of a light. vp: vector to the light, of any length (OpenGL 2.1 spec
/// 2.14.1).
constexpr const char* kShare = R"(
float share(gl_LightSourceParameters light, vec3 vp) {
  if (light.position.w == 0.0) return 1.0;
  float d = length(vp);
  float k = light.constantAttenuation + light.linearAttenuation * d + light.quadraticAttenuation * d * d;
  if (light.spotCutoff == 180.0) return 1.0 / k;
  float cosine = dot(-normalize(vp), normalize(light.spotDirection));
  if (cosine < light.spotCosCutoff) return 0.0;
  return (light.spotExponent == 0.0 ? 1.0 : pow(max(cosine, 0.0), light.spotExponent)) / k;
}
)";

/// GLSL function lit(): the primary colour at a point of eye space; `secondary` is the colour of the colour sum.
std::string equation_of(const Scene& scene) {
  const LightModel& model = scene.light_model;
  const char* to_eye = model.local_viewer ? "normalize(-p)" : "vec3(0.0, 0.0, 1.0)";
  const bool mirrored = model.specular == LightModel::Specular::reflection;
  const bool flips = model.sides == LightModel::Sides::flip;
  return fmt::format(R"(
vec4 lit(gl_MaterialParameters m, vec3 p, vec3 n, vec4 color, out vec4 secondary) {{
  vec3 e = {};
  vec3 gloss = vec3(0.0), sum = EMISSION(m).rgb + AMBIENT(m).rgb * gl_LightModel.ambient.rgb;
  for (int i = 0; i < {}; ++i) {{
    vec4 place = gl_LightSource[i].position;
    vec3 vp = place.w == 0.0 ? place.xyz : place.xyz - p;
    vec3 l = normalize(vp), k = n;
    {}
    float n_l = dot(k, l);
    vec3 shine = vec3(0.0), answer = AMBIENT(m).rgb * gl_LightSource[i].ambient.rgb;
    if (n_l > 0.0{}) {{
      float x = max({}, 0.0);
      float power = m.shininess == 0.0 ? 1.0 : x > 0.0 ? min(pow(x, m.shininess), 1e37) : 0.0;
      answer += n_l * DIFFUSE(m).rgb * gl_LightSource[i].diffuse.rgb;
      {} += power * SPECULAR(m).rgb * gl_LightSource[i].specular.rgb;
    }}
    float reaches = share(gl_LightSource[i], vp);
    if (reaches > 0.0) sum += reaches * answer;
    if (reaches > 0.0) gloss += reaches * shine;
  }}
  secondary = vec4(clamp(gloss, 0.0, 1.0), 0.0);
  return clamp(vec4(sum, DIFFUSE(m).a), 0.0, 1.0);
}}
)",
                     to_eye, scene.lights.size(), flips ? "if (dot(n, l) < 0.0 && dot(n, e) < 0.0) k = -n;" : "",
                     flips ? " && dot(k, e) > 0.0" : "",
                     mirrored ? "dot(2.0 * n_l * k - l, e)" : "dot(k, normalize(l + e))",
                     model.separate_specular ? "shine" : "answer");
}

// Whether Mesa 22.3 (ffvertex_prog.c) lights the draw wrongly. Where the shininess is 0, it leaves N.H out, and
// computes the specular term of a light that is attenuated or has a cone as (N.L)^(N.L) in place of 1 (measured: .239
// gives .7103). Where only one side's shininess is 0, it computes the power for both, and 0^0 as 0 where N.H is 0 or
// less (measured); where both are 0, that term is 1.
bool mesa_is_wrong(const Scene& scene, const Draw& draw) {
  const bool front = draw.material.shininess == 0,
             back = draw.back_material ? draw.back_material->shininess == 0 : front;
  if (scene.light_model.sides == LightModel::Sides::two && front != back) return true;
  return (front || back) && std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
           return light.kind == Light::Kind::point && (light.spot || light.attenuation != glm::vec3(1, 0, 0));
         });
}

}  // namespace

bool needs_light_program(const Scene& scene, const Draw& draw) {
  const LightModel& model = scene.light_model;
  return is_lit_per_fragment(draw) ||
         (draw.lit && (model.specular != LightModel::Specular::half_vector || model.sides == LightModel::Sides::flip ||
                       mesa_is_wrong(scene, draw)));
}

namespace {

constexpr const char* kPassedOn = R"(
  gl_Position = ftransform();
  gl_TexCoord[0] = gl_MultiTexCoord0;
  vec3 p_eye = vec3(gl_ModelViewMatrix * gl_Vertex);
  gl_FogFragCoord = abs(p_eye.z);
)";

/// GLSL statements of the draw's fog, by the fragment's own distance (OpenGL 2.1 spec 3.10); empty without fog.
std::string fog_of(const Draw& draw) {
  if (!draw.fog) return "";
  const char* factor = draw.fog->mode == Fog::Mode::linear ? "(gl_Fog.end - c) / (gl_Fog.end - gl_Fog.start)"
                       : draw.fog->mode == Fog::Mode::exp  ? "exp(-gl_Fog.density * c)"
                                                           : "exp(-(gl_Fog.density * c) * (gl_Fog.density * c))";
  return fmt::format("  float c = abs(p.z);\n  color.rgb = mix(gl_Fog.color.rgb, color.rgb, clamp({}, 0.0, 1.0));\n",
                     factor);
}

}  // namespace

std::string light_vertex_shader(const Scene& scene, const Draw& draw) {
  const std::string normal = normal_of(draw.normals);
  if (is_lit_per_fragment(draw)) {
    return fmt::format(
        "#version 120\nvarying vec3 p, n;\nvoid main() {{{}  p = p_eye;\n  n = {};\n"
        "  gl_FrontColor = gl_Color;\n  gl_BackColor = gl_Color;\n}}\n",
        kPassedOn, normal);
  }
  return "#version 120\n" + material_of(scene, draw) + kShare + equation_of(scene) +
         fmt::format(R"(
void main() {{{}
  vec3 n = {};
  vec4 secondary;
  gl_FrontColor = lit(gl_FrontMaterial, p_eye, n, gl_Color, secondary);
  gl_FrontSecondaryColor = secondary;
  gl_BackColor = lit(gl_BackMaterial, p_eye, -n, gl_Color, secondary);
  gl_BackSecondaryColor = secondary;
}}
)",
                     kPassedOn, normal);
}

std::string light_fragment_shader(const Scene& scene, const Draw& draw) {
  if (!is_lit_per_fragment(draw)) return "";
  const LightModel& model = scene.light_model;
  const bool two = model.sides == LightModel::Sides::two;
  return "#version 120\nuniform sampler2D image;\nvarying vec3 p, n;\n" + material_of(scene, draw) + kShare +
         equation_of(scene) +
         fmt::format(R"(
void main() {{
  vec3 k = normalize(n);
  vec4 secondary;
  vec4 color = {} ? lit(gl_FrontMaterial, p, k, gl_Color, secondary) : lit(gl_BackMaterial, p, -k, gl_Color, secondary);
{}{}{}  gl_FragColor = color;
}}
)",
                     two ? "gl_FrontFacing" : "true", environment_of(scene, draw),
                     model.separate_specular ? "  color.rgb = clamp(color.rgb + secondary.rgb, 0.0, 1.0);\n" : "",
                     fog_of(draw));
}

}  // namespace plumbline::osmesa
