// Dear ImGui's context, fonts and input, without a window: menus and words over the picture.
#pragma once

#include <memory>
#include <span>

#include "game/view/render/picture.h"
#include "game/view/render/renderer.h"
#include "game/view/window/window_event.h"

struct ImFont;
struct ImGuiContext;

namespace rink::view {

/// At most one exists at a time, and only while a context of OpenGL is current.
class Interface {
 public:
  Interface();
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void receive(const WindowEvent& event);
  /// Between begin and finish the widgets of Dear ImGui may be called. `elapsed_s` since the last
  /// begin.
  void begin(const WindowSize& size, double elapsed_s);
  /// Draws texts and dimming of `picture`, under all widgets.
  void draw(const Picture& picture);
  /// Draws widgets and texts over the canvas, if it is visible.
  void finish(const Canvas& canvas, bool is_seen);

  /// Smaller than a line of a menu, and larger.
  ImFont* small_font() const { return fonts_[0]; }
  ImFont* title_font() const { return fonts_[2]; }
  /// Pixels per 720th of the window's height, the unit of menus.
  float unit() const { return unit_; }

 private:
  void make_fonts(float step);
  ImGuiContext* context_;
  ImFont* fonts_[3] = {};
  float font_step_ = 0.0f;  ///< the unit that the fonts were made for
  float unit_ = 1.0f;
};

}  // namespace rink::view
