// SPDX-License-Identifier: MIT
// Checks that no two items of a list have the same name.
#pragma once
#include "Scene/SceneRanges.h"
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Empty, or one line that names the second item of that name. Any thread.
template <class T>
std::string checkUnique(const std::string& list, const std::vector<T>& all) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!names.insert(all[i].name).second)
            return detail::itemPath(list, i) + ".name: expected a name of its own, found \"" + all[i].name +
                   "\" again";
    return {};
}

} // namespace physvib
