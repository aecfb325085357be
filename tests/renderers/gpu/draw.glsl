// One draw, for Vulkan (GLSL 4.50) and WebGL 2 (GLSL ES 3.00): clip space positions and lit colours come from the export;
// texture environment, sum of colours, fog and alpha test are computed here. Compiled with and without VERTEX.
#ifdef VULKAN
#define VARYING(n) layout(location = n)
#define BLOCK layout(set = 0, binding = 0, std140)
#define SAMPLER layout(set = 0, binding = 1)
#else
precision highp float;
precision highp int;
#define VARYING(n)
#define BLOCK layout(std140)
#define SAMPLER
#endif

BLOCK uniform Draw {
  vec4 environment_color;
  vec4 fog_color;
  vec4 fog_range;         // density, start, end
  int fog_mode;           // 0 none, 1 linear, 2 exp, 3 exp2
  int environment;        // 0 no texture, 1 replace, 2 modulate, 3 decal, 4 blend, 5 add
  int texture_format;     // 0 alpha, 1 luminance, 2 luminance_alpha, 3 intensity, 4 rgb, 5 rgba
  int separate_specular;
  int alpha_func;         // 0 never, 1 less, 2 equal, 3 less_equal, 4 greater, 5 not_equal, 6 greater_equal, 7 always
  float alpha_reference;
  float point_size;
  float lod_bias;
};

#ifdef VERTEX

layout(location = 0) in vec4 in_p_clip;
layout(location = 1) in vec4 in_color;
layout(location = 2) in vec4 in_back_color;
layout(location = 3) in vec4 in_secondary;
layout(location = 4) in vec4 in_back_secondary;
layout(location = 5) in vec4 in_surface;  // s, t, z_eye

VARYING(0) out vec4 color;
VARYING(1) out vec4 back_color;
VARYING(2) out vec4 secondary;
VARYING(3) out vec4 back_secondary;
VARYING(4) out vec4 surface;

void main() {
  gl_Position = in_p_clip;
  gl_PointSize = point_size;
  color = in_color;
  back_color = in_back_color;
  secondary = in_secondary;
  back_secondary = in_back_secondary;
  surface = in_surface;
}

#else

SAMPLER uniform highp sampler2D image;

VARYING(0) in vec4 color;
VARYING(1) in vec4 back_color;
VARYING(2) in vec4 secondary;
VARYING(3) in vec4 back_secondary;
VARYING(4) in vec4 surface;

layout(location = 0) out vec4 out_color;

// OpenGL 2.1 specification, tables 3.22 and 3.23.
vec4 apply_environment(vec4 f, vec4 s) {
  bool has_color = texture_format != 0, has_alpha = texture_format != 1 && texture_format != 4;
  vec4 c = f;
  if (has_color) {
    if (environment == 1) c.rgb = s.rgb;
    if (environment == 2) c.rgb = f.rgb * s.rgb;
    if (environment == 3) c.rgb = texture_format == 4 ? s.rgb : mix(f.rgb, s.rgb, s.a);
    if (environment == 4) c.rgb = f.rgb * (1.0 - s.rgb) + environment_color.rgb * s.rgb;
    if (environment == 5) c.rgb = min(f.rgb + s.rgb, 1.0);
  }
  if (has_alpha && environment != 3) {
    c.a = f.a * s.a;
    if (environment == 1) c.a = s.a;
    if (texture_format == 3 && environment == 4) c.a = mix(f.a, environment_color.a, s.a);
    if (texture_format == 3 && environment == 5) c.a = min(f.a + s.a, 1.0);
  }
  return c;
}

float fog_factor(float z) {
  float x = fog_range.x * z;
  if (fog_mode == 1) return clamp((fog_range.z - z) / (fog_range.z - fog_range.y), 0.0, 1.0);
  return fog_mode == 2 ? exp(-x) : exp(-x * x);
}

bool passes_alpha_test(float alpha) {
  bool less = alpha < alpha_reference, equal = alpha == alpha_reference;
  bool greater = !less && !equal;
  return (alpha_func & 1) != 0 && less || (alpha_func & 2) != 0 && equal || (alpha_func & 4) != 0 && greater;
}

void main() {
  vec4 texel = texture(image, surface.xy, lod_bias);  // here, where all fragments of a quad come by
  vec4 c = gl_FrontFacing ? color : back_color;
  if (environment != 0) c = apply_environment(c, texel);
  if (separate_specular != 0) c.rgb = min(c.rgb + (gl_FrontFacing ? secondary : back_secondary).rgb, 1.0);
  if (fog_mode != 0) c.rgb = mix(fog_color.rgb, c.rgb, fog_factor(abs(surface.z)));
  if (!passes_alpha_test(c.a)) discard;
  out_color = c;
}

#endif
