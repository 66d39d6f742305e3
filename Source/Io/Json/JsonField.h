// SPDX-License-Identifier: MIT
// Strict parser of JSON, and typed access to its values with errors that name a value's path.
#pragma once
#include "Io/Disk/ReadFile.h"
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Instantiated once, in JsonField.cpp, because it dominates compile times. Include this in .cpp files only.
extern template class nlohmann::basic_json<>;

namespace physvib {

using Json = nlohmann::json;

/// An error in a JSON text and its place. Not thrown out of the modules that read JSON.
struct JsonError : std::runtime_error {
    /// Long paths are shortened to their ends, because their names come from the file.
    JsonError(const std::string& path, const std::string& message);
};

/// The parsed value; repeated fields and deep nesting are errors. Throws JsonError.
Json parseStrictly(std::string_view text);

/// A value and its path, such as bodies[3].name. Missing and wrong values throw JsonError with the path.
class JsonField {
public:
    JsonField(const Json& value, std::string path)
        : value_(value)
        , path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    [[noreturn]] void fail(const std::string& message) const;

    void expectObject() const;
    void expectObject(std::initializer_list<std::string_view> allowed) const;
    void expectOnly(std::span<const std::string_view> allowed) const;

    bool has(std::string_view key) const;
    std::vector<std::string> names() const; ///< of an object's fields
    JsonField operator[](std::string_view key) const;
    std::size_t arraySize() const;
    JsonField item(std::size_t index) const;

    double number() const;
    double positiveNumber() const;
    double numberUpTo(double max) const; ///< from 0
    double numberWithin(double min, double max) const;
    int wholeNumber() const; ///< -1e9 to 1e9
    int wholeNumberWithin(int min, int max) const;
    bool boolean() const;
    /// A string of at most `maxBytes` bytes without control characters.
    std::string text(std::size_t maxBytes = limits::maxNameBytes) const;
    /// Any string, cut and escaped to one displayable line; for titles in imported files.
    std::string line() const;
    /// Index of this string in `names`; an error if it is not one of them.
    std::size_t oneOf(std::span<const std::string_view> names) const;
    /// The value as JSON text on one line.
    std::string jsonText() const { return value_.dump(-1, ' ', false, Json::error_handler_t::replace); }
    bool isNull() const { return value_.is_null(); }
    bool isText() const { return value_.is_string(); }
    bool isNumber() const { return value_.is_number(); }
    bool isArray() const { return value_.is_array(); }
    bool equals(std::string_view word) const; ///< true if the value is this string

private:
    int wholeNumberUpTo(double max) const;
    [[noreturn]] void failWrongType(const std::string& expected) const;

    const Json& value_;
    std::string path_;
};
} // namespace physvib
