// SPDX-License-Identifier: MIT
// Type and range checks of JSON values, with their error messages.
#include "Io/Json/JsonField.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

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

int JsonField::wholeOf(double most) const {
    const double found = number();
    if (!(std::abs(found) <= most) || found != std::floor(found))
        fail("expected a whole number, found " + value_.dump());
    return static_cast<int>(found);
}

int JsonField::wholeNumber() const { return wholeOf(1.0e9); }

int JsonField::wholeWithin(int least, int most) const {
    const int found = wholeOf(std::numeric_limits<int>::max()); // as sounds and parts do
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

// Strict JSON parser on nlohmann's SAX interface: refuses repeated fields and deep nesting while parsing;
// positions are counted as in editors.

template class nlohmann::basic_json<>;

namespace physvib {
namespace {

std::string toldPath(const std::string& path) {
    constexpr std::size_t end = 60;
    if (path.size() <= 2 * end + 3) return path;
    return path.substr(0, end) + "..." + path.substr(path.size() - end);
}

/// "line 3, column 7" of the byte where the parser stopped, counted from 1.
std::string placeOf(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte == 0 ? 0 : std::min(byte - 1, text.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1; // npos + 1 is 0
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The parser's message without its number and position, at most 120 characters.
std::string detailOf(const std::exception& error) {
    constexpr std::size_t longest = 120;
    std::string_view words = error.what();
    words.remove_prefix(std::min(words.find("] ") + 2, words.size()));
    if (words.starts_with("parse error")) words.remove_prefix(std::min(words.find(": ") + 2, words.size()));
    return std::string(words.substr(0, longest)) + (words.size() > longest ? "..." : "");
}

/// Builds the value while the parser runs, and throws JsonError at a repeated field or too deep a nesting.
/// (The library's own builder scans a whole list after each object in it: minutes for a hundred thousand.)
class StrictBuilder final : public nlohmann::json_sax<Json> {
public:
    explicit StrictBuilder(std::string_view text)
        : text_{text} {}

    Json take() { return std::move(root_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; } // does not occur in text
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        Level& object = open_.back();
        const auto [field, isNew] = object.value->emplace(name, nullptr);
        if (!isNew) throw JsonError(path(), "field " + inQuotes(name) + " appears twice");
        object.field = &*field;
        object.name = std::move(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        const auto* const placed = dynamic_cast<const Json::parse_error*>(&error);
        throw JsonError(placed != nullptr ? placeOf(text_, placed->byte) : std::string{}, detailOf(error));
    }

private:
    /// An object or array that is still open.
    struct Level {
        Json* value;
        Json* field = nullptr; ///< of an object: the field that comes next, and its name
        std::string name{};
    };

    Json& place(Json value) {
        if (open_.empty()) return root_ = std::move(value);
        if (Level& parent = open_.back(); !parent.value->is_array()) return *parent.field = std::move(value);
        auto& list = open_.back().value->get_ref<Json::array_t&>();
        list.push_back(std::move(value));
        return list.back();
    }
    bool put(Json value) {
        place(std::move(value));
        return true;
    }
    bool open(Json container) {
        if (open_.size() == limits::maxJsonDepth)
            throw JsonError({}, "nested deeper than " + std::to_string(limits::maxJsonDepth) + " levels");
        open_.push_back({&place(std::move(container))});
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }
    /// Of the innermost container.
    std::string path() const {
        std::string words;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
            const Level& level = open_[i];
            if (level.value->is_array())
                words += "[" + std::to_string(level.value->size() - 1) + "]";
            else
                words.append(words.empty() ? "" : ".").append(printable(level.name));
        }
        return words;
    }

    std::string_view text_;
    Json root_;
    std::vector<Level> open_;
};

} // namespace

JsonError::JsonError(const std::string& path, const std::string& message)
    : std::runtime_error(path.empty() ? message : toldPath(path) + ": " + message) {}

namespace {

/// Each value or field has such a mark. In memory a value takes up to thirty times its bytes in the text.
void expectFewMarks(std::string_view text) {
    const std::size_t most = limits::maxJsonMarks + text.size() / limits::jsonBytesPerMark;
    const auto found = static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; }));
    if (found > most)
        throw JsonError({}, "expected at most " + std::to_string(most) +
                                " values and fields in so many bytes, found more");
}

} // namespace

Json parseStrictly(std::string_view text) {
    expectFewMarks(text);
    if (const auto nul = text.find('\0'); nul != std::string_view::npos) // for the parser, the end
        throw JsonError({}, "expected text, found a NUL after " + std::to_string(nul) + " bytes");
    StrictBuilder builder{text};
    Json::sax_parse(text, &builder);
    return builder.take();
}

} // namespace physvib
