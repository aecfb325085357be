// plumb's subcommands as functions of their options. arguments.cpp makes the options of a command line.
#pragma once

#include <string>
#include <vector>

#include "base/workers.h"
#include "check/diagnose/diagnose.h"
#include "cli/options/default_cache.h"
#include "cli/options/program_argument.h"
#include "cli/options/renderers.h"
#include "cli/options/scene_arguments.h"

namespace plumbline::cli {

/// Exit codes of every subcommand; bad input and bad usage throw, which main() turns into 2. Outputs are proven
/// writable before the work.
enum Exit { kHolds = 0, kDiffers = 1, kBadInput = 2 };

/// Largest number of scenes that are judged at a time.
inline constexpr int kMostJobs = 256;

/// Options of plumb check: scenes against references, stage by stage. An empty path is not wanted.
struct CheckOptions {
  std::vector<std::string> scenes;  ///< files, and folders of them
  std::vector<std::string> against = default_references();
  std::string json, report, ledger, junit, markdown;
  std::string rows;            ///< a folder: each scene's rows, and what fails, in <group>/<scene>.txt
  std::string failures;        ///< a folder: of each scene that does not hold, a page in <group>/<scene>
  std::string expect;          ///< a file of known differences (check/verdict/expectations.h)
  std::string today;           ///< YYYY-MM-DD, for their last days; empty: the clock's, UTC
  std::string shard;           ///< I/N: every Nth scene, from number I on
  std::string golden;          ///< the folder of goldens, whose rows stand beside the references'; or empty
  std::string fault;           ///< a fault to put into our renderer, or empty
  ProgramArgument candidate;   ///< another renderer, judged in place of ours
  std::string submissions;     ///< a folder: one candidate for each folder in it; or empty
  std::string rubric, grades;  ///< points by scene and stage (report/runs/grade.h), and where they go; or empty
  int jobs = 0;                ///< scenes judged at a time; 0: as many as there are processors
  WorkerLimits limits;         ///< of the processes that judge
  bool verbose = false;        ///< the rows of scenes that hold are printed, too, as those of a single scene always are
  bool allow_missing = false;
  bool seeks_causes = true;             ///< a program's wrong scenes are drawn with each known fault
  std::string cache = default_cache();  ///< a folder of verdicts of earlier runs (check/kept), or empty
  SceneArguments scene_arguments;
  std::string program = "plumb";  ///< as it was called, for the command that repeats a failure
};
int check(const CheckOptions& options);

/// Random scenes, judged, and what is found made small. The folder holds the journals of all its processes.
struct CampaignOptions {
  std::string folder;
  std::string seeds;               ///< FIRST..LAST, of each generator; empty: report what the journals hold
  std::string generator = "both";  ///< or ordinary, hard, plain, flat
  std::size_t round = 1;           ///< from 2 on, scenes are changed that reached something new in the round before
  bool judge_only = false;         ///< findings are neither shrunk nor reported
  bool write = false;              ///< the scenes' files, and nothing else
  CheckOptions judging;            ///< candidate, references, jobs, limits, assets; the rest is not used
};
int campaign(const CampaignOptions& options);

/// One scene: every stage that is wrong, its numbers, and what may have caused it. The candidate is our renderer, with
/// a fault or not; a capture's folder; or what a program leaves.
struct DiagnoseOptions {
  std::string scene;
  std::vector<std::string> against = default_references();
  std::string json, report;    ///< or empty
  std::string picture, depth;  ///< image files of a renderer that left nothing else, or empty
  std::string fault;           ///< or empty
  std::string folder;          ///< a capture of another renderer, or empty
  ProgramArgument candidate;   ///< another renderer
  std::string pixel;           ///< X,Y: this pixel's history is printed, too; or empty
  bool seeks_causes = true;    ///< known faults are drawn, where another renderer is wrong
  std::uint64_t most_fragments = check::kMostFragments;
  WorkerLimits limits;  ///< of the process that diagnoses
  SceneArguments scene_arguments;
};
int diagnose(const DiagnoseOptions& options);
/// Diagnosis of a picture alone: the known faults whose pictures are nearest to it.
int diagnose_picture(const DiagnoseOptions& options);

/// Options of plumb render: a scene to a picture.
struct RenderOptions {
  std::string scene;
  std::string output;  ///< .png, .tga, .ppm or .exr
  std::string depth;   ///< .exr, or empty
  std::string with = "ours", fault;
  SceneArguments scene_arguments;
};
int render(const RenderOptions& options);

/// Options of plumb capture: a renderer's records and planes of every stage, to a folder.
struct CaptureOptions {
  std::string scene, folder;
  std::string check;  ///< a capture folder to check for contradictions, instead of `scene` and `folder`; or empty
  std::string with = "ours", fault;
  SceneArguments scene_arguments;
};
int capture(const CaptureOptions& options);

/// A scene as plain arrays, for renderers in any language.
struct ExportOptions {
  std::string scene, folder;
  SceneArguments scene_arguments;
};
int export_scene(const ExportOptions& options);

/// A renderer's conventions: a table, and a file that check and diagnose take (--conventions).
struct LearnOptions {
  ProgramArgument candidate;  ///< a program; or, with an empty command,
  std::string with;           ///< one of renderer_names()
  std::string output;         ///< conventions.json, or empty
  std::string pictures;       ///< a folder for the probes' pictures, or empty
};
/// Ends 1 where a convention is a mistake, or the probes contradict each other.
int learn(const LearnOptions& options);

/// Options of plumb compare: two images or two captures, compared as they are stored.
struct CompareOptions {
  std::string a, b;             ///< two files or two folders
  std::string tolerance = "0";  ///< a number, or a fraction such as 1/255
  std::string output;           ///< of images: an amplified difference picture, or empty
  std::string amplify;          ///< factor of differences; empty: the largest one is white
  std::string json;
  bool allow_missing = false;  ///< what one capture alone holds is no failure
};
int compare(const CompareOptions& options);

/// Scenes compared with their goldens, and goldens updated.
struct GoldenOptions {
  std::vector<std::string> scenes;                        ///< files, and folders of them; none: the whole suite
  std::string suite = "tests/scenes", golden = "golden";  ///< folders
  std::string report;                                     ///< of an update, or empty
  std::string fault;                                      ///< or empty
  bool check = false;                                     ///< an update writes nothing
  SceneArguments scene_arguments;
  std::string program = "plumb";
};
/// Ends 1 where a golden is not what is drawn, is missing, or has no scene.
int golden_check(const GoldenOptions& options);
/// Writes what the references vouch for, refuses the rest, and ends 1 if there was anything to write or to refuse: a
/// run that blesses is no run that passes.
int golden_update(const GoldenOptions& options);

/// Options of plumb list: names of stages, renderers, faults and scenes, which other commands take.
struct ListOptions {
  std::string what = "all";
  std::vector<std::string> folders;  ///< of scenes
  SceneArguments scene_arguments;
};
int list(const ListOptions& options);

/// Runs of plumb check, by the JSON that they left: what changed, shards as one run, and other forms of one.
struct DiffOptions {
  std::string before, now;
  std::string json, markdown;  ///< or empty
  double factor = 1.25, slower = 1.5;
};
int report_diff(const DiffOptions& options);
struct MergeOptions {
  std::vector<std::string> runs;
  std::string output, junit, markdown, ledger;  ///< or empty
  std::string suite;                            ///< a folder whose scenes must all be in the runs, or empty
  std::vector<std::string> without;             ///< scenes of the suite that need not be in the runs, by name
  std::string expect;  ///< known differences (--expect): each of a scene that is in the runs or in `without`; or empty
};
int report_merge(const MergeOptions& options);

/// Options of plumb notes: what each section of the course notes teaches, and where the project does and shows it.
struct NotesOptions {
  std::string number;  ///< of one note, or empty: of all
};
int notes(const NotesOptions& options);

}  // namespace plumbline::cli
