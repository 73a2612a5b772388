#pragma once

#include <memory>

#include "render/gl_objects.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// Triangles of a tool in GL's memory: the unit sphere about its centre, or a mesh.
class ToolMesh {
 public:
  ToolMesh();
  /// Puts this mesh into GL's memory, unless it is there already. Null: the sphere.
  void show(const std::shared_ptr<const TriangleMesh>& mesh);
  void draw() const;

 private:
  void fill(const std::vector<Eigen::Vector3f>& corners);

  GlObject layout_, vertices_;
  int vertex_count_ = 0;
  std::shared_ptr<const TriangleMesh> shown_;
};

}  // namespace sandstroke
