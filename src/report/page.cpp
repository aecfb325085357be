#include "report/page.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "report/web_files.h"
#include "stages/image_file.h"

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

// The length of the UTF-8 sequence that the text begins with; 0: none, or one that UTF-8 forbids.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool no_character = (byte(0) == 0xed && byte(1) > 0x9f) || (byte(0) == 0xf4 && byte(1) > 0x8f);
  return overlong || no_character ? 0 : length;
}

}  // namespace

std::string as_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    out += length == 0 ? "\xef\xbf\xbd" : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : as_utf8(text)) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string file_name(std::string_view text) {
  std::string out;
  for (char c : text) {
    const bool hidden = c == '.' && (out.empty() || out.back() == '/');  // ".." as well
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-_./").find(c) != std::string_view::npos;
    if (plain && !hidden)
      out += c;
    else
      out += fmt::format("~{:02x}", static_cast<unsigned char>(c));
  }
  return out;
}

PageFolder::PageFolder(const std::filesystem::path& folder) : name_(folder), folder_(folder) {
  require_writable_folder(name_, files_of_page(name_));
  folder_.make_folder();
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
