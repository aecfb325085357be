// The terms of note 000's colour, Shading, beside a sum of their own in a wider format: the table goes on
// (transforms_table_test.cpp). The unit is an ULP of the terms' magnitudes added up: at most 4; in a million inputs 3.4
// is seen.
#include "pipeline/geometry.h"
#include "tests/cross/transforms_table.h"

namespace plumbline::test {
namespace {

/// One vertex of the fixed function under three directional lights of any direction; colours and normal are floats.
struct Lamps {
  Scene scene;
  Draw draw;
  Vec3<float> n;
  float ours() const {
    const Vertex<float> vertex{{0, 0, -5, 1}, {0, 0, 0, 1}, n};
    std::vector<pipeline::Attributes> lit;
    pipeline::light({scene, draw, scene.meshes[draw.mesh], pipeline::light_sources(scene), std::span(&vertex, 1)}, lit);
    return lit[0].color().r;
  }
};
float share(Inputs& r) { return static_cast<float>(r.between(0.01, 0.4)); }
Lamps lamps(Inputs& r) {
  Lamps out;
  out.scene.meshes.emplace_back();                       // which the draw names
  out.scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};  // directions are the same in world and eye space
  out.scene.light_model.ambient = glm::vec3(0);
  out.draw.material = {glm::vec4(0), glm::vec4(0), glm::vec4(0), glm::vec4(0), 1};
  out.n = Vec3<float>(glm::normalize(r.direction(1)));
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 to_light = r.direction(10);
    const glm::vec3 l_e(share(r));
    out.scene.lights.push_back({Light::Kind::directional, to_light, glm::vec3(0), l_e, l_e});
  }
  return out;
}

/// a.b, and the sum of its terms' magnitudes.
struct Dot {
  Wide value, terms;
};
Dot dot(const WideVec3& a, const WideVec3& b) { return {glm::dot(a, b), glm::dot(glm::abs(a), glm::abs(b))}; }

std::vector<Row> light_rows() {
  const char* const wide_sum = "as printed, 64 bits, N.L >= 0";
  return {
      {"K_d sum l_e (N.L) (000)", "light", wide_sum, 24, 4,
       [](Inputs& r) {
         Lamps l = lamps(r);
         const float kd = share(r);
         l.draw.material.diffuse = glm::vec4(kd);
         Entry e{l.ours(), 0, 0};
         for (const Light& lamp : l.scene.lights) {
           const Dot n_l = dot(wide(l.n), glm::normalize(wide(lamp.vector)));
           const Wide color = Wide(kd) * lamp.diffuse.r;
           e.theirs += color * std::max<Wide>(n_l.value, 0);
           e.magnitude += color * n_l.terms;
         }
         return Entries{e};
       }},
      {"K_s sum l_e (N.H)^s (000, GL's H)", "light", wide_sum, 24, 4,
       [](Inputs& r) {
         Lamps l = lamps(r);
         const float ks = share(r), s = static_cast<float>(std::floor(r.between(1, 129)));
         l.draw.material.specular = glm::vec4(ks);
         l.draw.material.shininess = s;
         for (Light& lamp : l.scene.lights) {
           lamp.vector.z = std::abs(lamp.vector.z);  // H, halfway to the eye, is then known as well as L
           // Where N.L is 0, the highlight comes or goes as a whole.
           if (std::abs(glm::dot(glm::dvec3(l.n), glm::normalize(lamp.vector))) < 1e-6) return Entries{};
         }
         Entry e{l.ours(), 0, std::numeric_limits<float>::min()};  // below it floats have fewer digits
         for (const Light& lamp : l.scene.lights) {
           const WideVec3 to_light = glm::normalize(wide(lamp.vector));
           if (glm::dot(wide(l.n), to_light) <= 0) continue;
           const Dot n_h = dot(wide(l.n), glm::normalize(to_light + WideVec3(0, 0, 1)));
           if (n_h.value <= 0) continue;
           const Wide power = Wide(ks) * lamp.specular.r * std::pow(std::min<Wide>(n_h.value, 1), Wide(s));
           e.theirs += power;
           e.magnitude += power * (1 + s * n_h.terms / n_h.value);  // an error of N.H, s times
         }
         return Entries{e};
       }},
      {"K_s sum l_e (R.E)^s (000)", "light", wide_sum, 24, 4,
       [](Inputs& r) {
         Lamps l = lamps(r);
         l.scene.light_model.specular = LightModel::Specular::reflection;
         const float ks = share(r), s = static_cast<float>(std::floor(r.between(1, 129)));
         l.draw.material.specular = glm::vec4(ks);
         l.draw.material.shininess = s;
         Entry e{0, 0, std::numeric_limits<float>::min()};
         for (const Light& lamp : l.scene.lights) {
           const WideVec3 n = wide(l.n), to_light = glm::normalize(wide(lamp.vector));
           const Dot n_l = dot(n, to_light);
           if (std::abs(n_l.value) < 1e-6) return Entries{};
           const Wide r_e = (2 * n_l.value * n - to_light).z;
           if (n_l.value <= 0 || r_e <= 0) continue;
           const Wide power = Wide(ks) * lamp.specular.r * std::pow(std::min<Wide>(r_e, 1), Wide(s));
           e.theirs += power;
           e.magnitude += power * (1 + s * (2 * n_l.terms * std::abs(n.z) + std::abs(to_light.z)) / r_e);
         }
         e.ours = l.ours();
         return Entries{e};
       }},
      {"K_a l_a (000)", "light", "as printed, 64 bits", 24, 1,
       [](Inputs& r) {
         Lamps l = lamps(r);
         const float ka = share(r), la = share(r);
         l.draw.material.ambient = glm::vec4(ka);
         l.scene.light_model.ambient = glm::vec3(la);
         return number(l.ours(), Wide(ka) * la);
       }},
  };
}

// The other way: without the clamp of N.L, with R in the place of H, and with a term twice.
TEST(LightTable, NamesASlip) {
  const auto slipped = [](Wide (*term)(Wide n_l, Wide r_e, Wide n_h)) {
    return Row{"", "", "", 24, 4, [=](Inputs& r) {
                 Lamps l = lamps(r);
                 l.scene.lights.resize(1);
                 l.draw.material.diffuse = l.draw.material.specular = glm::vec4(1);
                 l.draw.material.shininess = 2;
                 const WideVec3 n = wide(l.n), to_light = glm::normalize(wide(l.scene.lights[0].vector));
                 const Wide n_l = glm::dot(n, to_light), l_e = l.scene.lights[0].diffuse.r;
                 if (std::abs(n_l) < 0.01 || to_light.z < -0.9) return Entries{};
                 const Wide n_h = glm::dot(n, glm::normalize(to_light + WideVec3(0, 0, 1)));
                 return Entries{{l.ours(), l_e * term(n_l, (2 * n_l * n - to_light).z, n_h), 4}};
               }};
  };
  EXPECT_TRUE(holds(
      slipped([](Wide n_l, Wide, Wide n_h) { return n_l > 0 ? n_l + std::pow(std::max<Wide>(n_h, 0), Wide(2)) : 0; })));
  EXPECT_FALSE(holds(slipped([](Wide n_l, Wide, Wide n_h) { return n_l + n_h * n_h; })));
  EXPECT_FALSE(holds(slipped([](Wide n_l, Wide r_e, Wide) { return n_l > 0 ? n_l + r_e * r_e : 0; })));
  EXPECT_FALSE(holds(slipped(
      [](Wide n_l, Wide, Wide n_h) { return n_l > 0 ? 2 * n_l + std::pow(std::max<Wide>(n_h, 0), Wide(2)) : 0; })));
}

TEST(LightTable, ColorOf000) { expect_table(light_rows()); }

}  // namespace
}  // namespace plumbline::test
