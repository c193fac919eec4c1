// Makes OpenGL's objects, and throws the driver's error if it cannot.
#include "game/view/render/gl_objects.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace rink::view {
namespace {

GLuint generated(void (*generate)(GLsizei, GLuint*)) {
  GLuint name = 0;
  generate(1, &name);
  return name;
}

/// The shader's name, or an error with the compiler's text.
GLuint compiled(const char* what, GLenum kind, const char* shared, const char* source) {
  const std::array<const char*, 3> parts{"#version 330 core\n", shared, source};
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  glCompileShader(shader);
  GLint is_compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  if (is_compiled) return shader;
  std::array<char, 2000> words{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
  throw GraphicsError(std::string("the graphics driver does not compile the shader of the ") +
                      what + ": " + words.data());
}

}  // namespace

Program::Program(const char* what, const char* shared, const char* vertex, const char* fragment)
    : program_(glCreateProgram()) {
  const std::array<GLuint, 2> shaders{compiled(what, GL_VERTEX_SHADER, shared, vertex),
                                      compiled(what, GL_FRAGMENT_SHADER, shared, fragment)};
  for (const GLuint shader : shaders) glAttachShader(program_.name(), shader);
  glLinkProgram(program_.name());
  for (const GLuint shader : shaders) glDeleteShader(shader);
  GLint is_linked = 0;
  glGetProgramiv(program_.name(), GL_LINK_STATUS, &is_linked);
  if (!is_linked)
    throw GraphicsError(std::string("the graphics driver does not link the shaders of the ") +
                        what);
}

FloatStream::FloatStream(std::span<const int> sizes, bool per_instance)
    : array_(generated(glGenVertexArrays)), buffer_(generated(glGenBuffers)), row_(0) {
  assert(!sizes.empty() &&
         std::ranges::all_of(sizes, [](int size) { return size >= 1 && size <= 4; }));
  for (const int size : sizes) row_ += static_cast<std::size_t>(size);
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  std::size_t offset = 0;
  for (GLuint attribute = 0; attribute < sizes.size(); ++attribute) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, sizes[attribute], GL_FLOAT, GL_FALSE,
                          static_cast<GLsizei>(row_ * sizeof(float)),
                          reinterpret_cast<const void*>(offset * sizeof(float)));
    if (per_instance) glVertexAttribDivisor(attribute, 1);
    offset += static_cast<std::size_t>(sizes[attribute]);
  }
  glBindVertexArray(0);
}

void FloatStream::fill(std::span<const float> rows) {
  assert(rows.size() % row_ == 0);
  count_ = static_cast<GLsizei>(rows.size() / row_);
  capacity_ = std::max(capacity_, rows.size());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_ * sizeof(float)), nullptr,
               GL_STREAM_DRAW);  // a new store, so that this does not wait for the last frame
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(rows.size_bytes()), rows.data());
}

GlName<destroy_texture> make_texture(int width, int height, int channels,
                                     std::span<const std::uint8_t> pixels, bool repeats) {
  assert(width > 0 && height > 0 && (channels == 1 || channels == 4));
  assert(pixels.size() == static_cast<std::size_t>(width * height * channels));
  GlName<destroy_texture> texture(generated(glGenTextures));
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, channels == 1 ? GL_R8 : GL_RGBA8, width, height, 0,
               channels == 1 ? GL_RED : GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const GLint wrap = repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  return texture;
}

namespace {

GlName<destroy_texture> attached_texture(int width, int height, GLenum attachment) {
  const bool is_depth = attachment == GL_DEPTH_ATTACHMENT;
  GlName<destroy_texture> texture(generated(glGenTextures));
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, is_depth ? GL_DEPTH_COMPONENT32F : GL_RGBA8, width, height, 0,
               is_depth ? GL_DEPTH_COMPONENT : GL_RGBA, is_depth ? GL_FLOAT : GL_UNSIGNED_BYTE,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
  return texture;
}

GlName<destroy_renderbuffer> attached_samples(int width, int height, int samples,
                                              GLenum attachment) {
  GlName<destroy_renderbuffer> buffer(generated(glGenRenderbuffers));
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
  glRenderbufferStorageMultisample(
      GL_RENDERBUFFER, samples,
      attachment == GL_DEPTH_ATTACHMENT ? GL_DEPTH_COMPONENT32F : GL_RGBA8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
  return buffer;
}

}  // namespace

Target::Target(int width, int height, int samples)
    : framebuffer_(generated(glGenFramebuffers)), width_(width), height_(height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (samples > 0) {
    colour_samples_ = attached_samples(width, height, samples, GL_COLOR_ATTACHMENT0);
    depth_samples_ = attached_samples(width, height, samples, GL_DEPTH_ATTACHMENT);
  } else {
    colour_ = attached_texture(width, height, GL_COLOR_ATTACHMENT0);
    depth_ = attached_texture(width, height, GL_DEPTH_ATTACHMENT);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("the graphics driver has no framebuffer of " + std::to_string(width) + "x" +
                        std::to_string(height) + " with " + std::to_string(samples) + " samples");
}

}  // namespace rink::view
