// SPDX-License-Identifier: MIT
// Repeated fields and deep nesting are refused while the parser runs; places are counted as editors count them.
#include "Files/StrictJson.h"
#include "Files/FileLimits.h"
#include "Files/NumberText.h"
#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

template class nlohmann::basic_json<>;

namespace physvib {
namespace {

std::string toldPath(const std::string& path) {
    constexpr std::size_t end = 60;
    if (path.size() <= 2 * end + 3) return path;
    return path.substr(0, end) + "..." + path.substr(path.size() - end);
}

/// Follows the parser from value to value, and throws JsonError at a repeated field or too deep a nesting.
class JsonGuard {
public:
    bool operator()(Json::parse_event_t event, const Json& parsed) {
        using Event = Json::parse_event_t;
        if (event == Event::key) takeKey(parsed.get_ref<const std::string&>());
        if (event == Event::object_start || event == Event::array_start) open(event == Event::array_start);
        if (event == Event::object_end || event == Event::array_end) open_.pop_back();
        if (event == Event::value) nextPath();
        return true;
    }

private:
    struct Container {
        std::string path;
        bool isArray = false;
        std::size_t items = 0;
        std::string key;
        std::set<std::string> keys;
    };

    void takeKey(const std::string& key) {
        Container& object = open_.back();
        if (!object.keys.insert(key).second)
            throw JsonError(object.path, "field " + inQuotes(key) + " appears twice");
        object.key = key;
    }

    void open(bool isArray) {
        if (open_.size() == limits::maxJsonDepth)
            throw JsonError({}, "nested deeper than " + std::to_string(limits::maxJsonDepth) + " levels");
        open_.push_back({nextPath(), isArray, 0, {}, {}});
    }

    std::string nextPath() {
        if (open_.empty()) return {};
        Container& parent = open_.back();
        if (parent.isArray) return parent.path + "[" + std::to_string(parent.items++) + "]";
        const std::string name = printable(parent.key);
        return parent.path.empty() ? name : parent.path + "." + name;
    }

    std::vector<Container> open_;
};

/// "line 3, column 7" of the byte the parser stopped at, counted from 1.
std::string placeOf(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte == 0 ? 0 : std::min(byte - 1, text.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1; // npos + 1 is 0
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The parser's own words without its name, number and place, at most 120 characters.
std::string detailOf(const std::exception& error) {
    constexpr std::size_t longest = 120;
    std::string_view words = error.what();
    words.remove_prefix(std::min(words.find("] ") + 2, words.size()));
    if (words.starts_with("parse error")) words.remove_prefix(std::min(words.find(": ") + 2, words.size()));
    return std::string(words.substr(0, longest)) + (words.size() > longest ? "..." : "");
}

} // namespace

JsonError::JsonError(const std::string& path, const std::string& message)
    : std::runtime_error(path.empty() ? message : toldPath(path) + ": " + message) {}

Json parseStrictly(std::string_view text) {
    JsonGuard guard;
    try {
        return Json::parse(
            text, [&guard](int, Json::parse_event_t event, Json& parsed) { return guard(event, parsed); });
    } catch (const Json::parse_error& error) {
        throw JsonError(placeOf(text, error.byte), detailOf(error));
    } catch (const Json::exception& error) {
        throw JsonError({}, detailOf(error));
    }
}

} // namespace physvib
