/* A small rasterizer, as somebody might write it who has never heard of plumbline: triangles in clip space, with a
   colour at each corner, into a frame of doubles. */
#ifndef RASTERIZER_H
#define RASTERIZER_H

typedef struct {
  double p[4], color[4]; /* clip space; rgba */
} Vertex;

typedef enum { NEVER, LESS, EQUAL, LESS_EQUAL, GREATER, NOT_EQUAL, GREATER_EQUAL, ALWAYS } Compare;
#define COMPARES "never|less|equal|less_equal|greater|not_equal|greater_equal|always"

/* Callbacks of the stages: clipped polygons, triangles in pixels, fragments with the depth that is compared. */
struct Frame;
typedef struct {
  void (*polygon)(const struct Frame* frame, const Vertex* corners, int count);
  void (*triangle)(const struct Frame* frame, const double win[3][2], const double z[3], const Vertex* const v[3]);
  void (*fragment)(const struct Frame* frame, int x, int y, double z, const double color[4], int drawn);
} Listener;

typedef struct Frame {
  int width, height;
  double color_codes;       /* largest code of a channel, 0: float */
  double depth_codes;       /* largest code of a depth, 0: float */
  double* color;            /* rgba, in codes or float */
  double* depth;            /* likewise, of window z */
  float* floats;            /* finish_frame() */
  unsigned primitive;       /* being drawn */
  const Listener* listener; /* or NULL */
} Frame;

typedef struct {
  int cull_front, cull_back, depth_clamp, write_depth, write_color[4];
  int box[4]; /* x0, y0, x1, y1: pixels outside are not drawn */
  Compare depth_func;
  double near, far;                   /* window z of the near and far plane */
  double offset_factor, offset_units; /* of window z */
} State;

/* Allocates or grows the frame's pixels, and clears them all. */
void clear_frame(Frame* frame, const double color[4], double depth);
void draw_triangle(Frame* frame, const State* state, const Vertex corners[3]);
/* Codes become numbers: frame->floats is rgba in [0,1], frame->depth window z. */
void finish_frame(Frame* frame);

#endif
