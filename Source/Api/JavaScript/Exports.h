// SPDX-License-Identifier: MIT
// What the exports to JavaScript share: the prefix of their names, the text buffer, and errors. One thread.
#pragma once
#include <string>
#include <string_view>

#define PHYSVIB_JS(name) __attribute__((export_name("js_" #name))) js_##name

namespace physvib::js {

/// Buffer that JavaScript reads with js_text and js_text_bytes; it may contain zeros.
std::string& textBuffer() noexcept;

/// Aborts the current call: JavaScript throws, and discards this instance. Texts are therefore parsed in an
/// instance of their own.
[[noreturn]] void throwError(std::string_view message);

} // namespace physvib::js
