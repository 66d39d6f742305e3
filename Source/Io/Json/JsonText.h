// SPDX-License-Identifier: MIT
// Reads JSON texts with a size limit, checks the version of PhysVib's own files, and formats JSON readably.
// Included by .cpp files only.
#pragma once
#include "Io/Json/JsonField.h"
#include "Io/Result.h"
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

namespace physvib {
/// The result of `read` for the parsed value, or a one-line error that begins with `name`. `read` takes a
/// Json& and throws JsonError.
template <class Read>
Result<std::invoke_result_t<Read, Json&>> readJson(std::string_view text, std::string_view name,
                                                   std::size_t maxBytes, Read read) {
    try {
        if (text.size() > maxBytes)
            throw JsonError({}, "expected at most " + std::to_string(maxBytes) + " bytes, found more");
        Json root = parseStrictly(text);
        return read(root);
    } catch (const JsonError& error) {
        return Failure{std::string(name) + ": " + error.what()};
    }
}

/// Throws JsonError unless `root` is an object whose field `name` is a version from 1 to `newest`.
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

extern template class nlohmann::basic_json<nlohmann::ordered_map>; // compiled once, in JsonText.cpp

namespace physvib {

using OrderedJson = nlohmann::ordered_json; // fields stay in the order they were added

/// The shortest text that reads back as the same bits; "-0.0", because "-0" reads as an integer.
std::string jsonNumber(double number);

/// The value on one line, without a newline.
std::string compactJson(const OrderedJson& value);

/// The value over several lines of up to 140 characters, longer only for long strings. Ends in a newline.
std::string prettyJson(const OrderedJson& value);

} // namespace physvib
