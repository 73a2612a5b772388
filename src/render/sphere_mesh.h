#pragma once

#include "render/gl_objects.h"

namespace sandstroke {

/// Triangles of the unit sphere.
class SphereMesh {
 public:
  SphereMesh();
  void draw() const;

 private:
  GlObject layout_, vertices_;
  int vertex_count_ = 0;
};

}  // namespace sandstroke
