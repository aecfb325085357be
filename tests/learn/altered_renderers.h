// Our renderer with altered scenes and pictures, for plumb learn.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "faults/faults.h"
#include "learn/learn.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::learn {

using C = Conventions;
using Alter = std::function<void(Capture&)>;

// Another renderer's pictures, altered.
class Altered : public Renderer {
 public:
  Altered(std::unique_ptr<Renderer> renderer, Alter alter) : renderer_(std::move(renderer)), alter_(std::move(alter)) {}
  RendererInfo info() const override { return renderer_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = renderer_->capture(scene, request);
    alter_(out);
    return out;
  }

 private:
  std::unique_ptr<Renderer> renderer_;
  Alter alter_;
};

// Our renderer with a fault.
inline std::unique_ptr<Renderer> faulted(const std::string& name) {
  return pipeline::make_pipeline(faults::named(name).stages());
}

// A renderer, ours by default, on altered scenes; `after` then alters its pictures.
class OfAlteredScenes : public Renderer {
 public:
  RendererInfo info() const override { return renderer_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Scene other = scene;
    before(other);
    Capture out = renderer_->capture(other, request);
    after(scene, out);
    return out;
  }
  OfAlteredScenes() : renderer_(pipeline::make_pipeline()) {}
  explicit OfAlteredScenes(std::unique_ptr<Renderer> renderer) : renderer_(std::move(renderer)) {}
  std::function<void(Scene&)> before = [](Scene&) {};
  std::function<void(const Scene&, Capture&)> after = [](const Scene&, Capture&) {};

 private:
  std::unique_ptr<Renderer> renderer_;
};

// Conventions of our renderer.
inline C ours() {
  C out;
  out.tie_rule = C::TieRule::left_bottom;
  out.depth_corners = C::DepthCorners::as_they_are;
  return out;
}

inline C learned(std::unique_ptr<Renderer> renderer) { return learn(*renderer).conventions; }

}  // namespace plumbline::learn
