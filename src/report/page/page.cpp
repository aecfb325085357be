#include "report/page/page.h"

#include <fstream>
#include <set>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "capture/files/image_file.h"
#include "report/page/web_files.h"
#include "report/text/safe_text.h"

namespace plumbline::report {

namespace {

// The page's own list of its files; the first line says whose it is.
constexpr const char* kList = "plumb-report.txt";
constexpr std::string_view kListHead = "This page was made by plumb, and may be replaced by it. Its files:";

std::set<std::filesystem::path> files_of_page(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  std::ifstream in(folder / kList);
  std::string line;
  if (!std::getline(in, line) || line != kListHead) return files;
  while (std::getline(in, line)) files.insert(line);
  return files;
}

}  // namespace

PageFolder::PageFolder(const std::filesystem::path& folder) : name_(folder), folder_(folder) {
  require_writable_folder(name_, files_of_page(name_));
  folder_.make_folder();
}

void PageFolder::remove_earlier() {
  if (!std::filesystem::is_directory(name_)) return;
  const std::filesystem::path list = name_ / kList;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(name_)) {
    if (entry.path() != list) files.push_back(entry.path());
  }
  files.push_back(list);  // last: without it, nobody may replace the others
  std::error_code ignored;
  for (const auto& file : files) std::filesystem::remove_all(file, ignored);
}

void PageFolder::write(const std::string& name, std::string_view bytes) {
  folder_.write_inside(name, bytes);
  files_ += name + "\n";
}

void PageFolder::write_picture(const std::string& name, const Plane<glm::vec4>& plane) {
  write(name, encode_png(name, plane));
}

void PageFolder::commit(const std::string& title, std::string_view style, const std::string& body) {
  write("index.html", fmt::format("<!doctype html>\n<html lang=en><meta charset=utf-8>\n"
                                  "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n"
                                  "<title>{}</title>\n<style>\n{}{}</style>\n{}</html>\n",
                                  escaped(title), web_file("page.css"), style, body));
  folder_.write_inside(kList, fmt::format("{}\n{}\n{}", kListHead, kList, files_));
  require_writable_folder(name_, files_of_page(name_));  // the run was long
  folder_.commit();
}

}  // namespace plumbline::report
