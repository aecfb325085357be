#include "report/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "stages/atomic_path.h"

namespace plumbline::report {

void write_text(const std::filesystem::path& file, const std::string& text) {
  try {
    if (std::filesystem::is_directory(file)) throw std::runtime_error("it is a folder");
    AtomicPath target(file);
    std::ofstream out(target.path(), std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(std::strerror(errno));
    target.commit();
  } catch (const std::exception& e) {
    throw std::runtime_error(file.string() + ": cannot be written: " + e.what());
  }
}

}  // namespace plumbline::report
