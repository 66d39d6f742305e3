// SPDX-License-Identifier: MIT
// Strict JSON parsing: no repeated fields, no deep nesting, and errors that name the field. For .cpp files
// that read JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

// Instantiated once, in StrictJson.cpp, because it dominates the compile time of every file that uses it.
extern template class nlohmann::basic_json<>;

namespace physvib {

using Json = nlohmann::json;

/// An error in a JSON text and its place. Not thrown out of the modules that read JSON.
struct JsonError : std::runtime_error {
    /// Long paths are shortened to their ends, because their names come from the file.
    JsonError(const std::string& path, const std::string& message);
};

/// The parsed value. Throws JsonError.
Json parseStrictly(std::string_view text);

} // namespace physvib
