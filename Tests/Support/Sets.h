// SPDX-License-Identifier: MIT
// The instruction sets that a test is run on: those this processor has; the others are named once.
#pragma once
#include "Core/Modes/InstructionSet.h"
#include <gtest/gtest.h>
#include <iostream>
#include <ostream>
#include <string>
#include <vector>

namespace physvib {

inline void PrintTo(InstructionSet set, std::ostream* out) { *out << nameOf(set); }

namespace test {

/// Every set but `best`, in order; those that cannot be run here are left out and named on the first call.
inline const std::vector<InstructionSet>& runnableSets() {
    static const std::vector<InstructionSet> sets = [] {
        std::vector<InstructionSet> here;
        for (const auto set : {InstructionSet::scalar, InstructionSet::sse4, InstructionSet::avx2,
                               InstructionSet::avx512, InstructionSet::neon}) {
            if (isAvailable(set))
                here.push_back(set);
            else
                std::cout << "[ not here ] no " << nameOf(set) << " in this program on this processor\n";
        }
        return here;
    }();
    return sets;
}

/// A test that is run once per set.
class OnEachSet : public ::testing::TestWithParam<InstructionSet> {};
inline auto eachSet() { return ::testing::ValuesIn(runnableSets()); }
inline std::string setName(const ::testing::TestParamInfo<InstructionSet>& info) {
    return std::string{nameOf(info.param)};
}

} // namespace test
} // namespace physvib
