// SPDX-License-Identifier: MIT
// How every JSON text is read: within its limit, strictly, whole or not at all. For the .cpp files of Files.
#pragma once
#include "Files/Result.h"
#include "Files/Json/StrictJson.h"
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace physvib {

/// What `read` makes of the value that `text` spells, or one line that begins with `name`. `read` takes a Json& and
/// throws JsonError. Any thread.
template <class Read>
Result<std::invoke_result_t<Read, Json&>> readJson(std::string_view text, std::string_view name, std::size_t maxBytes, Read read) {
    try {
        if (text.size() > maxBytes)
            throw JsonError({}, "expected at most " + std::to_string(maxBytes) + " bytes, found more");
        Json root = parseStrictly(text);
        return read(root);
    } catch (const JsonError& error) {
        return Failure{std::string(name) + ": " + error.what()};
    }
}

} // namespace physvib
