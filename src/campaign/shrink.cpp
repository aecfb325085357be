#include "campaign/shrink.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plumbline::campaign {

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

constexpr std::string_view kKept[] = {"description", "mesh", "width", "height", "image", "positions"};

// Scene that shrinks by trials: a smaller scene replaces it if the finding still shows.
class Shrinker {
 public:
  Shrinker(const std::string& scene, const Shows& shows, int trials)
      : scene_(Json::parse(scene)), shows_(shows), left_(trials) {}

  std::string shrink() {
    for (std::string before; before != text() && left_ > 0;) {
      before = text();
      fewer_items({Pointer("/draws")});
      smaller_frame();
      fewer_members(Pointer());
      for (std::size_t i = 0; i < scene_["draws"].size(); ++i) smaller_mesh(Pointer("/draws") / i / "mesh");
      rounder(Pointer());
    }
    return text();
  }

 private:
  std::string text() const { return scene_.dump(1) + "\n"; }

  bool try_instead(Json smaller) {
    if (left_ <= 0 || smaller == scene_) return false;
    --left_;
    if (!shows_(smaller.dump(1) + "\n")) return false;
    scene_ = std::move(smaller);
    return true;
  }

  // Removes items of parallel lists: a half, then quarters, down to single items. One item stays.
  void fewer_items(const std::vector<Pointer>& lists) {
    const Pointer& list = lists.front();
    for (std::size_t run = scene_[list].size() / 2; run > 0; run /= 2) {
      for (std::size_t first = 0; first < scene_[list].size();) {
        const std::size_t size = scene_[list].size(), count = std::min(run, size - first);
        Json smaller = scene_;
        for (const Pointer& of : lists) {
          const auto begin = smaller[of].begin() + static_cast<Json::difference_type>(first);
          smaller[of].erase(begin, begin + static_cast<Json::difference_type>(count));
        }
        if (count == size || !try_instead(std::move(smaller))) first += count;
      }
    }
  }

  void smaller_frame() {
    for (const char* side : {"width", "height"}) {
      for (bool smaller = scene_.contains("frame"); smaller;) {
        Json next = scene_;
        const int now = next["frame"].value(side, 256);
        next["frame"][side] = std::max(1, now / 2);
        smaller = now > 1 && try_instead(std::move(next));
      }
    }
  }

  // Removes each member; if a member must stay, its members. smaller_frame() treats the frame's size.
  void fewer_members(const Pointer& place) {
    const Json value = scene_[place];
    if (value.is_array()) {
      if (value.empty() || !value[0].is_structured()) return;
      for (std::size_t i = value.size(); i-- > 0;) {
        Json next = scene_;
        next[place].erase(i);
        if (next[place].empty() || !try_instead(std::move(next))) fewer_members(place / i);
      }
    }
    if (!value.is_object()) return;
    for (const auto& [key, of] : value.items()) {
      if (std::ranges::count(kKept, key) > 0) continue;
      Json next = scene_;
      next[place].erase(key);
      if (key == "frame" || !try_instead(std::move(next))) fewer_members(place / key);
    }
  }

  // Replaces the mesh by one triangle or one square; else removes primitives, and vertices that no primitive uses.
  void smaller_mesh(const Pointer& place) {
    for (const char* simplest :
         {R"({"triangle": {"positions": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]}})", R"({"quad": {}})"}) {
      Json next = scene_;
      next[place] = Json::parse(simplest);
      if (scene_[place].dump().size() > next[place].dump().size() && try_instead(std::move(next))) return;
    }
    const std::string kind = scene_[place].begin().key();
    const Pointer mesh = place / kind;
    fewer_members(mesh);
    if (kind == "points") {
      fewer_items(lists_of_vertices(mesh));
    } else if (scene_[mesh].contains("indices")) {
      fewer_items({mesh / "indices"});
      drop_unused_vertices(mesh);
    } else if (scene_[mesh].is_object()) {
      smaller_counts(mesh);
    }
  }
  std::vector<Pointer> lists_of_vertices(const Pointer& mesh) const {
    std::vector<Pointer> out;
    for (const char* key : {"positions", "normals", "colors", "texcoords"}) {
      if (scene_[mesh].contains(key)) out.push_back(mesh / key);
    }
    return out;
  }
  void drop_unused_vertices(const Pointer& mesh) {
    Json next = scene_;
    Json& of = next[mesh];
    std::vector<bool> used(of["positions"].size());
    for (const Json& primitive : of["indices"]) {
      for (const Json& i : primitive) used.at(i.get<std::size_t>()) = true;
    }
    std::vector<std::size_t> now(used.size());
    for (std::size_t i = 1; i < used.size(); ++i) now[i] = now[i - 1] + (used[i - 1] ? 1 : 0);
    for (Json& primitive : of["indices"]) {
      for (Json& i : primitive) i = now[i.get<std::size_t>()];
    }
    for (const Pointer& list : lists_of_vertices(mesh)) {
      Json kept = Json::array();
      for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i]) kept.push_back(next[list][i]);
      }
      next[list] = kept;
    }
    try_instead(std::move(next));
  }
  // Halves each count of a mesh generator, as long as the scene shows the finding.
  void smaller_counts(const Pointer& mesh) {
    const Json members = scene_[mesh];
    for (const auto& [key, value] : members.items()) {
      if (!value.is_number_integer() || key == "seed" || key == "p" || key == "q") continue;
      for (bool smaller = true; smaller;) {
        Json next = scene_;
        const int now = next[mesh][key].get<int>();
        next[mesh][key] = now / 2;
        smaller = now > 1 && try_instead(std::move(next));
      }
    }
  }

  // Rounds each number with a fraction or exponent, outside `indices` and `frame`: to 0, to units, to tenths or to
  // hundredths, by the first value that shows the finding.
  void rounder(const Pointer& place) {
    const Json value = scene_[place];
    if (value.is_structured()) {
      for (const auto& [key, of] : value.items()) {
        if (key == "indices" || key == "frame") continue;
        rounder(value.is_array() ? place / static_cast<std::size_t>(std::stoul(key)) : place / key);
      }
    }
    if (!value.is_number_float()) return;
    const double now = value.get<double>();
    for (const double parts : {0.0, 1.0, 10.0, 100.0}) {
      Json next = scene_;
      const double rounded = parts == 0 ? 0 : std::round(now * parts) / parts;
      if (rounded == now) return;
      next[place] = rounded == std::round(rounded) ? Json(static_cast<std::int64_t>(rounded)) : Json(rounded);
      if (try_instead(std::move(next))) return;
    }
  }

  Json scene_;
  const Shows& shows_;
  int left_;
};

}  // namespace

std::string shrink(const std::string& scene, const Shows& shows, int trials) {
  return Shrinker(scene, shows, trials).shrink();
}

}  // namespace plumbline::campaign
