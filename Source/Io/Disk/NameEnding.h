// SPDX-License-Identifier: MIT
// Checks the file name ending of an output, with a common error message.
#pragma once
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// Empty, or `expected a name that ends in .webp, .gif or .mp4, found "a.avi"`. Any thread (allocates).
inline std::string endingFault(std::string_view path, std::span<const std::string_view> endings) {
    const auto has = [path](std::string_view ending) { return path.ends_with(ending); };
    if (std::ranges::any_of(endings, has)) return {};
    return "expected a name that ends in " + listed(endings, " or ") + ", found " + inQuotes(path);
}
inline std::string endingFault(std::string_view path, std::initializer_list<std::string_view> endings) {
    return endingFault(path, std::span{endings.begin(), endings.size()});
}

} // namespace physvib
