// SPDX-License-Identifier: MIT
// Checks type and range of JSON values, with error messages; and the strict parser, on nlohmann's SAX
// interface, which refuses repeated fields and deep nesting while it parses.
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

void JsonField::failWrongType(const std::string& expected) const {
    const std::string found = value_.type_name();
    const char* const article = value_.is_null() ? "" : value_.is_structured() ? "an " : "a ";
    fail("expected " + expected + ", found " + article + found);
}

void JsonField::expectObject() const {
    if (!value_.is_object()) failWrongType("an object");
}

void JsonField::expectObject(std::initializer_list<std::string_view> allowed) const {
    expectObject();
    expectOnly({allowed.begin(), allowed.size()});
}

void JsonField::expectOnly(std::span<const std::string_view> allowed) const {
    for (const auto& item : value_.items())
        if (std::ranges::find(allowed, item.key()) == allowed.end())
            fail("unknown field " + inQuotes(item.key()));
}

bool JsonField::has(std::string_view key) const { return value_.contains(key); }

JsonField JsonField::operator[](std::string_view key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) fail("field " + inQuotes(key) + " is missing");
    return {*found, (path_.empty() ? path_ : path_ + ".") + std::string(key)};
}

std::size_t JsonField::arraySize() const {
    if (!value_.is_array()) failWrongType("an array");
    return value_.size();
}

JsonField JsonField::item(std::size_t index) const {
    return {value_[index], path_ + "[" + std::to_string(index) + "]"};
}

double JsonField::number() const {
    if (!value_.is_number()) failWrongType("a number");
    return value_.get<double>();
}

double JsonField::positiveNumber() const {
    const double found = number();
    if (!(found > 0.0)) fail("expected a number > 0, found " + value_.dump());
    return found;
}

double JsonField::numberUpTo(double max) const {
    const double found = number();
    if (!(found >= 0.0 && found <= max))
        fail("expected a number from 0 to " + numberText(max) + ", found " + value_.dump());
    return found;
}

double JsonField::numberWithin(double min, double max) const {
    const double found = number();
    if (!(found >= min && found <= max))
        fail("expected " + numberText(min) + " to " + numberText(max) + ", found " + numberText(found));
    return found;
}

int JsonField::wholeNumberUpTo(double max) const {
    const double found = number();
    if (!(std::abs(found) <= max) || found != std::floor(found))
        fail("expected a whole number, found " + value_.dump());
    return static_cast<int>(found);
}

int JsonField::wholeNumber() const { return wholeNumberUpTo(1.0e9); }

int JsonField::wholeNumberWithin(int min, int max) const {
    const int found = wholeNumberUpTo(std::numeric_limits<int>::max()); // numbers of sounds and parts use all
                                                                        // of it
    if (found < min || found > max)
        fail("expected " + std::to_string(min) + " to " + std::to_string(max) + ", found " +
             std::to_string(found));
    return found;
}

bool JsonField::boolean() const {
    if (!value_.is_boolean()) failWrongType("true or false");
    return value_.get<bool>();
}

std::string JsonField::text(std::size_t maxBytes) const {
    if (!value_.is_string()) failWrongType("a string");
    const auto& string = value_.get_ref<const std::string&>();
    if (string.size() > maxBytes)
        fail("expected at most " + std::to_string(maxBytes) + " bytes, found " +
             std::to_string(string.size()));
    if (std::ranges::any_of(string, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
        fail("expected text without control characters, found " + inQuotes(string));
    return string;
}

std::string JsonField::line() const {
    if (!value_.is_string()) failWrongType("a string");
    return cleanLine(value_.get_ref<const std::string&>().substr(0, limits::maxNameBytes));
}

std::size_t JsonField::oneOf(std::span<const std::string_view> names) const {
    const std::string word = text();
    const auto found = std::ranges::find(names, std::string_view(word));
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    fail("expected one of " + nameList(names) + ", found " + inQuotes(word));
}

std::vector<std::string> JsonField::names() const {
    expectObject();
    std::vector<std::string> names;
    for (const auto& item : value_.items()) names.push_back(item.key());
    return names;
}

bool JsonField::equals(std::string_view word) const {
    return value_.is_string() && value_.get_ref<const std::string&>() == word;
}
} // namespace physvib

template class nlohmann::basic_json<>; // compiled here only, because it takes long

namespace physvib {
namespace {

std::string shortenedPath(const std::string& path) {
    constexpr std::size_t endLength = 60;
    if (path.size() <= 2 * endLength + 3) return path;
    return path.substr(0, endLength) + "..." + path.substr(path.size() - endLength);
}

/// "line 3, column 7" of byte number `byte` (from 1), where the parser stopped; counted as in editors.
std::string positionText(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte == 0 ? 0 : std::min(byte - 1, text.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1; // rfind() without a result,
                                                                             // npos, plus 1 is 0
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The parser's message without its number and position, at most 120 characters.
std::string shortMessage(const std::exception& error) {
    constexpr std::size_t maxLength = 120;
    std::string_view message = error.what();
    message.remove_prefix(std::min(message.find("] ") + 2, message.size()));
    if (message.starts_with("parse error"))
        message.remove_prefix(std::min(message.find(": ") + 2, message.size()));
    return std::string(message.substr(0, maxLength)) + (message.size() > maxLength ? "..." : "");
}

/// Builds the value while the parser runs, and throws JsonError at a repeated field or too deep a nesting.
/// (The library's own builder scans a whole list after each object in it: minutes for a hundred thousand.)
class StrictBuilder final : public nlohmann::json_sax<Json> {
public:
    explicit StrictBuilder(std::string_view text)
        : text_{text} {}

    Json result() { return std::move(root_); }

    bool null() override { return addValue(nullptr); }
    bool boolean(bool value) override { return addValue(value); }
    bool number_integer(number_integer_t value) override { return addValue(value); }
    bool number_unsigned(number_unsigned_t value) override { return addValue(value); }
    bool number_float(number_float_t value, const string_t&) override { return addValue(value); }
    bool string(string_t& value) override { return addValue(std::move(value)); }
    bool binary(binary_t&) override { return false; } // does not occur in text
    bool start_object(std::size_t) override { return openContainer(Json::object()); }
    bool start_array(std::size_t) override { return openContainer(Json::array()); }
    bool end_object() override { return closeContainer(); }
    bool end_array() override { return closeContainer(); }
    bool key(string_t& name) override {
        Level& object = levels_.back();
        const auto [field, isNew] = object.value->emplace(name, nullptr);
        if (!isNew) throw JsonError(path(), "field " + inQuotes(name) + " appears twice");
        object.field = &*field;
        object.name = std::move(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        const auto* const parseError = dynamic_cast<const Json::parse_error*>(&error);
        throw JsonError(parseError != nullptr ? positionText(text_, parseError->byte) : std::string{},
                        shortMessage(error));
    }

private:
    /// An object or array that is still open.
    struct Level {
        Json* value;
        Json* field = nullptr; ///< of an object: the field whose value is read next, and its name
        std::string name{};
    };

    Json& insert(Json value) {
        if (levels_.empty()) return root_ = std::move(value);
        if (Level& parent = levels_.back(); !parent.value->is_array())
            return *parent.field = std::move(value);
        auto& list = levels_.back().value->get_ref<Json::array_t&>();
        list.push_back(std::move(value));
        return list.back();
    }
    bool addValue(Json value) {
        insert(std::move(value));
        return true;
    }
    bool openContainer(Json container) {
        if (levels_.size() == limits::maxJsonDepth)
            throw JsonError({}, "nested deeper than " + std::to_string(limits::maxJsonDepth) + " levels");
        levels_.push_back({&insert(std::move(container))});
        return true;
    }
    bool closeContainer() {
        levels_.pop_back();
        return true;
    }
    /// Path of the innermost open container.
    std::string path() const {
        std::string text;
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
            const Level& level = levels_[i];
            if (level.value->is_array())
                text += "[" + std::to_string(level.value->size() - 1) + "]";
            else
                text.append(text.empty() ? "" : ".").append(printable(level.name));
        }
        return text;
    }

    std::string_view text_;
    Json root_;
    std::vector<Level> levels_;
};

} // namespace

JsonError::JsonError(const std::string& path, const std::string& message)
    : std::runtime_error(path.empty() ? message : shortenedPath(path) + ": " + message) {}

namespace {

/// Limits the number of values: in memory one takes up to thirty times its bytes in the text.
void checkMarkCount(std::string_view text) {
    const std::size_t max = limits::maxJsonMarks + text.size() / limits::jsonBytesPerMark;
    const auto found = static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; }));
    if (found > max)
        throw JsonError({}, "expected at most " + std::to_string(max) +
                                " values and fields in so many bytes, found more");
}

} // namespace

Json parseStrictly(std::string_view text) {
    checkMarkCount(text);
    if (const auto nul = text.find('\0'); nul != std::string_view::npos) // the parser would end there
        throw JsonError({}, "expected text, found a NUL after " + std::to_string(nul) + " bytes");
    StrictBuilder builder{text};
    Json::sax_parse(text, &builder);
    return builder.result();
}

} // namespace physvib
