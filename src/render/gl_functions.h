#pragma once

// Private to src/render: OpenGL, loaded when something is drawn. It and its compiler take 20 ms and 40 MB,
// which commands without pictures save.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

// The functions of OpenGL 3.3 that are called here.
#define SANDSTROKE_GL_FUNCTIONS(of)                                                                          \
  of(glActiveTexture) of(glAttachShader) of(glBindBuffer) of(glBindFramebuffer) of(glBindRenderbuffer)       \
      of(glBindTexture) of(glBindVertexArray) of(glBlitFramebuffer) of(glBufferData) of(                     \
          glCheckFramebufferStatus) of(glClear) of(glColorMask) of(glCompileShader) of(glCreateProgram)      \
          of(glCreateShader) of(glDeleteBuffers) of(glDeleteFramebuffers) of(glDeleteProgram)                \
              of(glDeleteRenderbuffers) of(glDeleteShader) of(glDeleteTextures) of(glDeleteVertexArrays) of( \
                  glDisable) of(glDrawArrays) of(glDrawElements) of(glEnable) of(glEnableVertexAttribArray)  \
                  of(glFramebufferRenderbuffer) of(glGenBuffers) of(glGenFramebuffers)                       \
                      of(glGenRenderbuffers) of(glGenTextures) of(glGenVertexArrays) of(glGenerateMipmap)    \
                          of(glGetError) of(glGetIntegerv) of(glGetProgramInfoLog) of(glGetProgramiv)        \
                              of(glGetShaderInfoLog) of(glGetShaderiv) of(glGetUniformLocation)              \
                                  of(glLinkProgram) of(glPixelStorei) of(glReadPixels)                       \
                                      of(glRenderbufferStorageMultisample) of(glScissor) of(glShaderSource)  \
                                          of(glTexImage2D) of(glTexParameteri) of(glTexSubImage2D)           \
                                              of(glUniform1f) of(glUniform1i) of(glUniform2fv)               \
                                                  of(glUniform2i) of(glUniform3fv) of(glUniform4fv)          \
                                                      of(glUniformMatrix4fv) of(glUseProgram)                \
                                                          of(glVertexAttribIPointer)                         \
                                                              of(glVertexAttribPointer) of(glViewport)

namespace sandstroke {

// Pointers with the functions' own names. In this namespace they come before those of the header. A function
// that the list lacks is an undefined reference for the linker.
#define SANDSTROKE_DECLARE(name) inline decltype(&::name) name = nullptr;
SANDSTROKE_GL_FUNCTIONS(SANDSTROKE_DECLARE)
#undef SANDSTROKE_DECLARE

/// Sets these pointers, once per process. Error: io, with what is missing.
void load_gl_functions();

}  // namespace sandstroke
