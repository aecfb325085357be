// The C kit in a program whose locale writes commas for decimal points: strtod() and localeconv() are replaced by such
// a locale's, for a test machine may have none.
#include <clocale>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/test_folder.h"

namespace {

double strtod_of_commas(const char* text, char** end) {
  std::string points = text;
  for (char& c : points) c = c == ',' ? '.' : c == '.' ? ',' : c;
  char* stop = nullptr;
  const double number = std::strtod(points.c_str(), &stop);
  *end = const_cast<char*>(text) + (stop - points.c_str());
  return number;
}
std::lconv* localeconv_of_commas() {
  static char comma[] = ",";
  static std::lconv locale = *std::localeconv();
  locale.decimal_point = comma;
  return &locale;
}

}  // namespace

#define strtod strtod_of_commas
#define localeconv localeconv_of_commas
#include "src/kit/plumbline.h"
#include "tests/text_file.h"
#undef strtod
#undef localeconv

namespace plumbline {
namespace {

class KitInALocaleOfCommas : public TestFolder {};

TEST_F(KitInALocaleOfCommas, ReadsNumbers) {
  test::write_text(root_ / "manifest.json", R"({"numbers": [1.5, -0.25e3, 12345678.9012345, 7]})");
  PlScene* scene = pl_open(root_.c_str());
  EXPECT_EQ(pl_number(scene, "numbers.0"), 1.5);
  EXPECT_EQ(pl_number(scene, "numbers.%d", 1), -250);
  EXPECT_EQ(pl_number(scene, "numbers.2"), 12345678.9012345);
  EXPECT_EQ(pl_number(scene, "numbers.3"), 7);
  pl_close(scene);
}

}  // namespace
}  // namespace plumbline
