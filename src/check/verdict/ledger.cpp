// The tolerance ledger, written by hand. What is not here is compared with tolerance zero. Beside it stands
// golden/tolerances.json, generated: the largest difference seen for each row over the full suite.
//
// u = 2^-24. "of the magnitude": times the sum of the absolute values of the terms (bounds.h), which is what rounding
// errors are proportional to. A product of n factors with n - 1 sums has a relative error of at most about n u
// (Higham, Accuracy and stability of numerical algorithms, section 3.1). A rounding below the smallest normal number
// has an absolute error besides: bounded.h, Roundings.
#include "check/verdict/ledger.h"

#include <array>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace plumbline::check {

namespace {

constexpr std::array kLedger = {
    Tolerance{Profile::exact, Stage::matrices, "", 1, "half ULP",
              "Rounding once from double to float is within half an ULP; entries below 1e-12 become 0."},
    Tolerance{Profile::opengl, Stage::matrices, "", 2, "1e-12",
              "Both are products in double, each within 1e-12 of the column (rounding; entries below 1e-12 become 0), "
              "rounded once to float: what is left of entries that cancel may differ in its last bits.",
              "Doubles' own rounding is a thousandth of it; an entry would have to lie on both sides of 1e-12."},
    Tolerance{Profile::exact, Stage::vertex, "", 8, "u",
              "Eye position: 4 products and 3 sums, 4 u of the magnitude |M||p|. Clip position: the same for the "
              "product of matrices and again for the point: 8 u of |P||M||p|. Normal: 3 u of |N||n|, length and "
              "division 4 more."},
    Tolerance{
        Profile::exact, Stage::vertex, "scene", 10, "u",
        "From the scene: as exact.vertex, and the entries of both matrices were rounded to float before, 1 u each."},
    Tolerance{Profile::exact, Stage::light, "", 16, "u",
              "Per light a normalised vector (3 u), two dot products of unit vectors (3 u each), products and sums (4 "
              "u), the power (below 1 u, times the shininess for its argument's error): 16 u of the magnitude of "
              "light_bounds.h, light_bounds.",
              "A chain of some 20 roundings: they do not all go one way, and where the power multiplies them it is "
              "also small."},
    Tolerance{Profile::opengl, Stage::vertex, "", 8, "u",
              "Positions: 0, both sides follow one float recipe. Normals: Mesa inverts the model-view in float, "
              "some 8 roundings of |N| |M|^T |N| |n| (bounds.h, inverted_normal_magnitude).",
              "The roundings do not all go one way, and the magnitude takes every term for the largest."},
    Tolerance{Profile::opengl, Stage::light, "", 32, "u",
              "Both sides are within exact.light of the exact value: twice that.", "As exact.light."},
    Tolerance{
        Profile::exact, Stage::clip, "", 8, "u",
        "A cut vertex lies on its edge and on its plane but for rounding: the plane's distance (2 u), t (3 u), and "
        "a + t (b - a) (3 u), of the largest coordinate of the primitive's corners; repeated cuts add. Along its edge "
        "it "
        "may be farther off: an error e of the distances d moves it by e |b - a| / |d_a - d_b|, without bound where "
        "the "
        "edge is nearly parallel to the plane and cancellation leaves little of d; its place on the edge is not held.",
        "The distance is taken from the nearer end, so that t and its error are at most a half, mostly far less."},
    Tolerance{Profile::opengl, Stage::clip, "", 4, "u",
              "p_clip is rebuilt from window coordinates: 1/w, product, scale and translation, at most 4 roundings of "
              "|p_clip| + w, undone in double. The cuts themselves follow one recipe."},
    Tolerance{Profile::exact, Stage::window, "", 4, "u",
              "1/w, product, and a fused or separate scale and translate: 4 roundings."},
    Tolerance{Profile::opengl, Stage::window, "", 1, "ULP",
              "1/w: feedback hands out w, the reciprocal of the reciprocal; p_win: 0."},
    Tolerance{Profile::exact, Stage::depth, "", 0.501, "step",
              "Rounding to the nearest code is half a step. The plane is evaluated in double; 0.001 steps are kept "
              "for it, and for slivers six roundings of its terms, which only there are more (mean_bounds.h, "
              "depth_rounding). "
              "(Within one step would let truncation pass.)"},
    Tolerance{
        Profile::opengl, Stage::coverage, "lines", 1, "pixel",
        "Lines of width 1 may be drawn by another rule than the diamond-exit rule (OpenGL 2.1, section 3.4.1): each "
        "pixel at most one off, one more or fewer in number, one to a column. Mesa's end points are moved so that "
        "some lines of ends off the pixels' centres begin or end a pixel elsewhere, and in a frame buffer object "
        "Mesa 22.3 loses the first pixel of steep lines that run downwards (25.0 does not). Of a wide line that goes "
        "for the line that is widened (3.4.2): its columns are whole. An even width moves it by half a pixel, and Mesa "
        "looks at its ends before: together that may be two in number, a dispute."},
    Tolerance{
        Profile::opengl, Stage::depth, "", 4, "u",
        "llvmpipe evaluates z0 + dz/dx x + dz/dy y in float from the window's origin: each term is a product and a "
        "sum, once to bring z0 to the origin and once at the pixel: 4 u of the magnitude of bounds.h, "
        "bounds_from_origin, which counts the gradients' own error; one step of the format more. Along a line it goes "
        "by the place on the major axis alone: the nearer of that depth and of the projection's counts.",
        "Four roundings and the gradients', which do not all go one way."},
    Tolerance{
        Profile::exact, Stage::attributes, "", 10, "u",
        "Barycentrics rounded to float (1), times 1/w (1), the sum of three such (4), reciprocal and product (2), "
        "the corners' difference and its product (2): 10 u of the magnitude of mean_bounds.h, bounds_of_mean, which "
        "counts the two last sums at a fifth, and at two fifths what float sums within blocks of 4 x 4 pixels."},
    Tolerance{
        Profile::opengl, Stage::attributes, "", 8, "u",
        "As opengl.depth, 4 u for colour / w and for 1 / w, which the magnitude joins, and 4 more for the products by "
        "1/w at the corners and the division; besides, what the two sides' vertex colours differ by, the "
        "candidate's own error (exact.attributes), and of a triangle that is cut opengl.clip's u of its largest. Along "
        "a line the nearer of the two colours counts, as for opengl.depth.",
        "Two renderers' worst cases add up, and roundings do not all go one way."},
    Tolerance{Profile::exact, Stage::texture, "", 3, "u",
              "Texel coordinates are exact in double; two means of texels in one level and one of two levels, each "
              "rounded to float (1 u); lambda is rounded once."},
    Tolerance{Profile::opengl, Stage::texture, "", 8, "u",
              "Beside what texture coordinates' errors come to (opengl.attributes, and 4 u for their product with the "
              "level's size, its fraction and the half texel): three means of texels, each a difference, a product "
              "and a sum. Levels of detail may be anything between the least and the greatest at the four pixels of "
              "a square, by a logarithm that is linear between powers of two, as the driver's, of differences of "
              "coordinates in float.",
              "As opengl.attributes, whose bounds of coordinates it has."},
    Tolerance{Profile::exact, Stage::shade, "", 4, "u",
              "Fog: f is computed in double from the distance in float and rounded once (1 u), so is 1 - f (1 u); two "
              "products and a sum (3 u), each of the magnitudes of shade_bounds.h. Light per fragment: as exact.light, "
              "with its 16 u for 4."},
    Tolerance{
        Profile::opengl, Stage::shade, "", 8, "u",
        "As exact.shade, by a renderer that evaluates attributes as opengl.attributes says and f in float: the "
        "argument (3 u) and the exponential (its polynomial is 4 u off). Its fog coordinate may be 4 u of |M| |p| "
        "from the z_eye that it hands out."},
    Tolerance{Profile::opengl, Stage::merge, "rgba8", 1, "1/255",
              "Both sides are within their float bound of one value, and round it to the nearest code: neighbours at "
              "most, where opengl.attributes is below a code; for slivers its whole codes more."},
    Tolerance{Profile::opengl, Stage::merge, "rgba16", 1, "1/65535",
              "As opengl.merge.rgba8; of the clear colour too, where its product in float may come to half a code."},
    Tolerance{Profile::opengl, Stage::merge, "blend.rgba16", 2.5, "1/65535", "As opengl.merge.blend, in 16 bits."},
    Tolerance{
        Profile::opengl, Stage::merge, "blend", 2.5, "1/255",
        "llvmpipe blends rgba8 in 8 bits. Per fragment: half a code for its colour, half a code for its alpha (or "
        "the constant) as a factor, a code for two rounded products or one truncated interpolation; half a code "
        "for our own rounding. What is there counts once, or twice where a factor reads the frame too."},
    Tolerance{
        Profile::opengl, Stage::merge, "blend.float", 8, "u",
        "opengl.attributes for each fragment's colour, which comes in as source, as factor of itself and as factor "
        "of what is there; 4 u for the blending's own roundings.",
        "The errors of colours do not all go one way, nor are they all of the largest channel."},
    Tolerance{Profile::exact, Stage::merge, "codes", 1, "half code",
              "A code is at most half a code from the value that was rounded, and the product by the largest code in "
              "float is 2 u off."},
    Tolerance{
        Profile::exact, Stage::resolve, "", 1, "bound",
        "Half a code for the rounding. Before it, of four equal samples in float: 2 u for a code's product with "
        "1/255, 3 u for three sums, 1 u to make codes of the mean: under 8 u of the largest sample; of float colours "
        "that alone, and of other means, which are taken in double, one rounding."},
    Tolerance{Profile::oracle, Stage::depth, "", 1, "step",
              "The legal interval, and one step of the depth format for the rounding."},
    Tolerance{Profile::oracle, Stage::attributes, "", 1, "bound",
              "The oracle's own bound of float arithmetic from the scene on (reference/arithmetic/color_error.h)."},
    Tolerance{Profile::oracle, Stage::merge, "", 1, "bound",
              "oracle.attributes' bound and, where the frame has codes, half a code for the rounding."},
};

}  // namespace

std::span<const Tolerance> ledger() { return kLedger; }

std::string name_of(const Tolerance& row) {
  return fmt::format("{}.{}{}{}", name_of(row.profile), name_of(row.stage), row.part.empty() ? "" : ".", row.part);
}

const Tolerance& tolerance(Profile profile, Stage stage, std::string_view part) {
  for (const Tolerance& row : kLedger) {
    if (row.profile == profile && row.stage == stage && row.part == part) return row;
  }
  throw std::logic_error(
      fmt::format("the tolerance ledger has no row {} {} {}", name_of(profile), name_of(stage), part));
}

}  // namespace plumbline::check
