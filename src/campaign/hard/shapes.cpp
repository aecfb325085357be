// Triangles where pipelines break: slivers, near-coincident and grazing surfaces, corners on the pixel grid, triangles
// that are huge, tiny, or reach behind the eye.
#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

struct Spot {
  double x, y;  ///< pixels
};

// Anywhere on the frame, now and then beside it; on a grid of 1/256 pixel at the finest.
Spot anywhere(Builder& b) {
  Choices& c = b.choose;
  const double margin = c.chance(20) ? 1.5 : 0.1, parts = c.of({1, 2, 16, 256, 256, 256});
  const auto along = [&](int side) {
    const double from = -margin * side, to = (1 + margin) * side;
    return static_cast<double>(
               c.whole(static_cast<std::int64_t>(from * parts), static_cast<std::int64_t>(to * parts))) /
           parts;
  };
  const double x = along(b.view.width);
  return {x, along(b.view.height)};
}

// Spot on a grid of 1, 1/2, 1/4 or 1/16 pixel, which holds pixels' corners and, from 1/2 on, centres.
Spot on_grid(Builder& b) {
  Choices& c = b.choose;
  const double parts = c.of({1, 2, 2, 4, 16});
  const double x = c.count(0, b.view.width), dx = c.count(0, 16), y = c.count(0, b.view.height), dy = c.count(0, 16);
  return {x + static_cast<int>(dx * parts / 16) / parts, y + static_cast<int>(dy * parts / 16) / parts};
}

void add_triangle(Shape& shape) {
  const int n = static_cast<int>(shape.positions.size());
  shape.triangles.push_back({n - 3, n - 2, n - 1});
}

Shape scattered(Builder& b) {
  Shape out;
  const int count = static_cast<int>(b.choose.of({1, 1, 2, 3, 5, 8}));
  for (int i = 0; i < count; ++i) {
    const bool upright = b.choose.chance(25);  // parallel to the picture
    const double of_all = distance(b);
    for (int corner = 0; corner < 3; ++corner) {
      const Spot at = anywhere(b);
      out.positions.push_back(b.view.at(at.x, at.y, upright ? of_all : distance(b)));
    }
    add_triangle(out);
  }
  return out;
}

// Triangles whose third corner lies on or near the line through the other two.
Shape slivers(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const int count = c.count(1, 4);
  for (int i = 0; i < count; ++i) {
    const Spot from = anywhere(b), to = anywhere(b);
    const double share = c.of({0.5, 0.25, 0.1, 0, 1, 1.5}), off = c.of({0, 1e-6, 1e-4, 1.0 / 256, 1.0 / 16, 0.25, 1});
    const double d = distance(b), d_to = c.chance(50) ? d : distance(b);
    out.positions.push_back(b.view.at(from.x, from.y, d));
    out.positions.push_back(b.view.at(to.x, to.y, d_to));
    out.positions.push_back(b.view.at(from.x + share * (to.x - from.x) + off, from.y + share * (to.y - from.y) - off,
                                      d + share * (d_to - d)));
    add_triangle(out);
  }
  return out;
}

// One triangle several times, each a hair behind the last or coincident, perhaps with rotated corners.
Shape coincident(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const Spot spots[] = {anywhere(b), anywhere(b), anywhere(b)};
  double distances[] = {distance(b), distance(b), distance(b)};
  const double step = c.of({0, 0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3});
  const int count = c.count(2, 4), turn = c.count(0, 1);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const int corner = (k + i * turn) % 3;
      out.positions.push_back(b.view.at(spots[corner].x, spots[corner].y, distances[corner]));
    }
    add_triangle(out);
    for (double& d : distances) d += step;
  }
  return out;
}

// A plane that the eye sees almost from its edge, from before the eye to far away.
Shape grazing(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const double height = b.view.height * c.of({0.5, 0.25, 0.75}), lift = c.of({0, 1e-6, 1e-3, 0.05, 1}),
               near = c.of({b.view.near, 0.5, 0.001, -1}), far = c.of({b.view.far, 10, 30, 1.5 * b.view.far}),
               w = b.view.width;
  out.positions = {b.view.at(0, height - lift, near), b.view.at(w, height - lift, near),
                   b.view.at(w, height + lift, far), b.view.at(0, height + lift, far)};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  return out;
}

// Corners at samples and pixels' corners: many samples are ties.
Shape gridded(Builder& b) {
  Shape out;
  const int count = b.choose.count(1, 6);
  const double d = distance(b);
  for (int i = 0; i < count; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Spot at = on_grid(b);
      out.positions.push_back(b.view.at(at.x, at.y, d));
    }
    add_triangle(out);
  }
  return out;
}

// Closed fan of triangles of one winding: each sample inside the fan is in one triangle.
Shape fan(Builder& b) {
  Choices& c = b.choose;
  constexpr std::array<std::array<double, 2>, 8> kRound = {
      {{1, 0}, {0.75, 0.75}, {0, 1}, {-0.75, 0.75}, {-1, 0}, {-0.75, -0.75}, {0, -1}, {0.75, -0.75}}};
  Shape out;
  const Spot middle = c.chance(60) ? on_grid(b) : anywhere(b);
  const double d = distance(b), slope = c.of({0, 0, 0.1, -0.1});
  out.positions.push_back(b.view.at(middle.x, middle.y, d));
  for (const auto& way : kRound) {
    const double r = c.of({0.5, 2, 7.5, 16, 40, c.number(0.1, 30)});
    out.positions.push_back(b.view.at(middle.x + way[0] * r, middle.y + way[1] * r, d + slope * way[0]));
  }
  for (int i = 0; i < 8; ++i) out.triangles.push_back({0, 1 + i, 1 + (i + 1) % 8});
  return out;
}

// A strip of squares cut in two, some by one diagonal, some by the other.
Shape strip(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const int count = c.count(1, 6);
  const Spot from = on_grid(b);
  const double side = c.of({0.5, 1, 2, 4, 8, 16}), d = distance(b), slope = c.of({0, 0, 0.2, 1});
  for (int i = 0; i <= count; ++i) {
    for (int up = 0; up < 2; ++up) {
      out.positions.push_back(b.view.at(from.x + i * side, from.y + up * side, d + i * slope));
    }
  }
  for (int i = 0; i < count; ++i) {
    const int n = 2 * i;
    if (c.chance(50)) {
      out.triangles.push_back({n, n + 2, n + 3});
      out.triangles.push_back({n, n + 3, n + 1});
    } else {
      out.triangles.push_back({n, n + 2, n + 1});
      out.triangles.push_back({n + 2, n + 3, n + 1});
    }
  }
  return out;
}

Shape huge(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const int count = c.count(1, 2);
  for (int i = 0; i < count; ++i) {
    const double size = c.of({10, 100, 1000, 10000});
    for (int corner = 0; corner < 3; ++corner) {
      const double x = c.number(-1, 2), y = c.number(-1, 2);
      out.positions.push_back(b.view.at(x * size * b.view.width, y * size * b.view.height, distance(b)));
    }
    add_triangle(out);
  }
  return out;
}

Shape tiny(Builder& b) {
  Choices& c = b.choose;
  Shape out;
  const int count = c.count(1, 12);
  const double d = distance(b);
  const Spot about = c.chance(50) ? on_grid(b) : anywhere(b);
  for (int i = 0; i < count; ++i) {
    const double size = c.of({1.0 / 256, 1.0 / 16, 0.25, 1, 2});
    const double x = about.x + c.number(-2, 2), y = about.y + c.number(-2, 2);
    for (int corner = 0; corner < 3; ++corner) {
      const double dx = c.number(-1, 1), dy = c.number(-1, 1);
      out.positions.push_back(b.view.at(x + dx * size, y + dy * size, d));
    }
    add_triangle(out);
  }
  return out;
}

// No area, and both windings of a triangle.
Shape degenerate(Builder& b) {
  Choices& c = b.choose;
  Shape out = scattered(b);
  const auto n = static_cast<int>(out.positions.size());
  out.positions.push_back(out.positions.front());
  const int a = c.count(0, n - 1);
  if (a != 0) out.triangles.push_back({0, n, a});
  out.triangles.push_back({0, 1, 2});
  out.triangles.push_back({2, 1, 0});
  return out;
}

}  // namespace

Shape shape(Builder& b) {
  const std::string_view kind =
      b.choose.word({"scattered", "scattered", "slivers", "coincident", "coincident", "grazing", "gridded", "gridded",
                     "fan", "strip", "strip", "huge", "tiny", "degenerate"});
  if (kind == "slivers") return slivers(b);
  if (kind == "coincident") return coincident(b);
  if (kind == "grazing") return grazing(b);
  if (kind == "gridded") return gridded(b);
  if (kind == "fan") return fan(b);
  if (kind == "strip") return strip(b);
  if (kind == "huge") return huge(b);
  if (kind == "tiny") return tiny(b);
  if (kind == "degenerate") return degenerate(b);
  return scattered(b);
}

}  // namespace plumbline::hard
