// What a federation may be told as its scheme, for those who know the RTI alone: names,
// expressions, and how they are written.
#pragma once

#include "im/expression_fault.h"
#include "im/filter.h"
#include "im/usage.h"
