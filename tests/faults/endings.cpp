#include "faults/endings.h"

#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "faults/variants.h"

namespace plumbline::faults {

namespace {

void crash(const pipeline::DrawInput&, pipeline::Polygon&) { ::raise(SIGSEGV); }

void hang(const pipeline::DrawInput&, const pipeline::Polygon&, std::vector<pipeline::ShadedTriangle>&) {
  while (true) ::pause();
}

void take_memory(const Scene&, const Draw&, const Mesh&, pipeline::Lights, std::span<const Vertex<float>>,
                 std::vector<pipeline::Attributes>& out) {
  while (true) out.resize(2 * out.size() + 1);
}

void refuse(const Matrices<float>&, Normals, const Mesh&, std::vector<Vertex<float>>&) {
  throw std::runtime_error("a vertex too many");
}

template <auto member, auto function>
constexpr Fault ending(std::string_view name, std::string_view changes, Stage stage) {
  return {name, changes, stage, put<member, function>};
}

constexpr Fault kEndings[] = {
    ending<&Stages::vertex, refuse>("endings.throw", "the vertex stage throws", Stage::vertex),
    ending<&Stages::light, take_memory>("endings.memory", "the light stage takes all memory", Stage::light),
    ending<&Stages::clip, crash>("endings.crash", "the clip stage is ended by a signal", Stage::clip),
    ending<&Stages::window, hang>("endings.hang", "the window stage does not end", Stage::window),
};

}  // namespace

std::span<const Fault> endings() { return kEndings; }

}  // namespace plumbline::faults
