#include "reference/osmesa/gl/feedback.h"

#include <algorithm>
#include <limits>

#include "capture/renderer.h"

namespace plumbline::osmesa {

std::span<const float> Feedback::run(std::size_t expected, const std::function<void()>& draw) {
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<GLsizei>::max());
  if (values_.size() < expected) values_.resize(expected);
  while (true) {
    if (values_.size() > kMost) throw RendererFailed("osmesa: feedback mode needs more room than OpenGL can be given");
    gl_.FeedbackBuffer(static_cast<GLsizei>(values_.size()), type_, values_.data());
    gl_.RenderMode(GL_FEEDBACK);
    draw();
    const GLint written = gl_.RenderMode(GL_RENDER);
    check(gl_, "feedback mode");
    if (written >= 0) return {values_.data(), static_cast<std::size_t>(written)};
    values_.resize(std::max<std::size_t>(2 * values_.size(), 1024));  // it overflowed
  }
}

}  // namespace plumbline::osmesa
