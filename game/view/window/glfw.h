// GLFW without the OpenGL header that it would bring along, which does not go with epoxy's.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
