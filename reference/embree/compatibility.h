// Embree 3 and 4 by one set of names. What differs between them of all that is used here: the header, the context's
// type, and how rays are sent off. Filter functions of a geometry work in 4 as they did in 3. Included by .cpp files
// alone.
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

/// Coherent rays; those whose `valid` is -1.
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

/// Coherent rays; those whose `valid` is -1.
inline void intersect(const int* valid, RTCScene scene, Context& context, RTCRayHit16& rays) {
  rtcIntersect16(valid, scene, &context, &rays);
}

#endif

}  // namespace plumbline::embree
