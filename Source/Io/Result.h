// SPDX-License-Identifier: MIT
// What reading a file gives: a value, or one line that says what is wrong with the file.
#pragma once
#include "Io/Text/CleanText.h"
#include <string>
#include <utility>

namespace physvib {

/// An error on its way into a Result: one line naming file, place and what was expected; names as they are,
/// Result cleans.
struct Failure {
    std::string message;
};

/// Either `value` (and no error), or `error` and an empty `value`: nothing is ever half-loaded.
template <class T>
struct Result {
    Result(T loaded)
        : value(std::move(loaded)) {}
    Result(Failure failure)
        : error(cleanLine(failure.message)) {}
    explicit operator bool() const noexcept { return error.empty(); }

    T value{};
    std::string error;
};

} // namespace physvib
