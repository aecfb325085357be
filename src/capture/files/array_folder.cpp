#include "capture/files/array_folder.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace plumbline {

ArrayFolder::ArrayFolder(AtomicPath& folder, std::filesystem::path inside)
    : folder_(folder), inside_(std::move(inside)) {}

void ArrayFolder::add(std::string_view name, std::string_view dtype, const Shape& shape, std::string_view bytes) {
  const std::string file = fmt::format("{}.bin", name);
  arrays_.push_back({{"name", name}, {"dtype", dtype}, {"shape", shape}, {"file", file}});
  folder_.write_inside(inside_ / file, bytes);
}

void ArrayFolder::finish(nlohmann::ordered_json manifest) {
  manifest["byte_order"] = "little";
  manifest["arrays"] = std::move(arrays_);
  folder_.write_inside(inside_ / "manifest.json",
                       manifest.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

}  // namespace plumbline
