// Capture folder: manifest.json and one little-endian .bin file per array. A renderer in another process, in any
// language, has nothing else to write.
//
//   {"format": "plumbline capture", "version": 1, "renderer": "...", "renderer_version": "...",
//    "width": 97, "height": 61, "byte_order": "little",
//    "arrays": [{"name": "window.p_win", "dtype": "f64", "shape": [1234, 3, 3], "file": "window.p_win.bin"}, ...]}
//
// dtype is one of f32 f64 u8 u16 u32 u64 i32; f32 may stand where f64 is expected. The first extent of a record's array
// is the number of records (of window.* the next is the corner), of a plane's the row, from the bottom; the last is the
// component; matrices are column by column. A file is its array's elements, the last index running fastest, and nothing
// else. The names, and what belongs to each, are listed in capture_columns.h; values mean what stages.h and capture.h
// say. What was not captured is left out: a plane, or all arrays of a record. Polygons, window triangles and fragments
// may be in any order, a polygon's triangles in its own; columns that follow from others may be left out
// (complete_records.h).
#pragma once

#include <filesystem>
#include <stdexcept>

#include "capture/capture.h"

namespace plumbline {

/// Error of a capture folder. The message names the file and, where there is one, the array.
struct CaptureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes a capture's records and planes; not its samples (an antialiased scene's passes), nor its legal answers. A
/// folder that holds a capture and nothing else, or nothing, is replaced, in one moment; its parents are made. Throws
/// OutputError (atomic_path.h).
void write_capture(const Capture& capture, const std::filesystem::path& folder);

/// Throws what write_capture() would throw for this folder, before there is a capture; leaves no file behind.
void require_writable_capture(const std::filesystem::path& folder);

/// Reads a capture back, bit for bit; values may be anything, NaN included. Throws CaptureError on what is missing, of
/// another size, type or shape than the manifest or the format says, of a version or name not known, or points outside
/// (polygons into their vertices, fragments into the window's triangles, where those are there, and into the frame).
Capture read_capture(const std::filesystem::path& folder);

}  // namespace plumbline
