// SPDX-License-Identifier: MIT
// Words that explanations share.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib {

/// Three digits, with a point in every locale. Any thread.
std::string threeDigits(double value);

/// `1 event`, `2 events`. Any thread.
std::string counted(std::uint64_t count, std::string_view what);

/// Whose names an explanation uses: those of the C++ classes, or of scene files.
enum class Names { cpp, scene };

/// Replaces the names of physvib.h in an explanation. Languages with bindings do so themselves, by the names
/// of their bindings. Any thread.
std::string inNames(std::string sentence, Names names);

} // namespace physvib
