// SPDX-License-Identifier: MIT
// Result of an operation that can fail: a value, or a one-line error message.
#pragma once
#include "Io/Text/CleanText.h"
#include <string>
#include <utility>

namespace physvib {

/// An error to be converted to a Result: one line naming file, place and expectation.
struct Failure {
    std::string message;
};

/// Either `value` with an empty `error`, or `error` with a default `value`.
template <class T>
struct Result {
    Result(T result)
        : value(std::move(result)) {}
    Result(Failure failure)
        : error(cleanLine(failure.message)) {}
    explicit operator bool() const noexcept { return error.empty(); }

    T value{};
    std::string error;
};

} // namespace physvib
