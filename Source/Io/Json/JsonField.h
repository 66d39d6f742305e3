// SPDX-License-Identifier: MIT
// Typed access to a JSON value, with errors that name its path. For .cpp files that read JSON.
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

// Strict JSON parsing: no repeated fields, no deep nesting, and errors that name the field. For .cpp files.

// Instantiated once, in JsonField.cpp, because it dominates the compile time of every file that uses it.
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

/// A value and its path. Missing or wrong values are thrown as JsonError.
class JsonField {
public:
    JsonField(const Json& value, std::string path)
        : value_(value)
        , path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    [[noreturn]] void fail(const std::string& message) const;

    void expectObject() const;
    void expectObject(std::initializer_list<std::string_view> known) const;
    void expectOnly(std::span<const std::string_view> known) const;

    bool has(std::string_view key) const;
    std::vector<std::string> names() const; ///< of an object's fields
    JsonField operator[](std::string_view key) const;
    std::size_t arraySize() const;
    JsonField item(std::size_t index) const;

    double number() const;
    double positiveNumber() const;
    double numberUpTo(double most) const; ///< from 0
    double numberWithin(double least, double most) const;
    int wholeNumber() const; ///< within 1e9
    int wholeWithin(int least, int most) const;
    bool truth() const;
    /// One line of at most `mostBytes` bytes.
    std::string text(std::size_t mostBytes = limits::maxNameBytes) const;
    /// Any text made displayable as one line; for titles in imported files.
    std::string line() const;
    /// Its index in `names`.
    std::size_t oneOf(std::span<const std::string_view> names) const;
    /// The value as a file of its own.
    std::string fileText() const { return value_.dump(-1, ' ', false, Json::error_handler_t::replace); }
    bool isNull() const { return value_.is_null(); }
    bool isText() const { return value_.is_string(); }
    bool isNumber() const { return value_.is_number(); }
    bool isArray() const { return value_.is_array(); }
    bool is(std::string_view word) const;

private:
    int wholeOf(double most) const;
    [[noreturn]] void failType(const std::string& expected) const;

    const Json& value_;
    std::string path_;
};
} // namespace physvib
