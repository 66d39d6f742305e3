// SPDX-License-Identifier: MIT
// Typed access to a JSON value, with errors that name the path to it. For the .cpp files of Files.
#pragma once
#include "Files/StrictJson.h"
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {

/// A value and the path to it; whatever is asked of it and not there is thrown as JsonError.
class JsonField {
public:
    JsonField(const Json& value, std::string path)
        : value_(value)
        , path_(std::move(path)) {}

    [[noreturn]] void fail(const std::string& message) const { throw JsonError(path_, message); }

    void expectObject(std::initializer_list<std::string_view> known) const {
        if (!value_.is_object()) failType("an object");
        for (const auto& item : value_.items())
            if (std::ranges::find(known, item.key()) == known.end())
                fail("unknown field " + inQuotes(item.key()));
    }

    bool has(const char* key) const { return value_.contains(key); }

    JsonField operator[](const char* key) const {
        if (!has(key)) fail("field \"" + std::string(key) + "\" is missing");
        return {value_[key], path_.empty() ? key : path_ + "." + key};
    }

    std::size_t arraySize() const {
        if (!value_.is_array()) failType("an array");
        return value_.size();
    }

    JsonField item(std::size_t index) const {
        return {value_[index], path_ + "[" + std::to_string(index) + "]"};
    }

    double number() const {
        if (!value_.is_number()) failType("a number");
        return value_.get<double>();
    }

    double positiveNumber() const {
        const double found = number();
        if (!(found > 0.0)) fail("expected a number > 0, found " + value_.dump());
        return found;
    }

    double numberUpTo(double most) const {
        const double found = number();
        if (!(found >= 0.0 && found <= most))
            fail("expected a number from 0 to " + numberText(most) + ", found " + value_.dump());
        return found;
    }

    /// One line of at most limits::maxNameBytes.
    std::string text() const {
        if (!value_.is_string()) failType("a string");
        const auto& words = value_.get_ref<const std::string&>();
        if (words.size() > limits::maxNameBytes)
            fail("expected at most " + std::to_string(limits::maxNameBytes) + " bytes, found " +
                 std::to_string(words.size()));
        if (std::ranges::any_of(words, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
            fail("expected text without control characters, found " + inQuotes(words));
        return words;
    }

private:
    [[noreturn]] void failType(const std::string& expected) const {
        const std::string found = value_.type_name();
        const char* const article = value_.is_null() ? "" : value_.is_structured() ? "an " : "a ";
        fail("expected " + expected + ", found " + article + found);
    }

    const Json& value_;
    std::string path_;
};

} // namespace physvib
