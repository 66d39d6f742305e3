// SPDX-License-Identifier: MIT
// The version field of our JSON formats. For the .cpp files of Files.
#pragma once
#include "Files/Json/JsonField.h"
#include <string>
#include <string_view>

namespace physvib {

/// Fails unless `root` is an object whose field `name` is a version from 1 to `newest`.
inline void checkVersion(const JsonField& root, std::string_view name, int newest) {
    root.expectObject();
    const JsonField field = root[name];
    const int version = field.wholeNumber();
    if (version < 1) field.fail("expected a version from 1 on, found " + std::to_string(version));
    if (version > newest)
        field.fail("made for a newer PhysVib: expected a version up to " + std::to_string(newest) +
                   ", found " + std::to_string(version));
}

} // namespace physvib
