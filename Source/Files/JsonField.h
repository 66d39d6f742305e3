// SPDX-License-Identifier: MIT
// Typed access to a JSON value, with errors that name the path to it. For the .cpp files of Files.
#pragma once
#include "Files/StrictJson.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
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

    const std::string& path() const { return path_; }

    [[noreturn]] void fail(const std::string& message) const { throw JsonError(path_, message); }

    void expectObject(std::initializer_list<std::string_view> known) const {
        expectObject();
        expectOnly({known.begin(), known.size()});
    }

    void expectObject() const {
        if (!value_.is_object()) failType("an object");
    }

    void expectOnly(std::span<const std::string_view> known) const {
        for (const auto& item : value_.items())
            if (std::ranges::find(known, item.key()) == known.end())
                fail("unknown field " + inQuotes(item.key()));
    }

    bool has(std::string_view key) const { return value_.contains(key); }

    JsonField operator[](std::string_view key) const {
        const auto found = value_.find(key);
        if (found == value_.end()) fail("field " + inQuotes(key) + " is missing");
        return {*found, (path_.empty() ? path_ : path_ + ".") + std::string(key)};
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

    int wholeNumber() const {
        const double found = number();
        if (!(std::abs(found) <= 1.0e9) || found != std::floor(found))
            fail("expected a whole number, found " + value_.dump());
        return static_cast<int>(found);
    }

    bool truth() const {
        if (!value_.is_boolean()) failType("true or false");
        return value_.get<bool>();
    }

    /// Index of the word it is among `names`.
    std::size_t oneOf(std::span<const std::string_view> names) const {
        const std::string word = text();
        const auto found = std::ranges::find(names, std::string_view(word));
        if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
        std::string list;
        for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
        fail("expected one of " + list + ", found " + inQuotes(word));
    }

    bool is(std::string_view word) const { return value_ == word; }

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
