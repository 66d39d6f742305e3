// SPDX-License-Identifier: MIT
// The user's own, of the same name as one of ours.
#pragma once

namespace user {
constexpr int outputs = 2;
}
