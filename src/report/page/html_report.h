// The verdict as a page for people: an overview of all scenes, and of each its stages and ours | reference |
// difference.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/judge/judge.h"
#include "check/verdict/verdict.h"
#include "report/page/page.h"

namespace plumbline::report {

/// A folder (page.h) with index.html and, for each scene, a thumbnail <group>/<scene>.png and the viewer's data
/// <group>/<scene>.js (viewer_data.h); a name that is taken gets a number. At most 5 MB, if up to a hundred scenes fail
/// or are disputed: a scene may take its share, and 46 kB at least. Of scenes that hold, as many as fit have all their
/// pictures, the others only the frame's colour. Scenes are added one by one, so that their captures need not be kept.
class HtmlReport {
 public:
  /// For so many scenes. Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not
  /// ours.
  explicit HtmlReport(const std::filesystem::path& folder, std::size_t scenes = 1);
  /// The page's data of one scene, except its file name. Several threads may call draw() at a time.
  struct Drawing {
    std::string scene, description, thumbnail;  ///< the last a PNG, or empty
    std::string outcome, first;                 ///< the first different stage, or empty
    bool fails = false;
    std::string all, color_alone;  ///< viewer's data: all, colour alone; the latter empty where all must be shown
  };
  /// `failure`: why the run fails for this scene (table.h, failure_lines()), or empty; `repeat`: the command.
  Drawing draw(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
               const check::BothCaptures& drawn, const Scene& scene, const std::string& failure = "",
               const std::string& repeat = "") const;
  void add(Drawing drawing);
  /// add(draw(...)).
  void add(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
           const check::BothCaptures& drawn, const Scene& scene, const std::string& failure = "",
           const std::string& repeat = "") {
    add(draw(verdict, references, drawn, scene, failure, repeat));
  }
  void write(const std::string& summary);

 private:
  std::string free_name(const std::string& scene);
  void put(const std::string& file, std::string_view bytes);

  PageFolder page_;
  std::size_t share_;            // of a scene, in bytes
  std::set<std::string> names_;  // one per scene
  std::string scenes_;           // the overview's, as JSON
  std::size_t written_ = 0;      // bytes
  struct Holding {
    std::string file, all, color_alone;
  };
  std::vector<Holding> holding_;  // written last, into the bytes that failing scenes leave
};

}  // namespace plumbline::report
