#pragma once

// Private to src/render: owners of OpenGL's objects.
#include <Eigen/Core>
#include <string>
#include <utility>

#include "render/gl_functions.h"

namespace sandstroke {

/// Owns one GL object. Its context must be current when the object is made and when it is destroyed.
class GlObject {
 public:
  using Destroy = void (*)(GLuint);
  GlObject() = default;
  GlObject(GLuint id, Destroy destroy) : id_(id), destroy_(destroy) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)), destroy_(other.destroy_) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }
  ~GlObject() {
    if (id_) destroy_(id_);
  }
  operator GLuint() const { return id_; }

 private:
  GLuint id_ = 0;
  Destroy destroy_ = nullptr;
};

GlObject make_texture();
GlObject make_buffer();
GlObject make_vertex_array();
GlObject make_framebuffer();
GlObject make_renderbuffer();

/// Throws (io) where GL has recorded an error since the last call; `doing` names the step.
void check_gl(const char* doing);

/// A linked vertex and fragment shader. Error: io, with the compiler's log.
class ShaderProgram {
 public:
  ShaderProgram(const std::string& name, const std::string& vertex, const std::string& fragment);
  void use() const { glUseProgram(program_); }

  // These set values of the program in use. Names that the compiler has optimised away are ignored.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, double value) const { glUniform1f(location(name), static_cast<float>(value)); }
  void set(const char* name, int x, int y) const { glUniform2i(location(name), x, y); }
  void set(const char* name, const Eigen::Vector2d& value) const;
  void set(const char* name, const Eigen::Vector3d& value) const;
  void set(const char* name, const Eigen::Vector4d& value) const;
  void set(const char* name, const Eigen::Matrix4d& value) const;
  /// The location of a name, for glUniform calls that are made often.
  GLint location(const char* name) const { return glGetUniformLocation(program_, name); }

 private:
  GlObject program_;
};

}  // namespace sandstroke
