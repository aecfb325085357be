#include "capture/files/capture_folder.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "capture/capture_columns.h"
#include "capture/files/array_folder.h"
#include "scene/json/json_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "plumbline capture";
constexpr int kVersion = 1;
constexpr int kLargestFrame = 16384;

// ---- writing

class Writer {
 public:
  Writer(ArrayFolder& folder, const Capture& capture) : folder_(folder), capture_(capture) {}

  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& records) {
    if (records.empty() && !capture_.without_records.contains(std::string(group.name))) return;
    columns.each([&](const auto& c) { column(group.name, records, c); });
  }

  template <class T>
  void plane(Handed of, const Plane<T>& plane) {
    if (plane.empty()) return;
    folder_.add(of.name, Element<T>::dtype, plane_shape<T>(plane.width(), plane.height()),
                {reinterpret_cast<const char*>(plane.values().data()), plane.size() * sizeof(T)});
  }

 private:
  template <class Record, class C>
  void column(std::string_view group, const std::vector<Record>& records, const C& column) {
    const std::vector<char> bytes = packed(records, column);
    folder_.add(fmt::format("{}.{}", group, column.name), Element<ColumnType<C, const Record>>::dtype,
                record_shape<C, const Record>(records.size()), {bytes.data(), bytes.size()});
  }

  ArrayFolder& folder_;
  const Capture& capture_;
};

// ---- reading

class Reader {
 public:
  Reader(const fs::path& folder, Capture& capture)
      : folder_(folder), manifest_(folder / "manifest.json"), capture_(capture) {
    const JsonNode root = manifest_.root();
    require(root["format"], kFormat);  // first: its message says what an export's folder is
    root.only({"format", "version", "renderer", "renderer_version", "width", "height", "byte_order", "arrays"});
    root["version"].integer(kVersion, kVersion);
    require(root["byte_order"], "little");
    capture.renderer = root["renderer"].text();
    if (const auto version = root.find("renderer_version")) {
      if (version->value().kind != JsonValue::Kind::text) version->refuse("a string");
      capture.version = version->value().text;
    }
    capture.width = static_cast<int>(root["width"].integer(1, kLargestFrame));
    capture.height = static_cast<int>(root["height"].integer(1, kLargestFrame));
    for (const JsonNode& array : root["arrays"].elements(0, SIZE_MAX)) {
      array.only({"name", "dtype", "shape", "file"});
      if (!arrays_.emplace(array["name"].text(), array).second) array["name"].refuse("each name once");
    }
  }

  template <class Record>
  void group(Handed group, const auto& columns, std::vector<Record>& records) {
    std::optional<std::size_t> count;  // before any memory is taken, every file is known to be of its right size
    std::vector<std::string> lacking, derived;
    columns.each([&](const auto& column) {
      const std::string name = fmt::format("{}.{}", group.name, column.name);
      if (!check<Record>(name, column, count)) (column.derivable ? derived : lacking).push_back(name);
    });
    if (!count) return;
    if (!lacking.empty()) {
      throw CaptureError(fmt::format("{}: expected all arrays {}.*, found none of {}", folder_.string(), group.name,
                                     fmt::join(lacking, ", ")));
    }
    records.resize(*count);
    if (*count == 0) capture_.without_records.insert(std::string(group.name));
    capture_.derived.insert(derived.begin(), derived.end());
    columns.each([&](const auto& column) { read(fmt::format("{}.{}", group.name, column.name), records, column); });
  }

  template <class T>
  void plane(Handed of, Plane<T>& plane) {
    const auto array = take(of.name);
    if (!array) return;
    const Shape shape = plane_shape<T>(capture_.width, capture_.height);
    check_type<T>(*array);
    if (const Shape found = read_shape(*array); found != shape) {
      (*array)["shape"].refuse(fmt::format("[{}] of {}", fmt::join(shape, ", "), of.name),
                               fmt::format("[{}]", fmt::join(found, ", ")));
    }
    const auto pixels = static_cast<std::size_t>(capture_.width) * static_cast<std::size_t>(capture_.height);
    check_size(*array, pixels, bytes_of<T>(*array));
    plane = Plane<T>(capture_.width, capture_.height);
    const std::vector<char> bytes = read_elements<T>(*array, pixels);
    std::memcpy(plane.values().data(), bytes.data(), bytes.size());
    if (is_narrow<T>(*array)) capture_.depth_in_float = true;  // the one plane of doubles
  }

  /// Names of the files that the manifest names, and its own. Call before anything else is read.
  std::set<fs::path> files() const {
    std::set<fs::path> names{"manifest.json"};
    for (const auto& [name, array] : arrays_) names.insert(array["file"].text());
    return names;
  }

  /// Refuses an array that is no group's and no plane's. Call after all groups and planes are read.
  void finish() const {
    for (const auto& [name, array] : arrays_) {
      array["name"].refuse("the name of an array of this format's version", fmt::format("\"{}\"", name));
    }
  }

 private:
  static void require(const JsonNode& node, std::string_view text) {
    if (node.text() != text) node.refuse(fmt::format("\"{}\"", text));
  }

  /// The array of this name, once.
  std::optional<JsonNode> take(std::string_view name) {
    const auto found = arrays_.extract(std::string(name));
    if (found.empty()) return std::nullopt;
    return found.mapped();
  }

  Shape read_shape(const JsonNode& array) const {
    constexpr std::size_t kMostExtents = 4;
    Shape shape;
    for (const JsonNode& extent : array["shape"].elements(1, kMostExtents)) {
      shape.push_back(static_cast<std::size_t>(extent.integer(0, INT64_MAX)));
    }
    return shape;
  }

  // Floats where doubles are expected: nothing is lost.
  template <class T>
  static bool is_narrow(const JsonNode& array) {
    return Element<T>::dtype == "f64" && array["dtype"].text() == "f32";
  }
  template <class T>
  static std::size_t bytes_of(const JsonNode& array) {
    return is_narrow<T>(array) ? sizeof(T) / 2 : sizeof(T);
  }

  template <class T>
  void check_type(const JsonNode& array) const {
    if (array["dtype"].text() == Element<T>::dtype || is_narrow<T>(array)) return;
    array["dtype"].refuse(fmt::format("\"{}\" of {}", Element<T>::dtype, array["name"].text()));
  }

  /// The array's file, known to hold `count` elements of `bytes` bytes.
  void check_size(const JsonNode& array, std::size_t count, std::size_t bytes) const {
    const fs::path file = file_of(array);
    if (!fs::is_regular_file(file))
      fail(array, fs::exists(file) ? "expected a regular file" : "expected a file, found none");
    const std::uintmax_t size = fs::file_size(file);
    if (size % bytes == 0 && size / bytes == count) return;
    fail(array, fmt::format("expected {} times {} bytes, found {} bytes", count, bytes, size));
  }

  /// Checks a column's entry and file; false: it is not there.
  template <class Record, class C>
  bool check(const std::string& name, const C&, std::optional<std::size_t>& count) {
    using T = ColumnType<C, Record>;
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) return false;
    const JsonNode& array = found->second;
    check_type<T>(array);
    const Shape shape = read_shape(array), expected = record_shape<C, Record>(shape[0]);
    if (shape != expected) {
      array["shape"].refuse(fmt::format("[{}] of {}", fmt::join(expected, ", "), name),
                            fmt::format("[{}]", fmt::join(shape, ", ")));
    }
    if (count && *count != shape[0]) {
      array["shape"].refuse(fmt::format("as many records in {} as in the other arrays {}.*, {}", name,
                                        name.substr(0, name.rfind('.')), *count),
                            fmt::format("{}", shape[0]));
    }
    count = shape[0];
    check_size(array, shape[0], kPerRecord<C> * bytes_of<T>(array));
    return true;
  }

  template <class Record, class C>
  void read(const std::string& name, std::vector<Record>& records, const C& column) {
    using T = ColumnType<C, Record>;
    const auto taken = take(name);
    if (!taken) return;
    const JsonNode& array = *taken;
    const std::vector<char> bytes = read_elements<T>(array, records.size() * kPerRecord<C>);
    if constexpr (std::is_same_v<T, bool>) {
      const auto odd = std::find_if(bytes.begin(), bytes.end(), [](char b) { return b != 0 && b != 1; });
      if (odd != bytes.end()) fail(array, fmt::format("expected 0 or 1, found {}", static_cast<unsigned char>(*odd)));
    }
    const char* from = bytes.data();
    for (Record& record : records) {
      for (std::size_t k = 0; k < kPerRecord<C>; ++k, from += sizeof(T)) {
        std::memcpy(&column.at(record, k), from, sizeof(T));
      }
    }
  }

  // The array's elements as they lie in memory.
  template <class T>
  std::vector<char> read_elements(const JsonNode& array, std::size_t count) const {
    std::vector<char> bytes(count * bytes_of<T>(array));
    std::ifstream in(file_of(array), std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in) fail(array, "cannot be read");
    if (!is_narrow<T>(array)) return bytes;
    std::vector<char> wide(2 * bytes.size());
    for (std::size_t i = 0; i < bytes.size() / sizeof(float); ++i) {
      float narrow = 0;
      std::memcpy(&narrow, &bytes[i * sizeof narrow], sizeof narrow);
      const double value = narrow;
      std::memcpy(&wide[i * sizeof value], &value, sizeof value);
    }
    return wide;
  }

  fs::path file_of(const JsonNode& array) const {
    const fs::path name = array["file"].text();
    if (name != name.filename() || name == "." || name == "..") array["file"].refuse("a file name without a folder");
    return folder_ / name;
  }

  [[noreturn]] void fail(const JsonNode& array, std::string_view what) const {
    throw CaptureError(fmt::format("{}: array {}: {}", file_of(array).string(), array["name"].text(), what));
  }

  fs::path folder_;
  JsonFile manifest_;
  Capture& capture_;
  std::map<std::string, JsonNode> arrays_;  ///< by name, those not yet read
};

/// Refuses a group that lies beside another and is of another size; where either is empty, it is not shown.
struct BesideOthers {
  const Records<double>& all;
  const fs::path& folder;

  void group(Handed group, const auto&, const auto& records) const {
    const Owners owners = owners_of(all, group.per);
    if (records.empty() || owners.count == 0 || records.size() == owners.count) return;
    throw CaptureError(fmt::format("{}: arrays {}.*: expected as many as in {}.*, {}, found {}", folder.string(),
                                   group.name, owners.group, owners.count, records.size()));
  }
  void plane(Handed, const auto&) const {}
};

/// Refuses what points outside.
void check_indices(const Capture& capture, const fs::path& folder) {
  const auto fail = [&](std::string_view array, std::size_t i, std::string_view what) {
    throw CaptureError(fmt::format("{}: array {}: element {}: {}", folder.string(), array, i, what));
  };
  const Records<double>& records = capture.records;

  const ClipPolygons<double>& clip = records.polygons;
  for (std::size_t i = 0; i < clip.polygons.size(); ++i) {
    const ClipPolygon& polygon = clip.polygons[i];
    if (polygon.count < 1 || polygon.count > kMostPolygonVertices) {
      fail("clip.polygon.count", i,
           fmt::format("expected 1 to {} vertices, found {}", kMostPolygonVertices, polygon.count));
    }
    if (std::uint64_t{polygon.first} + polygon.count > clip.vertices.size()) {
      fail("clip.polygon.first", i,
           fmt::format("expected vertices below {}, found {} from {}", clip.vertices.size(), polygon.count,
                       polygon.first));
    }
  }

  for (std::size_t i = 0; i < records.triangles.size(); ++i) {
    const std::uint32_t corners = records.triangles[i].corners;
    if (corners < 1 || corners > 3) fail("window.corners", i, fmt::format("expected 1 to 3, found {}", corners));
  }

  const bool has_window = !records.triangles.empty() || capture.without_records.contains("window");
  for (std::size_t i = 0; i < records.covered.size(); ++i) {
    const Covered& covered = records.covered[i];
    if (has_window && covered.triangle >= records.triangles.size()) {
      fail("coverage.triangle", i,
           fmt::format("expected a triangle below {}, found {}", records.triangles.size(), covered.triangle));
    }
    if (covered.x >= capture.width) {
      fail("coverage.x", i, fmt::format("expected x below {}, found {}", capture.width, covered.x));
    }
    if (covered.y >= capture.height) {
      fail("coverage.y", i, fmt::format("expected y below {}, found {}", capture.height, covered.y));
    }
  }

  visit_capture(BesideOthers{records, folder}, capture);
}

}  // namespace

void require_writable_capture(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code none;
  if (fs::exists(folder / "manifest.json", none)) {
    try {
      Capture header;
      files = Reader(folder, header).files();
    } catch (const std::exception& error) {
      throw OutputError(folder, fmt::format("the folder holds no capture ({}); it is left alone", error.what()));
    }
  }
  require_writable_folder(folder, files);
}

void write_capture(const Capture& capture, const fs::path& folder) {
  require_writable_capture(folder);
  AtomicPath atomic(folder);
  atomic.make_folder();
  ArrayFolder arrays(atomic);
  visit_capture(Writer(arrays, capture), capture);
  arrays.finish({{"format", kFormat},
                 {"version", kVersion},
                 {"renderer", capture.renderer},
                 {"renderer_version", capture.version},
                 {"width", capture.width},
                 {"height", capture.height}});
  atomic.commit();
}

Capture read_capture(const fs::path& folder) {
  try {
    Capture capture;
    Reader reader(folder, capture);
    capture.files_of_arrays = reader.files().size() - 1;  // beside the manifest
    visit_capture(reader, capture);
    reader.finish();
    check_indices(capture, folder);
    return capture;
  } catch (const JsonError& error) {
    throw CaptureError(error.what());
  } catch (const fs::filesystem_error& error) {
    throw CaptureError(fmt::format("{}: cannot be read: {}", folder.string(), error.what()));
  }
}

}  // namespace plumbline
