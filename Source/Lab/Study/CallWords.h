// SPDX-License-Identifier: MIT
// Validates the `physvib` calls in a protocol. Protocols are untrusted files. Their calls are run, and also
// stand in every row of the trial file, where users copy them into a shell. So a call may only render and
// read files below its folder. The options that write files are listed in Standalone/Calls/CallFiles.h.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

namespace physvib {

constexpr std::size_t mostCallBytes = 2000; // including recordings; a row of the trial file holds the calls
                                            // of all parts of a trial

/// Letters (including non-ASCII), digits, and characters that a shell does not interpret.
constexpr bool isPlainCharacter(char c) noexcept {
    const bool isLetter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    return isLetter || (c >= '0' && c <= '9') ||
           std::string_view{"_-+.,:=/%"}.find(c) != std::string_view::npos;
}

/// True for a relative path that stays below its starting folder and has only plain characters and spaces.
/// Names that are not paths pass too. Any thread.
constexpr bool isPlainPath(std::string_view path) noexcept {
    if (path.starts_with('/') ||
        !std::ranges::all_of(path, [](char c) { return c == ' ' || isPlainCharacter(c); }))
        return false;
    for (;;) {
        const std::size_t end = path.find('/');
        if (path.substr(0, end) == "..") return false;
        if (end == std::string_view::npos) return true;
        path.remove_prefix(end + 1);
    }
}

/// Empty, or the reason why a protocol may not make this call (with all names filled in), from its characters
/// and paths. Any thread (allocates).
inline std::string callFault(std::string_view call) {
    if (!call.starts_with("render ") && !call.starts_with("stimulus "))
        return "expected render or stimulus, and what they take";
    if (const auto unknown = call.find('{'); unknown != std::string_view::npos)
        return "expected names of factors or variables in braces, or alternative, object, level_db; found " +
               std::string(call.substr(unknown, call.find('}', unknown) - unknown)) + "}";
    if (!std::ranges::all_of(call, [](char c) { return c == ' ' || isPlainCharacter(c); }))
        return "expected letters, digits, spaces and _-+.,:=/%";
    while (!call.empty()) {
        const std::string_view word = call.substr(0, call.find(' '));
        call.remove_prefix(std::min(word.size() + 1, call.size()));
        for (std::string_view rest = word; !rest.empty();) { // splits words like 80=ball.wav
            const std::string_view piece = rest.substr(0, rest.find_first_of("=,:"));
            rest.remove_prefix(std::min(piece.size() + 1, rest.size()));
            if (!isPlainPath(piece))
                return "expected files in the folder or below, found " + std::string(word);
        }
    }
    return {};
}

} // namespace physvib
