// SPDX-License-Identifier: MIT
// What every fuzz target demands of a parser.
#pragma once
#include "Io/Result.h"
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace physvib::fuzz {

inline void demand(bool isTrue, const char* what, const std::string& text = {}) {
    if (isTrue) return;
    std::fprintf(stderr, "fuzz: %s\n%s\n", what, text.c_str());
    std::abort();
}

inline std::string_view asText(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// One line of reasonable length.
inline void demandLine(const std::string& text) {
    demand(text.size() < 600, "too long a message", text);
    for (const char c : text) demand(static_cast<unsigned char>(c) >= 0x20, "more than one line", text);
}

/// A refusal is one clear line of reasonable length, and leaves nothing behind.
template <class T>
void demandClearRefusal(const Result<T>& read, bool isEmpty) {
    demand(isEmpty, "half-loaded", read.error);
    demand(read.error.starts_with("f:"), "does not begin with the file's name", read.error);
    demandLine(read.error);
}

constexpr auto isDefault = []<class Value>(const Value& value) { return value == Value{}; };

/// The value, if the input is read as one; written, read and written again it is the same bytes. What is
/// refused leaves an empty one.
template <class Read, class Write, class IsEmpty = decltype(isDefault)>
auto tried(const std::uint8_t* data, std::size_t size, Read read, Write write, IsEmpty isEmpty = isDefault) {
    const auto first = read(asText(data, size), "f");
    auto kept = std::optional{first.value};
    if (!first) {
        demandClearRefusal(first, isEmpty(first.value));
        kept.reset();
        return kept;
    }
    const std::string written = write(first.value);
    const auto again = read(written, "f");
    demand(static_cast<bool>(again), "cannot read what was written", again.error + "\n" + written);
    const std::string twice = write(again.value);
    demand(twice == written, "written differently", written + "\n" + twice);
    return kept;
}

} // namespace physvib::fuzz
