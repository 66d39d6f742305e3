// SPDX-License-Identifier: MIT
// Type and range checks of JSON values, with their error messages.
#include "Io/Json/JsonField.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>

namespace physvib {

void JsonField::fail(const std::string& message) const { throw JsonError(path_, message); }

void JsonField::failType(const std::string& expected) const {
    const std::string found = value_.type_name();
    const char* const article = value_.is_null() ? "" : value_.is_structured() ? "an " : "a ";
    fail("expected " + expected + ", found " + article + found);
}

void JsonField::expectObject() const {
    if (!value_.is_object()) failType("an object");
}

void JsonField::expectObject(std::initializer_list<std::string_view> known) const {
    expectObject();
    expectOnly({known.begin(), known.size()});
}

void JsonField::expectOnly(std::span<const std::string_view> known) const {
    for (const auto& item : value_.items())
        if (std::ranges::find(known, item.key()) == known.end())
            fail("unknown field " + inQuotes(item.key()));
}

bool JsonField::has(std::string_view key) const { return value_.contains(key); }

JsonField JsonField::operator[](std::string_view key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) fail("field " + inQuotes(key) + " is missing");
    return {*found, (path_.empty() ? path_ : path_ + ".") + std::string(key)};
}

std::size_t JsonField::arraySize() const {
    if (!value_.is_array()) failType("an array");
    return value_.size();
}

JsonField JsonField::item(std::size_t index) const {
    return {value_[index], path_ + "[" + std::to_string(index) + "]"};
}

double JsonField::number() const {
    if (!value_.is_number()) failType("a number");
    return value_.get<double>();
}

double JsonField::positiveNumber() const {
    const double found = number();
    if (!(found > 0.0)) fail("expected a number > 0, found " + value_.dump());
    return found;
}

double JsonField::numberUpTo(double most) const {
    const double found = number();
    if (!(found >= 0.0 && found <= most))
        fail("expected a number from 0 to " + numberText(most) + ", found " + value_.dump());
    return found;
}

double JsonField::numberWithin(double least, double most) const {
    const double found = number();
    if (!(found >= least && found <= most))
        fail("expected " + numberText(least) + " to " + numberText(most) + ", found " + numberText(found));
    return found;
}

int JsonField::wholeNumber() const {
    const double found = number();
    if (!(std::abs(found) <= 1.0e9) || found != std::floor(found))
        fail("expected a whole number, found " + value_.dump());
    return static_cast<int>(found);
}

int JsonField::wholeWithin(int least, int most) const {
    const int found = wholeNumber();
    if (found < least || found > most)
        fail("expected " + std::to_string(least) + " to " + std::to_string(most) + ", found " +
             std::to_string(found));
    return found;
}

bool JsonField::truth() const {
    if (!value_.is_boolean()) failType("true or false");
    return value_.get<bool>();
}

std::string JsonField::text(std::size_t mostBytes) const {
    if (!value_.is_string()) failType("a string");
    const auto& words = value_.get_ref<const std::string&>();
    if (words.size() > mostBytes)
        fail("expected at most " + std::to_string(mostBytes) + " bytes, found " +
             std::to_string(words.size()));
    if (std::ranges::any_of(words, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
        fail("expected text without control characters, found " + inQuotes(words));
    return words;
}

std::string JsonField::line() const {
    if (!value_.is_string()) failType("a string");
    return cleanLine(value_.get_ref<const std::string&>().substr(0, limits::maxNameBytes));
}

std::size_t JsonField::oneOf(std::span<const std::string_view> names) const {
    const std::string word = text();
    const auto found = std::ranges::find(names, std::string_view(word));
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    fail("expected one of " + listed(names) + ", found " + inQuotes(word));
}

std::vector<std::string> JsonField::names() const {
    expectObject();
    std::vector<std::string> names;
    for (const auto& item : value_.items()) names.push_back(item.key());
    return names;
}

bool JsonField::is(std::string_view word) const {
    return value_.is_string() && value_.get_ref<const std::string&>() == word;
}

} // namespace physvib
