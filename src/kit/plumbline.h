/* plumbline's kit for C and C++: reads what `plumb export` writes, writes a capture, and is the server that plumb calls.
   One header, C99, no dependency. MIT licence. src/kit/README.md lists the arrays and the state.

     static void draw(const PlScene *scene, PlCapture *out) {
       const int width = (int)pl_number(scene, "frame.width"), height = (int)pl_number(scene, "frame.height");
       if (pl_has(scene, "draws.0.fog")) pl_unsupported("fog");
       ... pl_color(out, rgba); pl_depth(out, z); ...
     }
     int main(int argc, char **argv) { return pl_main(argc, argv, "mine", draw); }

   plumb diagnose SCENE --program './mine {input} {output}'       one process per scene
   plumb check SCENES --program './mine {serve}'                  one process for all scenes

   Bad input ends the program with status 1 and a message. */
#ifndef PLUMBLINE_H
#define PLUMBLINE_H

#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if !defined(_WIN32)
#include <unistd.h>
#endif

#if defined(__GNUC__)
#define PL_UNUSED __attribute__((unused))
#define PL_PRINTF(text, first) __attribute__((format(printf, text, first), unused))
#define PL_NORETURN __attribute__((noreturn))
#else
#define PL_UNUSED
#define PL_PRINTF(text, first)
#define PL_NORETURN
#endif

enum { PL_VERSION = 1, PL_UNSUPPORTED_STATUS = 77, PL_PATH = 256 };

/* State of the server: one per program with gcc, clang and C++17, elsewhere one per including file. */
typedef struct {
  jmp_buf to; /* of a server in C; in C++ an exception takes its place */
  int serving, jumps;
  char reason[512];
} PlServer;
#if defined(__cplusplus) && __cplusplus >= 201703L
inline PlServer pl_server;
#elif defined(__GNUC__)
PlServer pl_server __attribute__((weak));
#else
static PlServer pl_server;
#endif
#ifdef __cplusplus
struct PlUnsupported {}; /* thrown by a server's pl_unsupported(): destructors run */
#endif

static void pl_fail(const char* format, ...) PL_PRINTF(1, 2) PL_NORETURN;
static void pl_fail(const char* format, ...) {
  va_list values;
  va_start(values, format);
  vfprintf(stderr, format, values);
  va_end(values);
  fputc('\n', stderr);
  exit(1);
}

/* Refuses the scene, with a reason of one line. Does not return: a server goes on with the next scene, in C by longjmp
   (free memory before the call), in C++ by an exception. */
static void pl_unsupported(const char* format, ...) PL_PRINTF(1, 2) PL_NORETURN;
static void pl_unsupported(const char* format, ...) {
  char* c;
  va_list values;
  va_start(values, format);
  vsnprintf(pl_server.reason, sizeof pl_server.reason, format, values);
  va_end(values);
  for (c = pl_server.reason; *c != '\0'; ++c) *c = *c == '\n' || *c == '\r' ? ' ' : *c;
#ifdef __cplusplus
  if (pl_server.serving && !pl_server.jumps) throw PlUnsupported();
#endif
  if (pl_server.serving && pl_server.jumps) longjmp(pl_server.to, 1);
  fprintf(stderr, "%s\n", pl_server.reason);
  exit(PL_UNSUPPORTED_STATUS);
}

static void* pl_memory(void* old, size_t bytes) {
  void* memory = realloc(old, bytes > 0 ? bytes : 1);
  if (memory == NULL) pl_fail("no memory for %zu bytes", bytes);
  return memory;
}

static char* pl_read(const char* folder, const char* name, size_t* size) {
  char path[8192];
  FILE* file;
  char* bytes;
  long length;
  snprintf(path, sizeof path, "%s/%s", folder, name);
  file = fopen(path, "rb");
  if (file == NULL) pl_fail("%s: cannot be read", path);
  fseek(file, 0, SEEK_END);
  length = ftell(file);
  rewind(file);
  if (length < 0) pl_fail("%s: cannot be read", path);
  bytes = (char*)pl_memory(NULL, (size_t)length + 1);
  if (fread(bytes, 1, (size_t)length, file) != (size_t)length) pl_fail("%s: cannot be read", path);
  fclose(file);
  bytes[length] = '\0';
  *size = (size_t)length;
  return bytes;
}

/* ---- the scene: the manifest's values by their path, "draws.0.cull" */

typedef struct {
  char *path, *text; /* text: of a string; else NULL */
  double number;     /* of an array: how many elements it has */
  int is_null;
} PlValue;

typedef struct {
  char *name, *bytes;
  size_t size;
} PlArray;

typedef struct {
  char* folder;
  PlValue* values; /* sorted by path */
  size_t count, room;
  PlArray* arrays; /* those read so far */
  size_t array_count;
} PlScene;

typedef struct {
  const char* at;
  PlScene* scene;
  char path[PL_PATH];
} PlParser;

static void pl_skip(PlParser* p) {
  while (*p->at == ' ' || *p->at == '\n' || *p->at == '\r' || *p->at == '\t') ++p->at;
}
static void pl_expect(PlParser* p, char c) {
  pl_skip(p);
  if (*p->at != c) pl_fail("%s/manifest.json: expected %c, found %.20s", p->scene->folder, c, p->at);
  ++p->at;
}

/* A text; \" \\ and \/ lose their backslash, other escapes keep it (no key and no enumerator has one). */
static char* pl_string(PlParser* p) {
  const char* from;
  char *out, *to;
  pl_expect(p, '"');
  from = p->at;
  while (*p->at != '"' && *p->at != '\0') p->at += *p->at == '\\' && p->at[1] != '\0' ? 2 : 1;
  out = to = (char*)pl_memory(NULL, (size_t)(p->at - from) + 1);
  for (; from < p->at; ++from) {
    if (*from == '\\' && (from[1] == '"' || from[1] == '\\' || from[1] == '/')) ++from;
    *to++ = *from;
  }
  *to = '\0';
  pl_expect(p, '"');
  return out;
}

static PlValue* pl_add(PlParser* p) {
  PlScene* scene = p->scene;
  PlValue* value;
  size_t length = strlen(p->path);
  if (scene->count == scene->room) {
    scene->room = scene->room ? 2 * scene->room : 256;
    scene->values = (PlValue*)pl_memory(scene->values, scene->room * sizeof *scene->values);
  }
  value = &scene->values[scene->count++];
  memset(value, 0, sizeof *value);
  value->path = (char*)pl_memory(NULL, length + 1);
  memcpy(value->path, p->path, length + 1);
  return value;
}

/* Takes a JSON number off the text. strtod() takes the decimal point of the locale, which a renderer may have set. */
static double pl_number_at(PlParser* p) {
  const char* point = localeconv()->decimal_point;
  const size_t length = strspn(p->at, "+-.0123456789eE"), of_point = strlen(point);
  char digits[256], *to = digits, *end;
  double number;
  size_t i;
  for (i = 0; i < length && (size_t)(to - digits) + of_point + 1 < sizeof digits; ++i) {
    memcpy(to, p->at[i] == '.' ? point : p->at + i, p->at[i] == '.' ? of_point : 1);
    to += p->at[i] == '.' ? of_point : 1;
  }
  *to = '\0';
  number = strtod(digits, &end);
  if (length == 0 || i < length || *end != '\0')
    pl_fail("%s/manifest.json: expected a value, found %.20s", p->scene->folder, p->at);
  p->at += length;
  return number;
}

static void pl_parse(PlParser* p) {
  const size_t length = strlen(p->path);
  pl_skip(p);
  if (*p->at == '{' || *p->at == '[') {
    const int object = *p->at++ == '{';
    int count = 0;
    pl_skip(p);
    while (*p->at != (object ? '}' : ']')) {
      if (count > 0) pl_expect(p, ',');
      if (object) {
        char* key = pl_string(p);
        snprintf(p->path + length, PL_PATH - length, "%s%s", length > 0 ? "." : "", key);
        free(key);
        pl_expect(p, ':');
      } else {
        snprintf(p->path + length, PL_PATH - length, "%s%d", length > 0 ? "." : "", count);
      }
      pl_parse(p);
      p->path[length] = '\0';
      ++count;
      pl_skip(p);
    }
    ++p->at;
    pl_add(p)->number = count;
  } else if (*p->at == '"') {
    char* text = pl_string(p);
    pl_add(p)->text = text;
  } else if (strncmp(p->at, "null", 4) == 0) {
    pl_add(p)->is_null = 1;
    p->at += 4;
  } else if (strncmp(p->at, "true", 4) == 0) {
    pl_add(p)->number = 1;
    p->at += 4;
  } else if (strncmp(p->at, "false", 5) == 0) {
    pl_add(p);
    p->at += 5;
  } else {
    const double number = pl_number_at(p);
    pl_add(p)->number = number;
  }
}

static int pl_by_path(const void* a, const void* b) {
  return strcmp(((const PlValue*)a)->path, ((const PlValue*)b)->path);
}

static PlScene* pl_open(const char* folder) {
  PlScene* scene = (PlScene*)pl_memory(NULL, sizeof *scene);
  PlParser parser;
  size_t size, length = strlen(folder);
  char* text;
  memset(scene, 0, sizeof *scene);
  scene->folder = (char*)pl_memory(NULL, length + 1);
  memcpy(scene->folder, folder, length + 1);
  text = pl_read(folder, "manifest.json", &size);
  parser.at = text;
  parser.scene = scene;
  parser.path[0] = '\0';
  pl_parse(&parser);
  free(text);
  qsort(scene->values, scene->count, sizeof *scene->values, pl_by_path);
  return scene;
}

static void pl_close(PlScene* scene) {
  size_t i;
  for (i = 0; i < scene->count; ++i) free(scene->values[i].path), free(scene->values[i].text);
  for (i = 0; i < scene->array_count; ++i) free(scene->arrays[i].name), free(scene->arrays[i].bytes);
  free(scene->values);
  free(scene->arrays);
  free(scene->folder);
  free(scene);
}

static const PlValue* pl_find(const PlScene* scene, const char* path) {
  PlValue key;
  memset(&key, 0, sizeof key);
  key.path = (char*)(uintptr_t)path;
  return (const PlValue*)bsearch(&key, scene->values, scene->count, sizeof key, pl_by_path);
}

static const PlValue* pl_require(const PlScene* scene, const char* path) {
  const PlValue* value = pl_find(scene, path);
  if (value == NULL) pl_fail("%s/manifest.json: expected %s, found none", scene->folder, path);
  return value;
}

#define PL_FORMATTED(path, format)                 \
  char path[PL_PATH];                              \
  va_list pl_values;                               \
  va_start(pl_values, format);                     \
  vsnprintf(path, sizeof path, format, pl_values); \
  va_end(pl_values)

/* Functions of a value's path, formatted as by printf: pl_text(scene, "draws.%d.cull", i). */

/* True: a value other than null. */
static int pl_has(const PlScene* scene, const char* format, ...) PL_PRINTF(2, 3);
static int pl_has(const PlScene* scene, const char* format, ...) {
  const PlValue* value;
  PL_FORMATTED(path, format);
  value = pl_find(scene, path);
  return value != NULL && !value->is_null;
}

/* A number; true: 1, false: 0; of an array or object its size; of a text or null 0. */
static double pl_number(const PlScene* scene, const char* format, ...) PL_PRINTF(2, 3);
static double pl_number(const PlScene* scene, const char* format, ...) {
  PL_FORMATTED(path, format);
  return pl_require(scene, path)->number;
}

static const char* pl_text(const PlScene* scene, const char* format, ...) PL_PRINTF(2, 3);
static const char* pl_text(const PlScene* scene, const char* format, ...) {
  const PlValue* value;
  PL_FORMATTED(path, format);
  value = pl_require(scene, path);
  if (value->text == NULL) pl_fail("%s/manifest.json: expected text at %s", scene->folder, path);
  return value->text;
}

/* True: the text is this word. */
static int pl_is(const PlScene* scene, const char* word, const char* format, ...) PL_PRINTF(3, 4);
static int pl_is(const PlScene* scene, const char* word, const char* format, ...) {
  PL_FORMATTED(path, format);
  return strcmp(pl_text(scene, "%s", path), word) == 0;
}

/* Index from 0 of the text among words such as "none|back|front". Calls pl_unsupported() for any other text. */
static int pl_choice(const PlScene* scene, const char* words, const char* format, ...) PL_PRINTF(3, 4);
static int pl_choice(const PlScene* scene, const char* words, const char* format, ...) {
  const char *text, *last;
  size_t length;
  int i = 0;
  PL_FORMATTED(path, format);
  text = pl_text(scene, "%s", path);
  length = strlen(text);
  while (strncmp(words, text, length) != 0 || (words[length] != '|' && words[length] != '\0')) {
    words = strchr(words, '|');
    if (words == NULL) break;
    ++words, ++i;
  }
  last = strrchr(path, '.');
  if (words == NULL) pl_unsupported("%s %s", last != NULL ? last + 1 : path, text);
  return i;
}

/* Calls pl_unsupported() for a value other than null, such as a draw's fog. */
static void pl_none(const PlScene* scene, const char* format, ...) PL_PRINTF(2, 3);
static void pl_none(const PlScene* scene, const char* format, ...) {
  const char* last;
  PL_FORMATTED(path, format);
  last = strrchr(path, '.');
  if (pl_has(scene, "%s", path)) pl_unsupported("%s", last != NULL ? last + 1 : path);
}

/* The first `count` numbers of an array of the manifest. */
static void pl_numbers(const PlScene* scene, double* out, int count, const char* format, ...) PL_PRINTF(4, 5);
static void pl_numbers(const PlScene* scene, double* out, int count, const char* format, ...) {
  int i;
  PL_FORMATTED(path, format);
  for (i = 0; i < count; ++i) out[i] = pl_number(scene, "%s.%d", path, i);
}

/* ---- arrays, as they lie in their files; each is read once and lives as long as the scene; NULL: there is none */

static const void* pl_bytes(PlScene* scene, const char* name, size_t* size) {
  char file[4096];
  PlArray* array;
  FILE* there;
  size_t i, length = strlen(name);
  for (i = 0; i < scene->array_count; ++i) {
    if (strcmp(scene->arrays[i].name, name) == 0) {
      *size = scene->arrays[i].size;
      return scene->arrays[i].bytes;
    }
  }
  snprintf(file, sizeof file, "%s/%s.bin", scene->folder, name);
  there = fopen(file, "rb");
  if (there == NULL) return NULL;
  fclose(there);
  snprintf(file, sizeof file, "%s.bin", name);
  scene->arrays = (PlArray*)pl_memory(scene->arrays, (scene->array_count + 1) * sizeof *scene->arrays);
  array = &scene->arrays[scene->array_count++];
  array->name = (char*)pl_memory(NULL, length + 1);
  memcpy(array->name, name, length + 1);
  array->bytes = pl_read(scene->folder, file, &array->size);
  *size = array->size;
  return array->bytes;
}

/* Numbers of the array; `count`: how many numbers, not records; may be NULL. */
static const float* pl_floats(const PlScene* scene, size_t* count, const char* format, ...) PL_PRINTF(3, 4);
static const float* pl_floats(const PlScene* scene, size_t* count, const char* format, ...) {
  size_t size = 0;
  const void* bytes;
  PL_FORMATTED(path, format);
  bytes = pl_bytes((PlScene*)(uintptr_t)scene, path, &size);
  if (count != NULL) *count = size / sizeof(float);
  return (const float*)bytes;
}
static const uint32_t* pl_uints(const PlScene* scene, size_t* count, const char* format, ...) PL_PRINTF(3, 4);
static const uint32_t* pl_uints(const PlScene* scene, size_t* count, const char* format, ...) {
  size_t size = 0;
  const void* bytes;
  PL_FORMATTED(path, format);
  bytes = pl_bytes((PlScene*)(uintptr_t)scene, path, &size);
  if (count != NULL) *count = size / sizeof(uint32_t);
  return (const uint32_t*)bytes;
}

/* ---- the capture */

typedef struct {
  const char* folder;
  FILE* manifest;
  int width, height, arrays;
} PlCapture;

/* Writes an array. dtype: f32 f64 u8 u16 u32 u64 or i32; `shape`: `extents` numbers, the last index runs fastest. */
static void pl_array(PlCapture* capture, const char* name, const char* dtype, const void* values, int extents,
                     const size_t* shape) {
  char path[4096];
  const size_t element = dtype[1] == '8' ? 1 : dtype[1] == '1' ? 2 : dtype[1] == '6' ? 8 : 4;
  size_t size = element;
  FILE* file;
  int i;
  fprintf(capture->manifest, "%s\n  {\"name\": \"%s\", \"dtype\": \"%s\", \"file\": \"%s.bin\", \"shape\": [",
          capture->arrays++ > 0 ? "," : "", name, dtype, name);
  for (i = 0; i < extents; ++i) {
    size *= shape[i];
    fprintf(capture->manifest, "%s%zu", i > 0 ? ", " : "", shape[i]);
  }
  fprintf(capture->manifest, "]}");
  snprintf(path, sizeof path, "%s/%s.bin", capture->folder, name);
  file = fopen(path, "wb");
  if (file == NULL || fwrite(values, 1, size, file) != size || fclose(file) != 0)
    pl_fail("%s: cannot be written", path);
}

/* Writes an array of `count` records, each of `components` values. */
static void pl_records(PlCapture* capture, const char* name, const char* dtype, const void* values, size_t count,
                       size_t components) PL_UNUSED;
static void pl_records(PlCapture* capture, const char* name, const char* dtype, const void* values, size_t count,
                       size_t components) {
  size_t shape[2];
  shape[0] = count;
  shape[1] = components;
  pl_array(capture, name, dtype, values, components > 1 ? 2 : 1, shape);
}

/* Planes of the frame: rows as the scene counts them (frame.rows_from_top), `components` values a pixel. */
static void pl_plane(PlCapture* capture, const char* name, const char* dtype, const void* values, size_t components) {
  size_t shape[3];
  shape[0] = (size_t)capture->height;
  shape[1] = (size_t)capture->width;
  shape[2] = components;
  pl_array(capture, name, dtype, values, components > 1 ? 3 : 2, shape);
}
/* The frame's colour, rgba in [0,1], and its depth, window z. */
static void pl_color(PlCapture* capture, const float* rgba) PL_UNUSED;
static void pl_color(PlCapture* capture, const float* rgba) { pl_plane(capture, "planes.color", "f32", rgba, 4); }
static void pl_depth(PlCapture* capture, const double* z) PL_UNUSED;
static void pl_depth(PlCapture* capture, const double* z) { pl_plane(capture, "planes.depth", "f64", z, 1); }

/* ---- the program */

typedef void (*PlDraw)(const PlScene* scene, PlCapture* out);

/* Writes a JSON string. */
static void pl_quoted(FILE* to, const char* text) {
  fputc('"', to);
  for (; *text != '\0'; ++text) {
    if (*text == '"' || *text == '\\') fputc('\\', to);
    fputc((unsigned char)*text < ' ' ? ' ' : *text, to);
  }
  fputc('"', to);
}

static void pl_run(const char* input, const char* output, const char* renderer, PlDraw draw, PlScene** open,
                   FILE** manifest) {
  char path[4096];
  PlCapture capture;
  *open = pl_open(input);
  if (!pl_is(*open, "plumbline export", "format")) pl_fail("%s: expected a plumbline export", input);
  if (!pl_has(*open, "version") || pl_number(*open, "version") != 1)
    pl_fail("%s: expected a plumbline export of version 1", input);
  capture.folder = output;
  capture.width = (int)pl_number(*open, "frame.width");
  capture.height = (int)pl_number(*open, "frame.height");
  capture.arrays = 0;
  snprintf(path, sizeof path, "%s/manifest.json", output);
  capture.manifest = fopen(path, "w");
  if (capture.manifest == NULL) pl_fail("%s: cannot be written", path);
  *manifest = capture.manifest;
  fprintf(capture.manifest, "{\"format\": \"plumbline capture\", \"version\": 1, \"renderer\": ");
  pl_quoted(capture.manifest, renderer);
  fprintf(capture.manifest, ", \"width\": %d, \"height\": %d,\n \"byte_order\": \"little\", \"arrays\": [",
          capture.width, capture.height);
  draw(*open, &capture);
  fprintf(capture.manifest, "\n]}\n");
  *manifest = NULL;
  if (fclose(capture.manifest) != 0) pl_fail("%s: cannot be written", path);
  pl_close(*open);
  *open = NULL;
}

static void pl_answer(int to, const char* what, const char* reason) {
  char line[1024];
  const int length = snprintf(line, sizeof line, "%s%s\n", what, reason);
#if defined(_WIN32)
  (void)to;
  fwrite(line, 1, (size_t)length, stdout);
  fflush(stdout);
#else
  if (write(to, line, (size_t)length) != length) pl_fail("stdout: the answer cannot be written");
#endif
}

/* Draws one scene of a server; 0 where pl_unsupported() was called. */
static int pl_serve(const char* input, const char* output, const char* renderer, PlDraw draw) {
  static PlScene* open;
  static FILE* manifest;
  volatile int drawn = 1; /* longjmp() keeps it */
  pl_server.serving = 1;
#ifdef __cplusplus
  try {
    pl_run(input, output, renderer, draw, &open, &manifest);
  } catch (const PlUnsupported&) {
    drawn = 0;
  }
#else
  pl_server.jumps = 1;
  if (setjmp(pl_server.to) == 0) {
    pl_run(input, output, renderer, draw, &open, &manifest);
  } else {
    drawn = 0;
  }
#endif
  if (manifest != NULL) fclose(manifest);
  if (open != NULL) pl_close(open);
  manifest = NULL;
  open = NULL;
  return drawn;
}

/* Draws the scene of the command line (INPUT OUTPUT), or, given --serve, those that stdin names: "INPUT<tab>OUTPUT" a
   line, answered on stdout by "ok" or "unsupported REASON"; the renderer's prints then go to stderr. */
static int pl_main(int argc, char** argv, const char* renderer, PlDraw draw) PL_UNUSED;
static int pl_main(int argc, char** argv, const char* renderer, PlDraw draw) {
  char line[8192];
  int answers = 1;
  if (argc == 3) {
    PlScene* open;
    FILE* manifest;
    pl_run(argv[1], argv[2], renderer, draw, &open, &manifest);
    return 0;
  }
  if (argc != 2 || strcmp(argv[1], "--serve") != 0) pl_fail("usage: %s INPUT OUTPUT, or %s --serve", argv[0], argv[0]);
#if !defined(_WIN32)
  answers = dup(STDOUT_FILENO);
  if (answers < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) pl_fail("stdout: cannot be kept for answers");
#endif
  while (fgets(line, sizeof line, stdin) != NULL) {
    char* tab = strchr(line, '\t');
    line[strcspn(line, "\n")] = '\0';
    if (tab == NULL) pl_fail("stdin: expected INPUT<tab>OUTPUT, found %s", line);
    *tab = '\0';
    if (pl_serve(line, tab + 1, renderer, draw)) {
      pl_answer(answers, "ok", "");
    } else {
      pl_answer(answers, "unsupported ", pl_server.reason);
    }
  }
  return 0;
}

#endif
