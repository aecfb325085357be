// plumb compare: two images, or two captures, number by number.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "check/compare/compare_stored.h"
#include "cli/commands.h"
#include "cli/options/outputs.h"
#include "report/runs/json_report.h"
#include "report/text/table.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// A number or a fraction, finite and not negative.
double number(const std::string& option, const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto above = plain_number(text.substr(0, slash));
  const auto below = slash == text.npos ? std::optional(1.0) : plain_number(text.substr(slash + 1));
  const double value = above && below ? *above / *below : -1;
  if (std::isfinite(value) && value >= 0) return value;
  throw std::invalid_argument(
      fmt::format("{} {}: expected a finite number, 0 or more, such as 0.001 or 1/255", option, text));
}

bool is_folder(const std::string& path) {
  if (!fs::exists(path)) throw std::invalid_argument(fmt::format("{}: no such file or folder", path));
  return fs::is_directory(path);
}

std::vector<fs::path> inputs_of(const CompareOptions& o, bool folders) {
  if (!folders) return {o.a, o.b};
  std::vector<fs::path> files;
  for (const std::string& folder : {o.a, o.b}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  }
  return files;
}

void write_difference(const CompareOptions& o, std::optional<double> amplify, const StoredImage& a,
                      const StoredImage& b) {
  const Plane<glm::vec4> picture = check::amplified_difference(a, b, amplify);
  if (!picture.empty()) return write_image(o.output, picture);
  fmt::print("{} is not written: there is no pixel that both images have\n", o.output);
}

}  // namespace

int compare(const CompareOptions& o) {
  const double tolerance = number("--tolerance", o.tolerance);
  std::optional<double> amplify;
  if (!o.amplify.empty()) amplify = number("--amplify", o.amplify);
  if (amplify == 0.0) throw std::invalid_argument("--amplify: expected more than 0");
  const bool folders = is_folder(o.a);
  if (folders != is_folder(o.b)) throw std::invalid_argument("compare: expected two images or two captures' folders");
  if (folders && !o.output.empty()) throw std::invalid_argument("--output goes with images alone");
  if (!o.output.empty()) require_image_name(o.output);
  const Output outputs[] = {{"--output", o.output}, {"--json", o.json}};
  require_outputs(outputs, {}, inputs_of(o, folders));

  std::vector<check::StoredComparison> comparisons;
  if (folders) {
    comparisons = check::compare_captures(read_capture(o.a), read_capture(o.b), tolerance);
  } else {
    const StoredImage a = read_stored(o.a), b = read_stored(o.b);
    comparisons = check::compare_images(a, b, tolerance);
    if (!o.output.empty()) write_difference(o, amplify, a, b);
  }
  fmt::print("{}", report::stored_table(comparisons, tolerance));
  if (!o.json.empty()) report::write_json(o.json, o.a, o.b, tolerance, comparisons);
  const auto lacks = [](const check::StoredComparison& c) { return c.outcome == check::Outcome::missing; };
  const bool holds = !std::ranges::all_of(comparisons, lacks) &&
                     std::ranges::none_of(comparisons, [&](const check::StoredComparison& c) {
                       return is_failure(c.outcome) && !(o.allow_missing && lacks(c));
                     });
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli
