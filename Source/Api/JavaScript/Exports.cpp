// SPDX-License-Identifier: MIT
// Exports of the WebAssembly module besides physvib.h: errors (JavaScript throws them), the text buffer, and
// the layout of the structures of physvib.h, which JavaScript writes into memory.
#include "Api/JavaScript/Exports.h"
#include "Api/C/physvib.h"
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <typeinfo>

namespace physvib::js {

extern "C" {
[[noreturn]] void fail(const char* message) __attribute__((import_module("physvib"), import_name("fail")));

// Throwing calls fail() instead, because this C++ library has no unwinder. All exceptions of this project are
// std::exceptions.
void* __cxa_allocate_exception(std::size_t bytes) noexcept { return std::malloc(bytes); }
[[noreturn]] void __cxa_throw(void* exception, std::type_info*, void (*)(void*)) {
    fail(static_cast<std::exception*>(exception)->what());
}
}

std::string& textBuffer() noexcept {
    static std::string buffer;
    return buffer;
}

void throwError(std::string_view message) {
    textBuffer() = message;
    fail(textBuffer().c_str());
}

namespace {

template <class T>
struct Element {
    using Type = T;
    static constexpr int count = 1;
};
template <class T, std::size_t N>
struct Element<T[N]> {
    using Type = T;
    static constexpr int count = static_cast<int>(N);
};

template <class T>
constexpr char kind = 's'; // a structure
template <>
constexpr char kind<double> = 'd';
template <>
constexpr char kind<int> = 'i';
template <>
constexpr char kind<std::size_t> = 'u';
template <>
constexpr char kind<physvib_int64> = 'l';

/// Four 32-bit numbers per member, as JavaScript reads them. The last entry describes the structure.
struct StructMember {
    const char* name; // in the last entry: the structure's name
    int offset;       // in the last entry: the structure's size
    int kind;         // in the last entry: 0
    int count;
};

#define MEMBER(structure, member)                                                                            \
    {#member, offsetof(structure, member), kind<Element<decltype(structure::member)>::Type>,                 \
     Element<decltype(structure::member)>::count},
#define END(structure) {#structure, sizeof(structure), 0, 0},
constexpr StructMember members[]{
#include "Members.inc"
    {nullptr, 0, 0, 0}};

} // namespace

extern "C" {

const StructMember* PHYSVIB_JS(members)() { return members; }

const char* PHYSVIB_JS(text)() { return textBuffer().data(); }
int PHYSVIB_JS(text_bytes)() { return static_cast<int>(textBuffer().size()); }
}

} // namespace physvib::js
