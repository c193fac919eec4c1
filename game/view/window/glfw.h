// Includes GLFW without its OpenGL header, which conflicts with epoxy's.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
