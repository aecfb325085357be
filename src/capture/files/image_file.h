// Planes as image files. A plane's row 0 is its bottom, a file's first row its top: rows are flipped on the way. Alpha
// stays straight, colours are numbers: nothing is multiplied, no colour space converted.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture/plane.h"
#include "scene/scene.h"

namespace plumbline {

/// Error of an image file. The message names the file.
struct ImageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Bytes = std::string;

/// Encoders: each returns a plane as the bytes of the file that `file` names. All throw ImageError for an empty plane,
/// a name with another ending than the encoder's, or a format that the file cannot hold. Where a file holds codes,
/// values are clamped to [0,1] (NaN: 0) and rounded to nearest: value * 255, of an rgba12 frame value * 4095, of rgba16
/// value * 65535.
///
/// .png: 8-bit RGBA; of an rgba16 frame 16-bit; of rgba12, too, each code c as c * 65535 / 4095 rounded, so that none
/// is lost.
Bytes encode_png(const std::filesystem::path& file, const Plane<glm::vec4>& plane,
                 ColorFormat format = ColorFormat::rgba8);
/// .tga: 8-bit RGBA; throws for an rgba12 or rgba16 frame.
Bytes encode_tga(const std::filesystem::path& file, const Plane<glm::vec4>& plane,
                 ColorFormat format = ColorFormat::rgba8);
/// .ppm: binary, the codes themselves of red, green and blue, of at most 255, 4095 or 65535. No alpha.
Bytes encode_ppm(const std::filesystem::path& file, const Plane<glm::vec4>& plane,
                 ColorFormat format = ColorFormat::rgba8);
/// .exr: 32-bit float RGBA, bit for bit, lossless compression; the same bytes whenever it is written.
Bytes encode_exr(const std::filesystem::path& file, const Plane<glm::vec4>& plane);
/// .exr, one channel "Z": window z rounded to 32-bit float.
Bytes encode_depth_exr(const std::filesystem::path& file, const Plane<double>& plane);
/// .exr, one channel "Z": the codes of the depth format as numbers, which 32-bit float holds without loss up to 24
/// bits; of z32f window z itself. (Window z of 24 bits, a quotient, would be rounded.)
Bytes encode_depth_codes(const std::filesystem::path& file, const Plane<double>& plane, DepthFormat format);
/// Encodes by the file name's ending, .png, .tga, .ppm or .exr. `format`: the frame's colour format.
Bytes encode_image(const std::filesystem::path& file, const Plane<glm::vec4>& plane,
                   ColorFormat format = ColorFormat::rgba8);

/// Checks of a file name before there is a plane: throw what encode_image() and encode_depth_exr() would throw for it.
void require_image_name(const std::filesystem::path& file, ColorFormat format = ColorFormat::rgba8);
void require_depth_name(const std::filesystem::path& file);

/// Writes the plane as encode_image() of an rgba8 frame does; the file appears whole or not at all. Throws OutputError
/// (atomic_path.h) as well.
void write_image(const std::filesystem::path& file, const Plane<glm::vec4>& plane);

/// An image as it is stored: no alpha multiplied or divided, no colour converted, no tag obeyed.
struct StoredImage {
  struct Channel {
    std::string name;      ///< such as "R", "A", "Z"
    double scale = 1;      ///< a value is values / scale: 2^n - 1 for n-bit codes, 1 for floats
    Plane<double> values;  ///< all of one size; floats of any kind, NaN and infinities included
  };
  struct Window {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Window&) const = default;
  };
  std::vector<Channel> channels;  ///< at least one
  Window data, display;  ///< what is stored, and the frame that it is a part of; y from the top, as in the file
};

/// Reads an image of any format that OpenImageIO knows, of up to 16384 x 16384 pixels and 2^28 values. Throws
/// ImageError for several parts or MIP levels, deep pixels and volumes.
StoredImage read_stored(const std::filesystem::path& file);

/// Inverses, bit for bit, of encode_image (4 channels: not .ppm) and of encode_depth_codes. `file`: for messages. Throw
/// ImageError where the image has other channels, or another type of number.
Plane<glm::vec4> frame_color(const std::filesystem::path& file, const StoredImage& image, ColorFormat format);
Plane<double> frame_depth(const std::filesystem::path& file, const StoredImage& image, DepthFormat format);

/// Reads an image of 1 to 4 channels as RGBA, codes scaled to [0,1]. Of 1 or 2 channels the first is red, green and
/// blue, and the second alpha; a missing alpha is 1. Throws ImageError.
Plane<glm::vec4> read_image(const std::filesystem::path& file);

/// Version of OpenImageIO, which reads and writes image files.
std::string image_library_version();

}  // namespace plumbline
