// OpenGL's objects with owners: programs, buffers, textures, framebuffers. A context of OpenGL 3.3
// must be current wherever one is made, used or destroyed.
#pragma once

#include <epoxy/gl.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rink::view {

/// An error of the graphics driver, with its text.
class GraphicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The name of an OpenGL object that is destroyed with its owner.
template <void (*destroy)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) destroy(name_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void destroy_program(GLuint name) { glDeleteProgram(name); }
inline void destroy_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void destroy_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void destroy_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void destroy_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void destroy_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }

/// A linked pair of shaders. Unknown uniforms are ignored, as OpenGL does.
class Program {
 public:
  Program() = default;
  /// `shared` is put before both sources, after the version. Throws GraphicsError with the
  /// compiler's text.
  Program(const char* what, const char* shared, const char* vertex, const char* fragment);
  void use() const { glUseProgram(program_.name()); }
  void set(const char* uniform, float value) const { glUniform1f(at(uniform), value); }
  void set(const char* uniform, int value) const { glUniform1i(at(uniform), value); }
  void set(const char* uniform, const Eigen::Vector2f& value) const {
    glUniform2fv(at(uniform), 1, value.data());
  }
  void set(const char* uniform, const Eigen::Vector3f& value) const {
    glUniform3fv(at(uniform), 1, value.data());
  }
  void set(const char* uniform, const Eigen::Vector4f& value) const {
    glUniform4fv(at(uniform), 1, value.data());
  }
  void set(const char* uniform, const Eigen::Matrix4f& value) const {
    glUniformMatrix4fv(at(uniform), 1, GL_FALSE, value.data());
  }

 private:
  GLint at(const char* uniform) const { return glGetUniformLocation(program_.name(), uniform); }
  GlName<destroy_program> program_;
};

/// A stream of vertices or instances, each a row of floats cut into attributes of at most four.
class FloatStream {
 public:
  FloatStream() = default;
  /// `sizes`: floats of attributes 0, 1, …; `per_instance`: one row for each instance instead of
  /// each vertex.
  FloatStream(std::span<const int> sizes, bool per_instance);
  void fill(std::span<const float> rows);
  /// Rows that were filled in last.
  GLsizei count() const { return count_; }
  void bind() const { glBindVertexArray(array_.name()); }

 private:
  GlName<destroy_vertex_array> array_;
  GlName<destroy_buffer> buffer_;
  std::size_t row_ = 1, capacity_ = 0;
  GLsizei count_ = 0;
};

/// A texture of 8-bit colours, `channels` 1 or 4.
GlName<destroy_texture> make_texture(int width, int height, int channels,
                                     std::span<const std::uint8_t> pixels, bool repeats);

/// Colour and depth that can be drawn to and, without samples, read from.
class Target {
 public:
  Target() = default;
  /// `samples` 0: textures. Throws GraphicsError if the driver has no such framebuffer.
  Target(int width, int height, int samples);
  GLuint framebuffer() const { return framebuffer_.name(); }
  GLuint colour() const { return colour_.name(); }
  GLuint depth() const { return depth_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlName<destroy_framebuffer> framebuffer_;
  GlName<destroy_texture> colour_, depth_;
  GlName<destroy_renderbuffer> colour_samples_, depth_samples_;
  int width_ = 0, height_ = 0;
};

}  // namespace rink::view
