#include "report/text/safe_text.h"

#include <fmt/format.h>

#include "base/utf8.h"

namespace plumbline::report {

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
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool begins_name = out.empty() || out.back() == '/';
    const bool hidden = c == '.' && begins_name;  // ".." as well
    const bool lone = c == '/' && (begins_name || i + 1 == text.size());
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-_./").find(c) != std::string_view::npos;
    if (plain && !hidden && !lone)
      out += c;
    else
      out += fmt::format("~{:02x}", static_cast<unsigned char>(c));
  }
  return out;
}

}  // namespace plumbline::report
