// SPDX-License-Identifier: MIT
// Included before Box2D's joints: removes their b2Dump output, whose texts would enlarge the module.
#pragma once
#include <box2d/b2_common.h>

#define b2Dump(...) static_cast<void>(0)
