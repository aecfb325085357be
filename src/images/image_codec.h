// Image files, as OpenImageIO reads and writes them. It brings some 250 shared libraries, which take a quarter of a
// second to load: a library of its own (module/) is loaded when the first image is read or written, for most processes
// never.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace plumbline {

/// How a channel's numbers are stored; `other` cannot be asked for.
enum class SampleType { uint8, int8, uint16, int16, uint32, int32, float16, float32, float64, other };

struct ImageHeader {
  struct Channel {
    std::string name;  ///< such as "R", "Z"
    SampleType type = SampleType::other;
    std::string type_name;  ///< OpenImageIO's
  };
  int x = 0, y = 0, width = 0, height = 0, depth = 0;  ///< pixels that are stored; from the top
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;
  bool deep = false, several = false;   ///< several: parts, frames or MIP levels
  SampleType type = SampleType::other;  ///< into which all channels fit
  std::string type_name;
  std::vector<Channel> channels;
};

/// An open file. Numbers are as stored: no colour converted, no alpha multiplied or divided.
class OpenImage {
 public:
  virtual ~OpenImage() = default;
  const ImageHeader& header() const { return header_; }
  /// The channels from `first` to before `last` of each pixel, rows from the top, as numbers of the type. False: see
  /// error().
  virtual bool read(int first, int last, SampleType as, void* to) = 0;
  virtual std::string error() const = 0;

 protected:
  ImageHeader header_;
};

/// What to encode: alpha straight, lossless compression.
struct ImageToEncode {
  std::string name;  ///< its ending says the format
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< names
  SampleType type = SampleType::uint8;
  const void* pixels = nullptr;  ///< all channels of each pixel, rows from the top
};

struct ImageCodec {
  const char* version;  ///< of OpenImageIO
  /// Null where the file is no image: `error` says why.
  std::unique_ptr<OpenImage> (*open)(const std::string& name, std::string& error);
  /// Empty where it cannot be encoded: `error` says why.
  std::string (*encode)(const ImageToEncode& image, std::string& error);
};

/// Loads the module, once. Throws std::runtime_error if it is not beside the program.
const ImageCodec& image_codec();

}  // namespace plumbline
