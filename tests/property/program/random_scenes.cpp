// Random scenes for other tools: writes their files, and makes a failing scene smaller. Exit 0: done; 1: the scene does
// not fail; 2: bad usage or input.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <rapidcheck.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "check/judge/judge.h"
#include "ordinary/ordinary_scene.h"
#include "reference/embree/embree.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/property/random_scene.h"
#include "tests/property/scene_text.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_text(const fs::path& file, const std::string& text) {
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string random_scene_text(std::uint64_t seed) {
  const auto draw = rc::gen::exec([] { return test::random_scene(); });
  return test::scene_text(draw(rc::Random(seed), rc::kNominalSize).value(), fmt::format("Random scene {}.", seed));
}

struct WriteOptions {
  std::string kind = "ordinary", folder;
  std::uint64_t first = 1, count = 1;
};

int write(const WriteOptions& o) {
  for (std::uint64_t seed = o.first; seed < o.first + o.count; ++seed) {
    const std::string text = o.kind == "ordinary" ? ordinary::ordinary_scene(seed) : random_scene_text(seed);
    write_text(fs::path(o.folder) / fmt::format("{:05}.json", seed), text);
  }
  return 0;
}

// The row that a smaller scene must still fail.
struct Row {
  std::string reference;
  Stage stage;
  check::Outcome outcome;
  std::string reason;  // of a dispute
  bool operator==(const Row&) const = default;
};
Row row_of(const check::Comparison& c) {
  return {title_of(c.judge), c.stage, c.outcome, c.outcome == check::Outcome::dispute ? c.measurement.reason : ""};
}

class Judge {
 public:
  explicit Judge(const std::vector<std::string>& assets) {
    options_.asset_folders.insert(options_.asset_folders.end(), assets.begin(), assets.end());
  }
  // The first row, in stage order, of one of the outcomes; none where the scene is refused, too.
  std::vector<Row> rows(const fs::path& file, bool disputes) {
    const check::Reference references[] = {
        {"osmesa", osmesa_.get()}, {"embree", embree_.get()}, {"exact", exact_.get()}};
    std::vector<Row> out;
    try {
      for (const check::Comparison& c : check::judge(load_scene(file, options_), *ours_, references).comparisons) {
        if (is_failure(c.outcome) || (disputes && c.outcome == check::Outcome::dispute)) out.push_back(row_of(c));
      }
    } catch (const SceneError&) {
    }
    std::ranges::stable_sort(out, {}, &Row::stage);
    return out;
  }

 private:
  SceneFileOptions options_;
  std::unique_ptr<Renderer> ours_ = pipeline::make_pipeline(), osmesa_ = make_opengl(), embree_ = embree::make_embree(),
                            exact_ = exact::make_exact();
};

struct ShrinkOptions {
  std::string scene, out;
  std::vector<std::string> assets;
  bool disputes = false;
};

// Makes the scene smaller as long as its row fails: takes away members and elements, from the outside inwards, and
// halves the frame.
class Shrinker {
 public:
  Shrinker(const ShrinkOptions& o, Judge& judge) : out_(o.out), disputes_(o.disputes), judge_(judge) {}

  // The smallest; nothing where the scene does not fail.
  std::optional<Json> shrink(const Json& scene) {
    scene_ = scene;
    const std::vector<Row> rows = rows_of(scene);
    if (rows.empty()) return std::nullopt;
    row_ = rows.front();
    fmt::print("{} {} {} {}\n", row_.reference, name_of(row_.stage), name_of(row_.outcome), row_.reason);
    for (std::string before; before != scene_.dump();) {
      before = scene_.dump();
      halve_frame();
      drop(Json::json_pointer());
    }
    return scene_;
  }

 private:
  std::vector<Row> rows_of(const Json& scene) {
    write_text(out_, scene.dump(1) + "\n");
    return judge_.rows(out_, disputes_);
  }
  bool try_instead(const Json& smaller) {
    if (!std::ranges::count(rows_of(smaller), row_)) return false;
    scene_ = smaller;
    return true;
  }

  void halve_frame() {
    if (!scene_.contains("frame")) return;
    for (const char* side : {"width", "height"}) {
      for (bool smaller = true; smaller;) {
        Json next = scene_;
        const int now = next["frame"].value(side, 256);
        next["frame"][side] = std::max(1, now / 2);
        smaller = now > 1 && try_instead(next);
      }
    }
  }

  // Each member or element of the value at `place` away, if the rest fails; else what it holds.
  void drop(const Json::json_pointer& place) {
    const Json value = scene_[place];
    if (!value.is_structured()) return;
    if (value.is_array() && !value.empty() && value[0].is_number()) return;  // a vector
    if (value.contains("width")) return;                                     // a frame, an image
    for (std::size_t i = value.size(); i-- > 0;) {
      const std::string key =
          value.is_array() ? std::to_string(i) : std::next(value.begin(), static_cast<long>(i)).key();
      if (key == "description" || key == "mesh" || key == "frame") continue;
      Json next = scene_;
      if (value.is_array()) {
        next[place].erase(i);
      } else {
        next[place].erase(key);
      }
      if (!try_instead(next)) drop(value.is_array() ? place / i : place / key);
    }
  }

  fs::path out_;
  bool disputes_;
  Judge& judge_;
  Json scene_;
  Row row_{};
};

int shrink(const ShrinkOptions& o) {
  Judge judge(o.assets);
  std::ifstream in(o.scene, std::ios::binary);
  const auto smallest = Shrinker(o, judge).shrink(Json::parse(in, nullptr, true, true));
  if (!smallest) {
    fmt::print("{} holds\n", o.scene);
    return 1;
  }
  write_text(o.out, smallest->dump(1) + "\n");
  return 0;
}

}  // namespace
}  // namespace plumbline

int main(int argc, char** argv) try {
  CLI::App app("Random scenes: writes them, makes failing ones smaller");
  app.require_subcommand(1);
  plumbline::WriteOptions to_write;
  CLI::App* write = app.add_subcommand("write", "FOLDER/SEED.json of each seed");
  write->add_option("folder", to_write.folder)->required();
  write->add_option("--kind", to_write.kind)->check(CLI::IsMember({"ordinary", "random"}));
  write->add_option("--first", to_write.first);
  write->add_option("--count", to_write.count)->required();
  plumbline::ShrinkOptions to_shrink;
  CLI::App* shrink = app.add_subcommand("shrink", "the smallest scene that fails the same row");
  shrink->add_option("scene", to_shrink.scene)->required()->check(CLI::ExistingFile);
  shrink->add_option("out", to_shrink.out)->required();
  shrink->add_option("--assets", to_shrink.assets);
  shrink->add_flag("--disputes", to_shrink.disputes, "a row that is in dispute counts as failed");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return write->parsed() ? plumbline::write(to_write) : plumbline::shrink(to_shrink);
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
