/* Arrays that grow. */
#ifndef COLUMNS_H
#define COLUMNS_H

#include <stddef.h>

/* `count` records of `size` bytes. */
typedef struct {
  char* bytes;
  size_t size, count, room;
} Column;
void* append(Column* column, size_t size); /* one more record */

extern Column projections;               /* of all draws, in double */
extern Column p_eye, p_clip, n_eye, lit; /* of all vertices, in float */

#endif
