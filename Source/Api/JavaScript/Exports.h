// SPDX-License-Identifier: MIT
// Names that JavaScript sees, and texts that it reads. One thread.
#pragma once
#include <string>
#include <string_view>

#define PHYSVIB_JS(name) __attribute__((export_name("js_" #name))) js_##name

namespace physvib::js {

/// The bytes that are read next, by js_text and js_text_bytes; all of them, with zeros inside.
std::string& text() noexcept;

/// Ends this instance: JavaScript throws, and nothing after it runs. It is thrown away then, as texts are
/// read in an instance of their own.
[[noreturn]] void refuse(std::string_view line);

} // namespace physvib::js
