// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of outputs.
#include "Host/OutputMap.h"
#include <algorithm>
#include <numeric>

namespace physvib {

std::string OutputMap::want(int enchanters, const std::vector<int>& wanted) {
    wanted_.assign(static_cast<std::size_t>(enchanters), -1);
    at_.fill(-1);
    if (wanted.empty()) std::iota(wanted_.begin(), wanted_.end(), 0);
    else std::copy_n(wanted.begin(), std::min(wanted.size(), wanted_.size()), wanted_.begin());
    for (std::size_t j = 0; j < wanted_.size(); ++j)
        if (wanted_[j] >= 0 && std::count(wanted_.begin(), wanted_.end(), wanted_[j]) > 1)
            return "output " + std::to_string(wanted_[j] + 1) + " is given to two enchanters; expected one each";
    return {};
}

juce::BigInteger OutputMap::outputs(int offered) const {
    juce::BigInteger set;
    for (const int output : wanted_)
        if (output >= 0 && output < offered) set.setBit(output);
    return set;
}

void OutputMap::place(const juce::BigInteger& active) {
    const auto packed = [&](int output) {
        if (output < 0 || !active[output]) return -1;
        int before = 0;
        for (int k = 0; k < output; ++k) before += active[k] ? 1 : 0;
        return before;
    };
    std::transform(wanted_.begin(), wanted_.end(), at_.begin(), packed);
}

int OutputMap::unfelt() const noexcept {
    return static_cast<int>(std::count(at_.begin(), at_.begin() + enchanters(), -1));
}

} // namespace physvib
