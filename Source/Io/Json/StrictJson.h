// SPDX-License-Identifier: MIT
// JSON read strictly: no field twice, no deep nesting, and errors that name the field. For the .cpp files of
// Files.
#pragma once
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

// Compiled once, in StrictJson.cpp: in every file that reads or writes JSON it is most of the compiler's
// work.
extern template class nlohmann::basic_json<>;

namespace physvib {

using Json = nlohmann::json;

/// What is wrong with a JSON text, and where. Never leaves the rooms that read JSON.
struct JsonError : std::runtime_error {
    /// Of a long path the ends are told: the names in it are the file's.
    JsonError(const std::string& path, const std::string& message);
};

/// The value that `text` spells. Throws JsonError.
Json parseStrictly(std::string_view text);

} // namespace physvib
