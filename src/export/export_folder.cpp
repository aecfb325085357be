#include "export/export_folder.h"

#include <cstring>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "capture/files/array_folder.h"
#include "export/state_json.h"
#include "scene/antialias.h"
#include "scene/json/json_file.h"
#include "scene/names.h"

namespace plumbline {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "plumbline export";
constexpr int kVersion = 1;

// Writes a capture's records of stages 0 to 4 as arrays, doubles rounded to float.
class StageWriter {
 public:
  explicit StageWriter(ArrayFolder& folder) : folder_(folder) {}

  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& records) {
    if (!kGeometryStages.has(group.stage) || records.empty()) return;
    columns.each([&]<class C>(const C& column) {
      const std::string name = fmt::format("{}.{}", group.name, column.name);
      const std::vector<char> bytes = packed(records, column);
      std::string_view dtype = Element<ColumnType<C, const Record>>::dtype;
      std::string_view raw(bytes.data(), bytes.size());
      std::vector<float> floats;
      if (dtype == Element<double>::dtype) {
        floats = as_floats(raw);
        dtype = Element<float>::dtype;
        raw = {reinterpret_cast<const char*>(floats.data()), floats.size() * sizeof(float)};
      }
      folder_.add(name, dtype, record_shape<C, const Record>(records.size()), raw);
    });
  }
  void plane(Handed, const auto&) {}

 private:
  static std::vector<float> as_floats(std::string_view doubles) {
    std::vector<float> out(doubles.size() / sizeof(double));
    for (std::size_t i = 0; i < out.size(); ++i) {
      double value;
      std::memcpy(&value, doubles.data() + i * sizeof(double), sizeof value);
      out[i] = static_cast<float>(value);
    }
    return out;
  }

  ArrayFolder& folder_;
};

void add_matrices(const std::vector<Matrices<double>>& matrices, ArrayFolder& folder) {
  const auto add = [&](std::string_view name, auto member) {
    std::vector<std::remove_cvref_t<decltype(matrices[0].*member)>> values;
    for (const Matrices<double>& m : matrices) values.push_back(m.*member);
    folder.add(fmt::format("matrices_f64.{}", name), values);
  };
  add("model_view", &Matrices<double>::model_view);
  add("projection", &Matrices<double>::projection);
  add("normal", &Matrices<double>::normal);
}

void add_mesh(std::size_t number, const Mesh& mesh, ArrayFolder& folder) {
  const auto add = [&](std::string_view name, const auto& values) {
    if (!values.empty()) folder.add(fmt::format("meshes.{}.{}", number, name), values);
  };
  add("positions", mesh.positions);
  add("normals", mesh.normals);
  add("colors", mesh.colors);
  add("texcoords", mesh.texcoords);
  add("indices", mesh.triangles);
}

Json head(const Scene& scene) {
  return {{"format", kFormat}, {"version", kVersion}, {"name", scene.name}, {"frame", frame_json(scene)}};
}

// Writes a scene of one sample per pixel: one that is not antialiased, or a pass.
void write_single(const Scene& scene, const StagesOf& stages_of, ArrayFolder folder) {
  const ExportedStages stages = stages_of(scene);
  Json manifest = head(scene);
  manifest["light_model"] = light_model_json(scene.light_model);
  Json& lights = manifest["lights"] = Json::array();
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    lights.push_back(light_json(scene.lights[i], stages.ours.records.lights.at(i)));
  }
  Json& textures = manifest["textures"] = Json::array();
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    textures.push_back(texture_json(scene.textures[i]));
    for (std::size_t level = 0; level < scene.textures[i].levels.size(); ++level) {
      folder.add(fmt::format("textures.{}.{}", i, level), scene.textures[i].levels[level].texels);
    }
  }
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  Json& draws = manifest["draws"] = Json::array();
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    Json draw = draw_json(scene.draws[i]);
    draw["topology"] = name_of(scene.meshes[scene.draws[i].mesh].topology);
    draw["first_vertex"] = ranges[i].first_vertex;
    draw["vertices"] = ranges[i].vertex_count;
    draw["first_primitive"] = ranges[i].first_primitive;
    draw["primitives"] = ranges[i].primitive_count;
    draws.push_back(std::move(draw));
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) add_mesh(i, scene.meshes[i], folder);
  add_matrices(stages.matrices, folder);
  visit_capture(StageWriter(folder), stages.ours);
  folder.finish(std::move(manifest));
}

fs::path pass_folder(std::size_t pass) { return fmt::format("pass{}", pass); }

// Adds the files of an export, by its manifest, to `names`. `inside`: folder of a pass, relative to `folder`.
void add_files(const fs::path& folder, const fs::path& inside, std::set<fs::path>& names) {
  const JsonFile file(folder / inside / "manifest.json");
  const JsonNode root = file.root();
  root.require_format(kFormat);
  names.insert(inside / "manifest.json");
  for (const JsonNode& array : root["arrays"].elements(0, SIZE_MAX)) names.insert(inside / array["file"].text());
  if (const auto passes = root.find("passes")) {
    for (std::size_t i = 0; i < passes->size(); ++i) add_files(folder, inside / pass_folder(i), names);
  }
}

}  // namespace

void require_writable_export(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code none;
  if (fs::exists(folder / "manifest.json", none)) {
    try {
      add_files(folder, {}, files);
    } catch (const std::exception& error) {
      throw OutputError(folder, fmt::format("the folder holds no export ({}); it is left alone", error.what()));
    }
  }
  require_writable_folder(folder, files);
}

void write_export(const Scene& scene, const StagesOf& stages_of, const fs::path& folder) {
  require_writable_export(folder);
  AtomicPath atomic(folder);
  atomic.make_folder();
  if (!antialiased(scene)) {
    write_single(scene, stages_of, ArrayFolder(atomic));
    return atomic.commit();
  }
  const std::vector<Scene> passes = passes_of(scene);
  Json manifest = head(scene);
  manifest["factor"] = scene.frame.antialias.factor;
  Json& names = manifest["passes"] = Json::array();
  for (std::size_t i = 0; i < passes.size(); ++i) {
    names.push_back(pass_folder(i).string());
    write_single(passes[i], stages_of, ArrayFolder(atomic, pass_folder(i)));
  }
  Json& samples = manifest["samples"] = Json::array();
  for (const PixelSample& sample : samples_of(scene.frame.antialias)) {
    samples.push_back({sample.pass, sample.offset.x, sample.offset.y, sample.weight});
  }
  ArrayFolder(atomic).finish(std::move(manifest));
  atomic.commit();
}

}  // namespace plumbline
