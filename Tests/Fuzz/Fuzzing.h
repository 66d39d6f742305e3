// SPDX-License-Identifier: MIT
// What every fuzz target demands of a parser.
#pragma once
#include "Io/Result.h"
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
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

/// A refusal is one clear line of reasonable length, and leaves nothing behind.
template <class T>
void demandClearRefusal(const Result<T>& read, bool isEmpty) {
    demand(isEmpty, "half-loaded", read.error);
    demand(read.error.starts_with("f:"), "does not begin with the file's name", read.error);
    demand(read.error.size() < 600, "too long a message", read.error);
    for (const char c : read.error)
        demand(static_cast<unsigned char>(c) >= 0x20, "more than one line", read.error);
}

/// What was read, written, read and written again is the same bytes.
template <class Read, class Write>
void demandRoundTrip(const std::string& written, Read read, Write write) {
    const auto again = read(written);
    demand(static_cast<bool>(again), "cannot read what was written", again.error + "\n" + written);
    const std::string twice = write(again.value);
    demand(twice == written, "written differently", written + "\n" + twice);
}

} // namespace physvib::fuzz
