// The name by which im and the RTI know im/basics/checked.h.
#pragma once

#include "im/basics/checked.h"
