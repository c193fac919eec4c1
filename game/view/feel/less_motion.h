// Whether the player asked the desktop for less motion.
#pragma once

#include <string>

namespace rink::view {

/// By the files of GTK and KDE in `folder`, that of the desktop's settings.
bool wants_less_motion(const std::string& folder);
/// $XDG_CONFIG_HOME, or ~/.config; empty if there is neither.
std::string desktop_settings_folder();

}  // namespace rink::view
