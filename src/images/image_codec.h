// Interface to OpenImageIO, which reads and writes image files. OpenImageIO brings some 250 shared libraries, which
// take a quarter of a second to load; so it is behind a module (module/) that is loaded with the first image that is
// read or written, in most processes never.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace plumbline {

/// Stored type of a channel's numbers. `other` is reported only: neither read() nor encode() takes it.
enum class SampleType { uint8, int8, uint16, int16, uint32, int32, float16, float32, float64, other };

struct ImageHeader {
  struct Channel {
    std::string name;  ///< such as "R", "Z"
    SampleType type = SampleType::other;
    std::string type_name;  ///< OpenImageIO's
  };
  int x = 0, y = 0, width = 0, height = 0, depth = 0;           ///< stored pixels (data window); y from the top
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  ///< the whole picture (display window)
  bool deep = false, several = false;                           ///< several: parts, frames or MIP levels
  SampleType type = SampleType::other;                          ///< a type into which all channels fit
  std::string type_name;                                        ///< OpenImageIO's name of it
  std::vector<Channel> channels;
};

/// An open image file. Numbers are as stored: no colour converted, no alpha multiplied or divided.
class OpenImage {
 public:
  virtual ~OpenImage() = default;
  const ImageHeader& header() const { return header_; }
  /// Reads channels [first, last) of each pixel into `to`, interleaved, rows from the top, converted to type `as`. `to`
  /// holds width * height * (last - first) numbers. Returns false on failure: see error().
  virtual bool read(int first, int last, SampleType as, void* to) = 0;
  /// Why the last read() failed. OpenImageIO keeps a message once: the second call gives a general one.
  virtual std::string error() const = 0;

 protected:
  ImageHeader header_;
};

/// Input of encode(): an image of unassociated alpha, to be compressed without loss.
struct ImageToEncode {
  std::string name;  ///< file name; the ending selects the format
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< names
  SampleType type = SampleType::uint8;
  const void* pixels = nullptr;  ///< interleaved channels, rows from the top
};

/// The module's functions.
struct ImageCodec {
  const char* version;  ///< of OpenImageIO
  /// Opens a file. Null on failure: `error` says why.
  std::unique_ptr<OpenImage> (*open)(const std::string& name, std::string& error);
  /// The bytes of the encoded file. Empty on failure: `error` says why.
  std::string (*encode)(const ImageToEncode& image, std::string& error);
};

/// The codec; the first call loads the module, which is never unloaded. Throws std::runtime_error where the module
/// cannot be loaded.
const ImageCodec& image_codec();

}  // namespace plumbline
