// What most tests include of others' headers, parsed once for all of them.
#pragma once

#include "cmake/precompiled/standard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
