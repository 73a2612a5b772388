#include "render/gl_objects.h"

#include <vector>

#include "core/error.h"

namespace sandstroke {
namespace {

template <class Generate>
GLuint generated(Generate generate) {
  GLuint id = 0;
  generate(1, &id);
  return id;
}

GlObject compiled(GLenum stage, const std::string& name, const std::string& source) {
  GlObject shader(glCreateShader(stage), [](GLuint id) { glDeleteShader(id); });
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    std::vector<char> log(8192);
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw_io_error("the {} shader of '{}' does not compile with this OpenGL: {}",
                   stage == GL_VERTEX_SHADER ? "vertex" : "fragment", name, log.data());
  }
  return shader;
}

}  // namespace

GlObject make_texture() {
  return {generated(glGenTextures), [](GLuint id) { glDeleteTextures(1, &id); }};
}
GlObject make_buffer() {
  return {generated(glGenBuffers), [](GLuint id) { glDeleteBuffers(1, &id); }};
}
GlObject make_vertex_array() {
  return {generated(glGenVertexArrays), [](GLuint id) { glDeleteVertexArrays(1, &id); }};
}
GlObject make_framebuffer() {
  return {generated(glGenFramebuffers), [](GLuint id) { glDeleteFramebuffers(1, &id); }};
}
GlObject make_renderbuffer() {
  return {generated(glGenRenderbuffers), [](GLuint id) { glDeleteRenderbuffers(1, &id); }};
}

void check_gl(const char* doing) {
  if (const GLenum failure = glGetError(); failure != GL_NO_ERROR)
    throw_io_error("OpenGL error 0x{:04x} while {}{}", failure, doing,
                   failure == GL_OUT_OF_MEMORY ? ": use a smaller picture or bed" : "");
}

ShaderProgram::ShaderProgram(const std::string& name, const std::string& vertex, const std::string& fragment)
    : program_(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); }) {
  const GlObject vertex_shader = compiled(GL_VERTEX_SHADER, name, vertex);
  const GlObject fragment_shader = compiled(GL_FRAGMENT_SHADER, name, fragment);
  glAttachShader(program_, vertex_shader);
  glAttachShader(program_, fragment_shader);
  glLinkProgram(program_);
  GLint good = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (!good) {
    std::vector<char> log(8192);
    glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw_io_error("the shaders of '{}' do not link with this OpenGL: {}", name, log.data());
  }
}

void ShaderProgram::set(const char* name, const Eigen::Vector2d& value) const {
  const Eigen::Vector2f narrow = value.cast<float>();
  glUniform2fv(location(name), 1, narrow.data());
}
void ShaderProgram::set(const char* name, const Eigen::Vector3d& value) const {
  const Eigen::Vector3f narrow = value.cast<float>();
  glUniform3fv(location(name), 1, narrow.data());
}
void ShaderProgram::set(const char* name, const Eigen::Vector4d& value) const {
  const Eigen::Vector4f narrow = value.cast<float>();
  glUniform4fv(location(name), 1, narrow.data());
}
void ShaderProgram::set(const char* name, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix4f narrow = value.cast<float>();
  glUniformMatrix4fv(location(name), 1, GL_FALSE, narrow.data());
}

}  // namespace sandstroke
