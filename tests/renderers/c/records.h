/* What the renderer hands out beside its frame. Of plain.c nothing: its vertex stage is the export's. Of vertex.c and
   records.c what each stage of its own hands on; with PICTURES in the environment that is kept back, with GIVEN
   the vertex stage is the export's, and with PICTURE=FILE the frame is written there as well, as PPM. */
#ifndef RECORDS_H
#define RECORDS_H

#include "kit/plumbline.h"
#include "rasterizer.h"

/* Positions in clip space and lit colours of all vertices, four numbers each; valid until the next call. */
const float* vertices_of(const PlScene* scene, const float** colors);
/* Forgets the last scene's, but for the vertex stage's. */
const Listener* begin_records(const PlScene* scene);
void write_records(const Frame* frame, PlCapture* out);

#endif
