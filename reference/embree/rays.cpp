#include "reference/embree/rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "capture/renderer.h"
#include "reference/embree/compatibility.h"

namespace plumbline::embree {

namespace {

using math::Candidates;
using math::Projected;

constexpr double kRange = 1e18;  ///< largest coordinate: Embree silently drops triangles beyond it
constexpr int kPacket = 16;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class T>
using Handle = std::unique_ptr<std::remove_pointer_t<T>, Release>;

void require_no_error(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw RendererFailed(fmt::format("embree: {} failed with error {}", what, static_cast<int>(error)));
  }
}

Handle<RTCDevice> make_device() {
  Handle<RTCDevice> device(rtcNewDevice("threads=1"));
  require_no_error(device.get(), "making a device");
  return device;
}

/// Position of a corner in Embree's scene. Perspective: (X, Y, W), with rays from the origin, so that t is w.
/// Orthographic: (X, Y, z_clip), as w is 1 everywhere.
glm::dvec3 place(const Projected& projected, const math::Corner& corner) {
  return {corner.v.x, corner.v.y, projected.perspective ? corner.v.z : corner.z};
}

struct Finding {
  Context context;  // must be the first member: the filter function gets its address
  const std::vector<std::uint32_t>* primitives;
  Candidates* out;
};

/// Filter function, called for each triangle along a ray: adds it as a candidate and rejects the hit, so that the ray
/// goes on.
void note(const RTCFilterFunctionNArguments* args) {
  auto* finding = reinterpret_cast<Finding*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    args->valid[i] = 0;
    finding->out->add(RTCRayN_id(args->ray, args->N, i), (*finding->primitives)[RTCHitN_primID(args->hit, args->N, i)]);
  }
}

Handle<RTCGeometry> make_mesh(RTCDevice device, const Projected& projected, std::vector<std::uint32_t>& primitives) {
  for (std::uint32_t i = 0; i < projected.triangles.size(); ++i) {
    if (projected.triangles[i].drawn && !projected.triangles[i].flat) primitives.push_back(i);
  }
  Handle<RTCGeometry> mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), projected.corners.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), primitives.size()));
  require_no_error(device, "making room for the triangles");
  for (const math::Corner& corner : projected.corners) {
    const glm::dvec3 p = place(projected, corner);
    for (int i = 0; i < 3; ++i) *vertices++ = static_cast<float>(p[i]);
  }
  for (const std::uint32_t primitive : primitives) {
    for (const std::uint32_t corner : projected.triangles[primitive].corner) *indices++ = corner;
  }
  rtcSetGeometryBuildQuality(mesh.get(), RTC_BUILD_QUALITY_MEDIUM);
  rtcSetGeometryIntersectFilterFunction(mesh.get(), note);
  rtcCommitGeometry(mesh.get());
  return mesh;
}

/// Start of parallel rays [z]: before the near plane, at -1, and before all corners; clamped depths leave some there.
float start_of_rays(const Projected& projected) {
  double nearest = -1;
  for (const math::Corner& corner : projected.corners) nearest = std::min(nearest, place(projected, corner).z);
  return static_cast<float>(std::floor(nearest) - 1 + std::min(nearest + 1, 0.0) / 1024);  // beyond its rounding
}

/// Sets 16 rays through a row's pixels from x on; rays beyond the frame are inactive. `start`: start_of_rays().
void set_rays(const Projected& projected, int x, int y, float start, int* valid, RTCRayHit16& rays) {
  for (int i = 0; i < kPacket; ++i) {
    const glm::dvec3 d = projected.ray(x + i, y);
    const auto dx = static_cast<float>(d.x), dy = static_cast<float>(d.y);  // halves of integers: exact
    const bool on = x + i < projected.width;
    valid[i] = on ? -1 : 0;
    rays.ray.org_x[i] = projected.perspective ? 0 : dx;
    rays.ray.org_y[i] = projected.perspective ? 0 : dy;
    rays.ray.org_z[i] = projected.perspective ? 0 : start;
    rays.ray.dir_x[i] = projected.perspective ? dx : 0;
    rays.ray.dir_y[i] = projected.perspective ? dy : 0;
    rays.ray.dir_z[i] = 1;
    rays.ray.tnear[i] = 0;
    rays.ray.tfar[i] = on ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
    rays.ray.time[i] = 0;
    rays.ray.mask[i] = ~0u;
    rays.ray.flags[i] = 0;
    rays.ray.id[i] = on ? static_cast<unsigned>(y * projected.width + x + i) : 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
}

void require_in_range(const Projected& projected) {
  for (std::size_t i = 0; i < projected.corners.size(); ++i) {
    const glm::dvec3 p = place(projected, projected.corners[i]);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) <= kRange) continue;  // not for NaN
      throw Unsupported(
          fmt::format("embree: vertex {} of the scene is at ({}, {}, {}) in homogeneous window "
                      "coordinates; expected finite ones of at most {}",
                      i, p.x, p.y, p.z, kRange));
    }
  }
}

}  // namespace

void add_by_rays(const Projected& projected, Candidates& out) {
  require_in_range(projected);
  const Handle<RTCDevice> device = make_device();
  const Handle<RTCScene> scene(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  std::vector<std::uint32_t> primitives;
  const Handle<RTCGeometry> mesh = make_mesh(device.get(), projected, primitives);
  if (primitives.empty()) return;
  rtcAttachGeometry(scene.get(), mesh.get());
  rtcCommitScene(scene.get());
  require_no_error(device.get(), "building the scene");

  Finding finding{{}, &primitives, &out};
  init(finding.context);
  alignas(64) int valid[kPacket];
  RTCRayHit16 rays{};
  const float start = projected.perspective ? 0 : start_of_rays(projected);
  for (int y = 0; y < projected.height; ++y) {
    for (int x = 0; x < projected.width; x += kPacket) {
      set_rays(projected, x, y, start, valid, rays);
      intersect(valid, scene.get(), finding.context, rays);
    }
    out.require_complete();
  }
  require_no_error(device.get(), "casting rays");
}

std::string version() {
  const Handle<RTCDevice> device = make_device();
  const auto part = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device.get(), property); };
  return fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR), part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

}  // namespace plumbline::embree
