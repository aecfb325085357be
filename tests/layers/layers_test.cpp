// The layers of the sources, by their #include lines: no cycle of files or folders, no folder that grows without end,
// and no reference that sees the renderer it judges.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// What each node includes.
using Graph = std::map<std::string, std::set<std::string>>;

constexpr std::size_t kMostFiles = 32;  // of a folder
constexpr std::string_view kEndings[] = {".h", ".cpp", ".hpp", ".cc", ".c", ".inc", ".inl", ".ipp"};

struct Include {
  std::string from, to;  ///< files, from the project's folder
};

std::vector<std::string> source_files() {
  std::vector<std::string> out;
  const fs::path project = PLUMBLINE_SOURCE_DIR;
  for (const char* top : {"src", "reference", "tests"}) {
    for (const auto& file : fs::recursive_directory_iterator(project / top)) {
      const std::string ending = file.path().extension();
      if (std::ranges::count(kEndings, ending) > 0) out.push_back(file.path().lexically_relative(project));
    }
  }
  return out;
}

/// The name that a line includes, however it is spelt; empty: none.
std::string name_in(const std::string& line) {
  static const std::regex kInclude("^\\s*#(?:\\s|/\\*.*?\\*/)*include(?:\\s|/\\*.*?\\*/)*[\"<]([^\">]+)[\">]");
  std::smatch match;
  return std::regex_search(line, match, kInclude) ? match[1].str() : "";
}

/// The file that an #include of `name` in `from` means; empty: none of `files`.
std::string included(const std::set<std::string>& files, const std::string& from, const std::string& name) {
  const fs::path beside = (fs::path(from).parent_path() / name).lexically_normal();
  for (const std::string& candidate : {"src/" + name, "tests/" + name, name, beside.string()}) {
    if (files.contains(candidate)) return candidate;
  }
  return "";
}

std::vector<Include> includes_of(const std::vector<std::string>& names) {
  const std::set<std::string> files(names.begin(), names.end());
  std::vector<Include> out;
  for (const std::string& from : names) {
    std::ifstream in(fs::path(PLUMBLINE_SOURCE_DIR) / from);
    for (std::string line; std::getline(in, line);) {
      const std::string name = name_in(line), to = name.empty() ? "" : included(files, from, name);
      EXPECT_EQ(name.find(".."), name.npos) << from << " includes " << name << ": name it from src or the project";
      EXPECT_TRUE(to != "" || line.find('"') == line.npos || name.empty())
          << from << " includes " << name << ", which is no source file";
      if (!to.empty()) out.push_back({from, to});
    }
  }
  return out;
}

/// A header and its .cpp are one node.
std::string without_ending(const std::string& file) { return fs::path(file).replace_extension().string(); }
std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

Graph graph_of(const std::vector<Include>& includes, const std::function<std::string(const std::string&)>& node_of) {
  Graph out;
  for (const Include& include : includes) {
    const std::string from = node_of(include.from), to = node_of(include.to);
    if (from != to) out[from].insert(to);
  }
  return out;
}

/// The nodes of one cycle, in its order; empty: there is none.
std::vector<std::string> cycle_of(const Graph& graph) {
  std::set<std::string> done;
  std::vector<std::string> path, cycle;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    if (!cycle.empty() || done.contains(node)) return;
    if (const auto at = std::find(path.begin(), path.end(), node); at != path.end()) {
      cycle.assign(at, path.end());
      return;
    }
    path.push_back(node);
    if (const auto next = graph.find(node); next != graph.end()) std::ranges::for_each(next->second, visit);
    path.pop_back();
    done.insert(node);
  };
  for (const auto& [node, next] : graph) visit(node);
  return cycle;
}

/// All that `from` includes, directly or not.
std::set<std::string> reached(const Graph& graph, const std::string& from) {
  std::set<std::string> out;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    if (!out.insert(node).second) return;
    if (const auto next = graph.find(node); next != graph.end()) std::ranges::for_each(next->second, visit);
  };
  visit(from);
  return out;
}

/// The folders that hold more than `most` of the files.
std::map<std::string, std::size_t> crowded(const std::vector<std::string>& files, std::size_t most) {
  std::map<std::string, std::size_t> out;
  for (const std::string& file : files) ++out[folder_of(file)];
  std::erase_if(out, [&](const auto& folder) { return folder.second <= most; });
  return out;
}

TEST(Layers, FilesIncludeEachOtherOneWay) {
  EXPECT_EQ(fmt::format("{}", fmt::join(cycle_of(graph_of(includes_of(source_files()), without_ending)), " -> ")), "");
}

TEST(Layers, FoldersIncludeEachOtherOneWay) {
  EXPECT_EQ(fmt::format("{}", fmt::join(cycle_of(graph_of(includes_of(source_files()), folder_of)), " -> ")), "");
}

TEST(Layers, NoFolderHasMoreThan32SourceFiles) {
  for (const auto& [folder, count] : crowded(source_files(), kMostFiles)) ADD_FAILURE() << folder << ": " << count;
}

TEST(Layers, NoReferenceSeesTheRenderer) {
  const std::vector<Include> includes = includes_of(source_files());
  const Graph folders = graph_of(includes, folder_of);
  std::set<std::string> seen;  // folders
  int references = 0;
  for (const auto& [folder, next] : folders) {
    if (folder != "reference" && !folder.starts_with("reference/")) continue;
    ++references;
    seen.merge(reached(folders, folder));
  }
  EXPECT_GE(references, 5);
  const std::regex renderer("^src/(pipeline|painter|kernels|renderers)/");
  for (const Include& include : includes) {
    const bool sees = seen.contains(folder_of(include.from)) && std::regex_search(include.to, renderer);
    EXPECT_FALSE(sees && !std::regex_search(include.from, renderer)) << include.from << " includes " << include.to;
  }
}

TEST(Layers, AnIncludeIsReadHoweverItIsSpelt) {
  for (const char* line : {"#include \"a/b.h\"", "  #  include <a/b.h>", "#\tinclude\t\"a/b.h\"",
                           "#include/**/\"a/b.h\"", "# /* x */ include /* y */ <a/b.h>  // z"}) {
    EXPECT_EQ(name_in(line), "a/b.h") << line;
  }
  for (const char* line : {"// #include \"a/b.h\"", "#define include \"a/b.h\"", "include \"a/b.h\""}) {
    EXPECT_EQ(name_in(line), "") << line;
  }
}

TEST(Layers, ACycleIsSeen) {
  const Graph tree = {{"a", {"b", "c"}}, {"b", {"c"}}, {"d", {"a"}}};
  EXPECT_TRUE(cycle_of(tree).empty());
  Graph wrong = tree;
  wrong["c"] = {"d"};
  EXPECT_EQ(cycle_of(wrong).size(), 4u);
  EXPECT_EQ(reached(tree, "d"), (std::set<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(reached(tree, "b"), (std::set<std::string>{"b", "c"}));
}

TEST(Layers, AHeaderAndItsSourceAreOneNode) {
  const std::vector<Include> includes = {{"src/x/a.cpp", "src/x/b.h"}, {"src/x/b.cpp", "src/x/a.h"}};
  EXPECT_EQ(cycle_of(graph_of(includes, without_ending)).size(), 2u);
  EXPECT_TRUE(cycle_of(graph_of(includes, folder_of)).empty());
  EXPECT_EQ(crowded({"src/x/a.h", "src/x/a.cpp", "src/y/a.h"}, 1), (std::map<std::string, std::size_t>{{"src/x", 2}}));
}

}  // namespace
}  // namespace plumbline
