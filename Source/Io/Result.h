// SPDX-License-Identifier: MIT
// Result of an operation that can fail: a value, or a one-line error message.
#pragma once
#include "Io/Text/CleanText.h"
#include <string>
#include <utility>

namespace physvib {

/// An error to be converted to a Result: one line naming file, place and expectation. Result escapes
/// unprintable characters.
struct Failure {
    std::string message;
};

/// Either `value` (and no error), or `error` and an empty `value`: never a partial value.
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
