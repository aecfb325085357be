// One set of names for Embree 3 and 4, which differ, as far as used here, in the header, the context's type and the
// call that intersects rays. Filter functions of a geometry are the same in both. To be included by .cpp files only.
#pragma once

#if PLUMBLINE_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace plumbline::embree {

#if PLUMBLINE_EMBREE_MAJOR == 4

using Context = RTCRayQueryContext;

inline void init(Context& context) { rtcInitRayQueryContext(&context); }

/// Intersects 16 coherent rays, of which those with `valid` -1 are active.
inline void intersect(const int* valid, RTCScene scene, Context& context, RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  arguments.context = &context;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

#else

using Context = RTCIntersectContext;

inline void init(Context& context) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

/// Intersects 16 coherent rays, of which those with `valid` -1 are active.
inline void intersect(const int* valid, RTCScene scene, Context& context, RTCRayHit16& rays) {
  rtcIntersect16(valid, scene, &context, &rays);
}

#endif

}  // namespace plumbline::embree
