#include "report/runs/junit.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/runs/run_file.h"
#include "report/text/safe_text.h"
#include "report/text/table.h"

namespace plumbline::report {

namespace {

// Text for XML. Replaces by "?" what XML forbids even escaped: control characters but \n and \t, U+FFFE and U+FFFF.
std::string xml(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'; }, '?');
  std::string out = escaped(text);
  for (const char* none : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at = out.find(none); at != std::string::npos; at = out.find(none, at)) out.replace(at, 3, 1, '?');
  }
  return out;
}

}  // namespace

std::string junit(std::span<const check::SceneVerdict> verdicts, std::span<const std::string> of_run) {
  const auto fails = [](const check::SceneVerdict& v) { return !v.failure.empty(); };
  const auto is_unjudged = [&](const check::SceneVerdict& v) { return !fails(v) && !check::is_judged(v); };
  const auto failures = std::ranges::count_if(verdicts, fails), skipped = std::ranges::count_if(verdicts, is_unjudged);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites><testsuite name=\"plumb check\" tests=\"{}\" "
      "failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.3f}\">\n",
      verdicts.size() + of_run.size(), static_cast<std::size_t>(failures) + of_run.size(), skipped, seconds(verdicts));
  for (const check::SceneVerdict& v : verdicts) {
    const std::size_t slash = v.scene.find('/');
    out +=
        fmt::format("<testcase classname=\"{}\" name=\"{}\" file=\"{}\" time=\"{:.3f}\"", xml(v.scene.substr(0, slash)),
                    xml(slash == std::string::npos ? v.scene : v.scene.substr(slash + 1)), xml(v.path), v.seconds);
    if (!fails(v)) {
      out += is_unjudged(v) ? "><skipped message=\"nothing was judged\"/></testcase>\n" : "/>\n";
      continue;
    }
    out += fmt::format("><failure message=\"{}\">{}\n{}{}</failure></testcase>\n",
                       xml(v.failure.substr(0, v.failure.find('\n'))), xml(v.failure), xml(table_head()),
                       xml(table_rows(v)));
  }
  for (const std::string& what : of_run) {
    out += fmt::format("<testcase classname=\"run\" name=\"{0}\"><failure message=\"{0}\"/></testcase>\n", xml(what));
  }
  return out + "</testsuite></testsuites>\n";
}

}  // namespace plumbline::report
