// What of stages 8 and 9 is done lane by lane, by the definition itself.
#pragma once

#include "pipeline/fragment_light.h"
#include "pipeline/simd.h"
#include "pipeline/texture.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {

struct Colors {
  HWY_ALIGN float r[kWidth], g[kWidth], b[kWidth], a[kWidth];
  Colors() = default;
  explicit Colors(const Color<Simd>& c) {
    hn::Store(c.r.v, kFloats, r);
    hn::Store(c.g.v, kFloats, g);
    hn::Store(c.b.v, kFloats, b);
    hn::Store(c.a.v, kFloats, a);
  }
  Color<float> operator[](int i) const { return {r[i], g[i], b[i], a[i]}; }
  void set(int i, const Color<float>& c) { r[i] = c.r, g[i] = c.g, b[i] = c.b, a[i] = c.a; }
  Color<Simd> all() const {
    return {Simd(hn::Load(kFloats, r)), Simd(hn::Load(kFloats, g)), Simd(hn::Load(kFloats, b)),
            Simd(hn::Load(kFloats, a))};
  }
};

inline Color<Simd> sample(const TextureSetup& t, const TexCoords<Simd>& at, Simd lod) {
  HWY_ALIGN float s[kWidth], u[kWidth], l[kWidth];
  hn::Store(at.s.v, kFloats, s);
  hn::Store(at.t.v, kFloats, u);
  hn::Store(lod.v, kFloats, l);
  Colors out;
  for (int i = 0; i < kWidth; ++i) out.set(i, pipeline::sample(t, TexCoords<float>{s[i], u[i]}, l[i]));
  return out.all();
}

}  // namespace PLUMBLINE_TARGET
}  // namespace plumbline::pipeline
