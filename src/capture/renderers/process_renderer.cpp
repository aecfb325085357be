#include "capture/renderers/process_renderer.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/program.h"
#include "base/temporary_path.h"
#include "base/utf8.h"
#include "capture/by_conventions.h"
#include "capture/capture_columns.h"
#include "capture/complete_records.h"
#include "capture/files/capture_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) text.replace(at, what.size(), by);
  return text;
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& extra) {
  std::vector<std::string> all;
  for (char** e = environ; *e != nullptr; ++e) {
    const std::string_view entry = *e;
    if (!extra.contains(std::string(entry.substr(0, entry.find('='))))) all.emplace_back(entry);
  }
  for (const auto& [name, value] : extra) all.push_back(fmt::format("{}={}", name, value));
  return all;
}

/// End of a process. `status`: exit status, 0 where it did not exit by itself. `words`: any end but status 0.
struct Ending {
  std::string words;
  int status = 0;
};

Ending ending_of(const ProgramEnd& end, std::chrono::milliseconds limit) {
  if (end.start_error != 0) return {fmt::format("cannot be started: {}", std::strerror(end.start_error))};
  if (end.spoke) return {"answered before it was asked, and was killed"};
  if (end.rambled) {
    return {fmt::format("answered with more than {} bytes, where ok, unsupported REASON or failed REASON was expected",
                        kLongestAnswer)};
  }
  if (end.hung) return {fmt::format("took longer than {} and was killed", std::chrono::duration<double>(limit))};
  if (WIFSIGNALED(end.status) && WTERMSIG(end.status) == SIGXFSZ) {
    return {"was killed: it wrote a file, or to stderr, beyond the limit of a capture"};
  }
  if (WIFSIGNALED(end.status)) {
    return {fmt::format("was killed by signal {} ({})", WTERMSIG(end.status), ::strsignal(WTERMSIG(end.status)))};
  }
  const int status = WEXITSTATUS(end.status);
  if (status == 0) return {};
  // Status 128 + signal: a shell says so of a program that a signal killed (dash and bash; POSIX asks for above 128).
  const char* signal = status > 128 && status < 128 + NSIG ? ::strsignal(status - 128) : nullptr;
  if (signal != nullptr)
    return {fmt::format("exited with status {}: signal {} ({})", status, status - 128, signal), status};
  return {fmt::format("exited with status {}", status), status};
}

/// A folder for one run, which other users cannot read.
std::unique_ptr<TemporaryPath> temporary_folder(const fs::path& in) {
  try {
    return std::make_unique<TemporaryPath>(in, "plumbline-", TemporaryPath::Kind::private_folder);
  } catch (const std::system_error& error) {
    throw RendererFailed(fmt::format("{}: no temporary folder there: {}", in.string(), error.code().message()));
  }
}

/// The last lines of a file, of which not more than the last few KiB are read.
std::string last_lines(const fs::path& file, int lines) {
  constexpr std::uintmax_t kBytes = 4096;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size == 0) return "";
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(size - std::min(size, kBytes)));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::size_t from = text.size();
  for (int line = 0; line < lines && from != text.npos && from > 0; ++line) from = text.rfind('\n', from - 1);
  return from == text.npos || from == 0 ? text : text.substr(from + 1);
}

std::uintmax_t bytes_below(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) sum += entry.file_size();
  }
  return sum;
}

// Whether the program wrote all of a capture, and has not just begun it.
bool is_whole_capture(const fs::path& folder) {
  try {
    read_capture(folder);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

// Message text of a program's words: one short line of UTF-8 without control characters.
std::string shortened(std::string text) {
  constexpr std::size_t kMost = 200;
  for (char& c : text) c = static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  text = as_utf8(text);
  for (std::size_t i = text.find('\xc2'); i != text.npos; i = text.find('\xc2', i + 1)) {
    const bool is_control = static_cast<unsigned char>(text[i + 1]) < 0xa0;  // U+0080 to U+009F
    if (is_control) text.replace(i, 2, "?");
  }
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  std::size_t end = kMost;
  while (text.size() > kMost && continues(end)) --end;
  return text.size() > kMost ? text.substr(0, end) + "..." : text;
}

struct KeepOnly {
  StageSet stages;
  void group(Handed group, const auto&, auto& records) const {
    if (!stages.has(group.stage)) records.clear();
  }
  void plane(Handed, auto&) const {}
};

class ProcessRenderer : public Renderer {
 public:
  explicit ProcessRenderer(ProcessSpec spec) : spec_(std::move(spec)) {}

  RendererInfo info() const override {
    RendererInfo info;
    info.name = spec_.name;
    info.version = spec_.version;
    info.conventions = spec_.conventions;
    for (const Stage stage : kAllStages) {
      info[stage].shows = spec_.shows.has(stage);
      if (!info[stage].shows) info[stage].reason = "not among the stages that it is said to show";
    }
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    const bool by_file = std::ranges::any_of(
        spec_.argv, [](const std::string& argument) { return argument.find("{scene}") != argument.npos; });
    if (by_file && scene.path.empty()) {
      throw Unsupported(fmt::format("{}: a scene made in memory cannot be handed to a program", spec_.name));
    }
    if (antialiased(scene)) {
      throw Unsupported(fmt::format(
          "{}: plumb check judges each pass of an antialiased scene; the frame is not resolved", spec_.name));
    }
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    if (spec_.serves) start_server(request);
    const std::unique_ptr<TemporaryPath> temporary =
        temporary_folder(spec_.serves ? server_folder_->path() : temporary_files());
    const fs::path input = temporary->path() / "input", output = temporary->path() / "output";
    fs::create_directory(output);
    if (spec_.write_input) spec_.write_input(scene, input);
    try {
      spec_.serves ? ask_server(input, output) : run(scene, request, input, output);
    } catch (const std::system_error& error) {
      fail(fmt::format("could not be watched to its end: {}", error.what()));
    }
    return read(scene, request, output);
  }

 private:
  // Runs the program once.
  void run(const Scene& scene, const Request& request, const fs::path& input, const fs::path& output) {
    log_ = output.parent_path() / "stderr.txt";
    argv_ = spec_.argv;
    for (std::string& argument : argv_) {
      argument = replaced(argument, "{input}", input.string());
      argument = replaced(argument, "{output}", output.string());
      if (!scene.path.empty()) argument = replaced(argument, "{scene}", fs::absolute(scene.path).string());
    }
    take(ending_of(run_program(call(request, output.parent_path())), spec_.timeout));
  }

  // Throws unless the program ended well.
  void take(const Ending& ending) const {
    if (ending.status == kUnsupportedStatus) {
      const std::string reason = last_lines(log_, 1);
      throw Unsupported(reason.empty() ? fmt::format("{}: {}, and gave no reason", spec_.name, ending.words)
                                       : shortened(reason));
    }
    if (!ending.words.empty()) fail(ending.words);
  }

  // The program's call; `folder` is where it may write, if it is confined.
  ProgramCall call(const Request& request, const fs::path& folder) const {
    std::map<std::string, std::string> environment = spec_.environment;
    if (spec_.confined) environment["TMPDIR"] = folder.string();
    ProgramCall out{argv_, merged_environment(environment), log_, spec_.timeout};
    if (spec_.confined) out.writable = {folder.string()};
    out.most_bytes = request.memory_budget;
    return out;
  }

  void start_server(const Request& request) {
    if (server_) return;
    server_folder_ = temporary_folder(temporary_files());
    log_ = server_folder_->path() / "stderr.txt";
    argv_ = spec_.argv;
    server_.emplace(call(request, server_folder_->path()));
  }

  void ask_server(const fs::path& input, const fs::path& output) {
    std::optional<std::string> answer = server_->ask(input.string() + '\t' + output.string());
    if (!answer) {
      Ending ending = ending_of(server_->end(), spec_.timeout);
      if (server_->end().hung && is_whole_capture(output))
        ending.words += ": it left a capture, and no line of answer on stdout (flush stdout after each)";
      server_.reset();
      take(ending);
      fail("ended without an answer");
    }
    if (answer->ends_with('\r')) answer->pop_back();  // the line ended in CR LF
    if (*answer == "ok") return;
    const std::size_t space = std::min(answer->find(' '), answer->size());
    const std::string kind = answer->substr(0, space), reason = answer->substr(std::min(space + 1, answer->size()));
    if (kind == "unsupported") throw Unsupported(reason.empty() ? spec_.name + " gave no reason" : shortened(reason));
    if (kind == "failed") fail(reason.empty() ? "failed, and gave no reason" : "failed: " + shortened(reason));
    server_.reset();  // no later line can be matched with its question
    fail(fmt::format("answered \"{}\", expected ok, unsupported REASON or failed REASON", shortened(*answer)));
  }

  Capture read(const Scene& scene, const Request& request, const fs::path& folder) const {
    if (!fs::is_directory(fs::symlink_status(folder))) fail("left no capture: its folder is gone");
    try {
      for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (!entry.is_symlink()) continue;
        fail(fmt::format("left a link, {}, where a file was expected", entry.path().filename().string()));
      }
      if (const std::uintmax_t left = bytes_below(folder); left > request.memory_budget) {
        throw OverBudget(fmt::format("{}: left {} bytes in its folder, where a capture takes at most {}", spec_.name,
                                     left, request.memory_budget));
      }
      Capture capture = read_capture(folder);
      if (capture.files_of_arrays == 0) fail("left a capture that holds no array");
      if (capture.width != scene.frame.width || capture.height != scene.frame.height) {
        fail(fmt::format("left a capture of {} x {} pixels where the scene has {} x {}", capture.width, capture.height,
                         scene.frame.width, scene.frame.height));
      }
      if (spec_.give && request.records.has(Stage::coverage)) spec_.give(scene, capture);
      to_dialect(spec_.conventions, capture);
      complete_records(scene, capture, spec_.conventions, spec_.raw_depth ? Depths::raw : Depths::of_codes);
      visit_capture(KeepOnly{request.records}, capture);
      capture.renderer = spec_.name;
      return capture;
    } catch (const CaptureError& error) {
      fail(fmt::format("left no capture that can be read: {}",
                       replaced(error.what(), folder.string(), "{output}")));  // the folder is gone when this is read
    } catch (const fs::filesystem_error& error) {                              // it is changing its folder still, say
      fail(fmt::format("left a folder that cannot be read: {}", error.code().message()));
    } catch (const std::invalid_argument& error) {
      fail(fmt::format("left no capture of the scene: {}", error.what()));
    }
  }

  [[noreturn]] void fail(std::string_view what) const {
    constexpr int kLines = 10;
    const std::string lines = last_lines(log_, kLines);
    const std::string command = spec_.shown.empty() ? fmt::format("{}", fmt::join(argv_, " ")) : spec_.shown;
    throw RendererFailed(fmt::format("{}: {} {}{}{}", spec_.name, command, what,
                                     lines.empty() ? "" : "\nthe end of its stderr:\n", lines));
  }

  ProcessSpec spec_;
  std::vector<std::string> argv_;  ///< of the last run, or of the server
  fs::path log_;                   ///< its stderr
  std::unique_ptr<TemporaryPath> server_folder_;
  std::optional<ServerProgram> server_;
};

}  // namespace

std::unique_ptr<Renderer> make_process_renderer(ProcessSpec spec) {
  if (spec.argv.empty() || spec.argv[0].empty()) {
    throw std::invalid_argument(fmt::format("{}: expected a program to run, found none", spec.name));
  }
  require_temporary_files();
  return std::make_unique<ProcessRenderer>(std::move(spec));
}

}  // namespace plumbline
