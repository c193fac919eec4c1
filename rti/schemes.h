// Names of filters and the syntax of their expressions, for users of the RTI that do not include
// im/.
#pragma once

#include "im/expression_fault.h"
#include "im/filter.h"
#include "im/usage.h"
