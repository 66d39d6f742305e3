// SPDX-License-Identifier: MIT
// What every call has in common: no exception gets out, and what was wrong is said in one line.
#pragma once
#include "Api/C/physvib.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>

namespace physvib::api {

/// Of this thread; see physvib_error().
inline std::array<char, 640>& lastError() noexcept {
    thread_local std::array<char, 640> line{};
    return line;
}

/// Any thread but R.
inline int fail(int code, std::string_view line) noexcept {
    auto& kept = lastError();
    const std::size_t length = std::min(line.size(), kept.size() - 1);
    std::copy_n(line.data(), length, kept.data());
    kept[length] = '\0';
    return code;
}

inline int unknownHandle() noexcept {
    return fail(PHYSVIB_ERROR_HANDLE, "handle: expected one of this kind that has not been freed");
}
inline int nothingThere(std::string_view line) noexcept { return fail(PHYSVIB_ERROR_ARGUMENT, line); }

/// Of a call that says "": fine.
inline int resultOf(std::string_view fault, int code = PHYSVIB_ERROR_ARGUMENT) noexcept {
    return fault.empty() ? PHYSVIB_OK : fail(code, fault);
}

/// What `call` returns, a code or a count; of an exception, a code.
template <class Call>
auto guarded(Call call) noexcept -> decltype(call()) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return fail(PHYSVIB_ERROR_MEMORY, "memory: expected more of it");
    } catch (const std::length_error&) {
        return fail(PHYSVIB_ERROR_MEMORY, "memory: expected more of it");
    } catch (const std::invalid_argument& wrong) {
        return fail(PHYSVIB_ERROR_ARGUMENT, wrong.what());
    } catch (const std::exception& wrong) {
        return fail(PHYSVIB_ERROR_INTERNAL, wrong.what());
    } catch (...) {
        return fail(PHYSVIB_ERROR_INTERNAL, "unknown");
    }
}

/// Also between its members, which other languages may see.
template <class Struct>
Struct zeroed() noexcept {
    Struct values;
    std::memset(&values, 0, sizeof values);
    return values;
}

/// `values`, as far as the caller's version of the structure goes.
template <class Struct>
int begin(Struct* filled, std::size_t size, const Struct& values) noexcept {
    if (filled == nullptr) return nothingThere("structure: expected one, found NULL");
    if (size < sizeof size || size > sizeof values)
        return nothingThere("structure: expected its size, and a library that is as new as the header");
    std::memcpy(filled, &values, size);
    filled->size = size;
    return PHYSVIB_OK;
}

/// A structure of the caller's as this version knows it: what an older one lacks is as init has it. False,
/// and said, if it is none.
template <class Struct>
bool take(const Struct* from, Struct& to, int (*init)(Struct*, std::size_t)) noexcept {
    init(&to, sizeof to);
    if (from == nullptr) return nothingThere("structure: expected one, found NULL"), false;
    std::size_t size = 0;
    std::memcpy(&size, from, sizeof size);
    if (size < sizeof size || size > sizeof to)
        return nothingThere("structure: expected one that its _init has filled"), false;
    std::memcpy(&to, from, size);
    to.size = sizeof to;
    return true;
}

} // namespace physvib::api
