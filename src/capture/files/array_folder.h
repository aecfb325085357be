// Folders of arrays: manifest.json and one little-endian .bin file per array (capture_folder.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/atomic_path.h"
#include "capture/capture_columns.h"

namespace plumbline {

using Shape = std::vector<std::size_t>;

/// The extents of `count` records' array.
template <class C, class Record>
Shape record_shape(std::size_t count) {
  Shape shape{count};
  if (C::kCorners != 0) shape.push_back(C::kCorners);
  for (const std::size_t extent : Element<ColumnType<C, Record>>::extents) shape.push_back(extent);
  return shape;
}

/// Extents of a plane's array: height, width, and those of an element.
template <class T>
Shape plane_shape(int width, int height) {
  Shape shape{static_cast<std::size_t>(height), static_cast<std::size_t>(width)};
  for (const std::size_t extent : Element<T>::extents) shape.push_back(extent);
  return shape;
}

/// A folder of arrays, in a folder that is being written (atomic_path.h).
class ArrayFolder {
 public:
  /// `inside`: the arrays' folder, relative to `folder`; empty: `folder` itself.
  explicit ArrayFolder(AtomicPath& folder, std::filesystem::path inside = {});
  /// Writes `name`.bin: elements of this type, the last index running fastest. Throws OutputError.
  void add(std::string_view name, std::string_view dtype, const Shape& shape, std::string_view bytes);
  /// Writes an array of plain numbers, vectors or matrices.
  template <class T>
  void add(std::string_view name, const std::vector<T>& values) {
    Shape shape{values.size()};
    for (const std::size_t extent : Element<T>::extents) shape.push_back(extent);
    add(name, Element<T>::dtype, shape, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  /// Writes the manifest: these keys, then byte_order and arrays. Throws OutputError.
  void finish(nlohmann::ordered_json manifest);

 private:
  AtomicPath& folder_;
  std::filesystem::path inside_;
  nlohmann::ordered_json arrays_ = nlohmann::ordered_json::array();
};

}  // namespace plumbline
